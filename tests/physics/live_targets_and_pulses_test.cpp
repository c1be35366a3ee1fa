#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/carrier_phase.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape::live {
namespace {

/// One that stands a height above the sea, in the middle of ground that answers nothing.
radar::Target standing(Vec2d place, double height_m) {
  radar::Target target;
  target.track = radar::Track::straight({place.x, place.y, height_m});
  target.rcs_m2 = radar::Channels{10.0F, 10.0F, 0.0F, 10.0F};
  return target;
}

/// What a way of looking at a target makes of it: range and phase of where it is brightest, and all its power.
struct Answer {
  double range_m = 0.0;        ///< the mean, weighted by power
  std::complex<float> peak_m;  ///< I and Q of the brightest bin or sample, VV
  double power_m2 = 0.0;       ///< of all bins or samples
};

/// From I and Q over range, whose places `range_of` tells.
template <typename RangeOf>
Answer answer_of(const std::vector<std::complex<float>>& line, RangeOf&& range_of) {
  Answer answer;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto power_m2 = static_cast<double>(std::norm(line[i]));
    answer.power_m2 += power_m2;
    answer.range_m += power_m2 * range_of(i);
    if (std::norm(line[i]) > std::norm(answer.peak_m)) answer.peak_m = line[i];
  }
  answer.range_m /= std::max(answer.power_m2, 1e-30);
  return answer;
}

/// A live frame and a record of pulses of one target, over one sea.
class LiveTargetsAndPulses : public testing::Test {
 protected:
  LiveTargetsAndPulses() {
    example_.sigma0 = [](const radar::Look&) { return radar::Channels{}; };
    ground_ = example_.over(example_.store(folder_.path("atlas")), frequency_hz);
    terrain_ = example_.terrain();
  }

  static constexpr double radar_height_m = 100.0, distance_m = 60e3, wavelength = 0.03;
  static constexpr double frequency_hz = speed_of_light_mps / wavelength;
  static constexpr double bearing_rad = 0.5;  // from the radar to the target

  /// What the sea hides beyond the horizon of a low radar, by the k-Earth's circle (docs/physics/curved_earth.md, Eqs.
  /// (2), (3)).
  static double hidden_height_m() {
    const radar::CurvedEarth earth;
    return earth.drop_m(distance_m - earth.horizon_m(radar_height_m));
  }

  [[nodiscard]] Vec2d place() const { return example_.middle() + Vec2d{11.0, -7.0}; }
  [[nodiscard]] Vec3d radar_position() const {
    const Vec2d foot = place() - Vec2d{std::sin(bearing_rad), std::cos(bearing_rad)} * distance_m;
    return {foot.x, foot.y, radar_height_m};
  }

  [[nodiscard]] Answer live(double height_m) const {
    LiveSettings settings;
    settings.beams = 9;
    settings.ranges = 64;
    settings.beam_step_rad = 1e-3;
    settings.range_step_m = 5.0;
    const std::vector<radar::Target> targets{standing(place(), height_m)};
    Pose pose;
    pose.position = radar_position();
    pose.first_azimuth_rad = bearing_rad - 4.5 * settings.beam_step_rad;
    pose.first_range_m = distance_m - 160.0;
    pose.targets = targets;
    LiveRenderer renderer(ground_, settings);
    const Frame& frame = settled_frame(renderer, *ground_, pose);
    std::vector<std::complex<float>> line;
    for (std::size_t range = 0; range < settings.ranges; ++range)
      line.push_back(frame.amplitudes_m[(4 * settings.ranges + range) * 4]);
    return answer_of(line, [&](std::size_t i) {
      return pose.first_range_m + settings.range_step_m * (static_cast<double>(i) + 0.5);
    });
  }

  [[nodiscard]] Answer pulses(double height_m) const {
    radar::Radar radar;
    radar.frequency_hz = frequency_hz;
    radar.position = radar_position();
    radar.range_resolution_m = 10.0;
    radar.beam_width_rad = 0.02;
    radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = bearing_rad};
    radar.waveform.pulse_repetition_hz = 1000.0;
    radar.earth_refraction = radar::CurvedEarth{}.refraction;
    const std::vector<radar::Target> targets{standing(place(), height_m)};
    const simulate::CoherentScene scene{&terrain_, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; },
                                        targets};
    const Vec2d at = place();
    const auto record = simulate::phase_history(scene, radar, {at.x - 150.0, at.y - 150.0, at.x + 150.0, at.y + 150.0},
                                                {.interval_s = 0.002});
    std::vector<std::complex<float>> line;
    for (std::size_t sample = 0; sample < record.samples.columns(); ++sample)
      line.push_back(record.samples(sample, 0).vv);
    return answer_of(
        line, [&](std::size_t i) { return record.first_range_m + record.range_step_m * static_cast<double>(i); });
  }

  ScratchFolder folder_;
  ExampleGround example_;
  std::shared_ptr<LiveGround> ground_;
  terrain::HeightField terrain_;
};

double degrees_between(std::complex<float> a, std::complex<float> b) {
  return deg_from_radians(static_cast<double>(std::arg(a * std::conj(b))));
}

TEST_F(LiveTargetsAndPulses, over_a_round_earth_have_one_range_and_one_phase) {
  const double height_m = 1.5 * hidden_height_m();
  const double range_m = radar::CurvedEarth{}.slant_range_m(radar_height_m, height_m, distance_m);
  const std::complex<float> phase = receiver::carrier_phase(range_m, wavelength);
  for (const auto& [name, answer] : {std::pair("live frame", live(height_m)), {"pulses", pulses(height_m)}}) {
    validation::expect_close({"Targets", fmt::format("range over a round Earth at 60 km, {}", name), range_m,
                              answer.range_m, 0.1, "m", "straight line over an Earth of 4/3 of the radius"});
    validation::expect_close({"Targets", fmt::format("phase of the way over a round Earth at 60 km, {}", name), 0.0,
                              degrees_between(answer.peak_m, phase), 1.0, "°", "exp(-4 pi i r / lambda)"});
  }
}

TEST_F(LiveTargetsAndPulses, are_hidden_by_the_sea_at_one_height) {
  const double hidden_m = hidden_height_m();
  ASSERT_GT(hidden_m, 10.0);
  for (const double part : {0.9, 1.1}) {
    const bool is_seen = part > 1.0;
    EXPECT_EQ(live(part * hidden_m).power_m2 > 0.0, is_seen) << part;
    EXPECT_EQ(pulses(part * hidden_m).power_m2 > 0.0, is_seen) << part;
  }
}

}  // namespace
}  // namespace sigmascape::live
