#pragma once

#include <filesystem>
#include <mutex>
#include <optional>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/terrain/height_field_file.h"

namespace sigmascape::python {

/// An atlas on the disk; its textures and terrain are read when a call first needs them, and kept.
class LoadedAtlas {
 public:
  explicit LoadedAtlas(const std::filesystem::path& folder) : store_(atlas::Store::open(folder)) {}

  [[nodiscard]] const atlas::Store& store() const { return store_; }
  [[nodiscard]] const atlas::AtlasDescription& description() const { return store_.description(); }

  [[nodiscard]] const atlas::Atlas& textures() const {
    std::call_once(textures_read_, [this] { textures_.emplace(atlas::load_atlas(store_)); });
    return *textures_;
  }
  [[nodiscard]] const terrain::HeightField& terrain() const {
    std::call_once(terrain_read_, [this] {
      terrain_ = terrain::read_height_field(atlas::vouched_terrain(store_, atlas::Scrutiny::Content));
    });
    return terrain_;
  }

 private:
  atlas::Store store_;
  mutable std::once_flag textures_read_, terrain_read_;
  mutable std::optional<atlas::Atlas> textures_;
  mutable terrain::HeightField terrain_;
};

}  // namespace sigmascape::python
