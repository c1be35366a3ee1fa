#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "physics/even_window.h"
#include "physics/textbook_strip.h"
#include "validation/validation_record.h"

#include "sigmascape/base/error.h"
#include "sigmascape/receiver/stripmap_imager.h"

namespace sigmascape {
namespace {

constexpr std::string_view strip_movers_group = "Movers in strips";
constexpr double strip_wavelength = 0.03, strip_range_m = 4000.0, strip_resolution_m = 1.5;

/// Flies north and looks east.
radar::Radar radar_flying(double speed_mps, double repetition_hz) {
  radar::Radar radar;
  radar.frequency_hz = speed_of_light_mps / strip_wavelength;
  radar.range_resolution_m = 4.0;
  radar.beam_width_rad = radians_from_deg(2.9);
  radar.waveform.window = even_window;
  radar.waveform.pulse_repetition_hz = repetition_hz;
  radar.velocity_mps = {0.0, speed_mps, 0.0};
  radar.mode = radar::Mode::Stripmap;
  return radar;
}

radar::Target mover(Vec3d position, Vec3d velocity_mps) {
  radar::Target target;
  target.track = radar::Track::straight(position, velocity_mps);
  target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  return target;
}

double band_hz(double speed_mps, double along_resolution_m) {
  return radar::WindowResponse(even_window).half_power_width() / along_resolution_m * speed_mps;
}

struct StripPeak {
  double power = 0.0, along_m = 0.0, closest_range_m = 0.0;
};

/// The whole image of a target, in cells.
struct Imaged {
  radar::StripmapImage image;

