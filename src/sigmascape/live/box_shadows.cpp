#include "sigmascape/live/box_shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigmascape/base/units.h"

namespace sigmascape::live {
namespace {

/// Targets that one thread looks at before it takes more.
constexpr std::size_t chunk = 256;
/// Beams by which shadows are taken to be wider than they are.
constexpr double spare_beams = 1.0;
/// Steeper than any line of sight.
constexpr float wall = 1e30F;

/// How far over the ground a line of sight over something `down_m` under the radar, `distance_m` away, goes before it
/// comes to ground `height_m` under the radar: x with height + drop x² = x down / distance.
double reach_m(double distance_m, double down_m, double height_m, const BoxShadows::View& view) {
  const double fall = down_m / distance_m, under_root = fall * fall - 4.0 * view.drop_per_square_m * height_m;
  if (!(fall > 0.0) || !(under_root > 0.0)) return view.far_m;
  return std::min(2.0 * height_m / (fall + std::sqrt(under_root)), view.far_m);
}

/// A wedge from the box outwards; all ground about the radar when it stands over the box.
std::array<Vec2d, 4> corners_of(Vec2d towards, double near_m, double far_m, double half_m) {
  const Vec2d right{towards.y, -towards.x};
  if (near_m <= half_m) return {Vec2d{-far_m, -far_m}, {far_m, -far_m}, {far_m, far_m}, {-far_m, far_m}};
  const double far_half_m = half_m * far_m / near_m;
  return {towards * near_m + right * -half_m, towards * near_m + right * half_m, towards * far_m + right * far_half_m,
          towards * far_m + right * -far_half_m};
}

/// Sides that run from west to east leave their ends to their neighbours.
void enclose(BoxShadow& shadow, const std::array<Vec2d, 4>& corners) {
  shadow.bounds = {corners[0].x, corners[0].y, corners[0].x, corners[0].y};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2d from = corners[i], to = corners[(i + 1) % 4];
    const double slope = from.y == to.y ? 0.0 : (to.x - from.x) / (to.y - from.y);
    shadow.sides[i] = {std::min(from.y, to.y), std::max(from.y, to.y), from.x - slope * from.y, slope};
    shadow.bounds = {std::min(shadow.bounds.west_m, from.x), std::min(shadow.bounds.south_m, from.y),
                     std::max(shadow.bounds.east_m, from.x), std::max(shadow.bounds.north_m, from.y)};
  }
}

std::optional<BoxShadow> shadow_of(const radar::Target& target, double time_s, const BoxShadows::View& view) {
  const std::optional<radar::ShadowBox> standing = radar::ShadowBox::of(target, time_s);
  if (!standing) return std::nullopt;
  const radar::ShadowBox level = standing->seen_from(view.radar_position);
  const Vec2d away{level.centre().x, level.centre().y};
  const double distance_m = length(away), half_m = level.half_diagonal_m(), near_m = distance_m - half_m;
  if (near_m > view.far_m) return std::nullopt;
  const radar::ShadowBox box = level.lowered(view.drop_per_square_m * distance_m * distance_m);
  const double down_m = -(box.centre().z + 0.5 * box.size_m().z);
  const double far_m =
      std::max(reach_m(distance_m + half_m, down_m, view.radar_position.z - view.lowest_m, view), near_m);
  const Vec2d towards = distance_m > 0.0 ? away * (1.0 / distance_m) : Vec2d{0.0, 1.0};
  // Azimuths are counted from the middle of the frame, so that none is more than half a turn away.
  const double half_frame_rad = 0.5 * static_cast<double>(view.beams) * view.beam_step_rad;
  const double azimuth = wrapped_azimuth(azimuth_of(away) - view.first_azimuth_rad - half_frame_rad + pi) - pi;
  const double beam = (azimuth + half_frame_rad) / view.beam_step_rad;
  const double half_beams =
      (near_m > half_m ? std::atan2(half_m, near_m) : pi) / view.beam_step_rad + view.beams_beside + spare_beams;
  BoxShadow shadow{
      .box = box, .sides = {}, .bounds = {}, .first_beam = beam - half_beams, .last_beam = beam + half_beams};
  enclose(shadow, corners_of(towards, near_m, far_m, half_m));
  return shadow;
}

/// From west to east, what of a shadow's sides lies between two lines that run so.
struct Stretch {
  double west_m = std::numeric_limits<double>::infinity(), east_m = -std::numeric_limits<double>::infinity();

  void include(double x_m) {
    west_m = std::min(west_m, x_m);
    east_m = std::max(east_m, x_m);
  }
};

Stretch between(const std::array<BoxShadow::Side, 4>& sides, double south_m, double north_m) {
  Stretch found;
  for (const BoxShadow::Side& side : sides) {
    const double lower = std::max(side.south_m, south_m), upper = std::min(side.north_m, north_m);
    if (lower > upper) continue;
    found.include(side.at_zero_m + side.slope * lower);
    found.include(side.at_zero_m + side.slope * upper);
  }
  return found;
}

}  // namespace

