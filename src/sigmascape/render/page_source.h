#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sigmascape/atlas/aspect_cell.h"
#include "sigmascape/atlas/tile_reader.h"
#include "sigmascape/render/ground_page.h"

namespace sigmascape::render {

/// Fills heights of the cells' centres of a grid, [row][column], north up.
using HeightSource = std::function<void(const radar::GroundGrid& cells, std::span<float> height_m)>;

/// Fills slopes of the ground and the height of what stands on it at the centres of a tile's texels, [row][column].
using ReliefSource =
    std::function<void(const atlas::TileAddress& tile, std::span<terrain::PackedSlope> slope, std::span<float> top_m)>;

/// The ground by itself, of an atlas that keeps it apart.
struct BareGround {
  const atlas::Store& sigma0;  ///< of one azimuth
  ReliefSource relief;
};

/// Makes pages out of what is stored: tiles of a few looks and the terrain under them.
class PageSource {
 public:
  using Page = GroundPage;

  PageSource(const atlas::Store& store, HeightSource heights, double frequency_hz,
             const std::optional<BareGround>& bare_ground = {}, atlas::Scrutiny scrutiny = atlas::Scrutiny::Content);

  /// Fills `page` with what `page.key` names; its memory is used again. False when one of its looks is not in the store
  /// or cannot be read: without it the page would be darker than the ground is.
  [[nodiscard]] bool fill(GroundPage& page) const;

  /// Number of levels that pages can have.
  [[nodiscard]] std::size_t levels() const { return tiles_.levels(); }
  [[nodiscard]] const atlas::AspectCells& aspects() const { return aspects_; }
  /// The elevations of the bare ground; null when the atlas does not keep it apart.
  [[nodiscard]] const atlas::AspectCells* ground_aspects() const {
    return bare_ground_ ? &bare_ground_->aspects : nullptr;
  }
  /// Pages of bare ground that a tile has.
  [[nodiscard]] std::uint32_t ground_pages() const;
  /// Textures met so far that are not as their items say.
  [[nodiscard]] std::size_t damaged() const {
    return tiles_.damaged() + (bare_ground_ ? bare_ground_->tiles.damaged() : 0);
  }
  /// Of any page.
  [[nodiscard]] std::size_t most_bytes() const;
  [[nodiscard]] const atlas::AtlasDescription& description() const { return tiles_.description(); }

 private:
  struct GroundTiles {
    GroundTiles(const BareGround& ground, double frequency_hz, atlas::Scrutiny scrutiny)
        : tiles(ground.sigma0, scrutiny),
          relief(ground.relief),
          aspects(ground.sigma0.description().aspects, frequency_hz) {}
    atlas::TileReader tiles;
    ReliefSource relief;
    atlas::AspectCells aspects;
  };

  [[nodiscard]] bool fill_ground(GroundPage& page) const;
  /// Reads one look into its planes; whether it was there.
  static bool fill_look(const atlas::TileReader& tiles, atlas::LookIndex index, std::size_t look, GroundPage& page,
                        std::vector<atlas::Half>& halves);

  atlas::TileReader tiles_;
  HeightSource heights_;
  atlas::AspectCells aspects_;
  std::optional<GroundTiles> bare_ground_;
};

}  // namespace sigmascape::render
