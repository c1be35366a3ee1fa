#include "paper_look.h"

#include <algorithm>
#include <cmath>

#include "figures.h"

#include "sigmascape/bake/echo_landing.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/receiver/ground_accumulator.h"

namespace sigmascape::bench {
namespace {

bake::BakeSettings settings_for(unsigned threads) {
  bake::BakeSettings settings;
  settings.threads = threads;
  settings.shadows = bake::Shadows::Baked;
  return settings;
}

/// Over the whole scene the textures of the paper: 1024² texels. Its corner lies on the lattice.
radar::GroundGrid texels_over(const radar::Rectangle& extent, double texel_m) {
  const auto columns = static_cast<std::size_t>(std::round(extent.width_m() / texel_m));
  const auto rows = static_cast<std::size_t>(std::round(extent.height_m() / texel_m));
  return {extent.west_m, extent.north_m, texel_m, columns, rows};
}

/// Whether the lot of its block fell on the tile that begins with this cell.
bool is_drawn(const trace::LaunchCell& first, int thinning) {
  const auto tile_of = [](std::int32_t cell) {
    return (cell - (cell & (trace::tile_side_cells - 1))) / trace::tile_side_cells;
  };
  const int i = tile_of(first.i) + 4096 * thinning, j = tile_of(first.j) + 4096 * thinning;
  const std::uint64_t lot =
      hashed(11, static_cast<std::uint32_t>(i / thinning), static_cast<std::uint32_t>(j / thinning)) %
      static_cast<std::uint64_t>(thinning * thinning);
  return static_cast<std::uint64_t>((j % thinning) * thinning + i % thinning) == lot;
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

PaperLooks::PaperLooks(const scene::Scene& scene, int thinning, unsigned threads)
    : PaperLooks(scene, scene.extent, thinning, threads) {}

PaperLooks::PaperLooks(const scene::Scene& scene, const radar::Rectangle& part, int thinning, unsigned threads)
    : settings_(settings_for(threads)),
      thinning_(thinning),
      texels_(texels_over(part, settings_.patches.texel_m)),
      baker_(std::make_unique<bake::LookBaker>(scene, settings_)),
      surfaces_(trace::surface_models(scene, settings_.aspects.frequencies_hz)) {
  // Is there before anything is timed.
  (void)geometry();
}

trace::LaunchArea PaperLooks::area_of(const radar::Aspect& aspect) const {
  trace::LaunchArea area = baker_->area_of(texels_, aspect);
  std::vector<trace::LaunchCell> drawn;
  for (std::size_t first = 0; first < area.cells.size(); first += trace::cells_per_tile) {
    if (!is_drawn(area.cells[first], thinning_)) continue;
    const auto begin = area.cells.begin() + static_cast<std::ptrdiff_t>(first);
    drawn.insert(drawn.end(), begin, begin + static_cast<std::ptrdiff_t>(trace::cells_per_tile));
  }
  area.cells = std::move(drawn);
  return area;
}

double PaperLooks::part_of(const radar::Aspect& aspect) const {
  return static_cast<double>(area_of(aspect).cells.size()) /
         static_cast<double>(baker_->area_of(texels_, aspect).cells.size());
}

TimedLook PaperLooks::plain(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed) {
  return plain(aspect, samples, seed, settings_.max_bounces);
}

TimedLook PaperLooks::direct(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed) {
  return plain(aspect, samples, seed, 1);
}

TimedLook PaperLooks::plain(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed, int bounces) {
  TimedLook look;
  const auto area = area_of(aspect);
  const Watch watch;
  const trace::PathTracer tracer(baker_->geometry_about(texels_), surfaces_, trace::Viewpoint::distant(aspect),
                                 {.max_bounces = bounces,
                                  .estimator = trace::Estimator::OneWay,
                                  .roulette = false,
                                  .sampler = trace::Sampler::Independent},
                                 seed);
  const bake::EchoLanding landing(aspect);
  receiver::GroundAccumulator accumulator(texels_);
  look.counts =
      tracer.trace(area, {0, samples, samples}, settings_.threads, [&](std::span<const radar::Echo> echoes, unsigned) {
        for (const radar::Echo& echo : echoes) {
          if (const auto texel = accumulator.cell_at(landing.place_of(echo))) accumulator.add(*texel, echo.rcs_m2, 0.0);
        }
      });
  const auto sigma0 = accumulator.sigma0();
  watch.stop(look);
  take_off_what_is_not_due(look, aspect);
  append_power(sigma0, look.power);
  return look;
}

TimedLook PaperLooks::ours(const radar::Aspect& aspect, const bake::Sampling& sampling, std::uint64_t seed) {
  settings_.sampling = sampling;
  settings_.seed = seed;
  SilentProgress silent;
  TimedLook look;
  const auto area = area_of(aspect);
  const Watch watch;
  const auto baked = baker_->bake(texels_, area, aspect, silent);
  watch.stop(look);
  take_off_what_is_not_due(look, aspect);
  look.counts = baked.front().counts;
  append_power(baked.front().sigma0, look.power);
  const auto errors = baked.front().relative_errors.values();
  look.errors.assign(errors.begin(), errors.end());
  return look;
}

TimedLook PaperLooks::shared(const radar::Aspect& aspect, const bake::Sampling& sampling, std::uint64_t seed) {
  settings_.noise = bake::Noise::Shared;
  TimedLook look = ours(aspect, sampling, seed);
  settings_.noise = bake::Noise::Own;
  return look;
}

void PaperLooks::take_off_what_is_not_due(TimedLook& look, const radar::Aspect& aspect) {
  if (thinning_ == 1) return;
  auto area = area_of(aspect);
  area.cells.clear();
  SilentProgress silent;
  TimedLook without_rays;
  const Watch watch;
  const auto baked = baker_->bake(texels_, area, aspect, silent);
  watch.stop(without_rays);
  const double part_not_due = 1.0 - part_of(aspect);
  look.processor_seconds -= part_not_due * without_rays.processor_seconds;
  look.wall_seconds -= part_not_due * without_rays.wall_seconds;
}

}  // namespace sigmascape::bench
