#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "physics/even_window.h"
#include "physics/transformed_pulses.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/window_response.h"
#include "sigmascape/receiver/doppler_imager.h"
#include "sigmascape/receiver/pulse_receiver.h"
#include "sigmascape/receiver/smear.h"
#include "sigmascape/receiver/stripmap_imager.h"

namespace sigmascape {
namespace {

constexpr std::string_view doppler_group = "Doppler";

/// λ = 3 cm.
radar::Radar even_band_radar(double range_resolution_m) {
  radar::Radar radar;
  radar.frequency_hz = speed_of_light_mps / 0.03;
  radar.range_resolution_m = range_resolution_m;
  radar.waveform.window = even_window;
  radar.beam_width_rad = radians_from_deg(12.0);  // movers are seen from far before and behind
  return radar;
}

radar::Scatterer vv_point_at(Vec3d position) {
  return {position, {.vv = {1.0F, 0.0F}, .hh = {}, .hv = {}}};
}

/// A ground point at this range and squint from a platform that flies north at the origin.
Vec3d ahead(double range_m, double squint_rad, double height_m) {
  const double ground_m = std::sqrt(range_m * range_m - height_m * height_m);
  return {ground_m * std::sin(squint_rad), ground_m * std::cos(squint_rad), 0.0};
}

struct BinPeak {
  double column = 0.0, row = 0.0, power = 0.0;
};

/// The brightest bin, its place refined by a parabola through the neighbours.
BinPeak brightest_bin(const Array2D<radar::ComplexChannels>& bins) {
  std::size_t column = 0, row = 0;
  double best = -1.0;
  for (std::size_t r = 0; r < bins.rows(); ++r) {
    for (std::size_t c = 0; c < bins.columns(); ++c) {
      if (std::norm(bins(c, r).vv) > best) {
        best = std::norm(bins(c, r).vv);
        column = c;
        row = r;
      }
    }
  }
  const auto vertex = [](double left, double middle, double right) {
    const double bend = left - 2.0 * middle + right;
    return bend < 0.0 ? 0.5 * (left - right) / bend : 0.0;
  };
  const auto at = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
    const auto columns = static_cast<std::ptrdiff_t>(bins.columns()), rows = static_cast<std::ptrdiff_t>(bins.rows());
    return std::abs(
        bins(static_cast<std::size_t>((c + columns) % columns), static_cast<std::size_t>((r + rows) % rows)).vv);
  };
  const auto c = static_cast<std::ptrdiff_t>(column), r = static_cast<std::ptrdiff_t>(row);
  return {static_cast<double>(c) + 0.5 + vertex(at(c - 1, r), at(c, r), at(c + 1, r)),
          static_cast<double>(r) + 0.5 + vertex(at(c, r - 1), at(c, r), at(c, r + 1)), best};
}

/// Half-power width of the brightest row's main lobe, in bins, between bins by straight lines.
double half_power_bins(const Array2D<radar::ComplexChannels>& bins) {
  const BinPeak peak = brightest_bin(bins);
  const auto row = bins.row(static_cast<std::size_t>(peak.row));
  const auto crossing = [&](std::ptrdiff_t step) {
    auto at = static_cast<std::ptrdiff_t>(peak.column);
    const auto power = [&](std::ptrdiff_t c) {
      return static_cast<double>(std::norm(row[static_cast<std::size_t>(c)].vv));
    };
    while (power(at + step) > 0.5 * peak.power) at += step;
    const double part = (power(at) - 0.5 * peak.power) / (power(at) - power(at + step));
    return static_cast<double>(at) + part * static_cast<double>(step);
  };
  return crossing(1) - crossing(-1);
}

TEST(DopplerBeamSharpening, resolves_lambda_r_over_2vT_sine_squint) {
  const auto radar = even_band_radar(15.0);
  struct Example {
    double range_m, speed_mps, interval_s, squint_deg;
  };
  for (const Example& e :
       {Example{20'000.0, 150.0, 0.1, 45.0}, {20'000.0, 150.0, 0.5, 30.0}, {8'000.0, 80.0, 0.2, 90.0}}) {
    const double squint = radians_from_deg(e.squint_deg), repetition_hz = 2000.0;
    const auto track = radar::Track::straight({0.0, 0.0, 10.0}, {0.0, e.speed_mps, 0.0});
    const receiver::CoherentInterval interval{.pulses = static_cast<std::size_t>(e.interval_s * repetition_hz),
                                              .repetition_hz = repetition_hz,
                                              .window = even_window,
                                              .oversampling = 16.0};
    const Vec3d aim = ahead(e.range_m, squint, 10.0);
    receiver::DopplerImager imager(radar, track, interval, {e.range_m - 100.0, e.range_m + 100.0, 2.0}, aim);
    const std::vector<radar::Scatterer> point{vv_point_at(aim)};
    imager.add(point);
    const auto image = imager.image();
    // Metres across the line of sight a bin: by two points that are a small angle apart.
    const double apart_m = 5.0;
    const double angle = apart_m / e.range_m;
    const double bins_apart = image.place_of({ahead(e.range_m, squint + angle, 10.0)}).x - image.place_of({aim}).x;
    const double cell_m = half_power_bins(image.amplitude_m) * apart_m / std::abs(bins_apart) / 0.886;
    const double expected = radar::cross_range_resolution_m(e.range_m, 0.03, e.speed_mps, e.interval_s, squint);
    validation::expect_close({doppler_group,
                              "DBS cell at " + std::to_string(static_cast<int>(e.squint_deg)) + "° squint", expected,
                              cell_m, 0.05 * expected, "m", "λr/(2vT sin φ)"});
  }
}

/// On level ground, from above and in a climb: as fine as the horizontal angle says, however far off the course the
/// line of sight points down.
TEST(DopplerBeamSharpening, resolves_along_constant_range_by_the_angle_on_the_map) {
  const auto radar = even_band_radar(15.0);
  const double range_m = 8000.0, speed_mps = 150.0, repetition_hz = 2000.0, interval_s = 0.4;
  for (const auto& [off_deg, depression_deg, climb_mps] :
       {std::array{8.0, 20.0, 0.0}, {15.0, 40.0, 0.0}, {30.0, 40.0, 40.0}}) {
    const double off = radians_from_deg(off_deg), height_m = range_m * std::sin(radians_from_deg(depression_deg));
    const auto track = radar::Track::straight({0.0, 0.0, height_m}, {0.0, speed_mps, climb_mps});
    const Vec3d aim = ahead(range_m, off, height_m);
    receiver::DopplerImager imager(radar, track,
                                   {.pulses = static_cast<std::size_t>(interval_s * repetition_hz),
                                    .repetition_hz = repetition_hz,
                                    .window = even_window,
                                    .oversampling = 16.0},
                                   {range_m - 100.0, range_m + 100.0, 2.0}, aim);
    const std::vector<radar::Scatterer> point{vv_point_at(aim)};
    imager.add(point);
    const auto image = imager.image();
    const double apart_m = 2.0, angle = apart_m / std::hypot(aim.x, aim.y);
    const double bins_apart = image.place_of({ahead(range_m, off + angle, height_m)}).x - image.place_of({aim}).x;
    const double cell_m = half_power_bins(image.amplitude_m) * apart_m / std::abs(bins_apart) / 0.886;
    const double expected = radar::cross_range_resolution_m(range_m, 0.03, speed_mps, interval_s, off);
    validation::expect_close({doppler_group,
                              "DBS cell " + std::to_string(static_cast<int>(off_deg)) + "° off the course, " +
                                  std::to_string(static_cast<int>(depression_deg)) + "° down" +
                                  (climb_mps > 0.0 ? ", climbing" : ""),
                              expected, cell_m, 0.02 * expected, "m", "λr/(2vT sin φ)"});
  }
}

/// 41 pulses about time zero, from 3 km, 20 km away at 60° of squint.
struct ImageAndPulses {
  radar::Radar radar = even_band_radar(60.0);
  double repetition_hz = 2000.0;
  std::size_t count = 41;
  radar::Track track = radar::Track::straight({0.0, 0.0, 3000.0}, {0.0, 100.0, 0.0});
  double range_m = 20'000.0;
  Vec3d aim = ahead(range_m, radians_from_deg(60.0), 3000.0);

  [[nodiscard]] double difference_of(const std::vector<radar::Scatterer>& points,
                                     const std::vector<radar::Target>& targets) const {
    const receiver::RangeGate gate{range_m - 1000.0, range_m + 1000.0, 1.5};
    receiver::DopplerImager imager(radar, track,
                                   {.pulses = count, .repetition_hz = repetition_hz, .window = even_window}, gate, aim);
    imager.add(points);
    imager.add(targets);
    const auto image = imager.image();
    const auto history = receiver::PulseReceiver(radar, gate)
                             .receive(track,
                                      {.first_time_s = -static_cast<double>(count / 2) / repetition_hz,
                                       .count = count,
                                       .repetition_hz = repetition_hz},
                                      points, targets);
    EXPECT_EQ(history.samples.columns(), image.amplitude_m.rows());
    return difference_from_transform(image, history, 1, [&](std::size_t row, std::size_t pulse) {
      return std::complex<double>(history.samples(row, pulse).vv);
    });
  }
};

TEST(DopplerBeamSharpening, is_what_a_processor_makes_of_the_pulses) {
  const ImageAndPulses example;
  std::vector<radar::Scatterer> points{vv_point_at(example.aim), vv_point_at(example.aim + Vec3d{150.0, 300.0, 0.0}),
                                       vv_point_at(example.aim + Vec3d{-300.0, 400.0, 20.0}),
                                       vv_point_at(example.aim + Vec3d{130.0, -900.0, 0.0})};
  points[1].amplitude_m.vv = {0.0F, 0.7F};
  // What is left: 1 m of range walk against cells of 60 m, and 3° of Doppler change.
  validation::expect_close({doppler_group, "image against transformed pulses, relative error power", 0.0,
                            example.difference_of(points, {}), 1e-3, "1", "independent DFT"});
}

/// Each pulse has a draw of its own, and what that spreads over Doppler is in the image too.
TEST(DopplerBeamSharpening, is_what_a_processor_makes_of_targets_that_change_by_pulse) {
  for (const auto fluctuation : {radar::Swerling::Case2, radar::Swerling::Case4, radar::Swerling::Case3}) {
    for (const std::size_t count : {41UL, 40UL}) {
      ImageAndPulses example;
      example.count = count;
      radar::Target target;
      target.track = radar::Track::straight(example.aim, {});
      target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
      target.fluctuation = fluctuation;
      target.seed = 5;
      EXPECT_LT(example.difference_of({}, {target}), 1e-3)
          << "case " << static_cast<int>(fluctuation) << ", " << count << " pulses";
    }
  }
}

TEST(DopplerBeamSharpening, folds_at_the_pulse_repetition_frequency) {
  const auto radar = even_band_radar(15.0);
  const auto track = radar::Track::straight({0.0, 0.0, 10.0}, {0.0, 150.0, 0.0});
  const double range_m = 10'000.0, repetition_hz = 1000.0;
  const Vec3d aim = ahead(range_m, radians_from_deg(60.0), 10.0), other = ahead(range_m, radians_from_deg(48.0), 10.0);
  receiver::DopplerImager imager(
      radar, track, {.pulses = 100, .repetition_hz = repetition_hz, .window = even_window, .oversampling = 8.0},
      {range_m - 100.0, range_m + 100.0, 2.0}, aim);
  const std::vector<radar::Scatterer> point{vv_point_at(other)};
  imager.add(point);
  const auto image = imager.image();
  const double true_hz = 2.0 * 150.0 / 0.03 * dot(normalized(other - Vec3d{0.0, 0.0, 10.0}), Vec3d{0.0, 1.0, 0.0});
  const double aim_hz = 2.0 * 150.0 / 0.03 * dot(normalized(aim - Vec3d{0.0, 0.0, 10.0}), Vec3d{0.0, 1.0, 0.0});
  ASSERT_GT(true_hz - aim_hz, 1.5 * repetition_hz);  // folds, twice
  const double seen_hz = image.doppler_hz.middle_of(brightest_bin(image.amplitude_m).column);
  validation::expect_close({doppler_group, "folded Doppler", 0.0, std::remainder(seen_hz - true_hz, repetition_hz), 0.5,
                            "Hz", "f modulo PRF"});
  EXPECT_NEAR(image.place_of({other}).x, brightest_bin(image.amplitude_m).column, 0.1);
}

TEST(DopplerBeamSharpening, is_blind_ahead) {
  // Left and right of the nose share their Doppler, and the cell grows beyond the real beam within the wedge.
  const radar::Motion platform{{0.0, 0.0, 10.0}, {0.0, 150.0, 0.0}};
  const double range_m = 20'000.0;
  for (const double off_deg : {1.0, 5.0, 20.0}) {
    const double off = radians_from_deg(off_deg);
    EXPECT_NEAR(radar::range_rate_mps(platform, {ahead(range_m, off, 10.0)}),
                radar::range_rate_mps(platform, {ahead(range_m, -off, 10.0)}), 1e-9);
  }
  const double beam = radians_from_deg(3.0), interval_s = 0.1;
  for (const double depression_deg : {0.0, 40.0}) {
    const double depression = radians_from_deg(depression_deg), width_m = range_m * std::cos(depression) * beam;
    const double wedge = radar::blind_wedge_rad(0.03, 150.0, interval_s, beam, depression);
    EXPECT_NEAR(radar::cross_range_resolution_m(range_m, 0.03, 150.0, interval_s, wedge), width_m, 1e-6);
    EXPECT_GT(radar::cross_range_resolution_m(range_m, 0.03, 150.0, interval_s, wedge / 2.0), width_m);
  }
}

/// 5 m/s towards the radar, 100 m/s, 20 km: a kilometre.
TEST(Mover, is_shifted_by_r_vr_over_V) {
  const auto radar = even_band_radar(5.0);
  const double range_m = 20'000.0, speed_mps = 100.0;
  const Vec3d place{range_m, 0.0, 0.0};
  radar::Target target;
  target.track = radar::Track::straight(place, {-5.0, 0.0, 0.0});
  target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  const std::vector<radar::Target> movers{target};
  {
    const double repetition_hz = 3000.0;
    const auto track = radar::Track::straight({}, {0.0, speed_mps, 0.0});
    receiver::DopplerImager imager(
        radar, track, {.pulses = 300, .repetition_hz = repetition_hz, .window = even_window, .oversampling = 4.0},
        {range_m - 100.0, range_m + 100.0, 2.0}, place);
    imager.add(movers);
    const auto image = imager.image();
    // Where along the flight ground of the same range has that Doppler.
    const double seen_hz = image.doppler_hz.middle_of(brightest_bin(image.amplitude_m).column);
    const double shift_m = seen_hz * 0.03 / (2.0 * speed_mps) * range_m;
    const double cell_m = radar::cross_range_resolution_m(range_m, 0.03, speed_mps, 0.1, pi / 2.0);
    validation::expect_close(
        {doppler_group, "shift of a mover, sharpened beam", 1000.0, shift_m, cell_m, "m", "r v_r/V"});
  }
  {
    receiver::StripmapImager imager(
        radar, {{}, {0.0, speed_mps, 0.0}},
        {.first_along_m = -200.0, .last_along_m = 1400.0, .resolution_m = 5.0, .window = even_window},
        {range_m - 100.0, range_m + 100.0, 2.0});
    imager.add(movers);
    const auto image = imager.image();
    const double along_m = image.along_m.middle_of(brightest_bin(image.amplitude_m).column);
    validation::expect_close({doppler_group, "shift of a mover, stripmap", 1000.0, along_m, 5.0, "m", "r v_r/V"});
    validation::expect_close({doppler_group, "closed formula of the shift", 1000.0,
                              radar::mover_shift_m(range_m, -5.0, speed_mps), 1e-9, "m", "r v_r/V"});
    validation::expect_close({doppler_group, "shift of a mover of 5 m/s, 50 km away, seen from 150 m/s", 1666.7,
                              radar::mover_shift_m(50e3, -5.0, 150.0), 0.05, "m", "r v/V"});
  }
}

TEST(Mover, that_goes_along_is_smeared_over_more_than_twice_its_way) {
  const auto radar = even_band_radar(5.0);
  const double range_m = 10'000.0, speed_mps = 100.0, along_mps = 20.0;
  radar::Target target;
  target.track = radar::Track::straight({range_m, 0.0, 0.0}, {0.0, along_mps, 0.0});
  target.rcs_m2 = radar::Channels{4.0F, 4.0F, 0.0F, 4.0F};
  const std::vector<radar::Target> movers{target};
  const double resolution_m = 2.0;
  receiver::StripmapImager imager(radar, {{}, {0.0, speed_mps, 0.0}},
                                  {.first_along_m = -100.0,
                                   .last_along_m = 100.0,
                                   .resolution_m = resolution_m,
                                   .window = even_window,
                                   .oversampling = 2.0},
                                  {range_m - 50.0, range_m + 50.0, 2.0});
  imager.add(movers);
  const auto image = imager.image();
  const auto row = static_cast<std::size_t>(image.closest_range_m.place_of(range_m));
  double all = 0.0;
  for (const auto& bin : image.amplitude_m.row(row)) all += std::norm(bin.vv);
  // Between the points with a twentieth of the power before and after them: nine tenths of an evenly smeared length.
  double sum = 0.0, begin_m = 0.0, end_m = 0.0;
  for (std::size_t c = 0; c < image.along_m.bins; ++c) {
    const double along_m = image.along_m.middle_of(static_cast<double>(c) + 0.5);
    sum += std::norm(image.amplitude_m(c, row).vv);
    if (sum < 0.05 * all) begin_m = along_m;
    if (sum < 0.95 * all) end_m = along_m;
  }
  const double interval_s = 0.886 / resolution_m * 0.03 * range_m / (2.0 * speed_mps);
  const double drift_of_ground = std::pow(speed_mps / (speed_mps - along_mps), 2.0);  // over the mover's own
  const double expected = speed_mps * interval_s * (drift_of_ground - 1.0);
  validation::expect_close({doppler_group, "smear of a mover along the flight", expected, (end_m - begin_m) / 0.9,
                            0.05 * expected, "m", "V T |k_g/k − 1|"});
}

TEST(Smear, keeps_power_and_follows_the_left_over_phase) {
  for (const double cells : {0.01, 3.0, 40.0, -40.0, 20'000.0}) {
    const double interval_s = 0.5;
    const auto parts = receiver::smeared(cells / (interval_s * interval_s), interval_s);
    double power = 0.0;
    std::complex<double> middle;
    for (const auto& part : parts) {
      power += std::norm(part.amplitude);
      middle += std::complex<double>(part.amplitude) * std::polar(1.0, 2.0 * pi * part.cells * 0.3);
    }
    EXPECT_NEAR(power, 1.0, 1e-5);
    // At 0.3 T from the middle the phase is π Δk (0.3 T)².
    EXPECT_NEAR(std::remainder(std::arg(middle) - pi * cells * 0.09, 2.0 * pi), 0.0, 0.05) << cells;
  }
}

/// A quarter of the pulses' Doppler is processed, 89 of 354 Hz: so much of what changes from pulse to pulse.
TEST(Stripmap, keeps_its_band_of_targets_that_change_by_pulse) {
  auto radar = even_band_radar(5.0);
  const double range_m = 20'000.0, speed_mps = 100.0, resolution_m = 1.0;
  const double band_hz = radar::WindowResponse(even_window).half_power_width() / resolution_m * speed_mps;
  radar.waveform.pulse_repetition_hz = 4.0 * band_hz;
  double sum = 0.0, far = 0.0;
  constexpr int draws = 12;
  for (int draw = 0; draw < draws; ++draw) {
    radar::Target target;
    target.track = radar::Track::straight({range_m, 0.0, 0.0}, {});
    target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
    target.fluctuation = radar::Swerling::Case2;
    target.seed = static_cast<std::uint64_t>(draw) + 1;
    receiver::StripmapImager imager(
        radar, {{}, {0.0, speed_mps, 0.0}},
        {.first_along_m = -400.0, .last_along_m = 400.0, .resolution_m = resolution_m, .window = even_window},
        {range_m - 50.0, range_m + 50.0, 2.0});
    imager.add({&target, 1});
    const auto image = imager.image();
    const auto row = static_cast<std::size_t>(image.closest_range_m.place_of(range_m));
    for (std::size_t c = 0; c < image.along_m.bins; ++c) {
      const double power = std::norm(image.amplitude_m(c, row).vv) * image.along_m.step / image.along_cell_m / draws;
      sum += power;
      // Beyond what the platform flies while the beam is on the target.
      if (std::abs(image.along_m.middle_of(static_cast<double>(c) + 0.5)) > 266.0) far += power;
    }
  }
  EXPECT_NEAR(sum, pi / 4.0 + (1.0 - pi / 4.0) / 4.0, 0.02);
  EXPECT_LT(far, 1e-3);
}

/// 120 m of ground 10 km away, from 4 km up.
receiver::StripmapImager finely_sampled_strip(const radar::Radar& radar, double squint_rad) {
  return {radar,
          {{0.0, 0.0, 4000.0}, {0.0, 90.0, 0.0}},
          {.first_along_m = -60.0,
           .last_along_m = 60.0,
           .resolution_m = 1.0,
           .window = even_window,
           .oversampling = 16.0,
           .squint_rad = squint_rad},
          {9'950.0, 10'050.0, 16.0}};
}

TEST(Stripmap, answers_points_with_the_exact_response) {
  const auto radar = even_band_radar(2.0);
  for (const double squint_deg : {0.0, 30.0}) {
    const double squint = radians_from_deg(squint_deg);
    receiver::StripmapImager imager = finely_sampled_strip(radar, squint);
    const Vec3d place{std::sqrt(1e8 - 16e6), 12.34, 0.0};
    const std::vector<radar::Scatterer> point{vv_point_at(place)};
    imager.add(point);
    const auto image = imager.image();
    const BinPeak peak = brightest_bin(image.amplitude_m);
    validation::expect_close(
        {doppler_group, "stripmap place along", 12.34, image.along_m.middle_of(peak.column), 0.1, "m", "geometry"});
    validation::expect_close({doppler_group, "stripmap closest range", 10'000.0,
                              image.closest_range_m.middle_of(peak.row), 0.2, "m", "geometry"});
    EXPECT_NEAR(image.place_of(place).x, peak.column, 0.5);
    const auto row = image.amplitude_m.row(static_cast<std::size_t>(peak.row));
    auto right = static_cast<std::size_t>(peak.column);
    while (std::norm(row[right + 1].vv) < std::norm(row[right].vv)) ++right;
    double side_lobe = 0.0;
    for (std::size_t c = right; c < row.size(); ++c) side_lobe = std::max<double>(side_lobe, std::norm(row[c].vv));
    validation::expect_close(
        {doppler_group, "stripmap side lobe", -13.26, db_from_linear(side_lobe / peak.power), 0.1, "dB", "sinc²"});
    validation::expect_close({doppler_group, "stripmap half-power width", 1.0,
                              half_power_bins(image.amplitude_m) * image.along_m.step, 0.02, "m", "nominal"});
    EXPECT_NEAR(peak.power, 1.0, 0.01);
  }
}

/// Wherever along a squinted strip they stand: −4πrf/c of the closest range.
TEST(Stripmap, gives_targets_at_rest_the_phase_of_the_ground) {
  const auto radar = even_band_radar(2.0);
  const double squint = 0.1;
  for (const double along_m : {-20.0, 0.0, 10.0}) {
    const Vec3d place{std::sqrt(1e8 - 16e6), along_m, 0.0};
    const auto phase_of = [&](const auto& points) {
      receiver::StripmapImager imager = finely_sampled_strip(radar, squint);
      imager.add(points);
      const auto image = imager.image();
      const BinPeak peak = brightest_bin(image.amplitude_m);
      return std::arg(image.amplitude_m(static_cast<std::size_t>(peak.column), static_cast<std::size_t>(peak.row)).vv);
    };
    radar::Target target;
    target.track = radar::Track::straight(place);
    target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
    const double of_target = phase_of(std::vector<radar::Target>{target});
    const double of_ground = phase_of(std::vector<radar::Scatterer>{vv_point_at(place)});
    EXPECT_NEAR(std::remainder(of_target - of_ground, 2.0 * pi), 0.0, 0.1) << along_m;
  }
}

}  // namespace
}  // namespace sigmascape
