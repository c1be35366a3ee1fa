#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/sample_maker.h"
#include "sigmascape/dataset/sample_radar.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/trace/path_tracer.h"

// What a specification asks that its scene and its atlas do not have.

namespace sigmascape::dataset {
namespace {

/// How far above the highest thing the radar must stand.
constexpr double clearance_m = 2.0;
/// By how much the rounding of degrees may lead out of an atlas.
constexpr double slack_rad = 1e-9;

double half_diagonal_m(const DatasetSpec& spec) {
  return static_cast<double>(spec.cells) * spec.cell_m / std::sqrt(2.0);
}

}  // namespace

/// Labels of classes are bytes.
void SampleMaker::check_classes() const {
  const std::size_t classes = simulate::class_names(scene_).size();
  if (classes <= 256 || std::ranges::find(spec_.layers, simulate::LayerKind::Class) == spec_.layers.end()) return;
  throw Error(spec_.file.string() + ": dataset.layers",
              fmt::format("asks for class, and the scene has {} classes, where files hold 256", classes),
              "leave it out, or give the scene fewer materials");
}

void SampleMaker::check_radars() const {
  const auto& drawn = spec_.radar_ranges.frequency_hz;
  if (!atlas_) {
    if (drawn) check_materials(*drawn);
    return;
  }
  if (!drawn) return atlas_->check_frequency(spec_.radar.radar.frequency_hz);
  const auto& baked = atlas_->aspects().frequencies_hz;
  constexpr double slack = 1.01;
  if (drawn->lowest * slack < baked.front() || drawn->highest > baked.back() * slack) {
    throw Error(spec_.file.string() + ": radar.frequency_ghz",
                fmt::format("leads outside the atlas, which was baked from {:g} to {:g} GHz", baked.front() / 1e9,
                            baked.back() / 1e9),
                "stay within these, or bake more frequencies");
  }
}

/// What a material is not known for is said at once, not by the first sample that comes to it.
void SampleMaker::check_materials(const Range& frequencies_hz) const {
  try {
    static_cast<void>(trace::surface_models(scene_, std::array{frequencies_hz.lowest, frequencies_hz.highest}));
  } catch (const Error& unknown) {
    throw Error(spec_.file.string() + ": radar.frequency_ghz", "leads to where the scene is not known", unknown.what());
  }
}

void SampleMaker::check_views() const {
  const std::string file = spec_.file.string();
  if (atlas_) {
    const auto& baked = atlas_->aspects().elevations_rad;
    if (spec_.elevation_rad.lowest < baked.front() - slack_rad ||
        spec_.elevation_rad.highest > baked.back() + slack_rad) {
      throw Error(file + ": view.elevation_deg",
                  fmt::format("leads outside the atlas, which was baked from {:.6g} to {:.6g} degrees",
                              deg_from_radians(baked.front()), deg_from_radians(baked.back())),
                  "stay within these, or bake more elevations");
    }
  }
  const double highest_m = scene_.terrain.highest_m() + static_cast<float>(scene::tallest_object_m(scene_));
  const double least_altitude_m =
      scene_.terrain.lowest_m() + spec_.slant_range_m.lowest * std::sin(spec_.elevation_rad.lowest);
  if (least_altitude_m < highest_m + clearance_m) {
    throw Error(file + ": view.slant_range_km",
                fmt::format("lets the radar stand at {:.0f} m, and the scene reaches up to {:.0f} m", least_altitude_m,
                            highest_m),
                "begin the range further out, or the elevation higher");
  }
  if (spec_.slant_range_m.lowest * std::cos(spec_.elevation_rad.highest) < half_diagonal_m(spec_)) {
    throw Error(file + ": view.slant_range_km", "lets the radar stand over the map", "begin the range further out");
  }
}

/// A gate that is open to some of the maps is warned of where it is shut (dataset_warnings.h).
void SampleMaker::check_gate() const {
  const auto &first_m = spec_.radar.radar.receiver.first_range_m, &last_m = spec_.radar.radar.receiver.last_range_m;
  constexpr double never = std::numeric_limits<double>::infinity();
  const double unambiguous_m = radar::unambiguous_range_m(spec_.radar.radar.waveform.pulse_repetition_hz);
  const double opens_m = first_m.value_or(0.0);
  const double closes_m = std::min(last_m.value_or(never), first_m ? opens_m + unambiguous_m : never);
  const double flown_m =
      spec_.sequence.speed_mps.highest * spec_.sequence.interval_s * static_cast<double>(spec_.sequence.frames - 1);
  const double relief_m = scene_.terrain.highest_m() - scene_.terrain.lowest_m();
  const double about_m = flown_m + std::hypot(half_diagonal_m(spec_), relief_m);
  const double nearest_m = std::max(0.0, spec_.slant_range_m.lowest - about_m);
  const double farthest_m = spec_.slant_range_m.highest + about_m;
  if (opens_m <= farthest_m && closes_m >= nearest_m) return;
  throw Error(spec_.file.string() + ": view.slant_range_km",
              fmt::format("leads to maps from {:.5g} to {:.5g} km away, and the radar file's range gate is open from "
                          "{:.5g} to {:.5g} km",
                          nearest_m / 1e3, farthest_m / 1e3, opens_m / 1e3, closes_m / 1e3),
              "stay where the gate is open, or move it by receiver.first_range_km and last_range_km");
}

void SampleMaker::check_flights() const {
  const std::size_t frames = spec_.sequence.frames;
  if (!flies(spec_.sequence)) return;
  for (std::size_t first = 0; first < spec_.count; first += frames) {
    Interruption::heed();
    const SamplePlan begin = plan_of(spec_, centres_, first);
    // Level flight: the middle of the map is seen steepest from the frame that is nearest to it, flattest from an end.
    check_frame(plan_of(spec_, centres_, first + nearest_frame(spec_, begin, scene_.terrain)));
    check_frame(plan_of(spec_, centres_, first + frames - 1));
  }
}

void SampleMaker::check_frame(const SamplePlan& plan) const {
  const Vec3d to_radar = radar_of(spec_, plan, scene_.terrain).position - middle_of(plan, scene_.terrain);
  const double distance_m = length(Vec2d{to_radar.x, to_radar.y});
  const std::string where = spec_.file.string() + ": sequence.speed_mps";
  if (distance_m < half_diagonal_m(spec_)) {
    throw Error(where,
                fmt::format("takes the radar over the map, in frame {} of sequence {}", plan.frame, plan.sequence),
                "fly less far by fewer frames, a shorter interval or less speed, or begin further out");
  }
  if (!atlas_) return;
  const double elevation_rad = std::atan2(to_radar.z, distance_m);
  const auto& baked = atlas_->aspects().elevations_rad;
  if (elevation_rad >= baked.front() - slack_rad && elevation_rad <= baked.back() + slack_rad) return;
  throw Error(
      where,
      fmt::format("leads outside the atlas, which was baked from {:.2f} to {:.2f} degrees: frame {} of sequence {} "
                  "is seen under {:.2f}",
                  deg_from_radians(baked.front()), deg_from_radians(baked.back()), plan.frame, plan.sequence,
                  deg_from_radians(elevation_rad)),
      "fly less far, keep view.elevation_deg from the ends of the atlas, or bake more elevations");
}

}  // namespace sigmascape::dataset
