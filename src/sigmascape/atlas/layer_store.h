#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// Textures of one thing that an atlas keeps apart, in a folder of it that is a store by itself: of the same patches
/// and frequencies. What its collection says follows from the atlas.
struct LayerStore {
  std::string_view folder;  ///< of the atlas
  AtlasDescription description;
};

/// What tells that a store is a layer of an atlas, in a folder of it.
inline constexpr const char* layer_setting = "layer";
[[nodiscard]] bool is_layer_of_an_atlas(const AtlasDescription& description);

/// The description of such a store from that of its atlas: named and told so, seen under those aspects.
[[nodiscard]] AtlasDescription layer_description(const AtlasDescription& atlas, std::string_view name,
                                                 const std::string& what, const AspectGrid& aspects);

/// The store, made when it is not there; a collection that says something else, or nothing, is written anew and added
/// to `mended`.
[[nodiscard]] Store create_layer_store(const Store& atlas, const LayerStore& layer,
                                       std::vector<StoreFault>* mended = nullptr);

/// What is wrong with its collection, if anything, by itself and held against what follows from the atlas.
[[nodiscard]] std::optional<StoreFault> layer_collection_fault(const Store& atlas, const LayerStore& layer);

/// Throws Error when there is none that can be understood: the bake mends it.
[[nodiscard]] Store open_layer_store(const Store& atlas, std::string_view folder);

/// What is wrong with the collection in that folder of an atlas by itself: there is none that can be understood.
[[nodiscard]] std::optional<StoreFault> unread_collection_fault(const Store& atlas, std::string_view folder);

}  // namespace sigmascape::atlas
