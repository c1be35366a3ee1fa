#include "paper_look.h"

#include "figures.h"

#include "sigmascape/receiver/ground_accumulator.h"

namespace sigmascape::bench {
namespace {

bake::BakeSettings settings_for(bool whole, unsigned threads) {
  bake::BakeSettings settings;
  settings.patches.texels_per_side = whole ? 512 : 256;
  settings.threads = threads;
  return settings;
}

void append_power(const Array2D<radar::Channels>& sigma0, std::vector<float>& power) {
  for (const radar::Channels& texel : sigma0.values()) power.push_back(texel.power(radar::Polarization::Sum));
}

/// Notes what has passed since it was made.
class Watch {
 public:
  void stop(TimedLook& look) const {
    look.processor_seconds += processor_seconds() - processor_;
    look.wall_seconds += wall_seconds() - wall_;
  }

 private:
  double processor_ = processor_seconds();
  double wall_ = wall_seconds();
};

}  // namespace

PaperLooks::PaperLooks(const scene::Scene& scene, bool whole, unsigned threads)
    : scene_(scene),
      settings_(settings_for(whole, threads)),
      patches_(whole ? settings_.patches.covering(scene.extent) : std::vector<atlas::PatchIndex>{{0, 0}}),
      geometry_(scene, trace::Footing::LevelPlane),
      surfaces_(trace::surface_models(scene, settings_.aspects.frequencies_hz)) {}

TimedLook PaperLooks::plain(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed) const {
  constexpr double margin_m = 32.0;
  TimedLook look;
  for (const atlas::PatchIndex patch : patches_) {
    const Watch watch;
    const radar::GroundGrid texels = settings_.patches.texels_of(patch);
    const auto viewpoint = trace::Viewpoint::distant(aspect);
    const trace::PathTracer tracer(
        geometry_, surfaces_, viewpoint,
        {.estimator = trace::Estimator::OneWay, .roulette = false, .sampler = trace::Sampler::Independent}, seed);
    const auto area =
        trace::launch_area(viewpoint, texels.extent(), texels.cell_m, 0.0, geometry_.highest_m() + 1.0, margin_m);
    receiver::GroundAccumulator accumulator(texels, aspect);
    look.counts += tracer.trace(area, {0, samples, samples}, settings_.threads,
                                [&](std::span<const radar::Echo> echoes, unsigned) { accumulator.add(echoes); });
    const auto sigma0 = accumulator.sigma0();
    watch.stop(look);
    append_power(sigma0, look.power);
  }
  return look;
}

TimedLook PaperLooks::ours(const radar::Aspect& aspect, const bake::Sampling& sampling, std::uint64_t seed) const {
  bake::BakeSettings settings = settings_;
  settings.sampling = sampling;
  settings.seed = seed;
  const bake::LookBaker baker(scene_, settings);
  TimedLook look;
  SilentProgress silent;
  for (const atlas::PatchIndex patch : patches_) {
    const Watch watch;
    const auto baked = baker.bake(patch, aspect, silent);
    watch.stop(look);
    look.counts += baked.front().counts;
    append_power(baked.front().sigma0, look.power);
  }
  return look;
}

}  // namespace sigmascape::bench
