#include "sigmascape/atlas/catalogs.h"

#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/is_absent.h"

namespace sigmascape::atlas {
namespace {

/// Whether a folder holds a file that is whole under its name. Catalogs come before them.
bool holds_files(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (!entry.path().filename().string().starts_with('.')) return true;
  }
  return false;
}

std::optional<StoreFault> fault_of(const Store& store, const std::filesystem::path& file, const std::string& right,
                                   Scrutiny scrutiny) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(store.folder() / file, error);
  if (is_nothing_there(error))
    return StoreFault{file, "is missing", !holds_files((store.folder() / file).parent_path())};
  if (error) return StoreFault{file, cannot_be_read(error)};
  if (size == right.size() && (scrutiny == Scrutiny::Size || text_of(store.folder() / file).text == right)) {
    return std::nullopt;
  }
  return StoreFault{file, "does not link what the atlas is planned to hold: it was altered, or is of a former kind"};
}

/// As fault_of. What former versions wrote of the same store stays as it is.
std::optional<StoreFault> collection_fault(const Store& store, Scrutiny scrutiny) {
  auto fault = fault_of(store, collection_name, collection_text(store.description()), scrutiny);
  if (!fault) return std::nullopt;
  for (const std::string& former : former_collection_texts(store.description()))
    if (!fault_of(store, collection_name, former, scrutiny)) return std::nullopt;
  return fault;
}

/// The same.
std::optional<StoreFault> catalog_fault(const Store& store, const PyramidTile& tile, Scrutiny scrutiny) {
  const std::filesystem::path file = catalog_path(tile);
  auto fault = fault_of(store, file, catalog_text(store.description(), tile), scrutiny);
  if (!fault || !fault_of(store, file, former_catalog_text(store.description(), tile), scrutiny)) return std::nullopt;
  return fault;
}

using Visit = std::function<void(const PyramidTile&)>;

/// Visits a place and those under it of which something is there, finer ones first. Returns whether there was such.
bool visit_begun(const Store& store, const PyramidTiles& places, const PyramidTile& tile, const Visit& visit) {
  std::error_code hidden;
  bool is_begun = std::filesystem::exists(store.folder() / folder_of(tile), hidden);
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
    if (geo::is_absent(file)) geo::write_atomically(file, catalog_text(description, *place));
  }
}

std::vector<StoreFault> catalog_faults(const Store& store, Scrutiny scrutiny) {
  std::vector<StoreFault> faults;
  const auto note = [&](std::optional<StoreFault> fault) {
    if (fault) faults.push_back(std::move(*fault));
  };
  note(collection_fault(store, scrutiny));
  visit_begun(store, [&](const PyramidTile& tile) { note(catalog_fault(store, tile, scrutiny)); });
  return faults;
}

std::vector<StoreFault> mend_catalogs(const Store& store, Scrutiny scrutiny,
                                      const std::function<bool(std::size_t number)>& has) {
  std::vector<StoreFault> mended;
  // Atlases whose collection links other things may never have had catalogs.
  const bool had_catalogs = !collection_fault(store, scrutiny);
  const auto mend = [&](std::optional<StoreFault> fault, const auto& right) {
    if (!fault) return;
    const std::filesystem::path file = store.folder() / fault->file;
    fault->is_absent = fault->is_absent || (!had_catalogs && geo::is_absent(file));
    geo::write_atomically(file, right());
    mended.push_back(std::move(*fault));
  };
  std::size_t number = 0;
  visit_begun(store, [&](const PyramidTile& tile) {
    if (!has(number++)) return;
    mend(catalog_fault(store, tile, scrutiny), [&] { return catalog_text(store.description(), tile); });
  });
  // Never over that of another atlas.
  static_cast<void>(Store::find(store.folder(), store.description()));
  // Last, so that what it links is there.
  mend(collection_fault(store, scrutiny), [&] { return collection_text(store.description()); });
  return mended;
}

}  // namespace sigmascape::atlas
