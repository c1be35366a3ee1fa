#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

namespace sigmascape::live {
namespace {

// Near the radar beams are narrower than the texels of the level that all of a deep frame has.

constexpr double near_ground_gamma = 0.1;
constexpr std::size_t beams_left_out = 3;

double vv(const Frame& frame, std::size_t beam, std::size_t range) {
  const std::size_t bin = (beam * frame.grid.ranges + range) * 4;
  if (frame.powers_m2.empty()) return std::norm(std::complex<double>(frame.amplitudes_m[bin]));
  return static_cast<double>(frame.powers_m2[bin]);
}

/// How bins of level ground differ from γ sin ψ times their area.
struct Spread {
  double mean = 0.0, deviation = 0.0;  ///< of power over what is expected, the latter over the mean
  double least = 1e300;
  double below_a_tenth = 0.0;  ///< the part of the bins
};

/// That of eight ranges, of every beam but a few at either side.
class SpreadOfBins {
 public:
  void add(const Frame& frame, std::size_t first_range, double height_m) {
    const double expected_m2 = near_ground_gamma * height_m * frame.grid.range_step_m * frame.grid.azimuth_step_rad;
    for (std::size_t beam = beams_left_out; beam + beams_left_out < frame.grid.azimuths; ++beam) {
      for (std::size_t range = first_range; range < first_range + 8; ++range)
        powers_.push_back(vv(frame, beam, range) / expected_m2);
    }
  }
  [[nodiscard]] Spread spread() const {
    Spread spread;
    const auto count = static_cast<double>(powers_.size());
    double squares = 0.0;
    for (const double power : powers_) {
      spread.mean += power / count;
      squares += power * power / count;
      spread.least = std::min(spread.least, power);
      spread.below_a_tenth += power < 0.1 ? 1.0 / count : 0.0;
    }
    spread.deviation = std::sqrt(squares - spread.mean * spread.mean) / spread.mean;
    return spread;
  }

 private:
  std::vector<double> powers_;
};

constexpr double radar_height_m = 300.0;

class LiveNearGround : public testing::Test {
 protected:
  LiveNearGround() {
    example_.texel_m = 3.6;
    example_.azimuths = 1;
    example_.elevations_deg = {2.0, 37.0};
    example_.sigma0 = [](const radar::Look&) { return radar::Channels{}; };
    example_.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(near_ground_gamma, look); };
    const atlas::Store store = example_.store(folder_.path("atlas"));
    atlas::Pyramid(store).make_above(store.units());
    ground_ = example_.over(store);
  }

  /// From 400 m to 30 km: textures of twice the width of the finest, 3 to 11 times that of a beam at 500 m.
  [[nodiscard]] static LiveSettings deep(FrameContent content, double beam_step_rad) {
    LiveSettings settings;
    settings.content = content;
    settings.beams = 60;
    settings.ranges = 2000;
    settings.beam_step_rad = beam_step_rad;
    settings.threads = 2;
    settings.refraction = 1e9;
    return settings;
  }
  [[nodiscard]] Pose pose(const LiveSettings& settings, double azimuth_deg) const {
    Pose pose;
    const Vec2d ahead = radar::horizontal_direction(radians_from_deg(azimuth_deg));
    pose.position = {example_.middle().x - 700.0 * ahead.x, example_.middle().y - 700.0 * ahead.y, radar_height_m};
    pose.first_azimuth_rad =
        radians_from_deg(azimuth_deg) - 0.5 * settings.beam_step_rad * static_cast<double>(settings.beams);
    pose.first_range_m = 400.0;
    return pose;
  }

