#include "made_ground.h"

#include <fmt/format.h>
#include <unistd.h>

#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::bench {
namespace {

/// 0.5 to 1.5, 1 in the mean.
float grain_at(std::size_t column, std::size_t row) {
  return 0.5F + unit_float(hashed(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)));
}

void write_patch(const atlas::Store& store, atlas::PatchIndex patch) {
  const std::size_t side = store.description().patches.texels_per_side;
  for (atlas::LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
    const double elevation = store.description().aspects.look(look).aspect.elevation_rad;
    const auto vv = static_cast<float>(gamma_vv * std::sin(elevation));
    Array2D<radar::Channels> texels(side, side);
    for (std::size_t row = 0; row < side; ++row) {
      for (std::size_t column = 0; column < side; ++column) {
        const float here = vv * grain_at(column, row);
        texels(column, row) = {here, 0.5F * here, 0.1F * here, 0.3F * here};
      }
    }
    store.write(patch, look, texels, {});
  }
}

/// Lets `link` show what stands in the folder of `texture`.
void link_folder(const std::filesystem::path& store, const std::filesystem::path& texture,
                 const std::filesystem::path& link) {
  const auto from = (store / texture).parent_path(), to = (store / link).parent_path();
  if (from == to || std::filesystem::exists(to)) return;
  std::filesystem::create_directories(to.parent_path());
  std::filesystem::create_directory_symlink(from, to);
}

}  // namespace

ScratchStore::ScratchStore()
    : folder_(std::filesystem::temp_directory_path() / fmt::format("sigmascape-bench-render-{}", getpid())) {
  std::filesystem::create_directories(folder_);
}

ScratchStore::~ScratchStore() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

atlas::Store made_store(const std::filesystem::path& folder, int patches_a_side) {
  atlas::AtlasDescription description;
  description.name = "made for measuring";
  description.patches = {texel_m, 1024};
  const double side_m = description.patches.side_m() * patches_a_side;
  description.extent = {0.0, 0.0, side_m, side_m};
  description.aspects.azimuths_rad = {0.0, pi};
  description.aspects.elevations_rad = {radians_from_deg(5.0), radians_from_deg(40.0)};
  description.aspects.frequencies_hz = {9e9, 11e9};
  description.scene_hash = "none";
  atlas::Store store = atlas::Store::create(folder, description);

  const atlas::PatchIndex written{0, 0};
  write_patch(store, written);
  for (const atlas::PatchIndex& patch : description.patches.covering(description.extent)) {
    link_folder(folder, store.texture_path(written, 0), store.texture_path(patch, 0));
  }
  const atlas::Pyramid pyramid(store);
  for (std::size_t level = 1; level <= pyramid.levels(); ++level) {
    const atlas::PyramidTile first = pyramid.tile_over(written, level);
    for (atlas::LookIndex look = 0; look < description.aspects.look_count(); ++look) (void)pyramid.make(first, look);
    for (const atlas::PyramidTile& tile : pyramid.tiles(level)) {
      link_folder(folder, pyramid.texture_path(first, 0), pyramid.texture_path(tile, 0));
    }
  }
  return store;
}

std::shared_ptr<render::LiveGround> made_ground(const atlas::Store& store, std::size_t budget_bytes) {
  const radar::Rectangle& extent = store.description().extent;
  terrain::HeightField field;
  constexpr double margin_m = 500.0;
  field.west_m = extent.west_m - margin_m;
  field.north_m = extent.north_m + margin_m;
  field.spacing_m = std::max(10.0, extent.width_m() / 2000.0);
  const auto nodes = static_cast<std::size_t>((extent.width_m() + 2.0 * margin_m) / field.spacing_m) + 2;
  field.height_m = Array2D<float>(nodes, nodes, 0.0F);
  return std::make_shared<render::LiveGround>(store, std::move(field), frequency_hz,
                                              render::CacheOptions{.budget_bytes = budget_bytes});
}

}  // namespace sigmascape::bench
