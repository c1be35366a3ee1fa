#pragma once

#include <filesystem>

#include "unit/live/live_ground_example.h"

#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/terrain/height_field_file.h"

namespace sigmascape {

/// The example of live ground with γ of 0.1 everywhere, as programs in C open it: with its terrain beside it.
inline void write_atlas_of_even_ground(const std::filesystem::path& folder) {
  live::ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return live::constant_gamma(0.1, look); };
  const auto store = example.store(folder);
  terrain::write_height_field(folder / atlas::terrain_name, example.terrain(), store.description().frame.proj());
  atlas::vouch_for_terrain(store);
}

}  // namespace sigmascape
