#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::python {

/// A scene with what is made of it once and used by many calls.
class LoadedScene {
 public:
  explicit LoadedScene(scene::Scene scene) : scene_(std::move(scene)) {}

  [[nodiscard]] const scene::Scene& scene() const { return scene_; }

  [[nodiscard]] const std::string& hash() const {
    std::call_once(hashed_, [this] { hash_ = scene::scene_hash(scene_); });
    return hash_;
  }
  /// On its terrain, ready for rays.
  [[nodiscard]] const trace::SceneGeometry& geometry() const {
    std::call_once(built_, [this] { geometry_.emplace(scene_, trace::Footing::Terrain); });
    return *geometry_;
  }

 private:
  scene::Scene scene_;
  mutable std::once_flag hashed_, built_;
  mutable std::string hash_;
  mutable std::optional<trace::SceneGeometry> geometry_;
};

}  // namespace sigmascape::python
