#include "sigmascape/trace/crown_crossings.h"

#include <algorithm>

namespace sigmascape::trace {

void CrownCrossings::begin(const std::vector<scatter::SurfaceModel>& surfaces) {
  surfaces_ = &surfaces;
  crossings_.clear();
}

void CrownCrossings::add(const CrownCrossing& crossing) {
  const auto is_the_same = [&](const CrownCrossing& c) { return c.tree == crossing.tree && c.crown == crossing.crown; };
  if (std::ranges::none_of(crossings_, is_the_same)) crossings_.push_back(crossing);
}

float CrownCrossings::extinction_of(const CrownCrossing& crossing) const {
  return (*surfaces_)[crossing.medium].medium()->extinction_per_m() * crossing.extinction_scale;
}

float CrownCrossings::optical_depth(float distance_m) const {
  float depth = 0.0F;
  for (const CrownCrossing& c : crossings_)
    depth += extinction_of(c) * std::max(0.0F, std::min(c.leave_m, distance_m) - c.enter_m);
  return depth;
}

float CrownCrossings::return_depth(float distance_m) const {
  float depth = 0.0F;
  for (const CrownCrossing& c : crossings_) {
    if ((*surfaces_)[c.medium].medium()->shares_gaps()) continue;
    depth += extinction_of(c) * std::max(0.0F, std::min(c.leave_m, distance_m) - c.enter_m);
  }
  return depth;
}

float CrownCrossings::extinction_at(float distance_m) const {
  float extinction = 0.0F;
  for (const CrownCrossing& c : crossings_)
    extinction += c.enter_m <= distance_m && distance_m < c.leave_m ? extinction_of(c) : 0.0F;
  return extinction;
}

std::optional<Interception> CrownCrossings::interception(float depth, float distance_m, float choice) {
  borders_m_.clear();
  for (const CrownCrossing& c : crossings_) {
    borders_m_.push_back(c.enter_m);
    borders_m_.push_back(c.leave_m);
  }
  std::ranges::sort(borders_m_);
  float passed = 0.0F;
  for (std::size_t i = 0; i + 1 < borders_m_.size() && borders_m_[i] < distance_m; ++i) {
    const float extinction = extinction_at(borders_m_[i]);
    const float here = extinction * (borders_m_[i + 1] - borders_m_[i]);
    if (passed + here > depth) {
      const float at = borders_m_[i] + (depth - passed) / extinction;
      if (at >= distance_m) return std::nullopt;
      return chosen_at(std::min(at, borders_m_[i + 1]), borders_m_[i], choice);
    }
    passed += here;
  }
  return std::nullopt;
}

Interception CrownCrossings::chosen_at(float distance_m, float border_m, float choice) const {
  float left = choice * extinction_at(border_m);
  Interception chosen{distance_m, 0, 0.0F};
  for (const CrownCrossing& c : crossings_) {
    if (!(c.enter_m <= border_m && border_m < c.leave_m)) continue;
    chosen.medium = c.medium;
    chosen.extinction_per_m = extinction_of(c);
    left -= chosen.extinction_per_m;
    if (left < 0.0F) break;
  }
  return chosen;
}

}  // namespace sigmascape::trace
