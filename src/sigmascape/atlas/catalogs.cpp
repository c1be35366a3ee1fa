#include "sigmascape/atlas/catalogs.h"

#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::atlas {
namespace {

std::optional<StoreFault> fault_of(const Store& store, const std::filesystem::path& file, const std::string& right,
                                   Scrutiny scrutiny) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(store.folder() / file, error);
  if (error) return StoreFault{file, "is missing"};
  if (size == right.size() && (scrutiny == Scrutiny::Size || text_of(store.folder() / file) == right)) {
    return std::nullopt;
  }
  return StoreFault{file, "does not link what the atlas is planned to hold: it was altered, or is of a former kind"};
}

using Visit = std::function<void(const PyramidTile&)>;

/// Visits a place and those under it of which something is there, finer ones first. Returns whether there was such.
bool visit_begun(const Store& store, const PyramidTiles& places, const PyramidTile& tile, const Visit& visit) {
  bool is_begun = std::filesystem::exists(store.folder() / folder_of(tile));
  if (tile.level > 0) {
    for (const auto& part : places.parts_of(tile)) {
      if (part && visit_begun(store, places, *part, visit)) is_begun = true;
    }
  }
  if (is_begun) visit(tile);
  return is_begun;
}

void visit_begun(const Store& store, const Visit& visit) {
  const PyramidTiles places(store.description().patches, store.description().extent);
  for (const PyramidTile& tile : places.tiles(places.levels())) visit_begun(store, places, tile, visit);
}

}  // namespace

void make_catalogs_over(const std::filesystem::path& folder, const AtlasDescription& description,
                        const PyramidTile& tile) {
  const PyramidTiles places(description.patches, description.extent);
  for (std::optional<PyramidTile> place = tile; place; place = places.parent_of(*place)) {
    const std::filesystem::path file = folder / catalog_path(*place);
    if (!std::filesystem::exists(file)) geo::write_atomically(file, catalog_text(description, *place));
  }
}

std::vector<StoreFault> catalog_faults(const Store& store, Scrutiny scrutiny) {
  std::vector<StoreFault> faults;
  const auto look_at = [&](const std::filesystem::path& file, const std::string& right) {
    if (auto fault = fault_of(store, file, right, scrutiny)) faults.push_back(std::move(*fault));
  };
  look_at(collection_name, collection_text(store.description()));
  visit_begun(store,
              [&](const PyramidTile& tile) { look_at(catalog_path(tile), catalog_text(store.description(), tile)); });
  return faults;
}

std::size_t mend_catalogs(const Store& store, Scrutiny scrutiny, const std::function<bool(std::size_t number)>& has) {
  std::size_t written = 0;
  const auto mend = [&](const std::filesystem::path& file, const std::string& right) {
    if (!fault_of(store, file, right, scrutiny)) return;
    geo::write_atomically(store.folder() / file, right);
    ++written;
  };
  std::size_t number = 0;
  visit_begun(store, [&](const PyramidTile& tile) {
    if (has(number++)) mend(catalog_path(tile), catalog_text(store.description(), tile));
  });
  // Never over that of another atlas.
  static_cast<void>(Store::find(store.folder(), store.description()));
  // Last, so that what it links is there.
  mend(collection_name, collection_text(store.description()));
  return written;
}

}  // namespace sigmascape::atlas
