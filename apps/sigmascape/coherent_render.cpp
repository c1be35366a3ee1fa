#include "coherent_render.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <utility>

#include "stopwatch.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/iq_file.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/target_file.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/placement.h"

namespace sigmascape::cli {
namespace {

Vec3d middle_of(const radar::GroundGrid& grid, const terrain::HeightField& terrain) {
  const Vec2d centre = grid.extent().centre();
  return {centre.x, centre.y, terrain.height_at(centre)};
}

/// The map's area and what beside it answers in its outermost cells.
radar::Rectangle with_rim(const radar::Rectangle& area, double rim_m) {
  return {area.west_m - rim_m, area.south_m - rim_m, area.east_m + rim_m, area.north_m + rim_m};
}

Provenance provenance_of(const CoherentRequest& request, const radar::CoherentPlan& plan) {
  return {{"processing", fmt::format("level of detail {}: coherent, from terrain and atlas", request.level_of_detail)},
          {"mode", word_for(request.radar.mode)},
          {"interval_s", fmt::format("{:.6g}", plan.interval_s)},
          {"looks", std::to_string(plan.looks)},
          {"along_resolution_m", fmt::format("{:.4g}", plan.along_resolution_m)},
          {"squint_deg", fmt::format("{:.4g}", deg_from_radians(plan.squint_rad))},
          {"antenna_pattern", request.radar.processing.antenna_pattern ? "left in" : "none"},
          {"thermal_noise", request.radar.processing.thermal_noise ? "in it" : "none"},
          {"wind_mps", fmt::format("{:g}", request.radar.wind_mps)},
          {"targets", std::to_string(request.targets.size())},
          {"seed", std::to_string(request.seed)}};
}

/// The image of all pulses as one look, complex, before it is brought onto the ground.
void write_slant_image(const CoherentRequest& request, const simulate::CoherentScene& seen,
                       const radar::Rectangle& area, const simulate::CoherentSettings& settings, Provenance words) {
  words["looks"] = std::to_string(1);
  words["crs"] = request.scene.frame.proj();
  if (request.radar.mode == radar::Mode::Stripmap) {
    const auto image = simulate::stripmap_image(seen, request.radar, area, settings);
    product::write_iq(request.slant_file, product::iq_record(image, request.radar, std::move(words)));
  } else {
    const auto image = simulate::range_doppler_image(seen, request.radar, area, settings);
    product::write_iq(request.slant_file, product::iq_record(image, request.radar, std::move(words)));
  }
}

}  // namespace

const char* word_for(radar::Mode mode) {
  switch (mode) {
    case radar::Mode::RealBeam:
      return "real-beam";
    case radar::Mode::DopplerBeamSharpening:
      return "doppler-beam-sharpening";
    case radar::Mode::Stripmap:
      return "stripmap";
    case radar::Mode::Spotlight:
      return "spotlight";
  }
  return "";
}

std::vector<radar::Target> placed_targets(const scene::Scene& scene, const std::string& file) {
  return simulate::placed_targets(radar::read_target_file(file), scene.frame, scene.terrain);
}

std::vector<radar::Target> all_targets(const scene::Scene& scene, const std::string& file) {
  auto targets = simulate::targets_of(scene);
  if (file.empty()) return targets;
  for (radar::Target& target : placed_targets(scene, file)) targets.push_back(std::move(target));
  return targets;
}

CoherentMap coherent_map(const CoherentRequest& request) {
  const radar::Radar& radar = request.radar;
  const terrain::HeightField& terrain = request.scene.terrain;
  const Vec3d aim = middle_of(request.grid, terrain);
  const radar::CoherentPlan plan = radar::coherent_plan(radar, aim);
  for (const std::string& warning : radar::plan_warnings(radar, plan, request.grid.extent(), aim.z))
    fmt::print(stderr, "warning: radar {}: {}\n", radar.name, warning);

  request.atlas.check_frequency(request.texture_frequency_hz);
  const auto looks = static_cast<std::size_t>(plan.looks);
  const double of_all_looks_m = plan.along_resolution_m / plan.looks;
  const double finest_m = std::min(radar.range_resolution_m, of_all_looks_m);
  const double level = std::max(request.level_of_detail - 1.0, request.atlas.level_for(finest_m / 2.0));
  const simulate::CoherentScene seen{
      &terrain, render::AtlasReflectivity{&request.atlas, request.texture_frequency_hz, level}, request.targets,
      radar.wind_mps > 0.0 ? simulate::windblown_of(request.scene, request.grid.extent()) : simulate::Windblown{}};
  const simulate::CoherentSettings settings{.interval_s = plan.interval_s,
                                            .along_resolution_m = of_all_looks_m,
                                            .scatterer_spacing_m = finest_m / 2.0,
                                            .seed = request.seed,
                                            .threads = request.threads};
  const radar::Rectangle area =
      with_rim(request.grid.extent(), 2.0 * std::max(radar.range_resolution_m, plan.along_resolution_m));
  const Stopwatch watch;
  CoherentMap made{
      .map = radar.mode == radar::Mode::Stripmap
                 ? product::projected_to_ground(simulate::stripmap_power(seen, radar, area, settings, looks), terrain,
                                                request.grid)
                 : product::projected_to_ground(simulate::range_doppler_power(seen, radar, area, settings, looks),
                                                terrain, request.grid)};
  made.seconds = watch.seconds();
  made.provenance = provenance_of(request, plan);
  if (!request.slant_file.empty()) write_slant_image(request, seen, area, settings, made.provenance);
  made.cost = {{"mode", word_for(radar.mode)},
               {"interval_s", plan.interval_s},
               {"looks", plan.looks},
               {"along_resolution_m", plan.along_resolution_m}};
  return made;
}

}  // namespace sigmascape::cli
