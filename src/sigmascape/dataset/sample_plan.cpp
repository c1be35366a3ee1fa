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
  Realisation,
  Frequency,
  RangeResolution,
  BeamWidth,
  FlightSpeed,
  FlightCourse,
  TargetSpeed,
  TargetHeading
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

Vec2d velocity_of(double speed_mps, double heading_rad) {
  return {speed_mps * std::sin(heading_rad), speed_mps * std::cos(heading_rad)};
}

Range within(const std::optional<Range>& asked, Range possible, const DatasetSpec& spec, const char* key) {
  if (!asked) return possible;
  if (asked->lowest >= possible.lowest && asked->highest <= possible.highest) return *asked;
  throw Error(
      fmt::format("{}: view.{}", spec.file.string(), key),
      fmt::format("puts maps of {:.0f} m a side beyond the scene", static_cast<double>(spec.cells) * spec.cell_m),
      // Inwards, so that what is advised is not refused.
      fmt::format("stay within {:.1f} and {:.1f}", std::ceil(possible.lowest * 10.0) / 10.0,
                  std::floor(possible.highest * 10.0) / 10.0));
}

Range about(double middle, const std::optional<Range>& asked, Range all) {
  return asked ? Range{middle + asked->lowest, middle + asked->highest} : all;
}

void draw_radar(SamplePlan& plan, const DatasetSpec& spec, const Draws& draws) {
  const radar::Radar& radar = spec.radar.radar;
  const auto drawn = [&](const std::optional<Range>& range, Question question, double stated) {
    return range ? draws.in(*range, question) : stated;
  };
  plan.frequency_hz = drawn(spec.radar_ranges.frequency_hz, Question::Frequency, radar.frequency_hz);
  plan.range_resolution_m =
      drawn(spec.radar_ranges.range_resolution_m, Question::RangeResolution, radar.range_resolution_m);
  plan.beam_width_rad = drawn(spec.radar_ranges.beam_width_rad, Question::BeamWidth, radar.beam_width_rad);
  plan.flight_mps = velocity_of(draws.in(spec.sequence.speed_mps, Question::FlightSpeed),
                                draws.in(spec.sequence.course_rad, Question::FlightCourse));
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
  SamplePlan plan;
  plan.index = index;
  plan.sequence = index / spec.sequence.frames;
  plan.frame = index % spec.sequence.frames;
  plan.time_s = static_cast<double>(plan.frame) * spec.sequence.interval_s;
  const Draws draws(spec.seed, plan.sequence);
  plan.seed = draws.word(Question::Realisation);
  if (plan.frame > 0) plan.seed = hashed(plan.seed, plan.frame);
  draw_radar(plan, spec, draws);
  plan.azimuth_rad = wrapped_azimuth(draws.in(spec.azimuth_rad, Question::Azimuth));
  plan.elevation_rad = draws.in(spec.elevation_rad, Question::Elevation);
  plan.slant_range_m = draws.in(spec.slant_range_m, Question::SlantRange);
  plan.centre = {draws.in({centres.west_m, centres.east_m}, Question::East),
                 draws.in({centres.south_m, centres.north_m}, Question::North)};
  const double side_m = static_cast<double>(spec.cells) * spec.cell_m;
  plan.grid = {plan.centre.x - side_m / 2.0, plan.centre.y + side_m / 2.0, spec.cell_m, spec.cells, spec.cells};
  if (spec.snr_db) plan.snr_db = draws.in(*spec.snr_db, Question::Snr);
  if (spec.noise_sigma0_db) plan.noise_sigma0_db = draws.in(*spec.noise_sigma0_db, Question::Snr);
  const radar::Rectangle area = plan.grid.extent();
  for (std::size_t k = 0; k < spec.targets.size(); ++k) {
    const TargetClass& target = spec.targets[k];
    const auto count = static_cast<std::size_t>(
        std::floor(draws.in({target.number.lowest, target.number.highest + 1.0}, Question::Number, k)));
    const Range east = about(plan.centre.x, target.east_m, {area.west_m, area.east_m});
    const Range north = about(plan.centre.y, target.north_m, {area.south_m, area.north_m});
    for (std::size_t n = 0; n < count; ++n) {
      const Vec2d velocity = velocity_of(draws.in(target.speed_mps, Question::TargetSpeed, k, n),
                                         draws.in(target.heading_rad, Question::TargetHeading, k, n));
      const Vec2d begin{draws.in(east, Question::TargetEast, k, n), draws.in(north, Question::TargetNorth, k, n)};
      plan.targets.push_back({.target_class = k,
                              .track = plan.targets.size(),
                              .position = begin + velocity * plan.time_s,
                              .velocity_mps = velocity,
                              .rcs_m2 = linear_from_db(draws.in(target.rcs_db, Question::Rcs, k, n))});
    }
  }
  return plan;
}

}  // namespace sigmascape::dataset
