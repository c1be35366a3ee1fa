#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"

namespace sigmascape {
namespace {

constexpr double range_m = 20e3, cell_m = 4.0;

/// How wide pulse and two-way beam are at half power, in the map's cells.
struct Widths {
  double pulse_cells, beam_cells;
};

/// Looks east along level ground, with a Gaussian beam and a pulse of an even band.
radar::Radar looking_east(const Widths& widths) {
  radar::Radar radar;
  radar.position = {-range_m, 0.0, 0.0};
  radar.range_resolution_m = widths.pulse_cells * cell_m;
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  radar.beam_width_rad = std::sqrt(2.0) * widths.beam_cells * cell_m / range_m;
  return radar;
}

/// What a map of these cells sums up to of a point of one square metre, so far east and north of a cell's middle. The
/// bins, two a width, lie so many of their own steps away from where they lie by default.
double mapped_m2(const radar::Radar& radar, Vec2d offset_m, Vec2d bins_shift) {
  constexpr double half_m = 240.0;
  const double step_m = radar.range_resolution_m / 2.0;
  const double step_rad = radar::antenna_pattern(radar).azimuth().two_way_width_rad() / 2.0;
  const auto bins_in = [](double step) { return static_cast<std::size_t>(2.0 * half_m / step); };
  const radar::RangeAzimuthGrid bins{.first_range_m = range_m - half_m - bins_shift.x * step_m,
                                     .range_step_m = step_m,
                                     .ranges = bins_in(step_m),
                                     .first_azimuth_rad = pi / 2.0 - half_m / range_m - bins_shift.y * step_rad,
                                     .azimuth_step_rad = step_rad,
                                     .azimuths = bins_in(step_rad * range_m)};
  receiver::RangeAzimuthReceiver receiver(radar, bins);
  const Vec3d away{range_m + offset_m.x, offset_m.y, 0.0};
  const std::vector<radar::Echo> point{
      {.range_m = length(away), .cross = azimuth_of(away), .rcs_m2 = {1.0F, 1.0F, 0.0F, 1.0F}, .bounces = 1}};
  receiver.add(point);
  auto image = receiver.image();
  image.radar_position = radar.position;
  const terrain::HeightField level{
      .west_m = -2e3, .north_m = 2e3, .spacing_m = 100.0, .height_m = Array2D<float>(41, 41, 0.0F)};
  const radar::GroundGrid grid{
      .west_m = -50.5 * cell_m, .north_m = 50.5 * cell_m, .cell_m = cell_m, .columns = 101, .rows = 101};
  const radar::GroundMap map = product::ground_map(image, level, grid);
  double sum = 0.0;
  for (const radar::Channels& cell : map.sigma0.values())
    sum += std::isnan(cell.vv) ? 0.0 : static_cast<double>(cell.vv);
  return sum * cell_m * cell_m;
}

/// By what part of its mean a point's power on the map strays, r.m.s. over where the point stands within a cell along
/// this axis. The mean over how the bins lie leaves what the cells do.
double straying(const Widths& widths, Vec2d axis) {
  constexpr int places = 8, shifts = 8;
  const radar::Radar radar = looking_east(widths);
  std::vector<double> totals(places, 0.0);
  double mean = 0.0;
  for (int place = 0; place < places; ++place) {
    for (int shift = 0; shift < shifts; ++shift)
      totals[static_cast<std::size_t>(place)] +=
          mapped_m2(radar, axis * (cell_m * place / places), axis * (1.0 * shift / shifts)) / shifts;
    mean += totals[static_cast<std::size_t>(place)] / places;
  }
  double square = 0.0;
  for (const double total : totals) square += std::pow(total / mean - 1.0, 2.0) / places;
  return std::sqrt(square);
}

/// Sharing among bins of half the width, and reading between them.
double by_bins(double cells) {
  const double sinc = std::sin(pi * cells / 2.0) / (pi * cells / 2.0);
  return std::sqrt(2.0) * std::pow(sinc, 4.0);
}

/// An even band's pulse has the spectrum 1 − |f| δ/w and nothing beyond the band.
double of_pulse(double cells) {
  return by_bins(cells) * std::max(0.0, 1.0 - cells / 0.8859);
}

double gaussian(double cells) {
  return std::exp(-pi * pi * cells * cells / (4.0 * std::log(2.0)));
}
/// A Gaussian beam has a Gaussian one, which two bins a width repeat.
double of_beam(double cells) {
  return by_bins(cells) * (gaussian(cells) + gaussian(2.0 - cells));
}

void expect_straying(const char* what, double cells, double expected, double measured) {
  validation::expect_close({"Receiver",
                            "power of a point that strays among cells, " + std::string(what) + " of " +
                                std::to_string(cells).substr(0, 4) + " cells",
                            100.0 * expected, 100.0 * measured, 0.15 + 5.0 * expected, "%", "Poisson's sum"});
}

/// From a response of 0.96 cells on 1 % at most falls between cells, as radar_warnings has it, beside what bins do.
TEST(MapCells, LosePowerWhereTheResponseIsNarrower) {
  constexpr double wide = 8.0;
  for (const double cells : {0.6, 0.8, 1.0}) {
    expect_straying("pulse", cells, of_pulse(cells), straying({cells, wide}, {1.0, 0.0}));
  }
  for (const double cells : {0.6, 0.8, 0.96, 1.0}) {
    expect_straying("beam", cells, of_beam(cells), straying({wide, cells}, {0.0, 1.0}));
  }
  EXPECT_NEAR(by_bins(0.96) * gaussian(0.96), 0.01, 3e-4);
  EXPECT_GT(straying({0.5, wide}, {1.0, 0.0}), 0.35);
}

}  // namespace
}  // namespace sigmascape
