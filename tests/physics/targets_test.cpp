#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "physics/image_total.h"
#include "physics/level_terrain.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/iq_record.h"
#include "sigmascape/radar/corner_reflector.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/radar/range_response.h"
#include "sigmascape/receiver/bin_response.h"
#include "sigmascape/receiver/calibrated_voltage.h"
#include "sigmascape/receiver/pulse_receiver.h"
#include "sigmascape/receiver/receive_chain.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape {
namespace {

constexpr std::string_view targets_group = "Targets";

/// Looks north from the south, 20° down on the middle of the terrain, and flies east.
radar::Radar looking_north(double range_resolution_m) {
  radar::Radar radar;
  radar.position = radar::position_seeing({0.0, 0.0, 0.0}, pi, radians_from_deg(20.0), 8000.0);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = range_resolution_m;
  radar.waveform.pulse_repetition_hz = 2000.0;
  radar.mode = radar::Mode::Spotlight;
  return radar;
}

render::Reflectivity even_ground(float sigma0) {
  return [sigma0](Vec2d, const radar::Aspect&) { return radar::Channels{sigma0, sigma0, sigma0 / 10.0F, 0.0F}; };
}

radar::Target target_of(float rcs_m2, Vec3d position, Vec3d velocity_mps = {}) {
  radar::Target target;
  target.track = radar::Track::straight(position, velocity_mps);
  target.rcs_m2 = radar::Channels{rcs_m2, rcs_m2, 0.0F, rcs_m2};
  return target;
}

/// Whatever the bins: from metres to half a kilometre, as the levels of detail have them.
TEST(Target, of_ten_square_metres_returns_them_at_every_resolution) {
  const auto terrain = level_terrain();
  const radar::Rectangle area{-400.0, -400.0, 400.0, 400.0};
  for (const double resolution_m : {2.0, 8.0, 32.0, 128.0, 512.0}) {
    auto radar = looking_north(resolution_m);
    radar.mode = radar::Mode::RealBeam;
    radar.beam_width_rad = 0.01;
    const auto grid = simulate::bins_for(radar, area, terrain);
    radar::RangeAzimuthImage image{grid, radar.position, Array2D<radar::Channels>(grid.azimuths, grid.ranges)};
    const std::vector<radar::Target> targets{target_of(10.0F, {13.0, -27.0, 1.0})};
    simulate::add_targets(image, radar, {terrain}, targets, {});
    validation::expect_close(
        {targets_group, "10 m² in the power mode, cells of " + std::to_string(static_cast<int>(resolution_m)) + " m",
         10.0, db_from_linear(total_vv_m2(image)), 0.1, "dBm²", "weights sum to one"});
  }
}

TEST(Target, of_ten_square_metres_returns_them_in_coherent_modes) {
  const auto terrain = level_terrain();
  const radar::Rectangle area{-60.0, -60.0, 60.0, 60.0};
  const std::vector<radar::Target> targets{target_of(10.0F, {3.0, -2.0, 1.0})};
  const simulate::CoherentScene scene{&terrain, even_ground(0.0F), targets};
  const auto brightest = [](const Array2D<radar::ComplexChannels>& bins) {
    double best = 0.0;
    for (const auto& bin : bins.values()) best = std::max<double>(best, std::norm(bin.vv));
    return best;
  };
  for (const double resolution_m : {1.0, 4.0, 16.0}) {
    const auto radar = looking_north(resolution_m);
    // Bins are finer than cells, yet a target may fall between them; energy over the response's own does not.
    const auto image = simulate::range_doppler_image(scene, radar, area, {.interval_s = 0.05});
    double energy = 0.0;
    for (const auto& bin : image.amplitude_m.values()) energy += std::norm(bin.vv);
    const double noise_width = radar::WindowResponse(radar.waveform.window).noise_bandwidth();
    const double bins_a_cell = speed_of_light_mps /
                               (2.0 * radar::bandwidth_of(resolution_m, radar.waveform.window) * image.range_m.step) *
                               (static_cast<double>(image.doppler_hz.bins) / 100.0);
    validation::expect_close(
        {targets_group,
         "10 m² in a range–Doppler image, cells of " + std::to_string(static_cast<int>(resolution_m)) + " m", 10.0,
         db_from_linear(energy / (bins_a_cell * noise_width * noise_width)), 0.1, "dBm²", "energy of the response"});
    EXPECT_NEAR(db_from_linear(brightest(image.amplitude_m)), 10.0, 1.5);
    const auto strip = simulate::stripmap_image(scene, radar, area, {.along_resolution_m = resolution_m});
    EXPECT_NEAR(db_from_linear(brightest(strip.amplitude_m)), 10.0, 1.5);
  }
}

TEST(CoherentGround, returns_sigma0_times_the_area_of_a_cell) {
  const auto terrain = level_terrain();
  auto radar = looking_north(5.0);
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  const float sigma0 = 0.05F;
  const auto image =
      simulate::range_doppler_image({&terrain, even_ground(sigma0)}, radar, {-400.0, -400.0, 400.0, 400.0},
                                    {.interval_s = 0.3, .scatterer_spacing_m = 2.0, .seed = 4});
  double mean = 0.0, count = 0.0;
  for (std::size_t row = 0; row < image.range_m.bins; ++row) {
    const double range_m = image.range_m.middle_of(static_cast<double>(row) + 0.5);
    for (std::size_t column = 0; column < image.doppler_hz.bins; ++column) {
      const double frequency = image.doppler_hz.middle_of(static_cast<double>(column) + 0.5);
      // Well within the area.
      if (std::abs(frequency) > 80.0 || std::abs(range_m - 8000.0) > 250.0) continue;
      mean += std::norm(image.amplitude_m(column, row).vv);
      count += 1.0;
    }
  }
  mean /= count;
  // Doppler is that across the flight, so its cell is λr/2vT whatever the grazing angle; c/2B on the ground is longer.
  const double cell_m2 = 5.0 / 0.8859 / std::cos(radians_from_deg(20.0)) *
                         radar::cross_range_resolution_m(8000.0, wavelength_m(10e9), 100.0, 0.3, pi / 2.0);
  validation::expect_close({targets_group, "mean power of even ground, focused", 0.0,
                            db_from_linear(mean / (sigma0 * cell_m2)), 0.25, "dB", "σ0 · cell area"});
}

TEST(CoherentGround, is_dark_behind_a_mover_where_it_really_is) {
  const auto terrain = level_terrain();
  const auto radar = looking_north(2.0);
  // A moving wall, 40 m long across the line of sight and 15 m tall: its shadow on level ground is 15/tan 20° = 41 m.
  auto wall = target_of(1000.0F, {0.0, 0.0, 7.5}, {0.0, -3.0, 0.0});
  wall.size_m = {2.0, 40.0, 15.0};
  const std::vector<radar::Target> targets{wall};
  const radar::Rectangle area{-120.0, -120.0, 120.0, 120.0};
  const auto image =
      simulate::range_doppler_image({&terrain, even_ground(0.1F), targets}, radar, area, {.interval_s = 0.4});
  const auto mean_around = [&](Vec3d ground) {
    const Vec2d bin = image.place_of({ground});
    double sum = 0.0;
    for (int r = -3; r <= 3; ++r) {
      for (int c = -2; c <= 2; ++c) {
        sum +=
            std::norm(image.amplitude_m(static_cast<std::size_t>(bin.x + c), static_cast<std::size_t>(bin.y + r)).vv);
      }
    }
    return sum / 35.0;
  };
  const double lit = mean_around({-70.0, 20.0, 0.0}) / 2.0 + mean_around({70.0, 20.0, 0.0}) / 2.0;
  EXPECT_LT(db_from_linear(mean_around({0.0, 20.0, 0.0}) / lit), -10.0);  // behind the wall
  EXPECT_GT(db_from_linear(mean_around({0.0, 60.0, 0.0}) / lit), -4.0);   // beyond its shadow
  // The echo itself is a hundred metres off: r v_r/V with v_r = −3 cos 20°.
  std::size_t best = 0;
  for (std::size_t i = 0; i < image.amplitude_m.size(); ++i) {
    if (std::norm(image.amplitude_m.values()[i].vv) > std::norm(image.amplitude_m.values()[best].vv)) best = i;
  }
  const double seen_hz = image.doppler_hz.middle_of(static_cast<double>(best % image.doppler_hz.bins) + 0.5);
  const double shift_m = seen_hz * wavelength_m(10e9) / 200.0 * 8000.0;
  EXPECT_NEAR(shift_m, radar::mover_shift_m(8000.0, -3.0 * std::cos(radians_from_deg(20.0)), 100.0), 5.0);
}

TEST(CalibratedPulses, return_the_radar_equation_in_volts) {
  auto radar = looking_north(3.0);
  radar.atmosphere_per_m = std::log(linear_from_db(0.5)) / 1e3;  // 8 dB on the way there and back
  const Vec3d place{0.0, 0.0, 0.0};
  const std::vector<radar::Target> targets{target_of(10.0F, place)};
  const receiver::PulseReceiver receiver(radar, {7900.0, 8100.0, 4.0});
  const auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps), {.count = 1}, {},
                                        targets, receiver::calibrated_voltage(radar, receiver::towards(place)));
  EXPECT_EQ(history.unit, "V");
  double best = 0.0;
  for (const auto& sample : history.samples.values()) best = std::max<double>(best, std::norm(sample.vv));
  const double expected_w =
      radar::signal_to_noise(radar, 10.0, 8000.0) * radar::noise_power_w(radar) * radar.receiver.gain;
  validation::expect_close({targets_group, "peak power of 10 m² at 8 km over the radar equation's", 0.0,
                            db_from_linear(best / radar.receiver.impedance_ohm / expected_w), 0.1, "dB",
                            "P_t G² λ² σ e^(−2αr)/((4π)³ r⁴ L) · G_c"});
}

