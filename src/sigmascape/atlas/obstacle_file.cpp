#include "sigmascape/atlas/obstacle_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>

#include "sigmascape/atlas/mip_chain.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/base/error.h"

namespace sigmascape::atlas {
namespace {

void check_texels(const radar::ObstacleMap& map, const radar::GroundGrid& texels, const std::filesystem::path& file) {
  if (map.grid != texels || map.obstacles.columns() != texels.columns || map.obstacles.rows() != texels.rows) {
    throw Error(file.string(), "is not given on the texels of the patch",
                fmt::format("give {} x {}", texels.columns, texels.rows));
  }
  const auto is_sound = [](float value) { return std::isfinite(value) && value >= 0.0F; };
  const auto fault = std::ranges::find_if_not(map.obstacles.values(), [&](const radar::Obstacle& obstacle) {
    return is_sound(obstacle.solid_top_m) && is_sound(obstacle.crown_base_m) && is_sound(obstacle.crown_top_m) &&
           is_sound(obstacle.crown_extinction_per_m);
  });
  if (fault == map.obstacles.values().end()) return;
  const auto index = static_cast<std::size_t>(fault - map.obstacles.values().begin());
  throw Error(fmt::format("{}, column {}, row {}", file.string(), index % texels.columns, index / texels.columns),
              "holds what is negative or not a finite number",
              "heights and extinction of obstacles must be finite, 0 or more");
}

float tallest_m(const HalfTexture& texture) {
  float tallest = 0.0F;
  for (const Array2D<radar::Obstacle>& level : decoded_obstacles(texture)) {
    for (const radar::Obstacle& obstacle : level.values()) tallest = std::max(tallest, obstacle.top_m());
  }
  return tallest;
}

/// The levels are made before anything is rounded. Nothing in the file or `below` it is higher than the item says.
void write_levels(const Store& atlas, const PyramidTile& tile, radar::ObstacleMap finest, const std::string& made_from,
                  float tallest_below_m) {
  const HalfTexture halves = encoded(mip_chain(std::move(finest), tile_side));
  const std::filesystem::path file = obstacles_path(tile);
  write_texture(atlas, tile, file, halves, obstacle_bands, [&](TextureRecord record) {
    record.made_from = made_from;
    record.tallest_m = std::max(tallest_below_m, tallest_m(halves));
    return obstacles_item_text(atlas.description(), tile, file, record);
  });
}

class ObstacleLayer final : public PyramidLayer {
 public:
  explicit ObstacleLayer(const Store& atlas) : atlas_(atlas) {}

  [[nodiscard]] std::filesystem::path file_of(const PyramidTile& tile) const override { return obstacles_path(tile); }

  [[nodiscard]] FoundTexture found(const std::filesystem::path& file, Scrutiny scrutiny) const override {
    return found_obstacles(atlas_, file, scrutiny);
  }

  void write(const PyramidTile& tile, const PyramidQuarters& quarters, const std::string& made_from) const override {
    float tallest_below_m = 0.0F;
    for (const auto& quarter : quarters) {
      if (quarter) tallest_below_m = std::max(tallest_below_m, quarter->record.tallest_m.value_or(0.0F));
    }
    radar::GroundGrid texels = texels_of(atlas_.description().patches, tile);
    texels.cell_m /= 2.0;
    texels.columns *= 2;
    texels.rows *= 2;
    write_levels(atlas_, tile, radar::halved({texels, joined(quarters, decoded_obstacles)}), made_from,
                 tallest_below_m);
  }

 private:
  const Store& atlas_;
};

}  // namespace

std::filesystem::path obstacles_path(const PyramidTile& tile) {
  return folder_of(tile) / "obstacles.tif";
}

FoundTexture found_obstacles(const Store& atlas, const std::filesystem::path& file, Scrutiny scrutiny) {
  FoundTexture found = found_texture(atlas, file, scrutiny);
  if (!found.fault && !found.record->tallest_m) found.fault = StoreFault{file, obstacles_of_a_former_kind};
  return found;
}

std::optional<StoreFault> obstacles_fault(const Store& atlas, PatchIndex patch, Scrutiny scrutiny) {
  return found_obstacles(atlas, obstacles_path({0, patch}), scrutiny).fault;
}

void write_obstacles(const Store& atlas, PatchIndex patch, const radar::ObstacleMap& map) {
  const PyramidTile tile{0, patch};
  check_texels(map, atlas.description().patches.texels_of(patch), atlas.folder() / obstacles_path(tile));
  write_levels(atlas, tile, map, "", 0.0F);
}

Array2D<radar::Obstacle> read_obstacles(const Store& atlas, PatchIndex patch) {
  const std::filesystem::path file = obstacles_path({0, patch});
  if (const auto fault = obstacles_fault(atlas, patch, Scrutiny::Size)) {
    throw Error((atlas.folder() / fault->file).string(), fault->what, bake_again);
  }
  const std::size_t side = atlas.description().patches.texels_per_side;
  return std::move(decoded_obstacles(read_texture(atlas, file, side, 1, bake_again)).front());
}

LayerPyramid obstacle_pyramid(const Store& atlas) {
  return {atlas, std::make_unique<ObstacleLayer>(atlas)};
}

}  // namespace sigmascape::atlas