  [[nodiscard]] StripPeak peak() const {
    StripPeak found;
    for (std::size_t row = 0; row < image.closest_range_m.bins; ++row) {
      for (std::size_t column = 0; column < image.along_m.bins; ++column) {
        const double power = std::norm(image.amplitude_m(column, row).vv);
        if (power > found.power)
          found = {power, image.along_m.middle_of(static_cast<double>(column) + 0.5),
                   image.closest_range_m.middle_of(static_cast<double>(row) + 0.5)};
      }
    }
    return found;
  }
  /// Along the flight, all ranges together.
  [[nodiscard]] std::vector<double> along() const {
    std::vector<double> power(image.along_m.bins, 0.0);
    for (std::size_t row = 0; row < image.closest_range_m.bins; ++row) {
      for (std::size_t column = 0; column < power.size(); ++column)
        power[column] += std::norm(image.amplitude_m(column, row).vv);
    }
    return power;
  }
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (const double power : along()) sum += power;
    return sum;
  }
  /// Between the places with a twentieth of the energy before and after them.
  [[nodiscard]] double length_m() const {
    const std::vector<double> power = along();
    const double all = energy();
    double sum = 0.0, begin_m = 0.0, end_m = 0.0;
    for (std::size_t column = 0; column < power.size(); ++column) {
      sum += power[column];
      const double there_m = image.along_m.middle_of(static_cast<double>(column) + 0.5);
      if (sum < 0.05 * all) begin_m = there_m;
      if (sum < 0.95 * all) end_m = there_m;
    }
    return end_m - begin_m;
  }
};

struct StripOf {
  double first_along_m = -400.0, last_along_m = 400.0, along_resolution_m = strip_resolution_m;
  int order = 0;
  double squint_rad = 0.0;
};

Imaged imaged(const radar::Radar& radar, const radar::Target& target, const StripOf& strip = {}) {
  receiver::StripmapImager imager(radar, {{}, radar.velocity_mps},
                                  {.first_along_m = strip.first_along_m,
                                   .last_along_m = strip.last_along_m,
                                   .resolution_m = strip.along_resolution_m,
                                   .window = even_window,
                                   .oversampling = 6.0,
                                   .squint_rad = strip.squint_rad},
                                  {strip_range_m - 60.0, strip_range_m + 60.0, 6.0});
  imager.add({&target, 1}, strip.order);
  return {imager.image()};
}

/// What the textbook makes of the pulses themselves, at the brightest place about one.
StripPeak textbook_peak(const radar::Radar& radar, const radar::Target& target, double about_along_m,
                        double about_range_m, double squint_rad = 0.0) {
  const double speed_mps = length(radar.velocity_mps), repetition_hz = radar.waveform.pulse_repetition_hz;
  const radar::AntennaCut beam = radar::antenna_pattern(radar).azimuth();
  const double slant_range_m = strip_range_m / std::cos(squint_rad);
  const receiver::PulseReceiver receiver(radar, {slant_range_m - 60.0, slant_range_m + 120.0, 8.0});
  const auto voltage = [&](const radar::Pulse& pulse, Vec3d position, double) {
    const Vec3d away = position - pulse.platform.position;
    return static_cast<float>(beam.power(std::atan2(away.y, away.x) - squint_rad));
  };
  const double half_s = (0.5 * strip_wavelength / strip_resolution_m * strip_range_m) / speed_mps;
  const double middle_s = (about_along_m - strip_range_m * std::tan(squint_rad)) / speed_mps;
  const auto history = receiver.receive(radar::Track::straight({}, radar.velocity_mps),
                                        {.first_time_s = middle_s - half_s,
                                         .count = static_cast<std::size_t>(2.0 * half_s * repetition_hz),
                                         .repetition_hz = repetition_hz},
                                        {}, {&target, 1}, voltage);
  const TextbookStrip processor{strip_wavelength, speed_mps, band_hz(speed_mps, strip_resolution_m), beam, squint_rad};
  StripPeak found;
  for (double r = about_range_m - 3.0; r <= about_range_m + 3.0; r += 1.0) {
    for (double s = about_along_m - 2.0; s <= about_along_m + 2.0; s += 0.25) {
      const double power = std::norm(processor.focused(history, s, r));
      if (power > found.power) found = {power, s, r};
    }
  }
  return found;
}

/// The beam has passed a mover when its Doppler comes into the processed band: 1, 4, 8 and 23 dB at 1, 2, 3 and 5 m/s.
TEST(StripMover, IsAsBrightAsTheBeamLeavesIt) {
  const auto radar = radar_flying(100.0, 1200.0);
  for (const double away_mps : {-5.0, -3.0, -1.0, 0.0, 2.0, 5.0}) {
    const radar::Target target = mover({strip_range_m, 0.0, 0.0}, {away_mps, 0.0, 0.0});
    const StripPeak image = imaged(radar, target).peak();
    const StripPeak pulses = textbook_peak(radar, target, image.along_m, image.closest_range_m);
    const std::string name = std::to_string(static_cast<int>(away_mps)) + " m/s";
    validation::expect_close({strip_movers_group, "power of a mover of " + name, db_from_linear(pulses.power),
                              db_from_linear(image.power), 0.4, "dB", "back-projected pulses, pattern undone"});
    validation::expect_close({strip_movers_group, "place of a mover of " + name, pulses.along_m, image.along_m, 0.8,
                              "m", "back-projected pulses"});
  }
}

/// At λ f_p/2 = 6 m/s every pulse finds a mover half a wave on, as if it stood.
TEST(StripMover, OfBlindSpeedStandsWhereItIs) {
  const auto radar = radar_flying(100.0, 400.0);
  for (const double away_mps : {-6.0, 6.0, 12.0}) {
    const radar::Target target = mover({strip_range_m, 20.0, 0.0}, {away_mps, 0.0, 0.0});
    const StripPeak image = imaged(radar, target).peak();
    EXPECT_NEAR(image.along_m, 20.0, strip_resolution_m) << away_mps;
    const StripPeak pulses = textbook_peak(radar, target, image.along_m, image.closest_range_m);
    EXPECT_NEAR(db_from_linear(image.power / pulses.power), 0.0, 0.5) << away_mps;
    EXPECT_NEAR(pulses.along_m, image.along_m, 0.8) << away_mps;
    // Where it would stand if pulses knew its Doppler, nothing but what the beam leaves.
    const Imaged ghost = imaged(radar, target, {.order = away_mps > 0.0 ? 1 : -1});
    EXPECT_LT(ghost.peak().power, 0.05 * image.power) << away_mps;
  }
}

/// The platform passes what comes towards it at v after x V/(V + v), however fast that is.
TEST(StripMover, AlongTheFlightStandsWhereItIsPassed) {
  const double speed_mps = 30.0;
  const auto radar = radar_flying(speed_mps, 600.0);
  for (const double along_mps : {-60.0, -35.0, -30.0, -25.0, -10.0, 10.0, 20.0, 45.0}) {
    const double at_m = along_mps > speed_mps ? -60.0 : 60.0;
    const Imaged image = imaged(radar, mover({strip_range_m, at_m, 0.0}, {0.0, along_mps, 0.0}));
    const std::vector<double> power = image.along();
    double moment = 0.0;
    for (std::size_t column = 0; column < power.size(); ++column)
      moment += power[column] * image.image.along_m.middle_of(static_cast<double>(column) + 0.5);
    const double expected_m = at_m * speed_mps / (speed_mps - along_mps);
    ASSERT_GT(image.energy(), 0.0) << along_mps;
    EXPECT_NEAR(moment / image.energy(), expected_m, 1.0) << along_mps;
  }
}

/// A mover stays B/k in the band, k its own Doppler rate: as much longer as it is there it is brighter, and its smear
/// is v B |1/k_g − 1/k|.
TEST(StripMover, AlongTheFlightIsSmearedByItsOwnDopplerRate) {
  const double speed_mps = 100.0;
  const auto radar = radar_flying(speed_mps, 1200.0);
  const double at_rest = imaged(radar, mover({strip_range_m, 0.0, 0.0}, {})).energy();
  const double interval_s = 0.8859 / strip_resolution_m * strip_wavelength * strip_range_m / (2.0 * speed_mps);
  for (const double along_mps : {-40.0, -25.0, 25.0, 40.0}) {
    const Imaged image = imaged(radar, mover({strip_range_m, 0.0, 0.0}, {0.0, along_mps, 0.0}));
    const double longer = std::pow(speed_mps / (speed_mps - along_mps), 2.0);
    const std::string name = std::to_string(static_cast<int>(along_mps)) + " m/s along the flight";
    validation::expect_close({strip_movers_group, "energy of " + name, db_from_linear(longer),
                              db_from_linear(image.energy() / at_rest), 0.15, "dB", "k_g/k"});
    const double expected_m = speed_mps * interval_s * std::abs(longer - 1.0);
    validation::expect_close({strip_movers_group, "smear of " + name, expected_m, image.length_m() / 0.9,
                              0.05 * expected_m + 1.0, "m", "v B |1/k_g − 1/k|"});
  }
}

/// Whether the processor lets it wander through many range cells or none: the energy is that of the pattern over the
/// band.
TEST(StripMover, GhostsOfWhatStandsHaveThePatternsEnergy) {
  const double speed_mps = 100.0, repetition_hz = 150.0;
  for (const double range_resolution_m : {1.0, 8.0, 40.0}) {
    auto radar = radar_flying(speed_mps, repetition_hz);
    radar.range_resolution_m = range_resolution_m;
    const radar::Target target = mover({strip_range_m, 0.0, 0.0}, {});
    const double itself = imaged(radar, target).energy();
    const radar::AntennaCut beam = radar::antenna_pattern(radar).azimuth();
    for (const int order : {-1, 1}) {
      constexpr int parts = 400;
      double expected = 0.0;
      for (int k = 0; k < parts; ++k) {
        const double f = ((k + 0.5) / parts - 0.5) * band_hz(speed_mps, strip_resolution_m);
        const auto angle = [&](double hz) { return std::asin(strip_wavelength * hz / (2.0 * speed_mps)); };
        expected += std::pow(beam.power(angle(f + order * repetition_hz)) / beam.power(angle(f)), 2.0) / parts;
      }
      const double ghost = imaged(radar, target, {.order = order}).energy();
      EXPECT_NEAR(db_from_linear(ghost / itself / expected), 0.0, 0.15) << range_resolution_m << " m, " << order;
    }
  }
}

/// Steep and squinted: the azimuth that the antenna knows, on the ground, is wider than the angle to broadside.
TEST(StripMover, GhostsFromFarAheadAreSeenUnderTheirAzimuths) {
  const double speed_mps = 100.0, repetition_hz = 120.0, height_m = 4000.0, across_m = 4000.0;
  const double closest_m = std::hypot(height_m, across_m), squint_rad = radians_from_deg(32.8);
  auto radar = radar_flying(speed_mps, repetition_hz);
  radar.beam_width_rad = radians_from_deg(2.0);
  const receiver::Strip strip{.first_along_m = -100.0,
                              .last_along_m = 100.0,
                              .resolution_m = 4.0,
                              .window = even_window,
                              .squint_rad = squint_rad};
  const receiver::StripmapImager imager(radar, {{0.0, 0.0, height_m}, radar.velocity_mps}, strip,
                                        {closest_m - 20.0, closest_m + 20.0, 1.5});
  EXPECT_NEAR(imager.image().closest_range_cell_m, radar.range_resolution_m / 0.8859 * std::cos(squint_rad), 0.02)
      << "closest ranges differ by less than slant ranges do";
  const radar::AntennaCut beam = radar::antenna_pattern(radar).azimuth();
  const auto azimuth = [&](double sine) {
    return std::atan2(closest_m * sine / std::sqrt(1.0 - sine * sine), across_m);
  };
  const double axis = azimuth(std::sin(squint_rad));
  for (const int order : {-1, 1}) {
    constexpr int parts = 400;
    double expected = 0.0;
    for (int k = 0; k < parts; ++k) {
      const double sine =
          std::sin(squint_rad) + 0.5 * strip_wavelength * 0.8859 / strip.resolution_m * ((k + 0.5) / parts - 0.5);
      const double seen = sine + order * strip_wavelength * repetition_hz / (2.0 * speed_mps);
      expected += std::pow(beam.power(azimuth(seen) - axis) / beam.power(azimuth(sine) - axis), 2.0) / parts;
    }
    const auto ghosts = imager.ambiguities();
    const auto found = std::ranges::find(ghosts, order, &receiver::AzimuthAmbiguity::order);
    ASSERT_NE(found, ghosts.end()) << order;
    EXPECT_NEAR(db_from_linear(found->power / expected), 0.0, 0.1) << order;
  }
}

/// What is seen under `sine` and believed at place 0 and closest range `range_m` of a strip of this squint.
radar::Target believed_at_zero(double squint_rad, double speed_mps, double sine, double along_mps) {
  const double seen_m = strip_range_m / std::cos(squint_rad), time_s = -seen_m * std::sin(squint_rad) / speed_mps;
  return mover({seen_m * std::sqrt(1.0 - sine * sine), speed_mps * time_s + seen_m * sine - along_mps * time_s, 0.0},
               {0.0, along_mps, 0.0});
}

/// Parts of the band that see it at several closest ranges add up to what the pulses give: with the phase that a point
/// at rest has at each of them. A wavelength of range is 2 (1 − cos φ) turns there.
TEST(StripMover, OfASquintedStripHoldsTogetherAcrossRanges) {
  const double speed_mps = 100.0, squint_rad = radians_from_deg(20.0), sine = std::sin(squint_rad);
  const auto expect_focus = [&](const std::string& name, const radar::Radar& radar, const radar::Target& target,
                                int order) {
    const StripPeak image = imaged(radar, target, {.order = order, .squint_rad = squint_rad}).peak();
    const StripPeak pulses = textbook_peak(radar, target, image.along_m, image.closest_range_m, squint_rad);
    validation::expect_close({strip_movers_group, "power of " + name, db_from_linear(pulses.power),
                              db_from_linear(image.power), 0.7, "dB", "back-projected pulses, pattern undone"});
  };
  auto wide = radar_flying(speed_mps, 1200.0);
  wide.beam_width_rad = radians_from_deg(12.0);
  const double along_mps = -10.0, closing_mps = speed_mps * sine;
  expect_focus("a mover of -10 m/s along the flight, squint 20°", wide,
               believed_at_zero(squint_rad, speed_mps, closing_mps / (speed_mps - along_mps), along_mps), 0);
  auto fine = radar_flying(speed_mps, 150.0);
  fine.range_resolution_m = 1.0;
  for (const int order : {-1, 1}) {
    const double folded = order * strip_wavelength * fine.waveform.pulse_repetition_hz / (2.0 * speed_mps);
    expect_focus("a ghost of order " + std::to_string(order) + ", squint 20°", fine,
                 believed_at_zero(squint_rad, speed_mps, sine + folded, 0.0), order);
  }
}

TEST(StripMover, OfTooFewPulsesNoStripIsMade) {
  const auto radar = radar_flying(100.0, 1.0);
  EXPECT_THROW(imaged(radar, mover({strip_range_m, 0.0, 0.0}, {})), Error);
}

}  // namespace
}  // namespace sigmascape
