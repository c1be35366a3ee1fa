#include "sigmascape/receiver/receive_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "physics/level_scene.h"
#include "validation/validation_record.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/radar/range_response.h"
#include "sigmascape/receiver/bin_response.h"
#include "sigmascape/receiver/calibrated_voltage.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::receiver {
namespace {

void expect_case(const char* name, double expected, double measured, double tolerance, const char* unit,
                 const char* source) {
  validation::expect_close({.group = "Receiver",
                            .name = name,
                            .expected = expected,
                            .measured = measured,
                            .tolerance = tolerance,
                            .unit = unit,
                            .source = source});
}

/// A radar in the middle of which nothing is special: λ 3.2 cm, 30 m pulses, a beam of 1.5°.
radar::Radar plain_radar() {
  radar::Radar radar;
  radar.frequency_hz = 9.4e9;
  radar.range_resolution_m = 30.0;
  radar.beam_width_rad = radians_from_deg(1.5);
  radar.antenna.gain = linear_from_db(32.0);
  radar.waveform = {.peak_power_w = 20e3,
                    .pulse_length_s = 1e-6,
                    .pulse_repetition_hz = 500.0,
                    .window = {.shape = radar::WindowShape::Hamming}};
  radar.receiver.losses = linear_from_db(4.0);
  radar.receiver.noise_figure = linear_from_db(5.0);
  return radar;
}

/// `count` bins on either side of a place, two a resolution cell; the place is the middle of the middle bin.
radar::RangeAzimuthGrid bins_about(const radar::Radar& radar, double range_m, std::size_t count = 40,
                                   double oversampling = 2.0) {
  const double range_step = radar.range_resolution_m / oversampling;
  const double azimuth_step = radar::antenna_pattern(radar).azimuth().two_way_width_rad() / oversampling;
  const double half = static_cast<double>(count) + 0.5;
  return {range_m - half * range_step, range_step, 2 * count + 1, -half * azimuth_step, azimuth_step, 2 * count + 1};
}

radar::RangeAzimuthImage image_of(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid,
                                  const std::vector<radar::Echo>& echoes) {
  RangeAzimuthReceiver receiver(radar, grid);
  receiver.add(echoes);
  return receiver.image();
}

radar::Echo point_echo(double range_m, double rcs_m2, double azimuth_rad = 0.0) {
  const auto rcs = static_cast<float>(rcs_m2);
  return {.range_m = range_m, .cross = azimuth_rad, .rcs_m2 = {rcs, rcs, 0.0F, rcs}, .bounces = 1};
}

double greatest(const Array2D<float>& bins) {
  return static_cast<double>(*std::ranges::max_element(bins.values()));
}

TEST(ReceivedPower, OfAPointIsTheRadarEquation) {
  const radar::Radar radar = plain_radar();
  const auto grid = bins_about(radar, 20e3);
  const auto received = received_power(radar, image_of(radar, grid, {point_echo(20e3, 10.0)}), radar::Polarization::VV);
  const double expected = radar::received_power_w(radar, 10.0, 20e3) * radar::compression_gain(radar);
  expect_case("peak power of 10 m² at 20 km", db_from_linear(expected), db_from_linear(greatest(received.signal_w)),
              0.1, "dBW", "radar equation");
  expect_case("its signal-to-noise ratio", db_from_linear(radar::signal_to_noise(radar, 10.0, 20e3)),
              db_from_linear(greatest(received.signal_w) / received.noise_w), 0.1, "dB", "radar equation");
}

TEST(ReceivedPower, OfTheSumOfPolarizationsNoReceiverHas) {
  const radar::Radar radar = plain_radar();
  const auto image = image_of(radar, bins_about(radar, 20e3), {point_echo(20e3, 10.0)});
  EXPECT_THROW((void)received_power(radar, image, radar::Polarization::Sum), Error);
}

/// The compressed pulse of a Hamming window over 2BΔr/c, the spectrum 0.54 + 0.46 cos transformed, relative to its
/// peak.
double hamming_power(double t) {
  const auto sinc = [](double x) { return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x); };
  const double voltage = sinc(t) + 0.23 / 0.54 * (sinc(t - 1.0) + sinc(t + 1.0));
  return voltage * voltage;
}

