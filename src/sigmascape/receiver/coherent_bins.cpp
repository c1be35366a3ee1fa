#include "sigmascape/receiver/coherent_bins.h"

#include <cmath>

namespace sigmascape::receiver {

void CoherentBins::add(std::span<const PlacedAmplitude> placed, unsigned threads) {
  const auto columns = static_cast<double>(sums_.columns()), rows = static_cast<double>(sums_.rows());
  RowBands(placed, sums_.rows()).for_each(threads, [&](const PlacedAmplitude& echo) {
    const double left = std::floor(echo.column - 0.5), top = std::floor(echo.row - 0.5);
    const double right_power = echo.column - 0.5 - left, lower_power = echo.row - 0.5 - top;
    for (int down = 0; down < 2; ++down) {
      for (int across = 0; across < 2; ++across) {
        const double c = left + across, r = top + down;
        if (!(c >= 0.0 && r >= 0.0 && c < columns && r < rows)) continue;
        const double share =
            (across == 1 ? right_power : 1.0 - right_power) * (down == 1 ? lower_power : 1.0 - lower_power);
        sums_(static_cast<std::size_t>(c), static_cast<std::size_t>(r)) +=
            echo.amplitude * static_cast<float>(std::sqrt(share));
      }
    }
  });
}

}  // namespace sigmascape::receiver
