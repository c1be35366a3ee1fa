#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "physics/level_terrain.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/receiver/calibrated_voltage.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

constexpr std::string_view image_noise_group = "Noise and pattern of images";

render::Reflectivity even_in_all_channels(float sigma0) {
  return [sigma0](Vec2d, const radar::Aspect&) { return radar::Channels{sigma0, sigma0, sigma0, sigma0}; };
}

/// Looks north on the middle of the terrain and flies east.
radar::Radar looking_north_in(radar::Mode mode) {
  radar::Radar radar;
  radar.mode = mode;
  radar.position = radar::position_seeing({0.0, 0.0, 0.0}, pi, radians_from_deg(20.0), 8000.0);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = 5.0;
  radar.beam_width_rad = 0.05;
  radar.antenna.gain = 1000.0;
  radar.waveform.pulse_repetition_hz = 1000.0;
  radar.waveform.peak_power_w = 100.0;
  return radar;
}

/// Mean power of some rows, over all columns and the three independent polarizations.
double mean_of_rows(const Array2D<radar::ComplexChannels>& bins, std::size_t first, std::size_t end) {
  double sum = 0.0;
  for (std::size_t row = first; row < end; ++row) {
    for (const auto& bin : bins.row(row)) sum += std::norm(bin.vv) + std::norm(bin.hh) + std::norm(bin.hv);
  }
  return sum / (3.0 * static_cast<double>((end - first) * bins.columns()));
}

/// Pulses that are added up lift a target above the noise N/n_w times: in an image in square metres the noise is what
/// one pulse has, as a cross-section, over that.
TEST(ImageNoise, is_what_one_pulse_has_over_the_pulses) {
  const auto terrain = level_terrain(1000.0);
  auto radar = looking_north_in(radar::Mode::Spotlight);
  radar.antenna.azimuth = radar::EvenBeam{};
  radar.processing.thermal_noise = true;
  const auto image = simulate::range_doppler_image({&terrain, even_in_all_channels(0.0F)}, radar,
                                                   {-500.0, -500.0, 500.0, 500.0}, {.interval_s = 0.2, .seed = 3});
  const auto middle = static_cast<std::size_t>(image.range_m.place_of(8000.0));
  // kT₀BF (4π)³ r⁴ L/(P_t G² λ² G_c) · n_w/N, in decibels one by one.
  const double n_w = radar::WindowResponse(radar.waveform.window).noise_bandwidth();
  const double noise_dbw = db_from_linear(radar::noise_power_w(radar));
  const double signal_of_1_m2_dbw = 20.0 + 30.0 + 30.0 + 2.0 * db_from_linear(wavelength_m(radar.frequency_hz)) -
                                    db_from_linear(std::pow(4.0 * pi, 3.0)) - 4.0 * db_from_linear(8000.0) -
                                    db_from_linear(radar.receiver.losses);
  const double expected_db =
      noise_dbw - signal_of_1_m2_dbw - db_from_linear(radar::compression_gain(radar)) + db_from_linear(n_w / 200.0);
  validation::expect_close({image_noise_group, "noise-equivalent cross-section of 200 pulses at 8 km", expected_db,
                            db_from_linear(mean_of_rows(image.amplitude_m, middle - 40, middle + 40)), 0.1, "dBm²",
                            "k T₀ B F over the radar equation, N/n_w pulses"});
  // Noise has the band of the image: neighbours at two thirds of a cell are alike, and bins three cells off are not.
  std::complex<double> near, far;
  double power = 0.0;
  for (std::size_t row = middle - 40; row < middle + 40; ++row) {
    const auto bins = image.amplitude_m.row(row);
    for (std::size_t c = 0; c + 5 < bins.size(); ++c) {
      near += std::complex<double>(bins[c].vv * std::conj(bins[c + 1].vv));
      far += std::complex<double>(bins[c].vv * std::conj(bins[c + 5].vv));
      power += static_cast<double>(std::norm(bins[c].vv));
    }
  }
  EXPECT_GT(std::abs(near) / power, 0.5);
  EXPECT_LT(std::abs(far) / power, 0.1);
  // Looks: each adds up a quarter of the pulses, and four of them are averaged.
  Array2D<double> looks(image.amplitude_m.columns(), image.amplitude_m.rows());
  simulate::range_doppler_looks({&terrain, even_in_all_channels(0.0F)}, radar, {-500.0, -500.0, 500.0, 500.0},
                                {.interval_s = 0.2, .seed = 3}, 4, [&](const radar::RangeDopplerImage& look) {
                                  for (std::size_t i = 0; i < looks.size(); ++i)
                                    looks.values()[i] +=
                                        0.25 * static_cast<double>(std::norm(look.amplitude_m.values()[i].vv));
                                });
  double mean = 0.0, square = 0.0, count = 0.0;
  for (std::size_t row = middle - 40; row < middle + 40; ++row) {
    for (const double bin : looks.row(row)) {
      mean += bin;
      square += bin * bin;
      count += 1.0;
    }
  }
  mean /= count;
  validation::expect_close({image_noise_group, "the same in four looks", expected_db + 6.02, db_from_linear(mean), 0.2,
                            "dBm²", "a quarter of the pulses each"});
  validation::expect_close({image_noise_group, "looks of the noise", 4.0, mean * mean / (square / count - mean * mean),
                            0.6, "", "independent looks"});
}

