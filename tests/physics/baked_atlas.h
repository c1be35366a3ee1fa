#pragma once

#include "scratch_folder.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"

namespace sigmascape::physics_test {

/// A scene baked into a folder of its own, and loaded.
inline atlas::Atlas baked_atlas(const scene::Scene& scene, const bake::BakeSettings& settings) {
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings, folder.path("atlas"), silent);
  return atlas::load_atlas(atlas::Store::open(folder.path("atlas")));
}

}  // namespace sigmascape::physics_test
