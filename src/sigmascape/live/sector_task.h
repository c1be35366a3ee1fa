#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/atlas/tile_block.h"
#include "sigmascape/live/box_shadows.h"
#include "sigmascape/live/extent_cells.h"
#include "sigmascape/live/frame.h"
#include "sigmascape/live/frame_reach.h"
#include "sigmascape/live/lattice_row.h"
#include "sigmascape/live/live_ground.h"
#include "sigmascape/live/live_settings.h"
#include "sigmascape/live/page_rows.h"
#include "sigmascape/live/pose.h"
#include "sigmascape/live/row_bins.h"
#include "sigmascape/live/row_light.h"
#include "sigmascape/live/row_looks.h"
#include "sigmascape/live/row_places.h"
#include "sigmascape/live/sector.h"
#include "sigmascape/live/terrain_sectors.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/render/level_of_detail.h"

namespace sigmascape::live {

/// Beams that are reckoned from one middle direction, and filled by one task unless a scan asks for fewer. Wide enough
/// that rows of texels are read in long stretches, narrow enough to find an azimuth by a short series.
[[nodiscard]] std::size_t beams_together(double beam_step_rad);

/// What the tasks of a renderer share; it outlives them.
struct FrameParts {
  LiveGround& ground;
  const LiveSettings& settings;
  const radar::ScattererLattice& lattice;
  /// Of this frame, swept already: over the terrain of the level of detail in use and, while it gives way to the next,
  /// over that of the next.
  const std::array<const HorizonMap*, 2>& horizons;
  const std::array<std::span<const Occluders>, 2>& occluders;  ///< that they were swept over, sector by sector
  const TerrainSectors& sectors;
  const BoxShadows& shadows;            ///< that the frame's targets cast
  const terrain::HeightBounds& bounds;  ///< of the ground that this frame looks at
  std::span<float> bins;                ///< [beam][range][number]
};

/// Fills some beams of a frame: goes over the lattice cells of their sector, row by row.
class SectorTask {
 public:
  struct Beams {
    std::size_t first = 0, count = 0;
  };

  explicit SectorTask(const FrameParts& parts);

  void begin_frame(const PageCache::View& view, std::size_t targets);
  void end_frame() { pages_.end_frame(); }
  [[nodiscard]] const FrameReport& report() const { return report_; }
  [[nodiscard]] std::span<const PageKey> wanted() const { return pages_.wanted(); }

  /// Fills the beams with one level of the ground, or two with their shares of the power.
  void fill(const Pose& pose, Beams beams, const render::DetailBlend& levels);

 private:
  /// A stretch of texels of one row of a tile.
  struct Place {
    atlas::TileAddress tile;
    std::size_t row = 0, first_column = 0;
  };

  /// How many texels of a stretch are shown more coarsely than wanted, and for how many something is not there at all.
  struct Shortfall {
    std::size_t coarse = 0, dark = 0;

    /// With what another source of the same stretch lacks, which lacks it for all `count` texels or for none: each
    /// texel counts once.
    void join(const Shortfall& other, std::size_t count);
  };
  [[nodiscard]] static Shortfall of(const PageRow& source, std::size_t count);

  /// Moves the beams' numbers into the frame and leaves zeros behind.
  void hand_over(Beams beams);
  [[nodiscard]] float* own_bins() { return own_bins_.data()->of.data(); }
  /// The first or the second of the two.
  void add_level(const Pose& pose, Beams beams, std::size_t level, std::size_t which, float share);
  void start(const Pose& pose, Beams beams, std::size_t level);
  /// Reports the cells of the sector beyond the atlas' extent, all within a rectangle of the ground: there the scene
  /// has ended, and however far a radar looks beyond a small one, they are not gone over. Of more than some thousand
  /// rows every second, third … one is counted for all.
  void count_outside(const radar::Rectangle& ground);
  void fill_tile(const atlas::TileAddress& tile);
  void fill_stretch(const Place& place, std::size_t count);
  /// Puts the scatterers of the stretch in their places.
  void place_scatterers(const Place& place);
  /// Tells what is seen of the ground from what is seen of the things on it.
  void light_apart_from(const PageRow& ground);
  /// Leaves of what is seen of the cells across the border of the extent the part of their ground within. What stands
  /// on it, where ground is kept apart, is the scene's all the same: nothing else is in the textures of such cells.
  void keep_within_extent(LatticeRow::Of<float>& seen) const;
  /// Adds the bare ground of the stretch: each texel by the elevations about its own local grazing angle.
  Shortfall add_bare_ground(const Place& place, float area_m2);
  Shortfall add_bare_elevations(const Place& place, std::uint32_t first, std::uint32_t last);
  /// Those of the elevations from `first` to before `end`, all of one page.
  [[nodiscard]] GroundLooks ground_looks(const PageRow& source, std::uint32_t first, std::uint32_t end);
  /// Cuts the stretch where the aspect passes from one cell to the next, and blends each piece from its own page.
  Shortfall blend_by_aspect(const Place& place, float area_m2);
  /// Draws the scatterers' values.
  void draw();

  /// Whether the terrain that hides is known as finely as that which a page should stand on, where the page is not the
  /// texels' own or stands on coarser terrain.
  [[nodiscard]] bool hides_as_finely_as(const PageRow& ground) const;
  [[nodiscard]] PageHeights heights_of(const PageRow& ground) const;
  [[nodiscard]] Horizon horizon() const;
  [[nodiscard]] const atlas::AspectCells* ground_aspects() const;
  /// The cotangent of the grazing angle at a stretch's first texel, before it is located: good enough to find heights.
  [[nodiscard]] float cotangent_near() const;
  /// The page of bare ground that answers for level ground there.
  [[nodiscard]] std::uint32_t ground_page_near() const;
  [[nodiscard]] atlas::AspectCell aspects_near() const;
  [[nodiscard]] std::uint32_t azimuth_cell_at(float beam) const;
  [[nodiscard]] const atlas::AspectCells& aspects() const { return parts_.ground.aspects(); }
  [[nodiscard]] const atlas::PatchGrid& patches() const { return parts_.ground.description().patches; }

  FrameParts parts_;
  PageRows pages_;
  FrameReport report_;

  std::size_t stride_;  // bins between beams: a row across the beams must fit the caches
  struct alignas(64) Line {
    std::array<float, 16> of;
  };
  std::vector<Line> own_bins_;  // [beam][range][number] of a group of beams; zero between calls of fill

  // Of the level in hand.
  const Pose* pose_ = nullptr;
  const HorizonMap* horizon_ = nullptr;
  const terrain::TerrainView* terrain_ = nullptr;
  std::size_t level_ = 0, first_beam_ = 0;
  double texel_m_ = 1.0;
  ExtentCells of_extent_;
  double first_azimuth_rad_ = 0.0;
  float share_ = 1.0F;  // of the level's power
  Sector sector_;
  RowGeometry geometry_;
  SectorBins bins_;
  TileShadows shadows_;

  // Of the stretch in hand.
  radar::LatticeCell first_cell_;
  LatticeRow row_{};
  std::array<LatticeRow::Of<float>, 6> gaussians_{};
  std::array<std::int32_t, LatticeRow::most> columns_, rows_;
};

}  // namespace sigmascape::live