/// A strip adds up pulses in proportion to range, so that its noise goes with r³.
TEST(ImageNoise, of_a_strip_goes_with_the_third_power_of_range) {
  const auto terrain = level_terrain(4000.0);
  auto radar = looking_north_in(radar::Mode::Stripmap);
  radar.processing.thermal_noise = true;
  radar.range_resolution_m = 20.0;
  const auto image =
      simulate::stripmap_image({&terrain, even_in_all_channels(0.0F)}, radar, {-600.0, -3500.0, 600.0, 3500.0},
                               {.along_resolution_m = 4.0, .scatterer_spacing_m = 20.0});
  const auto rows_at = [&](double range_m) {
    const auto row = static_cast<std::size_t>(image.closest_range_m.place_of(range_m));
    return db_from_linear(mean_of_rows(image.amplitude_m, row - 8, row + 8));
  };
  validation::expect_close({image_noise_group, "noise of a strip at 10 km over that at 6 km",
                            30.0 * std::log10(10.0 / 6.0), rows_at(10e3) - rows_at(6e3), 0.3, "dB",
                            "r⁴ over pulses that go with r"});
  // B_s λ r f_p/2V pulses, and the r.m.s. of the window that they have.
  const double n_w = radar::WindowResponse(radar.waveform.window).noise_bandwidth();
  const double band_per_m = radar::WindowResponse(radar.waveform.window).half_power_width() / 4.0;
  const double pulses = band_per_m * wavelength_m(radar.frequency_hz) * 8000.0 * 1000.0 / 200.0;
  validation::expect_close({image_noise_group, "noise-equivalent cross-section of a strip at 8 km",
                            -db_from_linear(radar::signal_to_noise(radar, 1.0, 8000.0) * pulses / n_w), rows_at(8e3),
                            0.3, "dBm²", "as above"});
}

