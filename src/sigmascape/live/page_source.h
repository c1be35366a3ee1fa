#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "sigmascape/atlas/aspect_cell.h"
#include "sigmascape/atlas/tile_reader.h"
#include "sigmascape/live/ground_page.h"

namespace sigmascape::live {

/// Fills heights of the cells' centres of a grid, [row][column], north up, and tells what was lacking.
using HeightSource = std::function<Shortage(const radar::GroundGrid& cells, std::span<float> height_m)>;

/// Fills slopes of the ground, likewise.
using SlopeSource = std::function<Shortage(const radar::GroundGrid& cells, std::span<terrain::PackedSlope> slope)>;

/// Fills how high what lies over into the texels of a tile stands above the ground, 0 for nothing, [row][column],
/// likewise.
using TopSource = std::function<Shortage(const atlas::TileAddress& tile, std::span<float> top_m)>;

/// The ground by itself, of an atlas that keeps it apart.
struct BareGround {
  const atlas::Store& sigma0;  ///< of one azimuth
  SlopeSource slopes;
  TopSource tops;
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

  /// Whether something coarser stands in for terrain or obstacles under a page.
  [[nodiscard]] static bool lacks_something(const GroundPage& page) { return page.lacks_something(); }
  /// Whether any of what it lacks can be had by now.
  [[nodiscard]] static bool can_be_better(const GroundPage& page);
  /// Fills `page` with what is in a former one of the same key, over the terrain that there is now; always true.
  [[nodiscard]] bool renew(const GroundPage& former, GroundPage& page) const;

  /// Where a look of a page is read.
  struct StoredLook {
    const atlas::TileReader* tiles = nullptr;  ///< null where the page has room for more looks than there are
    atlas::LookIndex index = 0;

    friend constexpr auto operator<=>(const StoredLook&, const StoredLook&) = default;
  };
  /// Those of the page of a key, in its order; as many as it has looks.
  [[nodiscard]] std::array<StoredLook, atlas::AspectCells::most_looks> looks_of(const PageKey& key) const;
  [[nodiscard]] std::size_t looks_a_page() const { return aspects_.looks_a_cell(); }
  /// Fills heights and, of bare ground, slopes and tops of a page that has room for them, and what is lacking there.
  void fill_relief(GroundPage& page) const;

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
  /// Of any page with so many texels a side.
  [[nodiscard]] std::size_t most_bytes(std::size_t side = atlas::tile_side) const;
  /// Whether a page is never to give way to others: none, for all ground has pages that stand in (StandInGround).
  [[nodiscard]] static constexpr bool stays(const GroundPage&) { return false; }
  [[nodiscard]] const atlas::AtlasDescription& description() const { return tiles_.description(); }

 private:
  struct GroundTiles {
    GroundTiles(const BareGround& ground, double frequency_hz, atlas::Scrutiny scrutiny)
        : tiles(ground.sigma0, scrutiny),
          slopes(ground.slopes),
          tops(ground.tops),
          aspects(ground.sigma0.description().aspects, frequency_hz) {}
    atlas::TileReader tiles;
    SlopeSource slopes;
    TopSource tops;
    atlas::AspectCells aspects;
  };

  [[nodiscard]] std::array<StoredLook, atlas::AspectCells::most_looks> looks_of_ground(std::uint32_t page) const;

  atlas::TileReader tiles_;
  HeightSource heights_;
  atlas::AspectCells aspects_;
  std::optional<GroundTiles> bare_ground_;
};

}  // namespace sigmascape::live
