#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/ground_height.h"
#include "sigmascape/live/live_ground.h"
#include "sigmascape/live/live_terrain.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {

/// Heights of the ground below live frames, kept from one to the next.
///
/// Of a LiveGround a window of its terrain is kept that is larger than what a frame looks at by a quarter of its
/// farthest range on every side, so that a flight needs another only after that. Its nodes are those of one level of
/// the terrain, which follows from the bins and the Earth alone: the coarsest whose nodes stand at most two range bins
/// apart, or at most two 2044ths of the square about a turn of such a window. A place has the same height in every
/// window, whatever has been kept: nothing is wrong by being kept. Where tiles cannot be had coarser ones stand in, and
/// the window is taken anew as soon as some can be, for which the pyramid is asked once in its patience.
class KeptGround {
 public:
  /// None: for antennas that do not ask.
  KeptGround() = default;
  KeptGround(std::shared_ptr<LiveGround> ground) : ground_(std::move(ground)) {}  // NOLINT: stands for it
  KeptGround(GroundHeight height_m) : height_m_(std::move(height_m)) {}           // NOLINT: stands for it

  [[nodiscard]] bool is_known() const { return ground_ != nullptr || height_m_; }
  /// Makes sure of all places that ground of the ranges of a grid, seen from a place, can lie at. Reads tiles where it
  /// has to take another window, and where it looks after those that it lacks.
  void cover(const radar::RangeAzimuthGrid& grid, Vec2d radar, const radar::CurvedEarth& earth);
  /// Whether the window at hand has all these places.
  [[nodiscard]] bool covers(const radar::RangeAzimuthGrid& grid, Vec2d radar, const radar::CurvedEarth& earth) const;
  /// Windows that have been taken: heights that were asked for with as many before are those of now.
  [[nodiscard]] std::uint64_t windows() const { return windows_; }
  /// Whether heights that were asked for with as many windows may have been those of coarser tiles that stood in.
  [[nodiscard]] bool knows_better(std::uint64_t windows) const { return windows < first_better_window_; }

  /// Calls `use` with a function of a place that gives the height of the ground there.
  template <typename Use>
  void with_height(Use&& use) const {
    if (ground_ != nullptr) {
      use([this](Vec2d place) { return terrain::height_at(view_, place); });
    } else {
      use(height_m_);
    }
  }

 private:
  /// What a pose's bins look at, and how.
  struct View {
    radar::Rectangle seen;
    double margin_m = 0.0, node_m = 0.0;
  };
  [[nodiscard]] static View view_of(const radar::RangeAzimuthGrid& grid, Vec2d radar, const radar::CurvedEarth& earth);
  [[nodiscard]] bool covers(const View& view) const;
  /// Whether some of what the window lacks can be had by now, as far as it is time to ask.
  [[nodiscard]] bool is_out_of_date();

  std::shared_ptr<LiveGround> ground_;
  GroundHeight height_m_;
  std::shared_ptr<const LiveTerrain::Window> window_;
  std::chrono::steady_clock::time_point try_again_at_;  // where it lacks tiles
  terrain::TerrainView view_;
  radar::Rectangle covered_{};
  double node_m_ = 0.0;  // that was asked for
  std::uint64_t windows_ = 0;
  std::uint64_t first_better_window_ = 0;  // after the last one that lacked tiles
};

}  // namespace sigmascape::live