/// A band of seven tenths of a Gaussian beam, whose edges the processor lifts by 1/g².
TEST(ImageNoise, of_a_strip_is_lifted_as_the_pattern_is_evened_out) {
  const auto terrain = level_terrain(1000.0);
  auto radar = looking_north_in(radar::Mode::Stripmap);
  radar.processing.thermal_noise = true;
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  constexpr double resolution_m = 0.5;
  const double band_per_m = radar::WindowResponse(radar.waveform.window).half_power_width() / resolution_m;
  const double half_sine = band_per_m * wavelength_m(radar.frequency_hz) / 4.0;
  const double cosine_depression = std::cos(radians_from_deg(20.0));
  const auto azimuth_of = [&](double sine) { return std::atan(std::tan(std::asin(sine)) / cosine_depression); };
  radar.beam_width_rad = 2.0 * azimuth_of(half_sine) / 0.7;
  const auto rows_of = [&](const radar::Radar& of) {
    const auto image =
        simulate::stripmap_image({&terrain, even_in_all_channels(0.0F)}, of, {-60.0, -100.0, 60.0, 100.0},
                                 {.along_resolution_m = resolution_m, .scatterer_spacing_m = 20.0});
    const auto row = static_cast<std::size_t>(image.closest_range_m.place_of(8000.0));
    return db_from_linear(mean_of_rows(image.amplitude_m, row - 8, row + 8));
  };
  double lift = 0.0;
  constexpr int parts = 1000;
  for (int part = 0; part < parts; ++part) {
    const double widths = azimuth_of(half_sine * (2.0 * (part + 0.5) / parts - 1.0)) / radar.beam_width_rad;
    lift += std::exp(8.0 * std::log(2.0) * widths * widths) / parts;
  }
  auto wide = radar;
  wide.beam_width_rad *= 20.0;
  EXPECT_NEAR(db_from_linear(lift), 1.08, 0.01);
  validation::expect_close({image_noise_group, "noise of a strip whose band is 0.7 beams over that in a wide beam",
                            db_from_linear(lift), rows_of(radar) - rows_of(wide), 0.05, "dB",
                            "mean of 1/g⁴ over the band"});
}

/// Noise is lifted by the depression under which the strip is passed, not by that of time zero, 2 km lower.
TEST(ImageNoise, of_a_climbing_strip_is_that_of_where_it_is_passed) {
  const auto terrain = level_terrain(1000.0);
  auto level = looking_north_in(radar::Mode::Stripmap);
  level.processing.thermal_noise = true;
  level.waveform.window = {.shape = radar::WindowShape::Rectangular};
  level.beam_width_rad = radians_from_deg(2.0);
  level.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = 0.0};
  level.position.z = 6000.0;
  constexpr double climb_mps = 20.0, earlier_s = 200.0;
  auto climbing = level;
  climbing.velocity_mps = {std::sqrt(100.0 * 100.0 - climb_mps * climb_mps), 0.0, climb_mps};
  climbing.position = climbing.position - climbing.velocity_mps * earlier_s;
  const auto noise_db = [&](const radar::Radar& radar) {
    const auto image =
        simulate::stripmap_image({&terrain, even_in_all_channels(0.0F)}, radar, {-60.0, -100.0, 60.0, 100.0},
                                 {.along_resolution_m = 0.6, .scatterer_spacing_m = 20.0});
    const auto row = image.closest_range_m.bins / 2;
    return db_from_linear(mean_of_rows(image.amplitude_m, row - 8, row + 8));
  };
  validation::expect_close({image_noise_group,
                            "noise of a strip at the end of a climb of 4 km over that of level flight", 0.0,
                            noise_db(climbing) - noise_db(level), 0.2, "dB", "the same geometry"});
}

