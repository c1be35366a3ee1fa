#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/base/worker_team.h"
#include "sigmascape/live/lattice_row.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/shadow_box.h"

namespace sigmascape::live {

/// What a target with a size keeps from the radar, in metres from the radar: directions as in the local frame, heights
/// in the straight space over a curved Earth.
struct BoxShadow {
  radar::ShadowBox box;
  /// A side of a quadrilateral outside which no ground lies in the shadow: x = at_zero + slope · y.
  struct Side {
    double south_m = 0.0, north_m = 0.0;
    double at_zero_m = 0.0, slope = 0.0;
  };
  std::array<Side, 4> sides;
  radar::Rectangle bounds;  ///< of that
  /// Beams that may touch it, those of a frame counted from 0; may lie outside the frame.
  double first_beam = 0.0, last_beam = 0.0;
};

/// The shadows that the targets of a live frame cast on its ground. Found once a frame and put in order of groups of
/// beams; what each group does with them is done by TileShadows. The same geometry as radar::TargetShadows, over a
/// curved Earth. Nothing is allocated once the most targets have been seen.
class BoxShadows {
 public:
  struct View {
    Vec3d radar_position;
    double first_azimuth_rad = 0.0, beam_step_rad = 1e-3;
    std::size_t beams = 0;
    std::size_t group = 64;     ///< beams that are filled together
    double beams_beside = 1.0;  ///< of a beam, whose ground has a share in it
    double far_m = 0.0;         ///< over the ground, where the last bin ends
    double drop_per_square_m = 0.0;
    double lowest_m = 0.0;  ///< of the ground in view
  };

  void look(std::span<const radar::Target> targets, double time_s, const View& view, WorkerTeam& team);

  /// That may fall on ground of a group's beams, or on what is shared with them.
  struct InGroup {
    radar::Rectangle bounds;
    const BoxShadow* shadow;
  };
  [[nodiscard]] std::span<const InGroup> of_group(std::size_t group) const {
    return {sorted_.data() + starts_[group], starts_[group + 1] - starts_[group]};
  }

 private:
  template <typename Act>
  void over_groups(const BoxShadow& shadow, Act act) const;
  void sort();

  View view_;
  std::vector<std::optional<BoxShadow>> found_;  // as the targets were given
  std::vector<InGroup> sorted_;                  // by groups
  std::vector<std::size_t> starts_{0};           // in `sorted_`
};

/// The shadows on one tile of ground, row after row from the north: each row asks only those that can touch it.
class TileShadows {
 public:
  /// So that tiles of frames with so many targets take no memory, whichever thread they fall to.
  void make_room(std::size_t targets);
  /// `texels`: of the tile, from the radar.
  void begin(std::span<const BoxShadows::InGroup> shadows, const radar::GroundGrid& texels);
  /// Rows are asked in order, from 0; a row may be left out but not come back.
  void go_to_row(std::size_t row);

  /// After `light`: where a box stands before a texel nothing of it is seen. Returns how many were seen before.
  std::size_t shade(LatticeRow& row, std::size_t first_column) const;

 private:
  struct Rows {
    const BoxShadow* shadow;
    std::size_t first, last;
  };

  radar::GroundGrid texels_;
  std::size_t row_ = 0, next_ = 0;
  std::vector<Rows> by_first_row_;  // those that touch the tile
  std::vector<Rows> here_;          // and the row
};

}  // namespace sigmascape::live
