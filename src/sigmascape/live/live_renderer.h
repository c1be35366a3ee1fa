#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/base/worker_team.h"
#include "sigmascape/live/box_shadows.h"
#include "sigmascape/live/drawn_beams.h"
#include "sigmascape/live/frame.h"
#include "sigmascape/live/frame_bins.h"
#include "sigmascape/live/frame_reach.h"
#include "sigmascape/live/live_ground.h"
#include "sigmascape/live/live_settings.h"
#include "sigmascape/live/pose.h"
#include "sigmascape/live/terrain_sectors.h"
#include "sigmascape/live/visible_ground.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/receiver/target_frame.h"
#include "sigmascape/render/level_of_detail.h"

namespace sigmascape::live {

class SectorTask;

/// The live radar picture of a wide area: hand it a pose, get what the receiver has in its bins.
///
/// Every lattice cell of the sector answers once, at its own place and with its own phase; cells are as large as the
/// bins can tell apart, so that their number does not depend on how far the radar sees. When the level that this asks
/// for changes along a flight path, the two are drawn together for 30 frames, textures over the terrain that belongs to
/// them, each with its share of the power. No loader is waited for and no other renderer, and once the pages of a view
/// are there nothing is allocated, but for lines of sight that beams take which have become wider. The result does not
/// depend on the number of threads.
class LiveRenderer {
 public:
  LiveRenderer(std::shared_ptr<LiveGround> ground, const LiveSettings& settings);
  ~LiveRenderer();

  /// All beams. Throws Error for a pose that `check` refuses and for a radar below the lowest ground of the tile of
  /// terrain that it is over, and then leaves the frame as it was.
  const Frame& render(const Pose& pose);
  /// Beams first … first + count − 1 anew, the others as they were: one step of a scanning antenna. Theirs is the pose
  /// with which they were drawn (Frame::beams), although the frame's grid is that of the last one: an antenna turns by
  /// its beams, while first_azimuth_rad and first_range_m stay. Throws Error as `check_step` does and as `render` does.
  const Frame& scan(const Pose& pose, std::size_t first_beam, std::size_t count);

 private:
  void prepare(const Pose& pose);
  struct Beams {
    std::size_t first = 0, end = 0;
  };
  /// What was there when the frame began.
  struct FrameViews {
    PageCache::View pages;
    TerrainWindows::View terrain;
    LiveObstacles::Cache::View obstacles;
  };

  /// Those beams from what is there now, and the lists of what is not.
  void fill(const Pose& pose, Beams beams);
  /// The level of detail, or two while one gives way to the next.
  [[nodiscard]] render::DetailBlend next_levels();
  /// What the report says of cells of that level of the textures.
  [[nodiscard]] double beams_a_cell(std::size_t level) const;
  /// Asks for what the radar will see a second later, and for the beams that a scan comes to until then.
  void look_ahead(const FrameViews& there, const Pose& pose, Beams beams, std::size_t level);
  void look_ahead_at_pages(const PageCache::View& there, const Pose& pose, Beams beams, std::size_t level);
  /// All of them, for the next takes what is placed; those that the beams see are reported.
  void look_at_targets(const Pose& pose, Beams beams, const render::DetailBlend& levels);
  void find_shadows_of_targets(const Pose& pose);
  /// For the beams, and their edges, over the terrain of each level of detail in use.
  void find_visible_ground(const FrameViews& there, const Pose& pose, Beams beams, const render::DetailBlend& levels);
  /// Along edges of beams, from the first to before the end, and the lines between them, over the terrain of one level
  /// of detail in use.
  void find_along_edges(const Pose& pose, std::size_t which, Beams edges);
  /// What hides ground, sector by sector.
  using SectorOccluders = std::array<Occluders, TerrainSectors::most>;
  /// That of a level of detail, as far as it is there; reports what it lacks and asks for it.
  void find_terrain(const TerrainWindows::View& there, Vec3d radar, std::size_t level, SectorOccluders& occluders);
  [[nodiscard]] Occluders terrain_of(std::size_t sector, const TerrainWindows::View& there, Vec3d radar,
                                     std::size_t level);
  /// Lays out what stands on the ground, under the bins and, for each of the levels in use, before them.
  void find_obstacles(const LiveObstacles::Cache::View& there, Vec3d radar, std::span<SectorOccluders> occluders);
  /// Asks for what is wanted, instead of what was.
  void request();
  [[nodiscard]] const HorizonGrid& grid() const { return visible_[0].horizon().grid(); }
  /// Of the terrain, for a level of the textures.
  [[nodiscard]] int terrain_level(std::size_t level) const;
  /// The ground between two distances under those beams.
  [[nodiscard]] radar::Rectangle under(Beams beams, Vec3d radar, double near_m, double far_m) const;
  [[nodiscard]] Beams beams_of(std::size_t sector) const {
    return {sectors_.first_edge(sector), sectors_.first_edge(sector + 1)};
  }
  [[nodiscard]] GroundSector sector_of(Vec3d radar, double near_m, double far_m) const;
  /// Of the ground that the frame looks at and of what stands on it.
  [[nodiscard]] terrain::HeightBounds bounds_with_obstacles() const;
  /// A sweep's first step ends at the first node.
  [[nodiscard]] double swept_from_m() const { return std::max(grid().near_m - grid().step_m, 0.0); }
  [[nodiscard]] double far_m() const { return grid().near_m + grid().step_m * static_cast<double>(grid().distances); }

  std::shared_ptr<LiveGround> ground_;
  LiveSettings settings_;
  radar::ScattererLattice lattice_;
  WorkerTeam team_;
  terrain::HeightBounds bounds_;  // of the ground that the frame looks at
  FrameReach halfway_up_;         // of bins on ground of the middle height; levels of detail follow from it
  std::array<VisibleGround, 2> visible_;
  TerrainSectors sectors_;
  std::array<SectorOccluders, 2> occluders_;  // of the two levels of detail
  ObstacleMosaic obstacles_;
  std::array<ObstacleMosaic, 2> obstacles_before_;  // the bins
  std::array<const HorizonMap*, 2> horizon_of_;     // of the two levels of detail; the same when so is their terrain
  std::array<std::span<const Occluders>, 2> occluders_of_;  // sector by sector; the same when so is their terrain
  // Beams away from a beam, whose ground has a share in it.
  std::size_t beams_beside_ = 1;
  receiver::TargetFrame targets_;
  BoxShadows shadows_;
  render::DetailTransition transition_;
  int last_level_ = 0;
  DrawnBeams beams_;
  FrameBins bins_;
  std::vector<std::unique_ptr<SectorTask>> tasks_;  // one a worker
  std::vector<PageKey> wanted_;                     // by all of them
  std::vector<WindowWish> wanted_terrain_;
  std::vector<atlas::TileAddress> wanted_obstacles_;
  PageCache::Asker pages_;
  TerrainWindows::Asker terrain_;
  LiveObstacles::Cache::Asker obstacle_tiles_;  // where there are obstacles
  bool has_asked_ = false;                      // for something, after the last frame
  Frame frame_;
};

}  // namespace sigmascape::live
