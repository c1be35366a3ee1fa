#include "sigmascape/receiver/multilook.h"

#include <algorithm>
#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::receiver {

Array2D<radar::ComplexChannels> rows_from(const Array2D<radar::ComplexChannels>& all, std::size_t first,
                                          std::size_t count) {
  Array2D<radar::ComplexChannels> rows(all.columns(), count);
  for (std::size_t row = 0; row < count; ++row) std::ranges::copy(all.row(first + row), rows.row(row).begin());
  return rows;
}

Array2D<radar::Channels> multilooked(const ResponsePlane& plane, std::size_t looks, std::size_t first,
                                     std::size_t count, unsigned threads) {
  if (looks < 1 || looks > plane.columns().band) {
    throw Error("multilook", fmt::format("{} looks of {} pulses are asked for", looks, plane.columns().band),
                "take at least one pulse a look");
  }
  Array2D<radar::Channels> mean(plane.columns().bins, count);
  for (std::size_t look = 0; look < looks; ++look) {
    const auto bins = rows_from(plane.bins({look, looks}, threads), first, count);
    for (std::size_t i = 0; i < bins.size(); ++i) {
      mean.values()[i] += radar::power_of(bins.values()[i]) * (1.0F / static_cast<float>(looks));
    }
  }
  return mean;
}

}  // namespace sigmascape::receiver