/// Power of a point by the receive chain, which lays the radar equation over bins, and by pulses in volts.
TEST(CalibratedPulses, are_eclipsed_as_the_receive_chain_has_it) {
  auto radar = looking_north(3.0);
  radar.waveform.pulse_length_s = 20e-6;
  const Vec3d place{};
  const std::vector<radar::Target> targets{target_of(10.0F, place)};
  const double step_m = radar.range_resolution_m / 2.0, step_rad = radar.beam_width_rad / 2.0;
  const double bins_of_a_point =
      receiver::range_response(radar, step_m).peak_bins * receiver::azimuth_response(radar, step_rad).peak_bins;
  const auto rcs_m2 = static_cast<float>(10.0 / bins_of_a_point);
  const radar::RangeAzimuthImage image{.grid = {8000.0 - step_m / 2.0, step_m, 1, -step_rad / 2.0, step_rad, 1},
                                       .radar_position = radar.position,
                                       .rcs_m2 = Array2D<radar::Channels>(1, 1, {rcs_m2, rcs_m2, 0.0F, rcs_m2})};
  // An echo that comes back 53.4 µs after its pulse meets the next one 60 µs after it; another has just been sent.
  for (const auto& [interval_us, heard] : {std::pair{500.0, 1.0}, {60.0, 0.3314}, {45.0, 0.4186}}) {
    radar.waveform.pulse_repetition_hz = 1e6 / interval_us;
    EXPECT_NEAR(radar::uneclipsed_part(8000.0, 20e-6, 1e6 / interval_us), heard, 1e-3);
    const auto chain = receiver::received_power(radar, image, radar::Polarization::VV);
    const receiver::PulseReceiver receiver(radar, {7900.0, 8100.0, 4.0});
    const auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps),
                                          {.count = 1, .repetition_hz = 1e6 / interval_us}, {}, targets,
                                          receiver::calibrated_voltage(radar, receiver::towards(place)));
    double best = 0.0;
    for (const auto& sample : history.samples.values()) best = std::max<double>(best, std::norm(sample.vv));
    const double signal_w = best / radar.receiver.impedance_ohm / radar.receiver.gain;
    const double expected_db = db_from_linear(static_cast<double>(chain.signal_w(0, 0)) / chain.noise_w);
    validation::expect_close({targets_group,
                              "signal to noise of pulses every " + std::to_string(static_cast<int>(interval_us)) +
                                  " µs, a point at 8 km under pulses of 20 µs",
                              expected_db, db_from_linear(signal_w / radar::noise_power_w(radar)), 0.1, "dB",
                              "receive chain"});
    EXPECT_NEAR(expected_db - db_from_linear(radar::signal_to_noise(radar, 10.0, 8000.0)), 2.0 * db_from_linear(heard),
                0.02);
  }
}

