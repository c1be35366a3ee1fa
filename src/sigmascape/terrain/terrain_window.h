#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/terrain/terrain_pyramid.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::terrain {

/// What a window was made from.
struct WindowReport {
  int level = 0;          ///< whose nodes the window has: coarser than asked for when it would not fit otherwise
  std::size_t tiles = 0;  ///< that were wanted
  std::vector<TileKey> lacking = {};      ///< of them those for which a coarser one stands in
  std::vector<TileKey> standing_in = {};  ///< and which one, of each
  float error_m = 0.0F;                   ///< the greatest error of those that stand in
};

enum class WindowSlopes {
  Formed,  ///< as TerrainView::slope
  None,    ///< the view has heights alone, in half the memory
};

/// The terrain of one frame at one spacing: a fixed number of nodes, whatever their spacing.
///
/// Its tiles are of one level. Where one cannot be had its parent stands in, interpolated to the nodes of the window's
/// level: what comes out is one bilinear surface, in which levels meet without cracks. Slopes are those between
/// neighbouring nodes on either side, to be interpolated.
class TerrainWindow {
 public:
  /// Holds up to the square of `most_nodes_per_side`, whatever their proportions. A node takes 8 bytes, or 4 without
  /// slopes; memory is taken when an area needs more of it than any before.
  explicit TerrainWindow(std::size_t most_nodes_per_side, WindowSlopes slopes = WindowSlopes::Formed);

  /// Fills the window with the terrain over `area`, of `level` or the finest that fits. Tiles that cannot be had are
  /// replaced by their parents.
  WindowReport fill(TerrainPyramid& pyramid, const radar::Rectangle& area, int level);

  /// Valid until the next `fill`. Before the first it is empty.
  [[nodiscard]] TerrainView view() const;
  [[nodiscard]] std::size_t bytes() const {
    return height_m_.capacity() * sizeof(float) + slope_.capacity() * sizeof(PackedSlope);
  }

 private:
  /// The nodes of a level that an area needs, without their heights; nothing when they do not fit.
  [[nodiscard]] std::optional<TerrainView> placed(const PyramidLayout& layout, const radar::Rectangle& area,
                                                  int level) const;
  /// Writes the nodes of the window within `part`'s extent from a tile that covers it.
  void copy(int level, TileKey part, TileKey source, const HeightTile& tile);
  void form_slopes();

  std::size_t most_nodes_;  // in all
  WindowSlopes slopes_;
  TerrainView placement_;  // all of the view but its numbers
  std::vector<float> height_m_;
  std::vector<PackedSlope> slope_;
};

}  // namespace sigmascape::terrain
