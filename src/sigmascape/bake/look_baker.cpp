#include "sigmascape/bake/look_baker.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/receiver/ground_accumulator.h"
#include "sigmascape/trace/tile_progress.h"

namespace sigmascape::bake {
namespace {

/// How far around a patch paths of several bounces may begin that land in it: between their ends.
constexpr double multibounce_margin_m = 32.0;

radar::Rectangle intersection(const radar::Rectangle& a, const radar::Rectangle& b) {
  return {std::max(a.west_m, b.west_m), std::max(a.south_m, b.south_m), std::min(a.east_m, b.east_m),
          std::min(a.north_m, b.north_m)};
}

/// Relative standard error of a texel's total power from the sums over the first `share` of its samples and over all of
/// them, root mean square over the texels that answer at all: (S₁ − pS)² / (p (1 − p)) has the variance of S for its
/// mean.
double relative_error(const Array2D<radar::Channels>& first_part, const Array2D<radar::Channels>& whole, double share) {
  double sum = 0.0;
  std::size_t lit = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double total = whole.values()[i].power(radar::Polarization::Sum);
    if (total <= 0.0) continue;
    const double deviation = first_part.values()[i].power(radar::Polarization::Sum) / total - share;
    sum += deviation * deviation / (share * (1.0 - share));
    ++lit;
  }
  return lit > 0 ? std::sqrt(sum / static_cast<double>(lit)) : 0.0;
}

/// All echoes but the ground's direct ones.
std::vector<radar::Echo> without_ground(std::span<const radar::Echo> echoes) {
  std::vector<radar::Echo> kept;
  std::ranges::copy_if(echoes, std::back_inserter(kept), [](const radar::Echo& echo) { return !echo.from_ground; });
  return kept;
}

}  // namespace

LookBaker::LookBaker(const scene::Scene& scene, const BakeSettings& settings)
    : scene_(scene), settings_(settings), geometry_(scene, trace::Footing::LevelPlane) {
  for (const double frequency_hz : settings.aspects.frequencies_hz) {
    surfaces_.push_back(trace::surface_models(scene, frequency_hz));
  }
}

std::vector<BakedLook> LookBaker::bake(atlas::PatchIndex patch, const radar::Aspect& aspect,
                                       ProgressListener& progress) const {
  std::vector<BakedLook> looks;
  for (std::size_t frequency = 0; frequency < surfaces_.size(); ++frequency) {
    looks.push_back(bake_frequency(patch, aspect, frequency, progress));
  }
  return looks;
}

BakedLook LookBaker::bake_frequency(atlas::PatchIndex patch, const radar::Aspect& aspect, std::size_t frequency,
                                    ProgressListener& progress) const {
  const radar::GroundGrid texels = settings_.patches.texels_of(patch);
  const auto viewpoint = trace::Viewpoint::distant(aspect);
  const trace::PathTracer tracer(geometry_, surfaces_[frequency], viewpoint, {.max_bounces = settings_.max_bounces},
                                 settings_.seed);
  // The scene ends where its extent does; beyond a rim about it texels stay black.
  const auto area =
      trace::launch_area(viewpoint, intersection(texels.extent(), scene_.extent), settings_.patches.texel_m, 0.0,
                         geometry_.highest_m() + 1.0, multibounce_margin_m);

  BakedLook look;
  receiver::GroundAccumulator accumulator(texels, aspect);
  // Every tile is traced twice, half of its samples at a time.
  const auto frequencies = static_cast<double>(surfaces_.size());
  trace::TileProgress tiles(progress, "bake", "look", static_cast<double>(frequency) / frequencies,
                            static_cast<double>(frequency + 1) / frequencies, 1.0, 2 * area.tiles());
  const auto trace_samples = [&](std::uint32_t first, std::uint32_t samples) {
    look.counts += tracer.trace(area, {first, samples, settings_.samples_per_texel}, settings_.threads,
                                [&](std::span<const radar::Echo> echoes, unsigned worker) {
                                  if (settings_.shadows == Shadows::RunTime) {
                                    accumulator.add(without_ground(echoes));
                                  } else {
                                    accumulator.add(echoes);
                                  }
                                  tiles.tile_done(worker);
                                });
  };
  const std::uint32_t half = settings_.samples_per_texel / 2;
  trace_samples(0, half);
  const auto first_half = accumulator.sigma0();
  trace_samples(half, settings_.samples_per_texel - half);
  if (accumulator.bins().overflows() > 0) {
    throw Error(fmt::format("bake of patch ({}, {}), azimuth {:.1f}°, elevation {:.1f}°", patch.x, patch.y,
                            deg_from_radians(aspect.azimuth_rad), deg_from_radians(aspect.elevation_rad)),
                "a texel is brighter than the sums can hold", "use a smaller texel or a rougher material");
  }
  look.sigma0 = accumulator.sigma0();
  look.relative_standard_error =
      relative_error(first_half, look.sigma0, static_cast<double>(half) / settings_.samples_per_texel);
  return look;
}

}  // namespace sigmascape::bake
