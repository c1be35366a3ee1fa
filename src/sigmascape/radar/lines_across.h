#pragma once

#include <cmath>
#include <limits>

namespace sigmascape::radar {

/// The optical depth of a square of ground that lets as much pass as the lines of sight that were added, across it or
/// upwards.
///
/// Where a crown fills a square in part, lines through its gaps let more pass than one of the mean depth. With d the
/// depth of a line over the square and D that over the square and what stands before and behind it, the square has its
/// share of the depth by which as much passes as on all of them:
///
///     e = −ln(mean e^−D) · mean d / mean D
///
/// docs/physics/vegetation.md, Eq. (10).
class LinesAcross {
 public:
  /// Lines that stand for `weight` of all: their depth over the square and that with its neighbours, which is no less.
  void add(double across, double with_neighbours, double weight = 1.0) {
    if (with_neighbours < least_) {
      passing_ *= std::exp(with_neighbours - least_);
      least_ = with_neighbours;
    }
    passing_ += weight * std::exp(least_ - with_neighbours);
    weight_ += weight;
    across_ += weight * across;
    with_neighbours_ += weight * with_neighbours;
  }

  /// 0 where nothing was in the way.
  [[nodiscard]] double depth() const {
    if (!(across_ > 0.0)) return 0.0;
    return (least_ - std::log(passing_ / weight_)) * across_ / with_neighbours_;
  }

 private:
  double least_ = std::numeric_limits<double>::max();  // so that dense crowns do not let nothing at all pass
  double passing_ = 0.0;                               // times e^least
  double weight_ = 0.0, across_ = 0.0, with_neighbours_ = 0.0;
};

}  // namespace sigmascape::radar