/// A beam of 4° on a place 20° down, or half a width above or below it; half a beam beside the axis of a spotlight.
/// What is half as strong out and back is four times as far below the noise.
TEST(ImageNoise, is_lifted_where_the_pattern_is_divided_out) {
  const auto terrain = level_terrain(1000.0);
  const simulate::CoherentScene nothing{&terrain, even_in_all_channels(0.0F)};
  const auto noise_about = [&](const radar::Radar& radar, double east_m) {
    const radar::Rectangle area{-300.0, -40.0, 300.0, 40.0};
    const simulate::CoherentSettings settings{.interval_s = 0.2, .along_resolution_m = 4.0};
    Array2D<radar::ComplexChannels> bins;
    Vec2d place;
    if (radar.mode == radar::Mode::Stripmap) {
      const auto image = simulate::stripmap_image(nothing, radar, area, settings);
      place = image.place_of(Vec3d{east_m, 0.0, 0.0});
      bins = image.amplitude_m;
    } else {
      const auto image = simulate::range_doppler_image(nothing, radar, area, settings);
      place = image.place_of(Vec3d{east_m, 0.0, 0.0});
      bins = image.amplitude_m;
    }
    double sum = 0.0;
    const auto column = static_cast<std::size_t>(place.x), row = static_cast<std::size_t>(place.y);
    for (std::size_t r = row - 2; r <= row + 2; ++r) {
      for (std::size_t c = column - 1; c <= column + 1; ++c) sum += static_cast<double>(std::norm(bins(c, r).vv));
    }
    return sum;
  };
  for (const auto& [mode, name] : {std::pair{radar::Mode::Spotlight, "spotlight"},
                                   {radar::Mode::DopplerBeamSharpening, "sharpened image"},
                                   {radar::Mode::Stripmap, "strip"}}) {
    for (const double tilt_deg : {-20.0, -18.0, -22.0}) {
      radar::Radar radar = looking_north_in(mode);
      radar.processing.thermal_noise = true;
      const double on_axis = noise_about(radar, 0.0);
      radar.antenna.elevation = radar::GaussianBeam{};
      radar.antenna.elevation_width_rad = radians_from_deg(4.0);
      radar.antenna.tilt_rad = radians_from_deg(tilt_deg);
      validation::expect_close({image_noise_group,
                                fmt::format("noise of a {} 20° down, beam of 4° tilted by {}°", name, tilt_deg),
                                tilt_deg == -20.0 ? 0.0 : 6.02, db_from_linear(noise_about(radar, 0.0) / on_axis), 0.05,
                                "dB", "half power, out and back"});
      radar.processing.antenna_pattern = true;
      EXPECT_NEAR(noise_about(radar, 0.0) / on_axis, 1.0, 1e-3) << name << " with the pattern left in";
    }
  }
  const double half_beam_m = 8000.0 * std::cos(radians_from_deg(20.0)) * std::tan(0.025);
  for (const double east_m : {-half_beam_m, half_beam_m}) {
    radar::Radar radar = looking_north_in(radar::Mode::Spotlight);
    radar.processing.thermal_noise = true;
    const double lifted = noise_about(radar, east_m);
    radar.antenna.azimuth = radar::EvenBeam{};
    validation::expect_close({image_noise_group, "noise of a spotlight half a beam off its axis", 6.02,
                              db_from_linear(lifted / noise_about(radar, east_m)), 0.1, "dB",
                              "half power, out and back"});
    // Of a scan the axis passes over every place.
    radar::Radar sharpened = looking_north_in(radar::Mode::DopplerBeamSharpening);
    sharpened.processing.thermal_noise = true;
    const double scanned = noise_about(sharpened, east_m);
    sharpened.antenna.azimuth = radar::EvenBeam{};
    EXPECT_NEAR(scanned / noise_about(sharpened, east_m), 1.0, 1e-6);
  }
}

/// Pulses in volts have the noise of the receiver and the antenna in their echoes. What a processor makes of them,
/// which adds up N under a window and divides by what 1 m² gives at a place, has the noise of the image.
double noise_over_that_of_pulses_db(const radar::Radar& radar) {
  const auto terrain = level_terrain(1000.0);
  const simulate::CoherentScene nothing{&terrain, even_in_all_channels(0.0F)};
  const radar::Rectangle area{-40.0, -40.0, 40.0, 40.0};
  const Vec3d middle{};
  const double voltage = static_cast<double>(receiver::calibrated_voltage(radar, receiver::towards(middle))(
      {0.0, {radar.position, radar.velocity_mps}}, middle, 8000.0));
  const double n_w = radar::WindowResponse(radar.waveform.window).noise_bandwidth();
  double square_v2 = 0.0, samples = 0.0, square_m2 = 0.0, bins = 0.0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const simulate::CoherentSettings settings{.interval_s = 0.2, .seed = seed, .calibrated = true};
    const auto pulses = simulate::phase_history(nothing, radar, area, settings);
    for (const auto& sample : pulses.samples.values()) square_v2 += static_cast<double>(std::norm(sample.vv));
    samples += static_cast<double>(pulses.samples.size());
    const auto image = simulate::range_doppler_image(nothing, radar, area, settings);
    const Vec2d place = image.place_of(middle);
    const auto row = static_cast<std::size_t>(place.y), column = static_cast<std::size_t>(place.x);
    for (std::size_t c = column - 4; c <= column + 4; ++c) {
      for (std::size_t r = row - 10; r <= row + 10; ++r) {
        const auto& bin = image.amplitude_m(c, r);
        square_m2 += static_cast<double>(std::norm(bin.vv) + std::norm(bin.hh) + std::norm(bin.hv));
        bins += 3.0;
      }
    }
  }
  return db_from_linear(square_m2 / bins / (square_v2 / samples / (voltage * voltage) * n_w / 200.0));
}