void BoxShadows::look(std::span<const radar::Target> targets, double time_s, const View& view, WorkerTeam& team) {
  view_ = view;
  found_.resize(targets.size());
  if (!targets.empty()) {
    team.run((targets.size() + chunk - 1) / chunk, [&](std::size_t part, unsigned) {
      const std::size_t end = std::min(targets.size(), (part + 1) * chunk);
      for (std::size_t i = part * chunk; i < end; ++i) found_[i] = shadow_of(targets[i], time_s, view);
    });
  }
  sort();
}

template <typename Act>
void BoxShadows::over_groups(const BoxShadow& shadow, Act act) const {
  const auto groups = static_cast<double>(starts_.size() - 1), a_turn = 2.0 * pi / view_.beam_step_rad;
  const auto a_group = static_cast<double>(view_.group);
  // Frames that go round meet the same place from both ends.
  double next = 0.0;
  for (const double turn : {-a_turn, 0.0, a_turn}) {
    const double first = std::max(std::floor((shadow.first_beam + turn) / a_group), next);
    const double end = std::min(std::floor((shadow.last_beam + turn) / a_group) + 1.0, groups);
    for (double group = first; group < end; ++group) act(static_cast<std::size_t>(group));
    next = std::max(next, end);
  }
}

void BoxShadows::sort() {
  starts_.assign((view_.beams + view_.group - 1) / view_.group + 1, 0);
  for (const auto& shadow : found_) {
    if (shadow) over_groups(*shadow, [this](std::size_t group) { ++starts_[group + 1]; });
  }
  for (std::size_t group = 1; group < starts_.size(); ++group) starts_[group] += starts_[group - 1];
  sorted_.resize(starts_.back());
  // Filling moves every start to the next one's place; the last step moves them back.
  for (const auto& shadow : found_) {
    if (shadow)
      over_groups(*shadow, [&](std::size_t group) { sorted_[starts_[group]++] = {shadow->bounds, &*shadow}; });
  }
  std::shift_right(starts_.begin(), starts_.end(), 1);
  starts_.front() = 0;
}

void TileShadows::make_room(std::size_t targets) {
  by_first_row_.reserve(targets);
  here_.reserve(targets);
}

void TileShadows::begin(std::span<const BoxShadows::InGroup> shadows, const radar::GroundGrid& texels) {
  texels_ = texels;
  row_ = next_ = 0;
  by_first_row_.clear();
  here_.clear();
  const radar::Rectangle tile = texels.extent();
  const auto row_at = [&](double north_m) {
    return static_cast<std::size_t>(std::max((texels.north_m - north_m) / texels.cell_m, 0.0));
  };
  for (const auto& [bounds, shadow] : shadows) {
    if (bounds.east_m < tile.west_m || bounds.west_m > tile.east_m || bounds.north_m < tile.south_m ||
        bounds.south_m > tile.north_m) {
      continue;
    }
    by_first_row_.push_back({shadow, row_at(bounds.north_m), row_at(bounds.south_m)});
  }
  std::ranges::sort(by_first_row_, {}, &Rows::first);
}

void TileShadows::go_to_row(std::size_t row) {
  row_ = row;
  if (by_first_row_.empty()) return;
  for (; next_ < by_first_row_.size() && by_first_row_[next_].first <= row; ++next_) {
    here_.push_back(by_first_row_[next_]);
  }
  std::erase_if(here_, [row](const Rows& rows) { return rows.last < row; });
}

std::size_t TileShadows::shade(LatticeRow& row, std::size_t first_column) const {
  std::size_t darkened = 0;
  const double north_m = texels_.north_m - static_cast<double>(row_) * texels_.cell_m;
  const double west_m = texels_.west_m + static_cast<double>(first_column) * texels_.cell_m;
  const auto last = static_cast<double>(row.count);
  for (const Rows& rows : here_) {
    const Stretch across = between(rows.shadow->sides, north_m - texels_.cell_m, north_m);
    const double from = std::max(std::floor((across.west_m - west_m) / texels_.cell_m), 0.0);
    const double to = std::min(std::floor((across.east_m - west_m) / texels_.cell_m) + 1.0, last);
    if (!(from < to)) continue;
    for (auto i = static_cast<std::size_t>(from); i < static_cast<std::size_t>(to); ++i) {
      const Vec3d place{row.east_m[i], row.north_m[i], -static_cast<double>(row.below_m[i])};
      if (!rows.shadow->box.hides({0.0, 0.0, 0.0}, place)) continue;
      darkened += row.lit[i] > 0.0F ? 1U : 0U;
      row.lit[i] = 0.0F;
      row.horizon[i] = wall;
    }
  }
  return darkened;
}

}  // namespace sigmascape::live
