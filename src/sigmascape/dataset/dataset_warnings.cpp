#include "sigmascape/dataset/dataset_warnings.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "sigmascape/base/interruption.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/sample_plan.h"
#include "sigmascape/dataset/sample_radar.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/simulate/map_warnings.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::dataset {
namespace {

/// A sample by how far its radar is from the middle of its map.
struct FarSample {
  SamplePlan plan;
  double slant_range_m = 0.0;
};

/// Those whose radars are nearest and farthest.
class Ends {
 public:
  Ends(const DatasetSpec& spec, const terrain::HeightField& terrain) : spec_(spec), terrain_(terrain) {}

  void add(const SamplePlan& plan) {
    const double range_m = length(radar_of(spec_, plan, terrain_).position - middle_of(plan, terrain_));
    if (!nearest_ || range_m < nearest_->slant_range_m) nearest_ = {plan, range_m};
    if (!farthest_ || range_m > farthest_->slant_range_m) farthest_ = {plan, range_m};
  }
  [[nodiscard]] const FarSample& nearest() const { return *nearest_; }
  [[nodiscard]] const FarSample& farthest() const { return *farthest_; }

 private:
  const DatasetSpec& spec_;
  const terrain::HeightField& terrain_;
  std::optional<FarSample> nearest_, farthest_;
};

/// As flat as can be, where the swath is the longest.
SamplePlan seen_from(double slant_range_m, SamplePlan plan, const DatasetSpec& spec) {
  plan.slant_range_m = slant_range_m;
  plan.elevation_rad = spec.elevation_rad.lowest;
  return plan;
}

SamplePlan with_finest_radar(SamplePlan plan, const RadarRanges& drawn) {
  if (drawn.range_resolution_m) plan.range_resolution_m = drawn.range_resolution_m->lowest;
  if (drawn.beam_width_rad) plan.beam_width_rad = drawn.beam_width_rad->lowest;
  return plan;
}

Ends ends_of(const DatasetSpec& spec, const terrain::HeightField& terrain, const radar::Rectangle& centres) {
  Ends ends(spec, terrain);
  if (!flies(spec.sequence)) {
    for (const double range_m : {spec.slant_range_m.lowest, spec.slant_range_m.highest})
      ends.add(seen_from(range_m, plan_of(spec, centres, 0), spec));
    return ends;
  }
  const std::size_t frames = spec.sequence.frames;
  for (std::size_t first = 0; first < spec.count; first += frames) {
    Interruption::heed();
    const SamplePlan begin = plan_of(spec, centres, first);
    for (const std::size_t frame : {std::size_t{0}, nearest_frame(spec, begin, terrain), frames - 1})
      ends.add(plan_of(spec, centres, first + frame));
  }
  return ends;
}

/// The samples seen from the lowest and from the highest.
std::vector<SamplePlan> lowest_and_highest(const DatasetSpec& spec, const Ends& ends, const radar::Rectangle& centres) {
  if (flies(spec.sequence)) return {ends.nearest().plan, ends.farthest().plan};
  std::vector<SamplePlan> plans;
  for (const double elevation_rad : {spec.elevation_rad.lowest, spec.elevation_rad.highest}) {
    plans.push_back(plan_of(spec, centres, 0));
    plans.back().elevation_rad = elevation_rad;
  }
  return plans;
}

}  // namespace

std::vector<std::string> dataset_warnings(const DatasetSpec& spec, const terrain::HeightField& terrain,
                                          const radar::Rectangle& scene_extent) {
  const radar::Rectangle centres = centres_of(spec, scene_extent);
  const Ends ends = ends_of(spec, terrain, centres);
  std::vector<std::string> warnings;
  const auto add = [&](const FarSample& sample, double cell_m) {
    const SamplePlan plan = with_finest_radar(sample.plan, spec.radar_ranges);
    const radar::Radar radar = radar_of(spec, plan, terrain);
    const auto bins = simulate::bins_for(radar, plan.grid.extent(), terrain);
    for (const std::string& warning :
         radar::radar_warnings(radar, bins, simulate::mapped_ground(radar, plan.grid.extent(), terrain), cell_m))
      warnings.push_back(fmt::format("in maps {:.4g} km away {}", sample.slant_range_m / 1e3, warning));
  };
  add(ends.nearest(), spec.cell_m);
  // Farther away a beam is only wider, and cells are not asked about again.
  if (ends.farthest().slant_range_m > ends.nearest().slant_range_m) add(ends.farthest(), 0.0);
  for (const SamplePlan& plan : lowest_and_highest(spec, ends, centres)) {
    auto missed = simulate::beam_above_or_below(radar_of(spec, plan, terrain), plan.grid.extent(), terrain);
    if (!missed) continue;
    // Of sequences that fly the plan states where they begin.
    const Vec3d to_radar = radar_of(spec, plan, terrain).position - middle_of(plan, terrain);
    const double elevation_rad = std::asin(normalized(to_radar).z);
    warnings.push_back(fmt::format("of maps seen under {:.3g}°, {}", deg_from_radians(elevation_rad), *missed));
    break;
  }
  return warnings;
}

}  // namespace sigmascape::dataset
