#include "sigmascape/simulate/mode_image.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/azimuth_text.h"
#include "sigmascape/radar/coherent_warnings.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/simulate/map_provenance.h"
#include "sigmascape/simulate/scatterer_spacing.h"
#include "sigmascape/simulate/targets_seen.h"

namespace sigmascape::simulate {
namespace {

Vec3d middle_of(const radar::GroundGrid& grid, const terrain::HeightField& terrain) {
  const Vec2d centre = grid.extent().centre();
  return {centre.x, centre.y, terrain.height_at(centre)};
}

/// Over the ground from where ranges count to the nearest edge of the area, from outside or within: from the radar's
/// foot, of a strip from the line below the flight.
double nearest_edge_m(const radar::Radar& radar, const radar::Rectangle& area) {
  const Vec2d foot{radar.position.x, radar.position.y};
  if (radar.mode != radar::Mode::Stripmap) {
    if (!area.contains(foot)) return radar::nearest_m(area, foot);
    return std::min({foot.x - area.west_m, area.east_m - foot.x, foot.y - area.south_m, area.north_m - foot.y});
  }
  const Vec2d course{radar.velocity_mps.x, radar.velocity_mps.y};
  const Vec2d beside = Vec2d{course.y, -course.x} * (1.0 / length(course));
  const auto [left_m, right_m] = radar::span_over(area, [&](Vec2d place) { return dot(place - foot, beside); });
  return std::min(std::abs(left_m), std::abs(right_m));
}

/// By how much the ground that answers in a map's outermost cells reaches beyond them along range: two resolution
/// cells, and where a step of slant range is long on the ground as far as that many of slant range reach.
double range_rim_m(const radar::Radar& radar, const radar::Rectangle& map, double below_m) {
  const double edge_m = nearest_edge_m(radar, map), range_m = std::hypot(edge_m, below_m);
  const auto ground_m = [below_m](double of_range_m) {
    return radar::distance_of_range_m(radar::CurvedEarth::flat(), below_m, 0.0, std::max(of_range_m, 0.0));
  };
  const double spare_m = 2.0 * radar.range_resolution_m;
  return std::max({spare_m, edge_m - ground_m(range_m - spare_m), ground_m(range_m + spare_m) - edge_m});
}

/// What the makers of images ask for.
struct Prepared {
  CoherentScene scene;
  CoherentSettings settings;
  radar::Rectangle area;
};

Prepared prepared(const ModeRequest& request, const radar::CoherentPlan& plan) {
  const radar::Radar& radar = request.radar;
  request.atlas.check_frequency(request.texture_frequency_hz);
  const double of_all_looks_m = plan.along_resolution_m / plan.looks;
  const double spacing_m = scatterer_spacing_m(radar, of_all_looks_m);
  const double level = std::max(request.level_of_detail - 1.0, request.atlas.level_for(spacing_m));
  return {.scene = {&request.terrain, render::AtlasReflectivity{&request.atlas, request.texture_frequency_hz, level},
                    request.targets, request.windblown},
          .settings = {.interval_s = plan.interval_s,
                       .along_resolution_m = of_all_looks_m,
                       .scatterer_spacing_m = spacing_m,
                       .seed = request.seed,
                       .dwell = request.dwell,
                       .moment_s = request.moment_s,
                       .mapped = request.grid.extent(),
                       .threads = request.threads},
          .area = answering_area(radar, plan, request.grid.extent(), middle_of(request.grid, request.terrain).z)};
}

}  // namespace

radar::Rectangle answering_area(const radar::Radar& radar, const radar::CoherentPlan& plan, const radar::Rectangle& map,
                                double height_m) {
  const double along_range_m = range_rim_m(radar, map, radar.position.z - height_m);
  if (radar.mode == radar::Mode::Stripmap)
    return radar::widened(map, std::max(along_range_m, 2.0 * plan.along_resolution_m));
  return radar::widened(radar::answering_ground(radar, plan, map, height_m), along_range_m);
}

ModePlan mode_plan(const ModeRequest& request) {
  const Vec3d aim = middle_of(request.grid, request.terrain);
  ModePlan planned{.plan = radar::coherent_plan(request.radar, aim), .warnings = {}};
  planned.warnings = radar::plan_warnings(request.radar, planned.plan, request.grid.extent(), aim.z);
  if (auto warning =
          radar::narrower_than_cells("the image across range", planned.plan.along_resolution_m, request.grid.cell_m))
    planned.warnings.push_back(*std::move(warning));
  TargetsSeen seen = targets_in_map(request.targets, request.radar, request.grid.extent(), request.terrain,
                                    obstacles_of(request.atlas));
  std::ranges::move(seen.warnings, std::back_inserter(planned.warnings));
  planned.targets_seen = seen.count;
  return planned;
}

void mode_looks(const ModeRequest& request, const radar::CoherentPlan& plan,
                const std::function<void(const ModeImage&)>& visit) {
  const Prepared ready = prepared(request, plan);
  const auto looks = static_cast<std::size_t>(plan.looks);
  if (request.radar.mode == radar::Mode::Stripmap)
    return stripmap_looks(ready.scene, request.radar, ready.area, ready.settings, looks, visit);
  return range_doppler_looks(ready.scene, request.radar, ready.area, ready.settings, looks, visit);
}

ModeImage mode_image(const ModeRequest& request, const radar::CoherentPlan& plan) {
  const Prepared ready = prepared(request, plan);
  if (request.radar.mode == radar::Mode::Stripmap)
    return stripmap_image(ready.scene, request.radar, ready.area, ready.settings);
  return range_doppler_image(ready.scene, request.radar, ready.area, ready.settings);
}

std::map<std::string, std::string> source_of(const ModeRequest& request, const ModePlan& planned) {
  std::map<std::string, std::string> words{
      {"processing", fmt::format("level of detail {}: coherent, from terrain and atlas", request.level_of_detail)},
      {"mode", std::string(radar::mode_word(request.radar.mode))},
      {"look_side", look_side(request.radar, request.grid.extent())},
      {"antenna_pattern", request.radar.processing.antenna_pattern ? "left in" : "none"},
      {"thermal_noise", request.radar.processing.thermal_noise ? "in it" : "none"},
      {"wind_mps", fmt::format("{:g}", request.windblown ? request.radar.wind_mps : 0.0)},
      {"targets", std::to_string(request.targets.size())},
      {"targets_seen", std::to_string(planned.targets_seen)},
      {"seed", std::to_string(request.seed)},
      {"dwell", std::to_string(request.dwell)}};
  tell_of_frequency(request.radar, request.texture_frequency_hz, words);
  return words;
}

std::map<std::string, double> numbers_of_one_look(const radar::CoherentPlan& plan) {
  return {{"interval_s", plan.interval_s},
          {"looks", 1.0},
          {"along_resolution_m", plan.along_resolution_m / plan.looks},
          {"angle_off_course_deg", deg_from_radians(plan.squint_rad)}};
}

std::map<std::string, std::string> provenance_of(const ModeRequest& request, const ModePlan& planned) {
  const radar::CoherentPlan& plan = planned.plan;
  std::map<std::string, std::string> words = source_of(request, planned);
  words["interval_s"] = fmt::format("{:.6g}", plan.interval_s);
  words["looks"] = std::to_string(plan.looks);
  words["along_resolution_m"] = fmt::format("{:.4g}", plan.along_resolution_m);
  words["angle_off_course_deg"] = fmt::format("{:.4g}", deg_from_radians(plan.squint_rad));
  if (const auto azimuth_rad = beam_azimuth_rad(request.radar, request.grid.extent()))
    words["beam_azimuth_deg"] = radar::azimuth_text_deg(*azimuth_rad, 3);
  if (request.radar.earth_refraction)
    words["earth_refraction"] = fmt::format("{:.6g}", *request.radar.earth_refraction);
  return words;
}

}  // namespace sigmascape::simulate