TEST(CalibratedPulses, tell_in_their_file_what_leads_back_to_square_metres) {
  auto radar = looking_north(3.0);
  radar.atmosphere_per_m = std::log(linear_from_db(0.5)) / 1e3;
  radar.receiver.gain = 1e4;
  const Vec3d place{0.0, 0.0, 0.0};
  const std::vector<radar::Target> targets{target_of(10.0F, place)};
  const receiver::PulseReceiver receiver(radar, {7900.0, 8100.0, 4.0});
  const auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps), {.count = 1}, {},
                                        targets, receiver::calibrated_voltage(radar, receiver::towards(place)));
  double brightest = 0.0;
  for (const auto& sample : history.samples.values()) brightest = std::max<double>(brightest, std::abs(sample.vv));
  const auto numbers = product::iq_record(history, radar).numbers;
  const double one_square_metre =
      numbers.at("volts_from_1_m2_at_1_km") / 64.0 * std::pow(10.0, -numbers.at("atmosphere_db_per_km") * 7.0 / 10.0);
  validation::expect_close({targets_group, "10 m² at 8 km by what the file says of its volts", 10.0,
                            std::pow(brightest / one_square_metre, 2.0), 0.25, "m²", "docs/iq_files.md"});
  EXPECT_DOUBLE_EQ(numbers.at("noise_power_w"), radar::noise_power_w(radar) * 1e4);
  EXPECT_FALSE(product::iq_record(receiver.receive(radar::Track::straight({}, {}), {.count = 1}, {}, {}), radar)
                   .numbers.contains("impedance_ohm"));
}