// Wherever between the middles of bins a target lies, each bin has what pulse and beam make of it that far away; of a
// Gaussian beam the two-way power at φ is 2^(−8 (φ/θ)²).
TEST(ReceivedPower, OfATargetBetweenBinsIsTheRadarEquationAtItsOffset) {
  const radar::Radar radar = plain_radar();
  const auto grid = bins_about(radar, 20e3);
  const double bandwidth_hz = radar::bandwidth_of(radar.range_resolution_m, radar.waveform.window);
  for (const auto& [along, across] : {std::pair(0.0, 0.0), {0.25, 0.0}, {0.5, 0.0}, {0.0, 0.5}, {-0.5, 0.5}}) {
    const double offset_m = along * grid.range_step_m, offset_rad = across * grid.azimuth_step_rad;
    const radar::Echo target = point_echo(20e3 + offset_m, 10.0, offset_rad);
    radar::RangeAzimuthImage image{grid, radar.position, Array2D<radar::Channels>(grid.azimuths, grid.ranges)};
    add_echoes(image, radar, {&target, 1});
    const auto received = received_power(radar, image, radar::Polarization::VV);
    const double expected = radar::received_power_w(radar, 10.0, 20e3) * radar::compression_gain(radar) *
                            hamming_power(2.0 * bandwidth_hz * offset_m / speed_of_light_mps) *
                            std::exp2(-8.0 * std::pow(offset_rad / radar.beam_width_rad, 2.0));
    expect_case("target off a bin's middle, power there", db_from_linear(expected),
                db_from_linear(static_cast<double>(received.signal_w(40, 40))), 0.1, "dBW", "radar equation");
  }
}

// The radar equation takes the gain of the peak, wherever the measured beam has it.
TEST(ReceivedPower, OfABeamThatLooksAsideAndOfOneWithANullOnItsAxis) {
  radar::TabulatedBeam aside, null_on_axis;
  for (double offset = -3.0; offset <= 3.0; offset += 0.05) {
    aside.samples.push_back({offset, std::exp2(-4.0 * std::pow(offset - 0.5, 2.0))});
    const double lobes = std::exp2(-4.0 * std::pow(std::abs(offset) - 0.8, 2.0));
    null_on_axis.samples.push_back(
        {offset, std::max(1e-3, lobes * std::pow(std::min(1.0, std::abs(offset) / 0.5), 2.0))});
  }
  for (const auto& [name, beam] : {std::pair("peak power of 10 m², beam half a width aside", aside),
                                   {"the same, null on the axis", null_on_axis}}) {
    radar::Radar radar = plain_radar();
    radar.antenna.azimuth = beam;
    const auto grid = bins_about(radar, 20e3, 60, 8.0);
    const auto received =
        received_power(radar, image_of(radar, grid, {point_echo(20e3, 10.0)}), radar::Polarization::VV);
    expect_case(name, db_from_linear(radar::received_power_w(radar, 10.0, 20e3) * radar::compression_gain(radar)),
                db_from_linear(greatest(received.signal_w)), 0.1, "dBW", "radar equation");
  }
}

