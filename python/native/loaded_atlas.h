#pragma once

#include <filesystem>
#include <mutex>
#include <optional>

#include "loaded_scene.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/terrain/height_field_file.h"

namespace sigmascape::python {

/// An atlas on the disk; its terrain is read when a call first needs it, and of its textures what calls ask for, and
/// kept.
class LoadedAtlas {
 public:
  explicit LoadedAtlas(const std::filesystem::path& folder) : store_(atlas::Store::open(folder)) {}

  [[nodiscard]] const atlas::Store& store() const { return store_; }
  [[nodiscard]] const atlas::AtlasDescription& description() const { return store_.description(); }

  [[nodiscard]] const atlas::Atlas& textures() const {
    std::call_once(textures_read_,
                   [this] { textures_.emplace(atlas::load_atlas(store_, {.reading = atlas::Reading::AsAsked})); });
    return *textures_;
  }
  [[nodiscard]] const terrain::HeightField& terrain() const {
    std::call_once(terrain_read_, [this] {
      terrain_ = terrain::read_height_field(atlas::vouched_terrain(store_, atlas::Scrutiny::Content));
    });
    return terrain_;
  }

  /// Throws Error unless it was made of this scene.
  void check_baked_from(const LoadedScene& loaded) const {
    if (description().scene_hash == loaded.hash()) return;
    throw Error(store().folder().string(), "was baked from another scene than '" + loaded.scene().name + "'",
                "bake this scene, or give the scene that the atlas was made from");
  }

 private:
  atlas::Store store_;
  mutable std::once_flag textures_read_, terrain_read_;
  mutable std::optional<atlas::Atlas> textures_;
  mutable terrain::HeightField terrain_;
};

}  // namespace sigmascape::python