/// An echo that comes back 53.4 µs after its pulse meets the next one 60 µs after it, at the range from which it comes
/// and at that into which it folds.
TEST(CalibratedPulses, tell_in_their_file_what_the_transmitter_deafens) {
  auto radar = looking_north(3.0);
  radar.waveform.pulse_length_s = 20e-6;
  const std::vector<radar::Target> targets{target_of(10.0F, {})};
  for (const auto& [interval_s, gate_opens_m] : {std::pair{60e-6, 7900.0}, {45e-6, 7900.0}, {45e-6, 1150.0}}) {
    radar.waveform.pulse_repetition_hz = 1.0 / interval_s;
    const receiver::PulseReceiver receiver(radar, {gate_opens_m, gate_opens_m + 200.0, 4.0});
    const auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps),
                                          {.count = 1, .repetition_hz = 1.0 / interval_s}, {}, targets,
                                          receiver::calibrated_voltage(radar, receiver::towards({})));
    double brightest = 0.0;
    for (const auto& sample : history.samples.values()) brightest = std::max<double>(brightest, std::abs(sample.vv));
    const auto numbers = product::iq_record(history, radar).numbers;
    const double heard =
        radar::uneclipsed_part(8000.0, numbers.at("pulse_length_s"), numbers.at("pulse_repetition_hz"));
    EXPECT_LT(heard, 0.5);
    const double one_square_metre = heard * numbers.at("volts_from_1_m2_at_1_km") / 64.0 *
                                    std::pow(10.0, -numbers.at("atmosphere_db_per_km") * 7.0 / 10.0);
    EXPECT_NEAR(std::pow(brightest / one_square_metre, 2.0), 10.0, 0.25) << interval_s << ", " << gate_opens_m;
  }
}

