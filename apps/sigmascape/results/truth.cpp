#include "results/truth.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "map_files.h"

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/base/processor_stopwatch.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"
#include "sigmascape/trace/simd_setting.h"

namespace sigmascape::cli {
namespace {

constexpr const char* truth_settings_key = "truth_settings";
constexpr const char* samples_key = "truth_samples_per_cell";
constexpr const char* trace_seconds_key = "trace_seconds";

constexpr std::uint64_t first_seed = 1001, second_seed = 1002;

/// All that decides a map but the number of its rays.
std::string settings_text(const MeasuredScene& measured, const PlannedView& view, const ResultsPlan& plan,
                          std::uint64_t seed) {
  return fmt::format("scene {}{}, azimuth {} deg, elevation {} deg, {} km, {} bounces, seed {}, {}, physics {}",
                     scene::scene_hash(measured.scene), scene::targets_hash(measured.scene), view.azimuth_deg,
                     view.elevation_deg, view.slant_range_m / 1e3, plan.bounces, seed, trace::simd_setting(),
                     bake::physics_revision);
}

std::filesystem::path map_file(const MeasuredScene& measured, const PlannedView& view, std::uint64_t seed,
                               const std::filesystem::path& folder) {
  return folder / fmt::format("{}_{}_seed{}.tif", measured.name, view.file_name(), seed);
}

radar::GroundMap traced(const MeasuredScene& measured, const PlannedView& view, const ResultsPlan& plan,
                        std::uint32_t samples, std::uint64_t seed) {
  const scene::Scene& scene = measured.scene;
  const radar::RadarFile file = view.radar();
  const auto radar = simulate::placed_radar(file, scene.frame, scene.terrain, scene.extent);
  const auto grid = simulate::map_grid(file.map, scene.extent);
  const ProcessorStopwatch watch;
  const auto image = traced_image(measured, radar, grid, plan, samples, seed);
  return described_map(image, radar, scene.terrain, grid, scene.frame,
                       {{"scene", scene.name},
                        {"processing", "level of detail 0: path-traced"},
                        {truth_settings_key, settings_text(measured, view, plan, seed)},
                        {samples_key, std::to_string(samples)},
                        {trace_seconds_key, fmt::format("{:.3f}", watch.seconds())}});
}

/// The map of any number of rays in that file when it is of those settings.
std::optional<radar::GroundMap> kept_map(const std::filesystem::path& path, const std::string& settings) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  radar::GroundMap map = product::read_ground_map(path);
  const auto kept = map.metadata.find(truth_settings_key);
  if (kept == map.metadata.end() || kept->second != settings || !map.metadata.contains(samples_key) ||
      !map.metadata.contains(trace_seconds_key))
    return std::nullopt;
  return map;
}

std::uint32_t samples_of(const radar::GroundMap& map) {
  return static_cast<std::uint32_t>(std::stoul(map.metadata.at(samples_key)));
}

/// The map that both make together when each has so many rays.
radar::GroundMap mean_of(const radar::GroundMap& a, std::uint32_t rays_of_a, const radar::GroundMap& b,
                         std::uint32_t rays_of_b) {
  const float part_of_b = static_cast<float>(rays_of_b) / static_cast<float>(rays_of_a + rays_of_b);
  radar::GroundMap mean = a;
  for (std::size_t i = 0; i < mean.sigma0.size(); ++i)
    mean.sigma0.values()[i] = a.sigma0.values()[i] * (1.0F - part_of_b) + b.sigma0.values()[i] * part_of_b;
  return mean;
}

double seconds_of(const radar::GroundMap& map) {
  return std::stod(map.metadata.at(trace_seconds_key));
}

/// The map `kept` with as many rays more as the view still wants. These have a seed of their own, which keeps the two
/// maps of a view apart: one has odd seeds, the other even ones.
radar::GroundMap traced_on(const radar::GroundMap& kept, const MeasuredScene& measured, const PlannedView& view,
                           const ResultsPlan& plan, std::uint64_t seed) {
  const std::uint32_t before = samples_of(kept);
  const std::uint32_t more = view.traced_samples - before;
  const radar::GroundMap added = traced(measured, view, plan, more, seed + 2 * std::uint64_t{before});
  radar::GroundMap map = mean_of(kept, before, added, more);
  map.metadata[samples_key] = std::to_string(view.traced_samples);
  map.metadata[trace_seconds_key] = fmt::format("{:.3f}", seconds_of(kept) + seconds_of(added));
  return map;
}

radar::GroundMap traced_or_kept(const MeasuredScene& measured, const PlannedView& view, const ResultsPlan& plan,
                                std::uint64_t seed, const std::filesystem::path& folder) {
  const auto path = map_file(measured, view, seed, folder);
  auto kept = kept_map(path, settings_text(measured, view, plan, seed));
  if (kept && samples_of(*kept) == view.traced_samples) return *std::move(kept);
  // A better map stays where it is.
  if (kept && samples_of(*kept) > view.traced_samples) return traced(measured, view, plan, view.traced_samples, seed);
  product::write_map(path, kept ? traced_on(*kept, measured, view, plan, seed)
                                : traced(measured, view, plan, view.traced_samples, seed));
  // Read back, so that a run that traces and one that finds the map hold the same.
  return product::read_ground_map(path);
}

}  // namespace

radar::RangeAzimuthImage traced_image(const MeasuredScene& measured, const radar::Radar& radar,
                                      const radar::GroundGrid& grid, const ResultsPlan& plan, std::uint32_t samples,
                                      std::uint64_t seed) {
  trace::TraceCounts counts;
  return simulate::traced_image(measured.scene, measured.geometry, radar, grid.extent(),
                                {.cell_m = grid.cell_m,
                                 .samples_per_cell = samples,
                                 .max_bounces = plan.bounces,
                                 .seed = seed,
                                 .threads = plan.threads},
                                counts);
}

scene::Scene levelled(scene::Scene scene) {
  for (float& height_m : scene.terrain.height_m.values()) height_m = 0.0F;
  for (scene::Building& building : scene.buildings.items) building.footing_m = 0.0F;
  scene.name += ", levelled";
  return scene;
}

std::uint32_t samples_kept(const MeasuredScene& measured, const PlannedView& view, const ResultsPlan& plan,
                           const std::filesystem::path& folder) {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  for (const std::uint64_t seed : {first_seed, second_seed}) {
    const auto kept = kept_map(map_file(measured, view, seed, folder), settings_text(measured, view, plan, seed));
    fewest = std::min(fewest, kept ? samples_of(*kept) : 0U);
  }
  return fewest;
}

Truth traced_truth(const MeasuredScene& measured, const PlannedView& view, const ResultsPlan& plan,
                   const std::filesystem::path& folder) {
  Truth truth{.first = traced_or_kept(measured, view, plan, first_seed, folder),
              .second = traced_or_kept(measured, view, plan, second_seed, folder),
              .mean = {}};
  truth.mean = mean_of(truth.first, 1, truth.second, 1);
  truth.trace_seconds = (seconds_of(truth.first) + seconds_of(truth.second)) / 2.0;
  return truth;
}

}  // namespace sigmascape::cli
