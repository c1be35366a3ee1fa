#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "keep_worst.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/pulse_receiver.h"

namespace sigmascape {
namespace {

constexpr std::string_view phase_history_group = "Phase history";

radar::Radar radar_of_resolution(double range_resolution_m) {
  radar::Radar radar;
  radar.frequency_hz = 10e9;
  radar.range_resolution_m = range_resolution_m;
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  return radar;
}

radar::Scatterer point_at(Vec3d position) {
  return {position, {.vv = {1.0F, 0.0F}, .hh = {1.0F, 0.0F}, .hv = {}}};
}

/// A pulse between its samples: the sum over neighbouring samples that a signal of limited band obeys, under a window
/// that ends it.
std::complex<double> interpolated(const radar::PhaseHistory& history, std::size_t pulse, double range_m) {
  constexpr std::ptrdiff_t reach = 24;
  const double place = (range_m - history.first_range_m) / history.range_step_m;
  const auto middle = static_cast<std::ptrdiff_t>(std::llround(place));
  std::complex<double> sum;
  for (std::ptrdiff_t m = std::max<std::ptrdiff_t>(0, middle - reach);
       m <= std::min(middle + reach, static_cast<std::ptrdiff_t>(history.samples.columns()) - 1); ++m) {
    const double t = place - static_cast<double>(m);
    const double sinc = std::abs(t) < 1e-12 ? 1.0 : std::sin(pi * t) / (pi * t);
    const double taper = std::exp(-0.5 * (t / 9.0) * (t / 9.0));
    sum += std::complex<double>(history.samples(static_cast<std::size_t>(m), pulse).vv) * sinc * taper;
  }
  return sum;
}

/// The textbook's processor: turns every pulse back by the phase that the point of the image would have given it.
std::complex<double> focused(const radar::PhaseHistory& history, Vec3d point) {
  std::complex<double> sum;
  for (std::size_t n = 0; n < history.pulses.size(); ++n) {
    const double range_m = length(point - history.pulses[n].platform.position);
    sum += interpolated(history, n, range_m) *
           std::polar(1.0, std::remainder(4.0 * pi * range_m * history.frequency_hz / speed_of_light_mps, 2.0 * pi));
  }
  return sum / static_cast<double>(history.pulses.size());
}

/// Where along a line through a point the image is brightest, and how high its highest side lobe is.
struct Cut {
  double peak_m = 0.0, peak = 0.0, side_lobe_db = 0.0, half_power_width_m = 0.0;
};

template <typename Image>
Cut cut_along(const Image& image, double cell_m) {
  const double step = cell_m / 100.0;
  constexpr int reach = 300;
  std::vector<double> power;
  for (int k = -reach; k <= reach; ++k) power.push_back(std::norm(image(k * step)));
  std::size_t top = 0;
  for (std::size_t k = 0; k < power.size(); ++k) top = power[k] > power[top] ? k : top;
  std::size_t right = top, left = top;
  while (right + 1 < power.size() && power[right + 1] < power[right]) ++right;
  while (left > 0 && power[left - 1] < power[left]) --left;
  double side_lobe = 0.0;
  for (std::size_t k = 0; k < power.size(); ++k) {
    if (k < left || k > right) side_lobe = std::max(side_lobe, power[k]);
  }
  double above = 0.0;
  for (const double p : power) above += p > power[top] / 2.0 ? 1.0 : 0.0;
  return {(static_cast<double>(top) - reach) * step, std::sqrt(power[top]), db_from_linear(side_lobe / power[top]),
          above * step};
}

TEST(PhaseHistory, focuses_to_points_under_a_back_projector) {
  const auto radar = radar_of_resolution(1.0);
  const Vec3d centre{0.0, 0.0, 0.0};
  const std::vector<radar::Scatterer> points{point_at(centre), point_at({37.3, -21.7, 3.2})};
  // Broadside and 35° ahead of it.
  for (const double squint_deg : {0.0, 35.0}) {
    const double squint = radians_from_deg(squint_deg), range_m = 8000.0;
    const Vec3d flight{0.0, 120.0, 0.0};
    const Vec3d middle{-range_m * std::cos(squint) * std::cos(0.4), -range_m * std::sin(squint),
                       range_m * std::cos(squint) * std::sin(0.4)};
    const receiver::PulseTrain train{.first_time_s = -0.6, .count = 481, .repetition_hz = 400.0};
    const receiver::PulseReceiver pulses(radar, {range_m - 100.0, range_m + 100.0, 2.0});
    const auto history = pulses.receive(radar::Track::straight(middle, flight), train, points, {});

    for (const radar::Scatterer& point : points) {
      const Vec3d away = normalized(point.position - middle);
      const Vec3d across = normalized(normalized(flight) - away * dot(normalized(flight), away));
      const double aperture_m = 481.0 / 400.0 * 120.0 * std::cos(squint);
      const double azimuth_cell = wavelength_m(10e9) * length(point.position - middle) / (2.0 * aperture_m);
      const double range_cell = speed_of_light_mps / (2.0 * history.bandwidth_hz);
      const Cut in_range = cut_along([&](double d) { return focused(history, point.position + away * d); }, range_cell);
      const Cut in_azimuth =
          cut_along([&](double d) { return focused(history, point.position + across * d); }, azimuth_cell);
      const std::string name = squint_deg == 0.0 ? ", broadside" : ", squint 35°";
      constexpr std::string_view sinc = "sinc², even band and aperture";
      validation::expect_close(
          {phase_history_group, "range error" + name, 0.0, in_range.peak_m / range_cell, 0.1, "cells", "geometry"});
      validation::expect_close({phase_history_group, "cross-range error" + name, 0.0, in_azimuth.peak_m / azimuth_cell,
                                0.1, "cells", "geometry"});
      validation::expect_close(
          {phase_history_group, "range side lobe" + name, -13.26, in_range.side_lobe_db, 0.1, "dB", sinc});
      validation::expect_close(
          {phase_history_group, "cross-range side lobe" + name, -13.26, in_azimuth.side_lobe_db, 0.1, "dB", sinc});
      validation::expect_close({phase_history_group, "range width" + name, 1.0,
                                in_range.half_power_width_m / radar.range_resolution_m, 0.02, "of nominal", sinc});
      validation::expect_close({phase_history_group, "cross-range width" + name, 0.886,
                                in_azimuth.half_power_width_m / azimuth_cell, 0.02 * 0.886, "λr/2L", sinc});
      EXPECT_NEAR(in_range.peak, 1.0, 0.05);
    }
  }
}

TEST(PhaseHistory, keeps_range_to_a_millimetre_and_phase_to_the_wavelength_at_100_km) {
  const auto radar = radar_of_resolution(1.0);
  const receiver::PulseReceiver pulses(radar, {99'900.0, 100'100.0, 2.0});
  for (const double range_m : {99'990.123, 100'000.0, 100'003.4567}) {
    const std::vector<radar::Scatterer> point{point_at({range_m, 0.0, 0.0})};
    const auto history = pulses.receive(radar::Track::straight({}), {.count = 1}, point, {});
    double best = 0.0, place = 0.0;
    for (int k = -2000; k <= 2000; ++k) {
      const double at = range_m + k * 5e-5 + 1.7e-5;
      const double power = std::norm(interpolated(history, 0, at));
      if (power > best) {
        best = power;
        place = at;
      }
    }
    validation::expect_close(
        {phase_history_group, "range at 100 km", 0.0, (place - range_m) * 1e3, 1.0, "mm", "geometry"});
    const double turns = 2.0 * range_m * radar.frequency_hz / speed_of_light_mps;
    const double phase =
        std::arg(interpolated(history, 0, range_m) * std::polar(1.0, 2.0 * pi * std::remainder(turns, 1.0)));
    validation::expect_close(
        {phase_history_group, "carrier phase at 100 km", 0.0, deg_from_radians(phase), 0.1, "°", "−4πr/λ"});
  }
}

TEST(PhaseHistory, folds_what_comes_second_time_around) {
  const auto radar = radar_of_resolution(5.0);
  const receiver::PulseTrain train{.count = 1, .repetition_hz = 5000.0};
  const double unambiguous_m = speed_of_light_mps / (2.0 * 5000.0);
  const std::vector<radar::Scatterer> near{point_at({12'345.0, 0.0, 0.0})},
      far{point_at({12'345.0 + unambiguous_m, 0.0, 0.0})};
  const receiver::PulseReceiver pulses(radar, {12'000.0, 13'000.0, 2.0});
  const auto first = pulses.receive(radar::Track::straight({}), train, near, {});
  const auto second = pulses.receive(radar::Track::straight({}), train, far, {});
  for (std::size_t m = 0; m < first.samples.columns(); ++m) {
    EXPECT_NEAR(std::abs(first.samples(m, 0).vv), std::abs(second.samples(m, 0).vv), 1e-4);
  }
}

/// Every echo comes once an unambiguous range. In a gate little shorter than that, a point near one end has side lobes
/// at the other: sinc of the cells to each of its images within the 64 cells about the gate.
TEST(PhaseHistory, repeats_echoes_around_a_gate_near_the_unambiguous_range) {
  const auto radar = radar_of_resolution(15.0);
  const double repetition_hz = 200e3, unambiguous_m = speed_of_light_mps / (2.0 * repetition_hz);
  const double first_m = 8100.0, last_m = 8100.0 + unambiguous_m - 40.0;
  const receiver::PulseReceiver pulses(radar, {first_m, last_m, 2.0});
  const auto sinc = [](double x) { return std::abs(x) < 1e-9 ? 1.0 : std::sin(pi * x) / (pi * x); };
  double farthest = 0.0;
  for (const double range_m : {first_m + 7.0, 0.5 * (first_m + last_m), last_m - 9.0, last_m + 15.0,
                               first_m + 50.0 + unambiguous_m, last_m - 30.0 - 2.0 * unambiguous_m}) {
    const std::vector<radar::Scatterer> point{point_at({range_m, 0.0, 0.0})};
    const auto history = pulses.receive(radar::Track::straight({}), {.repetition_hz = repetition_hz}, point, {});
    const double cell_m = speed_of_light_mps / (2.0 * history.bandwidth_hz);
    const double turns = 2.0 * range_m * radar.frequency_hz / speed_of_light_mps;
    const std::complex<double> turned_back = std::polar(1.0, 2.0 * pi * std::remainder(turns, 1.0));
    for (std::size_t m = 0; m < history.samples.columns(); ++m) {
      const double at_m = history.first_range_m + static_cast<double>(m) * history.range_step_m;
      double expected = 0.0;
      for (int fold = -4; fold <= 4; ++fold) {
        const double image_m = range_m + fold * unambiguous_m;
        if (image_m > first_m - 64.0 * cell_m && image_m < last_m + 64.0 * cell_m)
          expected += sinc((at_m - image_m) / cell_m);
      }
      const auto off = std::complex<double>(history.samples(m, 0).vv) * turned_back - expected;
      keep_worst(farthest, std::abs(off));
    }
  }
  validation::expect_close({phase_history_group,
                            "echoes in a gate 40 m shorter than the unambiguous range, greatest error", 0.0, farthest,
                            0.02, "of a peak", "sum of sincs"});
}

TEST(PhaseHistory, does_not_depend_on_the_number_of_threads) {
  const auto radar = radar_of_resolution(5.0);
  std::vector<radar::Scatterer> points;
  for (int k = 0; k < 50; ++k) points.push_back(point_at({12'345.0 + 3.7 * k, 1.9 * k, 0.0}));
  const receiver::PulseReceiver pulses(radar, {12'000.0, 13'000.0, 1.2});
  const auto track = radar::Track::straight({}, {10.0, 100.0, 0.0});
  const auto one = pulses.receive(track, {.count = 16}, points, {}, {}, 1);
  const auto many = pulses.receive(track, {.count = 16}, points, {}, {}, 5);
  for (std::size_t i = 0; i < one.samples.size(); ++i) EXPECT_EQ(one.samples.values()[i], many.samples.values()[i]);
}

}  // namespace
}  // namespace sigmascape
