#include <memory>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/ground_layers.h"

namespace sigmascape::atlas {

Atlas load_atlas(const Store& store, const LoadOptions& options) {
  const AtlasDescription& description = store.description();
  Atlas atlas;
  atlas.aspects_ = selected_grid(description.aspects, options.aspects);
  atlas.patches_ = description.patches;
  atlas.table_ = std::make_shared<PatchTable>(store, selected_looks(description.aspects, options.aspects),
                                              options.finest_level, options.threads);
  atlas.finest_level_ = options.finest_level;
  atlas.levels_ = atlas.table_->levels();
  atlas.north_west_ = atlas.table_->block()[0];
  atlas.patch_columns_ = static_cast<int>(atlas.table_->block().columns());
  atlas.patch_rows_ = static_cast<int>(atlas.table_->block().rows());
  atlas.patches_in_memory_ = atlas.table_->patches().data();
  if (options.reading == Reading::AtOnce) atlas.table_->read(atlas.table_->block(), options.finest_level);
  if (keeps_ground_apart(store))
    atlas.ground_layers_ = std::make_shared<const GroundLayers>(load_ground_layers(store, options));
  return atlas;
}

}  // namespace sigmascape::atlas