TEST(CalibratedPulses, carry_noise_of_kTBF_with_the_band_of_the_pulse) {
  const auto radar = looking_north(3.0);
  const receiver::PulseReceiver receiver(radar, {7000.0, 9000.0, 2.0});
  auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps), {.count = 64}, {}, {},
                                  receiver::calibrated_voltage(radar, receiver::towards({})));
  receiver::add_thermal_noise(history, radar, 5);
  double power = 0.0;
  std::complex<double> next;
  for (std::size_t pulse = 0; pulse < 64; ++pulse) {
    const auto row = history.samples.row(pulse);
    for (std::size_t m = 0; m + 1 < row.size(); ++m) {
      power += std::norm(row[m].hh);
      next += std::complex<double>(row[m].hh * std::conj(row[m + 1].hh));
    }
  }
  const double samples = 64.0 * static_cast<double>(history.samples.columns() - 1);
  const double expected = radar::noise_power_w(radar) * radar.receiver.gain * radar.receiver.impedance_ohm;
  validation::expect_close({targets_group, "thermal noise of pulses over kTBF", 0.0,
                            db_from_linear(power / samples / expected), 0.1, "dB", "k T₀ B F"});
  // The ends of the gate have nothing in common, however many samples it has: this length a transform takes as it is.
  for (const std::size_t columns : {std::size_t{190}, std::size_t{192}}) {
    auto record = history;
    record.samples = Array2D<radar::ComplexChannels>(columns, 1024);
    record.pulses.resize(1024, record.pulses.front());
    receiver::add_thermal_noise(record, radar, 5);
    std::complex<double> both;
    for (std::size_t pulse = 0; pulse < 1024; ++pulse) {
      const auto row = record.samples.row(pulse);
      both += std::complex<double>(row.front().hh * std::conj(row.back().hh)) / 1024.0;
    }
    EXPECT_LT(std::abs(both) / expected, 0.12) << columns;
  }
  // Half a sample a resolution: neighbours are alike, as the band is half of what is sampled.
  EXPECT_GT(next.real() / power, 0.5);
  EXPECT_THROW(
      {
        auto metres = receiver.receive(radar::Track::straight({}, {}), {.count = 1}, {}, {});
        receiver::add_thermal_noise(metres, radar, 5);
      },
      std::exception);
}

// Looks at the same ground are added up to bring out what noise hides: it must be another each time, and speckle must
// not. The difference of two recordings is then noise alone, of twice the power of each.
TEST(CalibratedPulses, of_another_dwell_have_other_noise_over_the_same_speckle) {
  const auto terrain = level_terrain();
  const auto radar = looking_north(5.0);
  const auto recorded = [&](std::uint64_t dwell) {
    return simulate::phase_history(
        {&terrain, even_ground(0.05F)}, radar, {-400.0, -400.0, 400.0, 400.0},
        {.interval_s = 0.01, .scatterer_spacing_m = 2.0, .seed = 4, .dwell = dwell, .calibrated = true});
  };
  const auto first = recorded(1), again = recorded(1), second = recorded(2);
  double power = 0.0, repeated = 0.0, ground = 0.0;
  const auto a = first.samples.values(), b = second.samples.values(), c = again.samples.values();
  for (std::size_t i = 0; i < a.size(); ++i) {
    power += std::norm(std::complex<double>(a[i].vv) - std::complex<double>(b[i].vv));
    repeated += std::norm(std::complex<double>(a[i].vv) - std::complex<double>(c[i].vv));
    ground += std::norm(std::complex<double>(a[i].vv));
  }
  const double noise = radar::noise_power_w(radar) * radar.receiver.gain * radar.receiver.impedance_ohm;
  const auto count = static_cast<double>(a.size());
  EXPECT_GT(ground / count, 10.0 * noise) << "or speckle would not show";
  validation::expect_close({targets_group, "difference of two dwells over noise of both", 0.0,
                            db_from_linear(power / count / (2.0 * noise)), 0.2, "dB", "k T₀ B F"});
  EXPECT_EQ(repeated, 0.0);
}