// Offsets of a table are clockwise: a beam that looks to the right of its axis meets a point when the axis stands to
// the left of it, and there a map of the real beam shows it. Pulses meet the same point from the same axis.
TEST(ReceivedPower, OfABeamThatLooksToTheRightIsToTheLeftOfThePoint) {
  radar::TabulatedBeam aside;
  for (double offset = -3.0; offset <= 3.0; offset += 0.05)
    aside.samples.push_back({offset, std::exp2(-4.0 * std::pow(offset - 0.5, 2.0))});
  radar::Radar radar = plain_radar();
  radar.antenna.azimuth = aside;
  const auto grid = bins_about(radar, 20e3, 60, 8.0);
  const auto image = image_of(radar, grid, {point_echo(20e3, 10.0)});
  std::size_t best = 0;
  for (std::size_t column = 0; column < grid.azimuths; ++column) {
    if (image.rcs_m2(column, 60).vv > image.rcs_m2(best, 60).vv) best = column;
  }
  const double seen_rad = grid.first_azimuth_rad + (static_cast<double>(best) + 0.5) * grid.azimuth_step_rad;
  EXPECT_NEAR(seen_rad, -0.5 * radar.beam_width_rad, grid.azimuth_step_rad);
  const radar::Pulse pulse{0.0, {{0.0, 0.0, 1000.0}, {}}};
  const auto volts = [&](double axis_rad) {
    return calibrated_voltage(radar, fixed_at(axis_rad))(pulse, {0.0, 20e3, 1000.0}, 20e3);
  };
  EXPECT_GT(volts(seen_rad), 10.0F * volts(-seen_rad));
}

TEST(ReceivedPower, FallsWithTheFourthPowerOfRange) {
  const radar::Radar radar = plain_radar();
  double nearest = 0.0;
  for (const double range_m : {2e3, 6e3, 20e3, 60e3, 200e3}) {
    const auto received = received_power(radar, image_of(radar, bins_about(radar, range_m), {point_echo(range_m, 1.0)}),
                                         radar::Polarization::VV);
    const double power_db = db_from_linear(greatest(received.signal_w));
    if (nearest == 0.0) nearest = power_db;
    expect_case("power over range, relative to 2 km", -40.0 * std::log10(range_m / 2e3), power_db - nearest, 0.01, "dB",
                "r⁻⁴");
  }
}

// Every path of the chain: tracer, bins, radar equation. The ground is dark, and taken out by a look without the
// target.
TEST(ReceivedPower, OfATargetAtLevelOfDetailZero) {
  auto scene = physics_test::level_scene(
      {.name = "dark", .model = scatter::LambertParameters{1e-4, {0.0, 1.0}}, .source = {}}, 400.0);
  radar::Radar radar = plain_radar();
  radar.range_resolution_m = 10.0;
  radar.waveform.pulse_length_s = 1e-6;
  radar.position = radar::position_seeing({13.0, -7.0, 2.0}, 0.7, radians_from_deg(15.0), 8e3);
  const radar::Rectangle area{-150, -150, 150, 150};
  const auto total_w_r4 = [&] {
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    trace::TraceCounts counts;
    const auto image =
        simulate::traced_image(scene, geometry, radar, area, {.cell_m = 8.0, .samples_per_cell = 4}, counts);
    const auto received = received_power(radar, image, radar::Polarization::VV);
    double sum = 0.0;
    for (std::size_t row = 0; row < image.grid.ranges; ++row) {
      const double range_m = image.grid.first_range_m + (static_cast<double>(row) + 0.5) * image.grid.range_step_m;
      for (std::size_t column = 0; column < image.grid.azimuths; ++column)
        sum += static_cast<double>(received.signal_w(column, row)) * std::pow(range_m / 8e3, 4.0);
    }
    return sum / (range_response(radar, image.grid.range_step_m).peak_bins *
                  azimuth_response(radar, image.grid.azimuth_step_rad).peak_bins);
  };
  const double ground_w = total_w_r4();
  scene.point_targets.push_back(
      {.name = "target", .position = {13.0, -7.0}, .height_m = 2.0, .rcs_m2 = {10, 10, 0, 10}});
  expect_case("10 m² at level of detail 0",
              db_from_linear(radar::received_power_w(radar, 10.0, 8e3) * radar::compression_gain(radar)),
              db_from_linear(total_w_r4() - ground_w), 0.1, "dBW", "radar equation");
}

