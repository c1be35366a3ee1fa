#include "sigmascape/simulate/traced_to_error.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "physics/level_scene.h"
#include "unit/simulate/street_scene.h"

#include "sigmascape/base/error.h"

namespace sigmascape::simulate {
namespace {

class TracedToErrorTest : public testing::Test {
 protected:
  TracedToErrorTest() {
    radar_.position = radar::position_seeing({}, pi, radians_from_deg(30.0), 20e3);
    radar_.range_resolution_m = 3.0;
    radar_.beam_width_rad = 3.0 / 20e3;
  }

  [[nodiscard]] TracedToError traced(double goal_db, std::uint64_t seed = 1, unsigned threads = 2) const {
    trace::TraceCounts counts;
    return traced_to_error(scene_, geometry_, radar_, area_, {.cell_m = 2.0, .seed = seed, .threads = threads},
                           {.median_error_db = goal_db}, counts);
  }

  scene::Scene scene_ = street_scene();
  trace::SceneGeometry geometry_{scene_, trace::Footing::Terrain};
  radar::Radar radar_;
  radar::Rectangle area_{-40.0, -40.0, 40.0, 40.0};
};

double image_total(const radar::RangeAzimuthImage& image) {
  double sum = 0.0;
  for (const radar::Channels& bin : image.rcs_m2.values()) sum += bin.power(radar::Polarization::Sum);
  return sum;
}

TEST_F(TracedToErrorTest, StopsOnceTheErrorIsThatOfTheGoal) {
  const TracedToError rough = traced(0.1), fine = traced(0.05);
  EXPECT_LE(rough.median_error_db, 0.1);
  EXPECT_LE(fine.median_error_db, 0.05);
  // Half the error takes some four times the rays, and no pass more is made than it takes.
  EXPECT_GT(fine.samples_per_cell, 2 * rough.samples_per_cell);
  EXPECT_GT(fine.median_error_db, 0.045);
}

/// What two maps differ by in their median bin, in standard errors that they state of the difference.
double median_difference(const TracedToError& one, const TracedToError& other) {
  EXPECT_EQ(one.image.grid, other.image.grid);
  std::vector<double> in_errors;
  for (std::size_t bin = 0; bin < one.image.rcs_m2.size(); ++bin) {
    const auto power = [bin](const TracedToError& map) {
      return static_cast<double>(map.image.rcs_m2.values()[bin].power(radar::Polarization::Sum));
    };
    const double a = power(one), b = power(other);
    const double error = std::hypot(a * static_cast<double>(one.relative_errors.values()[bin]),
                                    b * static_cast<double>(other.relative_errors.values()[bin]));
    // The flanks of the responses around the area are the area's own noise over again.
    if (a > 1e-3 * image_total(one.image) / static_cast<double>(one.image.rcs_m2.size()) && error > 0.0)
      in_errors.push_back(std::abs(a - b) / error);
  }
  EXPECT_GT(in_errors.size(), 1000U);
  const auto middle = in_errors.begin() + static_cast<std::ptrdiff_t>(in_errors.size() / 2);
  std::ranges::nth_element(in_errors, middle);
  return *middle;
}

TEST_F(TracedToErrorTest, TheErrorIsWhatTwoMapsDifferBy) {
  constexpr int pairs = 6;
  double mean = 0.0;
  for (std::uint64_t pair = 0; pair < pairs; ++pair)
    mean += median_difference(traced(0.2, 2 * pair + 1), traced(0.2, 2 * pair + 2)) / pairs;
  // Half of normal deviations are below 0.674 standard errors, of Student's t for few passes 0.69. Where power comes
  // over rare paths most bins state too little.
  EXPECT_GT(mean, 0.66);
  EXPECT_LT(mean, 0.80);
}

TEST_F(TracedToErrorTest, HoldsThePowerOfAMapThatIsTracedAtOnce) {
  trace::TraceCounts counts;
  const auto at_once =
      traced_image(scene_, geometry_, radar_, area_, {.cell_m = 2.0, .samples_per_cell = 128, .threads = 2}, counts);
  EXPECT_NEAR(10.0 * std::log10(image_total(traced(0.1).image) / image_total(at_once)), 0.0, 0.05);
}

/// Houses on one side of an area that is open ground on the other, and around.
class UnevenAreaTest : public TracedToErrorTest {
 protected:
  static constexpr int maps = 48;
  const radar::Rectangle uneven_{20.0, -20.0, 60.0, 20.0};
  static constexpr ErrorGoal fewest_passes_{.median_error_db = 100.0};
};

TEST_F(UnevenAreaTest, FewerRaysWhereTheyBringLittle) {
  trace::TraceCounts spared, at_once;
  const TracedToError map = traced_to_error(scene_, geometry_, radar_, uneven_, {.threads = 2}, fewest_passes_, spared);
  (void)traced_image(scene_, geometry_, radar_, uneven_,
                     {.samples_per_cell = map.samples_per_cell, .max_bounces = 1, .threads = 2}, at_once);
  EXPECT_LT(spared.paths, 2 * at_once.paths / 3);
  // Of eight passes the first is for all cells.
  EXPECT_GT(spared.paths, at_once.paths / 8);
}

TEST_F(UnevenAreaTest, FewerRaysBringAsMuchPowerAndTheirScatterIsTheirError) {
  trace::TraceCounts counts;
  const double expected = image_total(
      traced_image(scene_, geometry_, radar_, uneven_, {.samples_per_cell = 2048, .seed = 1000, .threads = 2}, counts));
  std::vector<double> totals, power, squares, stated;
  for (int seed = 0; seed < maps; ++seed) {
    const TraceSettings settings{.seed = static_cast<std::uint64_t>(seed), .threads = 2};
    const TracedToError map = traced_to_error(scene_, geometry_, radar_, uneven_, settings, fewest_passes_, counts);
    totals.push_back(image_total(map.image));
    power.resize(map.image.rcs_m2.size());
    squares.resize(power.size());
    stated.resize(power.size());
    for (std::size_t bin = 0; bin < power.size(); ++bin) {
      const double x = map.image.rcs_m2.values()[bin].power(radar::Polarization::Sum);
      const double s = x * static_cast<double>(map.relative_errors.values()[bin]);
      power[bin] += x;
      squares[bin] += x * x;
      stated[bin] += s * s;
    }
  }
  double mean = 0.0, scatter = 0.0, variance = 0.0, stated_variance = 0.0;
  for (const double t : totals) mean += t / maps;
  for (const double t : totals) scatter += (t - mean) * (t - mean) / (maps - 1);
  for (std::size_t bin = 0; bin < power.size(); ++bin) {
    variance += (squares[bin] - power[bin] * power[bin] / maps) / (maps - 1);
    stated_variance += stated[bin] / maps;
  }
  const double error = std::sqrt(scatter / maps);
  EXPECT_LT(error, 2e-3 * expected);
  EXPECT_NEAR(mean, expected, 4.0 * error);
  EXPECT_NEAR(stated_variance / variance, 1.0, 0.1);
}

TEST_F(TracedToErrorTest, ThreadsDoNotMatter) {
  const TracedToError one = traced(1.0, 1, 1), three = traced(1.0, 1, 3);
  EXPECT_TRUE(std::ranges::equal(one.image.rcs_m2.values(), three.image.rcs_m2.values()));
  EXPECT_TRUE(std::ranges::equal(one.relative_errors.values(), three.relative_errors.values()));
}

TEST_F(TracedToErrorTest, AGoalThatCannotBeIsRefused) {
  EXPECT_THROW(traced(0.0), Error);
}

}  // namespace
}  // namespace sigmascape::simulate
