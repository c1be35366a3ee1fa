#include "sigmascape/bake/bake.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/atlas/store.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/receiver/ground_accumulator.h"
#include "sigmascape/trace/simd_setting.h"
#include "sigmascape/trace/tile_progress.h"

namespace sigmascape::bake {
namespace {

/// How far around a patch paths of several bounces may begin that land in it: between their ends.
constexpr double multibounce_margin_m = 32.0;

void check(const BakeSettings& settings) {
  const std::string where = "bake settings";
  if (settings.samples_per_texel < 2 || settings.samples_per_texel > (1U << 24U)) {
    throw Error(where, fmt::format("{} samples a texel", settings.samples_per_texel), "use 2 to 16777216");
  }
  if (settings.max_bounces < 1 || settings.max_bounces > 64) {
    throw Error(where, fmt::format("{} bounces", settings.max_bounces), "use 1 to 64");
  }
  for (const double elevation : settings.aspects.elevations_rad) {
    const double degrees = deg_from_radians(elevation);
    if (!(degrees >= 0.5 && degrees <= 89.0)) {
      throw Error(where, fmt::format("an elevation of {:.2f}°", degrees),
                  "use 0.5° to 89°: a level plane is not lit at 0° and has no ground range at 90°");
    }
  }
}

atlas::AtlasDescription description_of(const scene::Scene& scene, const BakeSettings& settings) {
  return {.name = scene.name,
          .frame = scene.frame,
          .extent = scene.extent,
          .patches = settings.patches,
          .aspects = settings.aspects,
          .scene_hash = scene::scene_hash(scene),
          .settings = {{"samples_per_texel", std::to_string(settings.samples_per_texel)},
                       {"max_bounces", std::to_string(settings.max_bounces)},
                       {"seed", std::to_string(settings.seed)},
                       {"simd", trace::simd_setting()}},
          .mantissa_bits = settings.mantissa_bits,
          .attribution = scene.attribution};
}

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

/// Bakes the looks of one scene, one (patch, look) at a time.
class Baker {
 public:
  Baker(const scene::Scene& scene, const BakeSettings& settings, const atlas::Store& store)
      : scene_(scene), settings_(settings), store_(store), geometry_(scene, trace::Footing::LevelPlane) {}

  /// Bakes look number `index` of `count`.
  void bake_unit(const atlas::Unit& unit, std::size_t index, std::size_t count, BakeReport& report,
                 ProgressListener& progress) {
    const radar::Look look = settings_.aspects.look(unit.look);
    const radar::GroundGrid texels = settings_.patches.texels_of(unit.patch);
    const auto viewpoint = trace::Viewpoint::distant(look.aspect);
    const trace::PathTracer tracer(geometry_, trace::surface_models(scene_, look.frequency_hz), viewpoint,
                                   {.max_bounces = settings_.max_bounces}, settings_.seed);
    // The scene ends where its extent does; beyond a rim about it texels stay black.
    const auto area =
        trace::launch_area(viewpoint, intersection(texels.extent(), scene_.extent), settings_.patches.texel_m, 0.0,
                           geometry_.highest_m() + 1.0, multibounce_margin_m);

    receiver::GroundAccumulator accumulator(texels, look.aspect);
    // Every tile is traced twice, half of its samples at a time.
    trace::TileProgress tiles(progress, "bake", "looks", static_cast<double>(index), static_cast<double>(index + 1),
                              static_cast<double>(count), 2 * area.tiles());
    const auto trace_samples = [&](std::uint32_t first, std::uint32_t samples) {
      report.counts += tracer.trace(area, {first, samples, settings_.samples_per_texel}, settings_.threads,
                                    [&](std::span<const radar::Echo> echoes, unsigned worker) {
                                      accumulator.add(echoes);
                                      tiles.tile_done(worker);
                                    });
    };
    const std::uint32_t half = settings_.samples_per_texel / 2;
    trace_samples(0, half);
    const auto first_half = accumulator.sigma0();
    trace_samples(half, settings_.samples_per_texel - half);
    if (accumulator.bins().overflows() > 0) {
      throw Error("bake of patch " + store_.texture_path(unit.patch, unit.look).string(),
                  "a texel is brighter than the sums can hold", "use a smaller texel or a rougher material");
    }
    const auto sigma0 = accumulator.sigma0();
    const double error = relative_error(first_half, sigma0, static_cast<double>(half) / settings_.samples_per_texel);
    store_.write(unit.patch, unit.look, sigma0,
                 {.seed = settings_.seed,
                  .samples_per_texel = settings_.samples_per_texel,
                  .relative_standard_error = error,
                  .simd = trace::simd_setting(),
                  .counts = {}});
    squared_errors_ += error * error;
    ++baked_;
  }

  [[nodiscard]] double mean_error() const {
    return baked_ > 0 ? std::sqrt(squared_errors_ / static_cast<double>(baked_)) : 0.0;
  }
  [[nodiscard]] std::size_t geometry_bytes() const { return geometry_.memory_bytes(); }

 private:
  const scene::Scene& scene_;
  const BakeSettings& settings_;
  const atlas::Store& store_;
  trace::SceneGeometry geometry_;
  double squared_errors_ = 0.0;
  std::size_t baked_ = 0;
};

}  // namespace

BakeReport bake(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder,
                ProgressListener& progress) {
  check(settings);
  const atlas::Store store = atlas::Store::create(folder, description_of(scene, settings));
  Baker baker(scene, settings, store);

  BakeReport report;
  const auto units = store.units();
  report.looks = units.size();
  report.geometry_bytes = baker.geometry_bytes();
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (store.is_done(units[i].patch, units[i].look)) {
      ++report.already;
    } else {
      baker.bake_unit(units[i], i, units.size(), report, progress);
    }
    progress.advanced("bake", static_cast<double>(i + 1), static_cast<double>(units.size()), "looks");
  }
  report.relative_standard_error = baker.mean_error();
  return report;
}

}  // namespace sigmascape::bake