  ScratchFolder folder_;
  ExampleGround example_;
  std::shared_ptr<LiveGround> ground_;
};

TEST_F(LiveNearGround, FillsEveryBeamOfADeepFrameEvenly) {
  for (const double azimuth_deg : {0.0, 30.0, 45.0}) {
    for (const double beam_step_rad : {2e-3, 4.36e-3}) {
      const LiveSettings settings = deep(FrameContent::Powers, beam_step_rad);
      LiveRenderer renderer(ground_, settings);
      const Frame& frame = settled_frame(renderer, *ground_, pose(settings, azimuth_deg));
      ASSERT_EQ(frame.report.level, 1U);
      for (const std::size_t first_range : {2U, 5U, 20U, 50U}) {
        SpreadOfBins bins;
        bins.add(frame, first_range, radar_height_m);
        const Spread spread = bins.spread();
        const double range_m = 400.0 + 15.0 * static_cast<double>(first_range);
        const std::string name =
            fmt::format("level ground {} m away, at {}°, beams of {} mrad", range_m, azimuth_deg, 1e3 * beam_step_rad);
        validation::expect_close({.group = "Live frames",
                                  .name = name + ", mean power",
                                  .expected = 0.0,
                                  .measured = db_from_linear(spread.mean),
                                  .tolerance = 0.15,
                                  .unit = "dB",
                                  .source = "γ sin ψ times the area of the bin"});
        validation::expect_close({.group = "Live frames",
                                  .name = name + ", deviation of bins over their mean",
                                  .expected = 0.0,
                                  .measured = spread.deviation,
                                  .tolerance = 0.25,
                                  .unit = "1",
                                  .source = "level ground is even"});
        EXPECT_GT(spread.least, 0.3) << name;
      }
    }
  }
}

TEST_F(LiveNearGround, HasTheSpeckleOfEvenGround) {
  for (const double azimuth_deg : {0.0, 30.0}) {
    SpreadOfBins bins;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      LiveSettings settings = deep(FrameContent::Amplitudes, 2e-3);
      settings.seed = seed;
      LiveRenderer renderer(ground_, settings);
      const Frame& frame = settled_frame(renderer, *ground_, pose(settings, azimuth_deg));
      bins.add(frame, 2, radar_height_m);
      bins.add(frame, 20, radar_height_m);
    }
    const Spread spread = bins.spread();
    const auto expect_of_speckle = [&](const char* what, double expected, double measured, double tolerance) {
      validation::expect_close(
          {.group = "Live frames",
           .name = fmt::format("speckle of level ground nearer than 1 km, at {}°, {}", azimuth_deg, what),
           .expected = expected,
           .measured = measured,
           .tolerance = tolerance,
           .unit = "1",
           .source = "power of a circular Gaussian number, exponentially distributed"});
    };
    expect_of_speckle("mean power over γ sin ψ times the area of the bin", 1.0, spread.mean, 0.08);
    expect_of_speckle("deviation over mean", 1.0, spread.deviation, 0.08);
    expect_of_speckle("part of the bins below a tenth of it", 1.0 - std::exp(-0.1), spread.below_a_tenth, 0.015);
  }
}

TEST_F(LiveNearGround, FillsAllBeamsAroundARadarThatLooksStraightDown) {
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 360;
  settings.beam_step_rad = 2.0 * pi / 360.0;
  settings.ranges = 40;
  settings.range_step_m = 15.0;
  settings.refraction = 1e9;
  Pose pose;
  pose.position = {example_.middle().x + 1.0, example_.middle().y - 0.7, 30.0};
  pose.first_range_m = 22.0;
  LiveRenderer renderer(ground_, settings);
  const Frame& frame = settled_frame(renderer, *ground_, pose);
  // From 52 m on the elevation is one of those of the ground.
  for (const std::size_t first_range : {2U, 10U, 20U}) {
    SpreadOfBins bins;
    bins.add(frame, first_range, pose.position.z);
    const Spread spread = bins.spread();
    EXPECT_NEAR(db_from_linear(spread.mean), 0.0, 0.1) << first_range;
    EXPECT_LT(spread.deviation, 0.25) << first_range;
    EXPECT_GT(spread.least, 0.3) << first_range;
  }
  // The first with ground in them, which lies straight below: no beam has what belongs to others.
  double first_m2 = 0.0;
  for (std::size_t beam = 0; beam < settings.beams; ++beam)
    first_m2 = std::max(first_m2, vv(frame, beam, 0) + vv(frame, beam, 1));
  const double even_m2 = near_ground_gamma * pose.position.z * settings.range_step_m * settings.beam_step_rad;
  EXPECT_LT(first_m2, 3.0 * even_m2);
}

TEST_F(LiveNearGround, IsTheSameWhoeverDrawsIt) {
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveSettings settings = deep(content, 2e-3);
    settings.beams = 200;
    settings.ranges = 100;
    const Pose pose = this->pose(settings, 10.0);
    LiveRenderer together(ground_, settings);
    const Frame& whole = settled_frame(together, *ground_, pose);
    settings.threads = 1;
    LiveRenderer in_steps(ground_, settings);
    constexpr std::size_t step = 7;
    const Frame* stepwise = nullptr;
    for (std::size_t first = 0; first < settings.beams; first += step) stepwise = &in_steps.scan(pose, first, step);
    EXPECT_TRUE(std::ranges::equal(whole.powers_m2, stepwise->powers_m2));
    EXPECT_TRUE(std::ranges::equal(whole.amplitudes_m, stepwise->amplitudes_m));
  }
}

