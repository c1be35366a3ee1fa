#include "sigmascape/simulate/recording_interval.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/simulate/level_ground.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::simulate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr radar::Rectangle wide_area{-200.0, -50.0, 200.0, 50.0};

/// Looks north from 8 km to the south and 3 km up, with cells of 3 m and a beam of 2°, and flies east at 100 m/s.
radar::Radar flying_east(radar::Mode mode) {
  radar::Radar radar;
  radar.position = {0.0, -8000.0, 3000.0};
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = 3.0;
  radar.beam_width_rad = radians_from_deg(2.0);
  radar.mode = mode;
  return radar;
}

/// w λ r/2 v δ: docs/physics/doppler.md, Eqs. (3) and (5) at broadside.
double broadside_s(const radar::Radar& radar, double range_m, double resolution_m) {
  return radar::WindowResponse(radar.waveform.window).half_power_width() * wavelength_m(radar.frequency_hz) * range_m /
         (2.0 * 100.0 * resolution_m);
}

TEST(RecordingInterval, OfARealBeamIsATenthOfASecond) {
  const radar::Radar radar = flying_east(radar::Mode::RealBeam);
  EXPECT_EQ(recording_interval_s(std::nullopt, radar, wide_area, level_ground), 0.1);
  EXPECT_EQ(recording_interval_s(0.02, radar, wide_area, level_ground), 0.02);
  EXPECT_THAT(interval_warnings(1e-3, radar, wide_area, level_ground), IsEmpty());
}

/// In whole pulses, a thousand a second, as many in every look.
TEST(RecordingInterval, OfAModeIsThatOfItsMap) {
  radar::Radar radar = flying_east(radar::Mode::Spotlight);
  const double range_m = std::hypot(8000.0, 3000.0);
  EXPECT_NEAR(recording_interval_s(std::nullopt, radar, wide_area, level_ground), broadside_s(radar, range_m, 3.0),
              0.5e-3);
  radar.processing.looks = 4;
  EXPECT_NEAR(recording_interval_s(std::nullopt, radar, wide_area, level_ground),
              4.0 * broadside_s(radar, range_m, 3.0), 2e-3);
  radar.processing.interval_s = 0.8;
  EXPECT_EQ(recording_interval_s(std::nullopt, radar, wide_area, level_ground), 0.8);
  EXPECT_EQ(recording_interval_s(0.1, radar, wide_area, level_ground), 0.1);
}

/// 400 m at 100 m/s, and at both ends what a place of the far edge is processed for.
TEST(RecordingInterval, OfAStripIsUntilAllOfItHasPassed) {
  radar::Radar radar = flying_east(radar::Mode::Stripmap);
  radar.processing.along_resolution_m = 2.0;
  const double far_m = std::hypot(8050.0, 3000.0);
  EXPECT_NEAR(recording_interval_s(std::nullopt, radar, wide_area, level_ground), 4.0 + broadside_s(radar, far_m, 2.0),
              1e-6);
}

/// A beam 20° ahead passes over the middle before time zero, about which pulses lie evenly: over the far western end
/// 8050 m · tan 20° + 200 m short of the platform's place.
TEST(RecordingInterval, OfASquintedStripReachesAsFarBackAsItsBeamPasses) {
  radar::Radar radar = flying_east(radar::Mode::Stripmap);
  radar.processing.along_resolution_m = 2.0;
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = radians_from_deg(20.0)};
  const double first_s = (8050.0 * std::tan(radians_from_deg(20.0)) + 200.0) / 100.0;
  const double interval_s = recording_interval_s(std::nullopt, radar, wide_area, level_ground);
  EXPECT_GT(interval_s, 2.0 * first_s);
  // The aperture grows as 1/cos² of the squint, and with the range: some 1.2 times that abeam.
  EXPECT_LT(interval_s, 2.0 * first_s + 1.5 * broadside_s(radar, std::hypot(8050.0, 3000.0), 2.0));
}

TEST(RecordingInterval, ThatIsTooShortForTheModeIsTold) {
  radar::Radar radar = flying_east(radar::Mode::Spotlight);
  radar.processing.interval_s = 0.8;
  EXPECT_THAT(interval_warnings(0.1, radar, wide_area, level_ground),
              ElementsAre(HasSubstr("recorded for 0.1 s, and the spotlight of this radar adds up 0.8 s: across range "
                                    "they tell apart 8 times less")));
  EXPECT_THAT(interval_warnings(0.8, radar, wide_area, level_ground), IsEmpty());
  EXPECT_THAT(interval_warnings(std::nullopt, radar, wide_area, level_ground), IsEmpty());
  radar = flying_east(radar::Mode::Stripmap);
  EXPECT_THAT(interval_warnings(3.0, radar, wide_area, level_ground),
              ElementsAre(HasSubstr("until its beam has passed over all")));
  EXPECT_THAT(interval_warnings(30.0, radar, wide_area, level_ground), IsEmpty());
}

TEST(RecordingInterval, OfALongStripThatNobodyAskedForIsTold) {
  radar::Radar radar = flying_east(radar::Mode::Stripmap);
  EXPECT_THAT(interval_warnings(std::nullopt, radar, wide_area, level_ground), IsEmpty());
  radar.waveform.pulse_repetition_hz = 50e3;
  EXPECT_THAT(interval_warnings(std::nullopt, radar, wide_area, level_ground),
              ElementsAre(HasSubstr("pulses of the whole strip")));
  EXPECT_THAT(interval_warnings(30.0, radar, wide_area, level_ground), IsEmpty());
}

/// What cannot be mapped can be recorded, for as long as somebody says.
TEST(RecordingInterval, MustBeStatedWhereTheModeMapsNothing) {
  radar::Radar radar = flying_east(radar::Mode::Spotlight);
  radar.velocity_mps = {0.0, 100.0, 0.0};
  EXPECT_THROW(static_cast<void>(recording_interval_s(std::nullopt, radar, wide_area, level_ground)), Error);
  EXPECT_EQ(recording_interval_s(0.1, radar, wide_area, level_ground), 0.1);
  EXPECT_THAT(interval_warnings(0.1, radar, wide_area, level_ground), IsEmpty());
}

TEST(RecordingInterval, AndModeAreTold) {
  radar::Radar radar = flying_east(radar::Mode::Spotlight);
  radar.processing.interval_s = 0.8;
  std::map<std::string, std::string> of_spotlight, of_real_beam;
  tell_of_mode(radar, wide_area, level_ground, of_spotlight);
  EXPECT_EQ(of_spotlight,
            (std::map<std::string, std::string>{{"radar_mode", "spotlight"}, {"mode_interval_s", "0.8"}}));
  tell_of_mode(flying_east(radar::Mode::RealBeam), wide_area, level_ground, of_real_beam);
  EXPECT_EQ(of_real_beam, (std::map<std::string, std::string>{{"radar_mode", "real-beam"}}));
}

}  // namespace
}  // namespace sigmascape::simulate
