#include "sigmascape/receiver/response_spread.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/bin_response.h"

namespace sigmascape::receiver {
namespace {

// A beam with a floor under its side lobes answers from all round: responses are longer than rows.
TEST(ResponseSpread, IsTheSameOfResponsesLongerThanTheRow) {
  radar::Radar radar;
  radar.range_resolution_m = 10.0;
  radar.beam_width_rad = radians_from_deg(2.0);
  radar.antenna.side_lobe_floor = 1e-2;
  radar::RangeAzimuthGrid grid{.first_range_m = 5e3,
                               .range_step_m = 5.0,
                               .ranges = 41,
                               .azimuth_step_rad = radians_from_deg(0.5),
                               .azimuths = 21};
  radar::RangeAzimuthImage image{grid, {}, Array2D<radar::Channels>(21, 41)};
  image.rcs_m2(4, 20) = {1.0F, 2.0F, 0.0F, 0.0F};
  spread_responses(image, radar);
  const BinResponse azimuth = azimuth_response(radar, grid.azimuth_step_rad),
                    range = range_response(radar, grid.range_step_m);
  ASSERT_GT(azimuth.weights.size() / 2, 21U);
  for (std::size_t column = 0; column < 21; ++column) {
    for (std::size_t row = 0; row < 41; ++row) {
      const auto weight = [](const BinResponse& response, std::size_t at, std::size_t from) {
        const auto place = static_cast<std::ptrdiff_t>(response.weights.size() / 2) +
                           static_cast<std::ptrdiff_t>(from) - static_cast<std::ptrdiff_t>(at);
        return place < 0 || place >= static_cast<std::ptrdiff_t>(response.weights.size())
                   ? 0.0F
                   : response.weights[static_cast<std::size_t>(place)];
      };
      const float expected = weight(azimuth, column, 4) * weight(range, row, 20);
      EXPECT_NEAR(image.rcs_m2(column, row).vv, expected, 1e-5F * expected + 1e-12F) << column << " " << row;
      EXPECT_NEAR(image.rcs_m2(column, row).hh, 2.0F * expected, 2e-5F * expected + 1e-12F) << column << " " << row;
    }
  }
}

}  // namespace
}  // namespace sigmascape::receiver
