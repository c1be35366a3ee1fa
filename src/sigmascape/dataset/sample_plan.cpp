#include "sigmascape/dataset/sample_plan.h"

#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::dataset {
namespace {

/// Names what a number is drawn for, so that a new question leaves the answers to the others as they were.
enum class Question : std::uint64_t {
  Azimuth,
  Elevation,
  SlantRange,
  East,
  North,
  Snr,
  Number,
  TargetEast,
  TargetNorth,
  Rcs,
  Realisation
};

class Draws {
 public:
  Draws(std::uint64_t seed, std::size_t sample) : key_(hashed(seed, sample)) {}

  /// A number in [0, 1) with 53 bits.
  [[nodiscard]] double unit(Question question, std::uint64_t first = 0, std::uint64_t second = 0) const {
    return static_cast<double>(word(question, first, second) >> 11U) * 0x1p-53;
  }
  [[nodiscard]] double in(Range range, Question question, std::uint64_t first = 0, std::uint64_t second = 0) const {
    return range.lowest + (range.highest - range.lowest) * unit(question, first, second);
  }
  [[nodiscard]] std::uint64_t word(Question question, std::uint64_t first = 0, std::uint64_t second = 0) const {
    return hashed(key_, static_cast<std::uint64_t>(question), first, second);
  }

 private:
  std::uint64_t key_;
};

Range within(const std::optional<Range>& asked, Range possible, const DatasetSpec& spec, const char* key) {
  if (!asked) return possible;
  if (asked->lowest >= possible.lowest && asked->highest <= possible.highest) return *asked;
  throw Error(
      fmt::format("{}: view.{}", spec.file.string(), key),
      fmt::format("puts maps of {:.0f} m a side beyond the scene", static_cast<double>(spec.cells) * spec.cell_m),
      fmt::format("stay within {:.1f} and {:.1f}", possible.lowest, possible.highest));
}

}  // namespace

radar::Rectangle centres_of(const DatasetSpec& spec, const radar::Rectangle& scene_extent) {
  const double side_m = static_cast<double>(spec.cells) * spec.cell_m;
  if (side_m > scene_extent.width_m() || side_m > scene_extent.height_m()) {
    throw Error(fmt::format("{}: dataset.cells", spec.file.string()),
                fmt::format("makes maps of {0:.0f} x {0:.0f} m, larger than the scene of {1:.0f} x {2:.0f} m", side_m,
                            scene_extent.width_m(), scene_extent.height_m()),
                "ask for fewer or smaller cells");
  }
  const double half_m = side_m / 2.0;
  const Range east =
      within(spec.target_east_m, {scene_extent.west_m + half_m, scene_extent.east_m - half_m}, spec, "target_east_m");
  const Range north = within(spec.target_north_m, {scene_extent.south_m + half_m, scene_extent.north_m - half_m}, spec,
                             "target_north_m");
  return {east.lowest, north.lowest, east.highest, north.highest};
}

SamplePlan plan_of(const DatasetSpec& spec, const radar::Rectangle& centres, std::size_t index) {
  const Draws draws(spec.seed, index);
  SamplePlan plan;
  plan.index = index;
  plan.seed = draws.word(Question::Realisation);
  plan.azimuth_rad = wrapped_azimuth(draws.in(spec.azimuth_rad, Question::Azimuth));
  plan.elevation_rad = draws.in(spec.elevation_rad, Question::Elevation);
  plan.slant_range_m = draws.in(spec.slant_range_m, Question::SlantRange);
  plan.centre = {draws.in({centres.west_m, centres.east_m}, Question::East),
                 draws.in({centres.south_m, centres.north_m}, Question::North)};
  const double side_m = static_cast<double>(spec.cells) * spec.cell_m;
  plan.grid = {plan.centre.x - side_m / 2.0, plan.centre.y + side_m / 2.0, spec.cell_m, spec.cells, spec.cells};
  if (spec.snr_db) plan.snr_db = draws.in(*spec.snr_db, Question::Snr);
  const radar::Rectangle area = plan.grid.extent();
  for (std::size_t k = 0; k < spec.targets.size(); ++k) {
    const TargetClass& target = spec.targets[k];
    const auto count = static_cast<std::size_t>(
        std::floor(draws.in({target.number.lowest, target.number.highest + 1.0}, Question::Number, k)));
    for (std::size_t n = 0; n < count; ++n) {
      plan.targets.push_back({.target_class = k,
                              .position = {draws.in({area.west_m, area.east_m}, Question::TargetEast, k, n),
                                           draws.in({area.south_m, area.north_m}, Question::TargetNorth, k, n)},
                              .rcs_m2 = linear_from_db(draws.in(target.rcs_db, Question::Rcs, k, n))});
    }
  }
  return plan;
}

}  // namespace sigmascape::dataset