TEST_F(LiveNearGround, IsReportedByTheBeamsThatACellIsWide) {
  const LiveSettings narrow = deep(FrameContent::Powers, 2e-3), wide = deep(FrameContent::Powers, 40e-3);
  // Between 400 m away and 300 m below.
  const double ground_m = std::sqrt(400.0 * 400.0 - radar_height_m * radar_height_m);
  LiveRenderer of_narrow(ground_, narrow), of_wide(ground_, wide);
  EXPECT_NEAR(of_narrow.render(pose(narrow, 0.0)).report.beams_a_cell, 7.2 / (2e-3 * ground_m), 0.02);
  EXPECT_EQ(of_wide.render(pose(wide, 0.0)).report.beams_a_cell, 1.0);
}

/// One texel that is not dark, eight beams wide, 500 m north of the radar.
class LiveWideTexel : public testing::Test {
 protected:
  LiveWideTexel() {
    example_.sigma0 = [](const radar::Look& look) { return constant_gamma(near_ground_gamma, look); };
    example_.pattern = [](const radar::Look&, Vec2d at) {
      return std::abs(at.x - 0.5 * side_m) < 1.0 && std::abs(at.y - 0.5 * side_m) < 1.0 ? 1.0F : 0.0F;
    };
    const atlas::Store store = example_.store(folder_.path("atlas"));
    atlas::Pyramid(store).make_above(store.units());
    ground_ = example_.over(store);
    settings_.content = FrameContent::Powers;
    settings_.beams = 200;
    settings_.ranges = 24;
    settings_.beam_step_rad = 1e-3;
    settings_.refraction = 1e9;
    pose_.position = {example_.middle().x + 0.5 * side_m, example_.middle().y + 0.5 * side_m - distance_m, height_m};
    pose_.first_azimuth_rad = -0.1;
    pose_.first_range_m = std::hypot(distance_m, height_m) - 12.0 * settings_.range_step_m;
  }

  [[nodiscard]] static std::vector<double> powers_of_beams(const Frame& frame) {
    std::vector<double> powers(frame.grid.azimuths);
    for (std::size_t beam = 0; beam < powers.size(); ++beam) {
      for (std::size_t range = 0; range < frame.grid.ranges; ++range) powers[beam] += vv(frame, beam, range);
    }
    return powers;
  }

  static constexpr double side_m = 4.0, distance_m = 500.0, height_m = 115.0;
  static constexpr double answers_m2 = near_ground_gamma * height_m / 513.054 * side_m * side_m;  // γ sin ψ A

  ScratchFolder folder_;
  ExampleGround example_;
  std::shared_ptr<LiveGround> ground_;
  LiveSettings settings_;
  Pose pose_;
};

TEST_F(LiveWideTexel, AnswersEvenlyInTheBeamsOverItAndInNoOthers) {
  LiveRenderer renderer(ground_, settings_);
  const std::vector<double> powers = powers_of_beams(settled_frame(renderer, *ground_, pose_));
  for (std::size_t beam = 0; beam < powers.size(); ++beam) {
    const double off_middle = std::abs(static_cast<double>(beam) + 0.5 - 100.0);
    // What it is to half a beam's width, by which its scatterer's place moves it.
    if (off_middle < 3.0) {
      EXPECT_NEAR(powers[beam], answers_m2 / 8.0, 0.02 * answers_m2 / 8.0) << beam;
    } else if (off_middle > 5.0) {
      EXPECT_EQ(powers[beam], 0.0) << beam;
    }
  }
}

// Beams are filled 64 at a time.
TEST_F(LiveWideTexel, KeepsItsPowerAcrossBeamsThatAreFilledApart) {
  LiveRenderer renderer(ground_, settings_);
  settled_frame(renderer, *ground_, pose_);
  for (double shift = 24.0; shift < 48.0; shift += 0.7) {
    Pose turned = pose_;
    turned.first_azimuth_rad += shift * settings_.beam_step_rad;
    double sum_m2 = 0.0;
    for (const double power : powers_of_beams(renderer.render(turned))) sum_m2 += power;
    EXPECT_NEAR(sum_m2, answers_m2, 0.01 * answers_m2) << shift;
  }
}

}  // namespace
}  // namespace sigmascape::live