TEST(ImageNoise, off_the_axis_is_what_pulses_have) {
  radar::Radar radar = looking_north_in(radar::Mode::Spotlight);
  radar.processing.thermal_noise = true;
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(4.0);
  radar.antenna.tilt_rad = radians_from_deg(-17.0);
  validation::expect_close({image_noise_group, "noise of a spotlight 3° under its axis, over that of its pulses", 0.0,
                            noise_over_that_of_pulses_db(radar), 0.2, "dB", "volts of 1 m² there, N/n_w pulses"});
}

/// The receiver is deaf while a pulse of 133 µs leaves: of what comes from 8 km, 53 µs away, it hears 0.4.
TEST(ImageNoise, of_a_range_that_is_heard_in_part_is_what_pulses_have) {
  radar::Radar radar = looking_north_in(radar::Mode::Spotlight);
  radar.processing.thermal_noise = true;
  radar.waveform.pulse_length_s = 133e-6;
  EXPECT_NEAR(noise_over_that_of_pulses_db(radar), 0.0, 0.2);
}

/// The bytes are those of one thread for any number of them, with the pattern in the image or its noise lifted.
TEST(ImageNoise, and_all_else_does_not_depend_on_threads) {
  const auto terrain = level_terrain(1000.0);
  radar::Target mover;
  mover.track = radar::Track::straight({10.0, 20.0, 2.0}, {3.0, 4.0, 0.0});
  mover.rcs_m2 = radar::Channels{50.0F, 40.0F, 3.0F, 20.0F};
  mover.size_m = {6.0, 3.0, 4.0};
  const std::vector<radar::Target> targets{mover};
  const simulate::CoherentScene scene{&terrain, even_in_all_channels(0.1F), targets,
                                      [](Vec2d place) { return place.x > 0.0; }};
  for (const radar::Mode mode : {radar::Mode::Spotlight, radar::Mode::Stripmap}) {
    auto radar = looking_north_in(mode);
    radar.wind_mps = 7.0;
    radar.antenna.azimuth = radar::ApertureBeam{{.shape = radar::WindowShape::Rectangular}};
    radar.waveform.pulse_repetition_hz = 400.0;
    radar.processing.thermal_noise = true;
    radar.processing.antenna_pattern = mode == radar::Mode::Stripmap;
    const radar::Rectangle area{-100.0, -100.0, 100.0, 100.0};
    const auto image_by = [&](unsigned threads) {
      const simulate::CoherentSettings settings{
          .interval_s = 0.2, .along_resolution_m = 3.0, .seed = 11, .threads = threads};
      return mode == radar::Mode::Stripmap ? simulate::stripmap_image(scene, radar, area, settings).amplitude_m
                                           : simulate::range_doppler_image(scene, radar, area, settings).amplitude_m;
    };
    const auto one = image_by(1), many = image_by(5);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one.values()[i], many.values()[i]) << i;
  }
}