TEST(CornerReflectors, AreWhatSentinel1IsCalibratedWith) {
  const double wavelength = wavelength_m(5.405e9);
  const auto expect_dbsm = [](const char* name, double expected, double rcs_m2) {
    validation::expect_close({targets_group, name, expected, db_from_linear(rcs_m2), 0.01, "dBsm", "ESA STEP forum"});
  };
  expect_dbsm("dihedral of 1.5 m at 5.405 GHz", 46.17, radar::dihedral_rcs_m2(1.5, 1.5, wavelength));
  expect_dbsm("trihedral of triangles of 2.5 m at 5.405 GHz", 47.26,
              radar::triangular_trihedral_rcs_m2(2.5, wavelength));
  // A triangular trihedral shows the area of a hexagon, a square one three times as much.
  EXPECT_NEAR(radar::square_trihedral_rcs_m2(1.0, wavelength) / radar::triangular_trihedral_rcs_m2(1.0, wavelength),
              9.0, 1e-12);
}

/// Half a width above or below its peak a beam has lost 3 dB out and 3 dB back; a peak above the horizontal hears
/// nothing of the ground.
TEST(CalibratedPulses, have_the_elevation_cut_of_the_antenna) {
  const radar::Pulse pulse{0.0, {looking_north(3.0).position, {100.0, 0.0, 0.0}}};
  const auto volts = [&](const radar::BeamShape& elevation, double tilt_deg) {
    auto radar = looking_north(3.0);
    radar.antenna.elevation = elevation;
    radar.antenna.elevation_width_rad = radians_from_deg(4.0);
    radar.antenna.tilt_rad = radians_from_deg(tilt_deg);
    return static_cast<double>(receiver::calibrated_voltage(radar, receiver::towards({}))(pulse, {}, 8000.0));
  };
  const double even = volts(radar::EvenBeam{}, 0.0);
  ASSERT_GT(even, 0.0);
  for (const auto& [tilt_deg, expected_db] : {std::pair{-20.0, 0.0}, {-18.0, -6.02}, {-22.0, -6.02}}) {
    validation::expect_close(
        {targets_group, fmt::format("pulses of a place 20° down, beam of 4° tilted by {}°", tilt_deg), expected_db,
         2.0 * db_from_linear(volts(radar::GaussianBeam{}, tilt_deg) / even), 0.01, "dB", "half power, out and back"});
  }
  EXPECT_EQ(volts(radar::GaussianBeam{}, 20.0), 0.0);
}

/// Leaves that the wind moves towards the radar, straight below it, are heard like those that stand.
TEST(CalibratedPulses, hear_what_moves_below_the_radar) {
  auto radar = looking_north(3.0);
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(60.0);
  const auto voltage = receiver::calibrated_voltage(radar, receiver::towards({}));
  const radar::Pulse pulse{0.0, {{0.0, 0.0, 1000.0}, {100.0, 0.0, 0.0}}};
  const float nearer = voltage(pulse, {}, 999.999), still = voltage(pulse, {}, 1000.0);
  ASSERT_GT(still, 0.0F);
  EXPECT_NEAR(nearer / still, 1.0F, 1e-4F);
}

}  // namespace
}  // namespace sigmascape
