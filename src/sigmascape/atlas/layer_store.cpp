#include "sigmascape/atlas/layer_store.h"

#include <fmt/format.h>
#include <system_error>
#include <utility>

#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::atlas {
namespace {

/// As faults of an atlas name it.
std::filesystem::path collection_in(std::string_view folder) {
  return std::filesystem::path(folder) / collection_name;
}

/// What is wrong with the collection, if there is one.
std::optional<StoreFault> fault_of_any(const Store& atlas, const LayerStore& layer) {
  try {
    static_cast<void>(Store::find(atlas.folder() / layer.folder, layer.description));
    return std::nullopt;
  } catch (const Error&) {
    return StoreFault{collection_in(layer.folder), "was altered: it does not say what follows from the atlas"};
  }
}

}  // namespace

bool is_layer_of_an_atlas(const AtlasDescription& description) {
  return description.settings.contains(layer_setting);
}

AtlasDescription layer_description(const AtlasDescription& atlas, std::string_view name, const std::string& what,
                                   const AspectGrid& aspects) {
  AtlasDescription description = atlas;
  description.name += fmt::format(", {} alone", name);
  description.aspects = aspects;
  description.settings = {{layer_setting, what}};
  if (atlas.settings.contains(physics_revision_setting))
    description.settings[physics_revision_setting] = atlas.physics_revision();
  return description;
}

Store create_layer_store(const Store& atlas, const LayerStore& layer, std::vector<StoreFault>* mended) {
  const std::filesystem::path folder = atlas.folder() / layer.folder;
  if (auto fault = fault_of_any(atlas, layer)) {
    geo::write_atomically(folder / collection_name, collection_text(layer.description));
    if (mended != nullptr) mended->push_back(*std::move(fault));
  }
  return Store::create(folder, layer.description);
}

Store open_layer_store(const Store& atlas, std::string_view folder) {
  try {
    return Store::open(atlas.folder() / folder);
  } catch (const Error&) {
    const auto fault = unread_collection_fault(atlas, folder);
    if (!fault) throw;
    throw Error((atlas.folder() / fault->file).string(), fault->what, bake_again);
  }
}

std::optional<StoreFault> layer_collection_fault(const Store& atlas, const LayerStore& layer) {
  if (auto fault = unread_collection_fault(atlas, layer.folder)) return fault;
  return fault_of_any(atlas, layer);
}

std::optional<StoreFault> unread_collection_fault(const Store& atlas, std::string_view folder) {
  try {
    static_cast<void>(Store::open(atlas.folder() / folder));
    return std::nullopt;
  } catch (const Error&) {
    const std::error_code error = text_of(atlas.folder() / collection_in(folder)).error;
    if (is_nothing_there(error)) return StoreFault{collection_in(folder), "is missing"};
    return StoreFault{collection_in(folder), error ? cannot_be_read(error) : "is truncated or was altered"};
  }
}

}  // namespace sigmascape::atlas