/// Half a beam off the axis a point has lost 3 dB out and 3 dB back. Where the antenna scans it has not, and elevation
/// counts in all modes.
TEST(ImagePattern, darkens_what_the_beam_looks_past) {
  const auto terrain = level_terrain(1000.0);
  const double half_beam_m = 8000.0 * std::cos(radians_from_deg(20.0)) * std::tan(0.025);
  const radar::GroundGrid grid{-half_beam_m - 20.0, 60.0, 2.0, static_cast<std::size_t>(half_beam_m) + 20, 60};
  const auto around = [&](const radar::Radar& radar, double east_m) {
    const simulate::CoherentScene scene{&terrain, even_in_all_channels(0.1F)};
    const auto map = product::projected_to_ground(
        simulate::range_doppler_image(scene, radar, {-300.0, -100.0, 300.0, 100.0}, {.interval_s = 0.5}), terrain,
        grid);
    double sum = 0.0, count = 0.0;
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        if (std::abs(grid.centre_of(column, row).x - east_m) > 10.0) continue;
        sum += static_cast<double>(map.sigma0(column, row).vv);
        count += 1.0;
      }
    }
    return sum / count;
  };
  // Against the image of the same speckle without the pattern.
  const auto fall_db = [&](const radar::Radar& plain) {
    radar::Radar radar = plain;
    radar.processing.antenna_pattern = true;
    return db_from_linear(around(radar, -half_beam_m) / around(plain, -half_beam_m) * around(plain, 0.0) /
                          around(radar, 0.0));
  };
  radar::Radar spotlight = looking_north_in(radar::Mode::Spotlight);
  validation::expect_close({image_noise_group, "even ground half a beam off the axis of a spotlight", -6.02,
                            fall_db(spotlight), 0.2, "dB", "half power, out and back"});
  EXPECT_NEAR(fall_db(looking_north_in(radar::Mode::DopplerBeamSharpening)), 0.0, 0.01);
  radar::Radar fixed = looking_north_in(radar::Mode::DopplerBeamSharpening);
  fixed.scan.kind = radar::ScanKind::Fixed;
  EXPECT_NEAR(fall_db(fixed), -6.02, 0.2);
}

/// A target 20° down, under a beam of 4° whose peak is on it, half a width above or below it, or in the sky.
TEST(ImagePattern, counts_elevation_in_all_modes) {
  const auto terrain = level_terrain(1000.0);
  radar::Target target;
  target.track = radar::Track::straight({0.0, 0.0, 0.0});
  target.rcs_m2 = radar::Channels{100.0F, 100.0F, 0.0F, 100.0F};
  const std::vector<radar::Target> targets{target};
  const simulate::CoherentScene scene{&terrain, even_in_all_channels(0.0F), targets};
  const radar::Rectangle area{-40.0, -40.0, 40.0, 40.0};
  const auto energy = [&](radar::Radar radar, const radar::BeamShape& elevation, double tilt_deg) {
    radar.processing.antenna_pattern = true;
    radar.antenna.elevation = elevation;
    radar.antenna.elevation_width_rad = radians_from_deg(4.0);
    radar.antenna.tilt_rad = radians_from_deg(tilt_deg);
    const simulate::CoherentSettings settings{.interval_s = 0.2, .along_resolution_m = 4.0};
    const auto bins = radar.mode == radar::Mode::Stripmap
                          ? simulate::stripmap_image(scene, radar, area, settings).amplitude_m
                          : simulate::range_doppler_image(scene, radar, area, settings).amplitude_m;
    double sum = 0.0;
    for (const auto& bin : bins.values()) sum += static_cast<double>(std::norm(bin.vv));
    return sum;
  };
  for (const auto& [mode, name] : {std::pair{radar::Mode::Spotlight, "spotlight"},
                                   {radar::Mode::DopplerBeamSharpening, "sharpened image"},
                                   {radar::Mode::Stripmap, "strip"}}) {
    const auto radar = looking_north_in(mode);
    const double peak = energy(radar, radar::EvenBeam{}, 0.0);
    ASSERT_GT(peak, 0.0) << name;
    for (const auto& [tilt_deg, expected_db] : {std::pair{-20.0, 0.0}, {-18.0, -6.02}, {-22.0, -6.02}}) {
      validation::expect_close({image_noise_group,
                                fmt::format("{}, place 20° down, beam of 4° tilted by {}°", name, tilt_deg),
                                expected_db, db_from_linear(energy(radar, radar::GaussianBeam{}, tilt_deg) / peak),
                                0.02, "dB", "half power, out and back"});
    }
    EXPECT_EQ(energy(radar, radar::GaussianBeam{}, 20.0), 0.0) << name;
  }
}

}  // namespace
}  // namespace sigmascape