TEST(RangeAzimuthReceiver, ShowsTheSideLobesOfPulseAndBeam) {
  radar::Radar radar = plain_radar();
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  radar.antenna.azimuth = radar::ApertureBeam{{.shape = radar::WindowShape::Rectangular}};
  constexpr double oversampling = 16.0;
  constexpr std::size_t count = 60;
  const auto image = image_of(radar, bins_about(radar, 20e3, count, oversampling), {point_echo(20e3, 1.0)});
  const auto peak = static_cast<double>(image.rcs_m2(count, count).vv);
  double in_range = 0.0, in_azimuth = 0.0;
  for (std::size_t k = count + 20; k <= 2 * count; ++k) {
    in_range = std::max(in_range, static_cast<double>(image.rcs_m2(count, k).vv) / peak);
    // The first zero of the two-way beam lies at 1/0.886/0.72 of half-widths beyond.
    if (k > count + 26) in_azimuth = std::max(in_azimuth, static_cast<double>(image.rcs_m2(k, count).vv) / peak);
  }
  expect_case("side lobe of the pulse in the bins", -13.26, db_from_linear(in_range), 0.1, "dB", "sinc²");
  expect_case("side lobe of the beam in the bins", -26.52, db_from_linear(in_azimuth), 0.2, "dB", "sinc⁴");
}

TEST(RangeAzimuthReceiver, PlacesAPointWithinATenthOfACell) {
  const radar::Radar radar = plain_radar();
  const auto grid = bins_about(radar, 100e3);
  for (const double part : {-0.45, -0.2, 0.0, 0.1, 0.33, 0.5}) {
    const double range_m = 100e3 + part * radar.range_resolution_m, azimuth = part * radar.beam_width_rad;
    const auto image = image_of(radar, grid, {point_echo(range_m, 1.0, azimuth)});
    double power = 0.0, range_sum = 0.0, azimuth_sum = 0.0;
    for (std::size_t row = 0; row < grid.ranges; ++row) {
      for (std::size_t column = 0; column < grid.azimuths; ++column) {
        const auto bin = static_cast<double>(image.rcs_m2(column, row).vv);
        power += bin;
        range_sum += bin * ((static_cast<double>(row) + 0.5) * grid.range_step_m);
        azimuth_sum += bin * ((static_cast<double>(column) + 0.5) * grid.azimuth_step_rad);
      }
    }
    expect_case("range of a point at 100 km", range_m, grid.first_range_m + range_sum / power, 1e-3, "m", "geometry");
    EXPECT_NEAR(grid.first_azimuth_rad + azimuth_sum / power, azimuth, 1e-3 * radar.beam_width_rad);
    EXPECT_NEAR(power, 1.0, 1e-5);
  }
}

TEST(RangeAzimuthReceiver, FoldsEchoesFromBeyondTheUnambiguousRange) {
  radar::Radar radar = plain_radar();
  radar.waveform.pulse_repetition_hz = 10e3;
  const double fold_m = radar::unambiguous_range_m(10e3);
  const auto grid = bins_about(radar, 8e3);
  const auto direct = image_of(radar, grid, {point_echo(8e3, 1.0)});
  for (const int times : {1, 2, 3}) {
    const double range_m = 8e3 + times * fold_m;
    const auto folded = image_of(radar, grid, {point_echo(range_m, std::pow(range_m / 8e3, 4.0))});
    for (std::size_t i = 0; i < direct.rcs_m2.size(); ++i)
      ASSERT_NEAR(folded.rcs_m2.values()[i].vv, direct.rcs_m2.values()[i].vv, 2e-6F) << times;
  }
}

