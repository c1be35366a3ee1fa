#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "sigmascape/radar/obstacle.h"

namespace sigmascape::terrain {

/// How much of a place is seen.
struct Sight {
  /// Of the bare ground, from 0 to 1, behind terrain, solid things and what comes through crowns.
  double ground = 0.0;
  /// The height above the ground up to which terrain alone hides what stands there; 0 where it hides nothing.
  double hidden_m = std::numeric_limits<double>::infinity();
};

/// The part, from 0 to 1, of what answers from heights up to `top_m` that is seen above terrain which hides it up to
/// `hidden_m`.
[[nodiscard]] constexpr double part_above(double hidden_m, double top_m) {
  if (hidden_m <= 0.0) return 1.0;
  return hidden_m < top_m ? 1.0 - hidden_m / top_m : 0.0;
}

/// In how many pieces of one length a crown so high is taken that is gone over in a stride in which a line of sight
/// falls by so much: in none of them by more than half the height; and half of them lie before the middle.
[[nodiscard]] inline int crown_pieces(double fall_m, double height_m) {
  // Beyond, what is so flat beside a stride is met by too few lines.
  constexpr double most_a_half = 8.0;
  const double wanted = std::clamp(fall_m / std::max(height_m, 1e-3), 1.0, most_a_half);
  const auto whole = static_cast<int>(wanted);
  return 2 * (static_cast<double>(whole) < wanted ? whole + 1 : whole);
}

/// Calls `visit(nearer)` for the middle of each piece of a stride around `distance_m`, outwards: the slope to what
/// stands in the middle of the stride, times `nearer`, is that to the same height there.
template <typename Number, typename Visit>
void for_each_piece(int pieces, Number distance_m, Number stride_m, const Visit& visit) {
  const Number piece_m = stride_m / static_cast<Number>(pieces), half = static_cast<Number>(0.5);
  for (int piece = 0; piece < pieces; ++piece) {
    const Number beyond_m = (static_cast<Number>(piece) + half) * piece_m - half * stride_m;
    visit(distance_m / (distance_m + beyond_m));
  }
}

/// The part, from 0 to 1, of a stride on which a line of sight is within a crown: so high above the ground in the
/// middle of it, and by so much lower at its far end than there.
[[nodiscard]] inline double part_within(const radar::Obstacle& obstacle, double above_m, double half_fall_m) {
  const auto base_m = static_cast<double>(obstacle.crown_base_m), top_m = static_cast<double>(obstacle.crown_top_m);
  if (half_fall_m < 1e-6) return above_m > base_m && above_m < top_m ? 1.0 : 0.0;
  const double lowest_m = std::max(above_m - half_fall_m, base_m), highest_m = std::min(above_m + half_fall_m, top_m);
  return std::max(0.0, highest_m - lowest_m) / (2.0 * half_fall_m);
}

/// Walks outwards from an observer along one azimuth over ground with obstacles and tells what is seen of each place.
///
/// A line of sight is named by its slope. Ground is hidden by terrain and solid things whose slope is steeper; through
/// a crown that reaches from one slope to another, e^−κs of it is seen, s the way of the line of sight within. A crown
/// is taken in pieces over which a line of sight falls by no more than half its height, half of them before the middle
/// of a step, so that the ground there is hidden by what of its own crown lies before it. As only ground at or above
/// the horizon is seen at all, slopes of interest only rise: each crown enters and leaves the sum of optical depths
/// once, so that a walk takes time in proportion to its length times the logarithm of the crowns that are in the way at
/// once.
class ObstacleSweep {
 public:
  explicit ObstacleSweep(double observer_height_m) : observer_height_m_(observer_height_m) {}

  /// What lies on the way, told to nobody, hides all under lines of sight that are less steep.
  void rise_to(double slope) { horizon_ = std::max(horizon_, slope); }

  /// Takes the next piece of the way, `step_m` long, around the distance `distance_m`. An obstacle hides the ground
  /// that it stands on as well.
  Sight advance(double distance_m, double ground_m, const radar::Obstacle& obstacle, double step_m) {
    const double slope = (ground_m - observer_height_m_) / distance_m;
    if (slope > horizon_) horizon_ = slope;
    if (obstacle.solid_top_m > 0.0F) {
      solid_horizon_ = std::max(solid_horizon_, slope + static_cast<double>(obstacle.solid_top_m) / distance_m);
    }
    if (obstacle.crown_top_m > 0.0F) add_crown(distance_m, slope, obstacle, step_m);
    if (slope < horizon_) return {0.0, (horizon_ - slope) * distance_m};
    return {slope < solid_horizon_ ? 0.0 : transmission_at(slope), 0.0};
  }

 private:
  /// Optical depths are whole multiples of this, so that what a crown adds it takes away again.
  static constexpr double depth_unit = 1e-6;

  /// One part in 10¹³ comes through; what is less counts as nothing, and nobody looks up what the ground there returns.
  static constexpr double deepest = 30.0;

  struct Edge {
    double slope;
    std::int64_t depth;
    friend bool operator>(const Edge& a, const Edge& b) { return a.slope > b.slope; }
  };
  using Edges = std::priority_queue<Edge, std::vector<Edge>, std::greater<>>;

  void add_crown(double distance_m, double slope, const radar::Obstacle& obstacle, double step_m) {
    const double base = slope + static_cast<double>(obstacle.crown_base_m) / distance_m;
    const double top = slope + static_cast<double>(obstacle.crown_top_m) / distance_m;
    if (top <= horizon_) return;
    const double height_m = static_cast<double>(obstacle.crown_top_m) - static_cast<double>(obstacle.crown_base_m);
    const int pieces = crown_pieces(step_m * std::abs(slope), height_m);
    const double way_m = step_m / pieces * std::sqrt(1.0 + slope * slope);
    const auto depth = std::llround(static_cast<double>(obstacle.crown_extinction_per_m) * way_m / depth_unit);
    for_each_piece(pieces, distance_m, step_m, [&](double nearer) {
      bases_.push({base * nearer, depth});
      tops_.push({top * nearer, depth});
    });
  }

  double transmission_at(double slope) {
    for (; !bases_.empty() && bases_.top().slope <= slope; bases_.pop()) depth_ += bases_.top().depth;
    for (; !tops_.empty() && tops_.top().slope <= slope; tops_.pop()) depth_ -= tops_.top().depth;
    if (depth_ == 0) return 1.0;
    const double depth = depth_unit * static_cast<double>(depth_);
    return depth < deepest ? std::exp(-depth) : 0.0;
  }

  double observer_height_m_;
  double horizon_ = -std::numeric_limits<double>::infinity();  // steepest slope to terrain so far
  double solid_horizon_ = -std::numeric_limits<double>::infinity();
  std::int64_t depth_ = 0;
  Edges bases_, tops_;  // edges of crowns that no line of sight has reached yet
};

}  // namespace sigmascape::terrain
