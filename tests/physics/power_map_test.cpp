#include <cmath>
#include <gtest/gtest.h>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/radar/antenna_pattern.h"
#include "sigmascape/radar/range_response.h"
#include "sigmascape/receiver/receive_chain.h"

namespace sigmascape {
namespace {

constexpr double even_sigma0 = 0.02;

radar::Radar mapper() {
  radar::Radar radar;
  radar.frequency_hz = 9.4e9;
  radar.range_resolution_m = 15.0;
  radar.beam_width_rad = radians_from_deg(1.2);
  radar.antenna.gain = linear_from_db(33.0);
  radar.waveform = {.peak_power_w = 25e3,
                    .pulse_length_s = 2e-6,
                    .pulse_repetition_hz = 500.0,
                    .window = {.shape = radar::WindowShape::Hamming}};
  radar.receiver.losses = linear_from_db(5.0);
  radar.receiver.noise_figure = linear_from_db(4.0);
  radar.position = {-9000.0, 3000.0, 1200.0};
  return radar;
}

/// Bins over the ground about the origin, each with the cross-section of level ground in it.
radar::RangeAzimuthImage image_of_even_ground(const radar::Radar& radar, double half_side_m) {
  const double range_m = length(radar.position), ground_m = std::hypot(radar.position.x, radar.position.y);
  const double step_m = 0.5 * radar.range_resolution_m, step_rad = 0.25 * radar.beam_width_rad;
  radar::RangeAzimuthImage image{
      .grid = {.first_range_m = range_m - half_side_m,
               .range_step_m = step_m,
               .ranges = static_cast<std::size_t>(2.0 * half_side_m / step_m),
               .first_azimuth_rad = std::atan2(-radar.position.x, -radar.position.y) - half_side_m / ground_m,
               .azimuth_step_rad = step_rad,
               .azimuths = static_cast<std::size_t>(2.0 * half_side_m / ground_m / step_rad)},
      .radar_position = radar.position,
      .rcs_m2 = {}};
  image.rcs_m2 = Array2D<radar::Channels>(image.grid.azimuths, image.grid.ranges);
  for (std::size_t row = 0; row < image.grid.ranges; ++row) {
    const double middle_m = image.grid.first_range_m + (static_cast<double>(row) + 0.5) * step_m;
    const auto rcs = static_cast<float>(even_sigma0 * middle_m * step_m * step_rad);
    for (std::size_t column = 0; column < image.grid.azimuths; ++column)
      image.rcs_m2(column, row) = {rcs, 0.5F * rcs, 0.1F * rcs, 0.7F * rcs};
  }
  return image;
}

/// ∫ response(x) dx over ± reach.
template <typename Response>
double width_of(const Response& response, double reach) {
  constexpr int pieces = 200'000;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) sum += response(reach * (2.0 * (i + 0.5) / pieces - 1.0));
  return sum * 2.0 * reach / pieces;
}

// Ground under one pulse and beam, worked out without the receiver: dA = r dr dφ weighted by the pulse and the two-way
// beam; 9.4 GHz; no atmosphere.
TEST(PowerMap, OfEvenGroundIsTheRadarEquationInEveryCell) {
  const radar::Radar radar = mapper();
  const auto image = image_of_even_ground(radar, 1500.0);
  const terrain::HeightField level{-2000, 2000, 4000, Array2D<float>(2, 2)};
  const radar::GroundGrid grid{.west_m = -800, .north_m = 800, .cell_m = 20.0, .columns = 80, .rows = 80};
  const auto map = product::power_map(receiver::received_image(radar, image), level, grid, 2);

  const auto pulse = radar::RangeResponse::of_width(radar.range_resolution_m, radar.waveform.window);
  const auto beam = radar::antenna_pattern(radar).azimuth();
  const double pulse_width_m = width_of([&](double x) { return pulse.power(x); }, 60.0 * radar.range_resolution_m);
  const double beam_width_rad = width_of([&](double x) { return beam.two_way_power(x); }, 10.0 * radar.beam_width_rad);
  // Gain of compression: time by bandwidth, over the noise bandwidth of Hamming's window, 1.3628 bins.
  const double compression = 2e-6 * pulse.bandwidth_hz() / 1.3628;
  const double wavelength_m = 299'792'458.0 / 9.4e9;
  const double gain = std::pow(10.0, 3.3), losses = std::pow(10.0, 0.5);
  double worst_db = 0.0, sum_db = 0.0;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d place = grid.centre_of(column, row);
      const double range_m = length(Vec3d{place.x, place.y, 0.0} - radar.position);
      const double area_m2 = range_m * pulse_width_m * beam_width_rad;
      const double expected_w = 25e3 * gain * gain * wavelength_m * wavelength_m * even_sigma0 * area_m2 * compression /
                                (std::pow(4.0 * pi, 3.0) * std::pow(range_m, 4.0) * losses);
      const radar::Channels& cell = map.power_w(column, row);
      const double error_db = db_from_linear(static_cast<double>(cell.vv) / expected_w);
      ASSERT_FALSE(std::isnan(error_db)) << column << " " << row;
      worst_db = std::abs(error_db) > std::abs(worst_db) ? error_db : worst_db;
      sum_db += error_db;
      ASSERT_NEAR(cell.hh / cell.vv, 0.5, 1e-5);
      ASSERT_NEAR(cell.hv / cell.vv, 0.1, 1e-5);
    }
  }
  validation::expect_close({.group = "Receiver",
                            .name = "power map of even ground, worst of 6400 cells",
                            .expected = 0.0,
                            .measured = worst_db,
                            .tolerance = 0.05,
                            .unit = "dB",
                            .source = "radar equation over r Δr Δφ"});
  const double noise_w = 1.380649e-23 * 290.0 * pulse.bandwidth_hz() * std::pow(10.0, 0.4);
  EXPECT_NEAR(db_from_linear(map.noise_w / noise_w), 0.0, 0.01);
}

TEST(PowerMap, IsOfTheCellsOfTheReflectivityMapAndAsOneSampleHasIt) {
  const radar::Radar radar = mapper();
  const auto image = image_of_even_ground(radar, 600.0);
  const terrain::HeightField level{-2000, 2000, 4000, Array2D<float>(2, 2)};
  const radar::GroundGrid grid{.west_m = -1500, .north_m = 1500, .cell_m = 50.0, .columns = 60, .rows = 60};
  const auto received = receiver::received_image(radar, image);
  const auto power = product::power_map(received, level, grid);
  const auto reflectivity = product::ground_map(image, level, grid);
  const auto vv = receiver::received_power(radar, image, radar::Polarization::VV);
  const auto cross = receiver::received_power(radar, image, radar::Polarization::VH);
  EXPECT_EQ(received.noise_w, vv.noise_w);
  for (std::size_t i = 0; i < received.power_w.size(); ++i) {
    ASSERT_NEAR(received.power_w.values()[i].vv / vv.signal_w.values()[i], 1.0, 1e-6);
    ASSERT_NEAR(received.power_w.values()[i].hv / cross.signal_w.values()[i], 1.0, 1e-6);
  }
  std::size_t unseen = 0;
  for (std::size_t i = 0; i < power.power_w.size(); ++i) {
    const bool is_unseen = std::isnan(power.power_w.values()[i].vv);
    ASSERT_EQ(is_unseen, std::isnan(reflectivity.sigma0.values()[i].vv));
    if (is_unseen) ++unseen;
  }
  EXPECT_GT(unseen, 1000U);
  EXPECT_LT(unseen, 3500U);
}

}  // namespace
}  // namespace sigmascape