// Between the bins' middles a map reads both: those beside the gate's ends are there.
TEST(RangeAzimuthReceiver, KnowsNothingOutsideTheGate) {
  radar::Radar radar = plain_radar();
  const auto grid = bins_about(radar, 8e3);
  const double first_m = 8e3 - 20.0, last_m = 8e3 + 10.0;
  radar.receiver.first_range_m = first_m;
  radar.receiver.last_range_m = last_m;
  const auto is_known = [&](const radar::RangeAzimuthImage& image, double from_m, double to_m) {
    for (std::size_t row = 0; row < grid.ranges; ++row) {
      const double middle_m = grid.first_range_m + (static_cast<double>(row) + 0.5) * grid.range_step_m;
      const bool is_open = middle_m > from_m - grid.range_step_m && middle_m < to_m + grid.range_step_m;
      EXPECT_EQ(std::isnan(image.rcs_m2(0, row).vv), !is_open) << row;
    }
  };
  is_known(image_of(radar, grid, {point_echo(8e3, 1.0)}), first_m, last_m);
  EXPECT_EQ(std::ranges::max(image_of(radar, grid, {point_echo(last_m + 1.0, 1.0)}).rcs_m2.values(), {},
                             [](const auto& bin) { return std::isnan(bin.vv) ? -1.0F : bin.vv; })
                .vv,
            0.0F);

  // A receiver listens for one period of its pulses at most.
  radar.receiver.last_range_m.reset();
  radar.waveform.pulse_repetition_hz = speed_of_light_mps / (2.0 * 30.0);
  is_known(image_of(radar, grid, {}), first_m, first_m + 30.0);
}

// The axis of a fixed beam lies between two columns, or on one: there a map has what it looks at.
TEST(RangeAzimuthReceiver, SeesAlongAFixedBeam) {
  radar::Radar radar = plain_radar();
  const auto grid = bins_about(radar, 20e3);
  for (const double part : {0.0, 0.3, 0.5, 0.9}) {
    const double axis =
        grid.first_azimuth_rad + (0.5 * static_cast<double>(grid.azimuths) + part) * grid.azimuth_step_rad;
    radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = axis};
    const auto image = image_of(radar, grid, {point_echo(20e3, 1.0)});
    const double column = (axis - grid.first_azimuth_rad) / grid.azimuth_step_rad - 0.5;
    const auto left = static_cast<std::size_t>(std::floor(column + 1e-9));
    EXPECT_FALSE(std::isnan(image.rcs_m2(left, 0).vv)) << part;
    EXPECT_FALSE(std::isnan(image.rcs_m2(left + 1, 0).vv)) << part;
    EXPECT_TRUE(std::isnan(image.rcs_m2(left - 2, 0).vv)) << part;
    EXPECT_TRUE(std::isnan(image.rcs_m2(left + 3, 0).vv)) << part;
  }
}

TEST(RangeAzimuthReceiver, WeightsByTheElevationPatternTwice) {
  radar::Radar radar = plain_radar();
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(4.0);
  radar.antenna.tilt_rad = radians_from_deg(-10.0);
  const auto total = [&](double depression_deg) {
    radar::Echo echo = point_echo(20e3, 1.0);
    echo.sin_depression = static_cast<float>(std::sin(radians_from_deg(depression_deg)));
    RangeAzimuthReceiver receiver(radar, bins_about(radar, 20e3));
    receiver.add({&echo, 1});
    return receiver.bins().total()[0];
  };
  EXPECT_NEAR(total(10.0), 1.0, 1e-4);
  EXPECT_NEAR(total(12.0), 0.25, 1e-3);
  EXPECT_NEAR(total(8.0), 0.25, 1e-3);
  EXPECT_NEAR(total(6.0), 1.0 / 256.0, 1e-4);
}

TEST(RangeAzimuthReceiver, IsBlindWhereTheScanNeverComes) {
  radar::Radar radar = plain_radar();
  radar.scan = {.kind = radar::ScanKind::Sector,
                .azimuth_rad = 0.0,
                .sector_width_rad = 4.0 * radar.beam_width_rad,
                .rate_rad_per_s = 1.0};
  const auto grid = bins_about(radar, 20e3);
  const auto image = image_of(radar, grid, {point_echo(20e3, 1.0)});
  for (std::size_t column = 0; column < grid.azimuths; ++column) {
    const double azimuth = grid.first_azimuth_rad + (static_cast<double>(column) + 0.5) * grid.azimuth_step_rad;
    const bool inside = std::abs(azimuth) <= 2.0 * radar.beam_width_rad + grid.azimuth_step_rad + 1e-12;
    EXPECT_EQ(std::isnan(image.rcs_m2(column, 0).vv), !inside) << column;
  }
}

