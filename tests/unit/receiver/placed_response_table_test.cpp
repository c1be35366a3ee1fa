#include "sigmascape/receiver/placed_response_table.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "keep_worst.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::receiver {
namespace {

/// The greatest error of a weight among many places, over the greatest weight of all.
double greatest_error(const PlacedResponse& response) {
  const PlacedResponseTable table(response);
  double error = 0.0, peak = 0.0;
  for (std::uint64_t number = 0; number < 2000; ++number) {
    const double place = static_cast<double>(unit_float(hashed(number, 1))) * 40.0 - 20.0;
    const PlacedResponse::Weights exact = response.at(place);
    const PlacedResponseTable::Place found = table.at(place);
    EXPECT_EQ(found.first_bin, exact.first_bin) << place;
    EXPECT_EQ(table.taps(), exact.of_bins.size());
    for (std::size_t tap = 0; tap < table.taps(); ++tap) {
      keep_worst(error, std::abs(static_cast<double>(table.weight(found, tap) - exact.of_bins[tap])));
      peak = std::max(peak, static_cast<double>(exact.of_bins[tap]));
    }
  }
  return error / peak;
}

TEST(PlacedResponseTable, KeepsToTheResponseWherePlacesLieBetweenItsOwn) {
  radar::Radar radar;
  for (const double bins_a_width : {1.0, 2.0, 3.0, 8.0}) {
    EXPECT_LT(greatest_error(placed_range_response(radar, radar.range_resolution_m / bins_a_width)), 1e-5)
        << bins_a_width;
    EXPECT_LT(greatest_error(placed_azimuth_response(radar, radar.beam_width_rad / bins_a_width)), 1e-5)
        << bins_a_width;
  }
}

// However far its side lobes reach, places within the main lobe are told apart.
TEST(PlacedResponseTable, KeepsToTheResponseOfANarrowBeamWithFarSideLobes) {
  radar::Radar radar;
  radar.beam_width_rad = 0.02;
  radar.antenna.side_lobe_floor = 1e-3;
  for (const double bins_a_width : {1.0, 2.0, 4.0}) {
    const PlacedResponse response = placed_azimuth_response(radar, radar.beam_width_rad / bins_a_width);
    ASSERT_GT(PlacedResponseTable(response).taps(), 300U);
    EXPECT_LT(greatest_error(response), 1e-5) << bins_a_width;
  }
}

TEST(PlacedResponseTable, AResponseMuchNarrowerThanABinIsInTheNearest) {
  radar::Radar radar;
  const PlacedResponseTable table(placed_azimuth_response(radar, 20.0 * radar.beam_width_rad));
  for (const double place : {3.1, 3.5, 3.9}) {
    const auto found = table.at(place);
    EXPECT_NEAR(table.weight(found, static_cast<std::size_t>(3 - found.first_bin)), 1.0F, 1e-6F) << place;
  }
}

}  // namespace
}  // namespace sigmascape::receiver
