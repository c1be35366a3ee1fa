#include "sigmascape/atlas/building_textures.h"

#include <algorithm>

#include "sigmascape/atlas/layer_store.h"

namespace sigmascape::atlas {
namespace {

LayerStore layer_of(const Store& atlas) {
  return {building_textures_folder, layer_description(atlas.description(), "buildings",
                                                      "what buildings return directly", atlas.description().aspects)};
}

}  // namespace

bool keeps_building_textures(const AtlasDescription& description) {
  const auto setting = description.settings.find(building_textures_setting);
  return setting != description.settings.end() && setting->second == building_textures_kept;
}

Store create_building_textures(const Store& atlas, std::vector<StoreFault>* mended) {
  return create_layer_store(atlas, layer_of(atlas), mended);
}

Store open_building_textures(const Store& atlas) {
  return open_layer_store(atlas, building_textures_folder);
}

std::optional<StoreFault> building_textures_fault(const Store& atlas) {
  return layer_collection_fault(atlas, layer_of(atlas));
}

LookStores::LookStores(const Store& atlas) : stores_{atlas} {
  if (!keeps_building_textures(atlas.description())) return;
  is_complete_ = !building_textures_fault(atlas);
  if (is_complete_) stores_.push_back(open_building_textures(atlas));
}

bool LookStores::is_done(PatchIndex patch, LookIndex look, Scrutiny scrutiny) const {
  return is_complete_ &&
         std::ranges::all_of(stores_, [&](const Store& store) { return store.is_done(patch, look, scrutiny); });
}

}  // namespace sigmascape::atlas