radar::RangeAzimuthImage empty_image(const radar::RangeAzimuthGrid& grid) {
  return {grid, {}, Array2D<radar::Channels>(grid.azimuths, grid.ranges)};
}

TEST(DetectedImage, NoiseHasItsPowerAndItsStatistics) {
  radar::Radar radar = plain_radar();
  radar.receiver.gain = linear_from_db(100.0);
  const auto grid = bins_about(radar, 20e3, 300);
  const auto power = received_power(radar, empty_image(grid), radar::Polarization::VV);
  const auto image = detected_image(radar, power, 7);
  double sum = 0.0, squares = 0.0;
  for (const float video : image.video.values()) {
    sum += static_cast<double>(video);
    squares += static_cast<double>(video) * static_cast<double>(video);
  }
  const auto count = static_cast<double>(image.video.size());
  const double mean_w = sum / count / radar.receiver.impedance_ohm / radar.receiver.gain;
  const double bandwidth_hz = 1.303 * speed_of_light_mps / (2.0 * 30.0);
  expect_case("thermal noise", db_from_linear(1.380649e-23 * 290.0 * bandwidth_hz * linear_from_db(5.0)),
              db_from_linear(mean_w), 0.1, "dBW", "k T₀ B F");
  expect_case("spread of noise power over its mean", 1.0,
              std::sqrt(squares / count - sum * sum / count / count) * count / sum, 0.02, "1",
              "exponential distribution");
}

TEST(DetectedImage, PulsesAverageTheNoise) {
  radar::Radar radar = plain_radar();
  radar.receiver.pulses_integrated = 16;
  const auto grid = bins_about(radar, 20e3, 60);
  const auto image = detected_image(radar, received_power(radar, empty_image(grid), radar::Polarization::VV), 3);
  double sum = 0.0, squares = 0.0;
  for (const float video : image.video.values()) {
    sum += static_cast<double>(video) * 1e15;
    squares += static_cast<double>(video) * 1e15 * static_cast<double>(video) * 1e15;
  }
  const auto count = static_cast<double>(image.video.size());
  EXPECT_NEAR(std::sqrt(squares / count - sum * sum / count / count) * count / sum, 0.25, 0.01);
}

TEST(DetectedImage, IsTheSameForAnyNumberOfThreads) {
  radar::Radar radar = plain_radar();
  radar.receiver.analog_to_digital = radar::AnalogToDigital{.bits = 10, .full_scale_v = 1e-5};
  const auto grid = bins_about(radar, 20e3);
  const auto power = received_power(radar, image_of(radar, grid, {point_echo(20e3, 10.0)}), radar::Polarization::VV);
  const auto one = detected_image(radar, power, 5, 1);
  for (const unsigned threads : {2U, 3U, 7U}) {
    const auto many = detected_image(radar, power, 5, threads);
    EXPECT_TRUE(std::ranges::equal(one.video.values(), many.video.values())) << threads;
    EXPECT_EQ(one.saturated, many.saturated);
  }
  const auto other = detected_image(radar, power, 6, 2);
  EXPECT_FALSE(std::ranges::equal(one.video.values(), other.video.values()));
}

