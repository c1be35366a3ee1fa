#include "sigmascape/receiver/placed_response_table.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::receiver {
namespace {

/// Those of responses of which a bin is a small part may stand wider apart than those of responses that are as narrow
/// as a bin, whose power turns within a small part of it: what lies between two is off as the square of their distance
/// over the response's width. A peak's weight in the middle of a bin is one over that width in bins. Short responses
/// take as many as memory allows, for those narrower than a bin.
std::size_t steps_of(const PlacedResponse& response) {
  constexpr std::size_t numbers = std::size_t{1} << 16U, fewest = 128, most = 4096;
  constexpr float to_a_width = 512.0F;
  const std::vector<float> weights = response.at(0.5).of_bins;
  const auto of_width = static_cast<std::size_t>(std::ceil(to_a_width * std::ranges::max(weights)));
  return std::clamp(std::max(numbers / weights.size(), of_width), fewest, most);
}

}  // namespace

PlacedResponseTable::PlacedResponseTable(const PlacedResponse& response) {
  const PlacedResponse::Weights from_left = response.at(0.0);
  first_bin_ = from_left.first_bin;
  taps_ = from_left.of_bins.size();
  steps_ = steps_of(response);
  weights_.reserve((steps_ + 1) * taps_);
  for (std::size_t step = 0; step <= steps_; ++step) {
    // The last is still within the bin: from its edge on the next bin is the nearest.
    const double place = std::min(static_cast<double>(step) / static_cast<double>(steps_), std::nextafter(1.0, 0.0));
    const PlacedResponse::Weights weights = response.at(place);
    weights_.insert(weights_.end(), weights.of_bins.begin(), weights.of_bins.end());
  }
}

PlacedResponseTable::Place PlacedResponseTable::at(double place) const {
  const double bin = std::floor(place), row = (place - bin) * static_cast<double>(steps_);
  const auto whole = std::min(static_cast<std::size_t>(row), steps_ - 1);
  return {first_bin_ + static_cast<std::ptrdiff_t>(bin), whole, static_cast<float>(row - static_cast<double>(whole))};
}

}  // namespace sigmascape::receiver