/// Output in decibels along range of level ground of constant γ under a radar at `height_m`: σ of a patch r dr dφ is
/// γ (H/r) of it.
std::vector<double> ground_profile_db(const radar::Radar& radar, double height_m) {
  radar::RangeAzimuthGrid grid = bins_about(radar, 5e3, 10);
  grid.first_range_m = 5e3;
  grid.ranges = 2000;
  std::vector<radar::Echo> echoes;
  for (std::size_t row = 0; row < 2 * grid.ranges; ++row) {
    const double range_m = grid.first_range_m + (static_cast<double>(row) + 0.5) * 0.5 * grid.range_step_m;
    const double area_m2 = range_m * 0.5 * grid.range_step_m * grid.azimuth_step_rad;
    for (std::size_t column = 0; column < grid.azimuths; ++column) {
      const double azimuth = grid.first_azimuth_rad + (static_cast<double>(column) + 0.5) * grid.azimuth_step_rad;
      echoes.push_back(point_echo(range_m, 0.1 * height_m / range_m * area_m2, azimuth));
    }
  }
  auto received = received_power(radar, image_of(radar, grid, echoes), radar::Polarization::VV);
  received.noise_w = 0.0;
  const auto video = detected_image(radar, received, 1).video;
  std::vector<double> profile;
  for (std::size_t row = 50; row + 50 < grid.ranges; ++row)
    profile.push_back(db_from_linear(static_cast<double>(video(10, row))));
  return profile;
}

TEST(SensitivityTimeControl, LevelsGroundOfConstantGamma) {
  radar::Radar radar = plain_radar();
  radar.receiver.sensitivity_time_control = radar::SensitivityTimeControl{40e3, 4.0};
  const auto [lowest, highest] = std::ranges::minmax(ground_profile_db(radar, 2e3));
  expect_case("spread of constant-γ ground, 5.75 to 34.2 km, with time control", 0.0, highest - lowest, 0.5, "dB",
              "n = 4");
  radar.receiver.sensitivity_time_control.reset();
  const auto falling = ground_profile_db(radar, 2e3);
  expect_case("fall of constant-γ ground, 5.75 to 34.2 km, without", -40.0 * std::log10(34.24 / 5.76),
              falling.back() - falling.front(), 0.1, "dB", "r⁻⁴");
}

TEST(AnalogToDigital, RoundsToStepsAndSaturates) {
  const radar::AnalogToDigital converter{.bits = 8, .full_scale_v = 1.0};
  std::vector<std::complex<float>> volts{{0.3F, -0.3F}, {5.0F, 0.0F}, {0.0F, -5.0F}, {0.003F, 0.005F}};
  EXPECT_EQ(digitise(volts, converter), 2U);
  constexpr float step = 1.0F / 128.0F;
  EXPECT_EQ(volts[0], (std::complex<float>{38.0F * step, -38.0F * step}));
  EXPECT_EQ(volts[1].real(), 127.0F * step);
  EXPECT_EQ(volts[2].imag(), -1.0F);
  EXPECT_EQ(volts[3], (std::complex<float>{0.0F, step}));
}

// Rounding adds the noise of a uniform error: a twelfth of a step squared in each part.
TEST(AnalogToDigital, RoundingNoiseIsATwelfthOfAStepSquared) {
  const radar::AnalogToDigital converter{.bits = 6, .full_scale_v = 1.0};
  std::vector<std::complex<float>> volts(100'000);
  add_noise(volts, 0.02, 1.0, 11);
  auto rounded = volts;
  digitise(rounded, converter);
  double error = 0.0;
  for (std::size_t i = 0; i < volts.size(); ++i) error += static_cast<double>(std::norm(rounded[i] - volts[i]));
  EXPECT_NEAR(error / static_cast<double>(volts.size()) * 1024.0, 2.0 / 12.0, 0.005);
}

TEST(Detected, LinearSquareAndLog) {
  const std::complex<float> volts{3.0F, -4.0F};
  EXPECT_FLOAT_EQ(detected(volts, radar::Detector::Linear), 5.0F);
  EXPECT_FLOAT_EQ(detected(volts, radar::Detector::SquareLaw), 25.0F);
  EXPECT_FLOAT_EQ(detected(volts, radar::Detector::Log), 13.979400F);
}

}  // namespace
}  // namespace sigmascape::receiver
