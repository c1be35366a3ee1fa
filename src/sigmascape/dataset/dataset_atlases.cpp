#include "sigmascape/dataset/dataset_atlases.h"

#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sigmascape/atlas/stac_description.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"

namespace sigmascape::dataset {
namespace {

atlas::Store opened_store(const DatasetSpec& spec, const std::filesystem::path& folder, const std::string& key,
                          const std::string& scene_hash) {
  auto store = atlas::Store::open(folder);
  if (store.description().scene_hash != scene_hash) {
    throw Error(fmt::format("{}: dataset.{}", spec.file.string(), key), "was baked from another scene",
                "bake this scene, or name the scene that the atlas was made from");
  }
  return store;
}

/// Throws Error for a store that differs from the atlas in more than the surfaces that a path may meet: what the one
/// holds less the other would be the difference of two bakes then, not of bounces.
void check_same_bake(const atlas::AtlasDescription& fewer, const atlas::AtlasDescription& all,
                     const std::string& where) {
  if (fewer.aspects != all.aspects)
    throw Error(where, "has other looks than the atlas", "bake it with the same azimuths, elevations and frequencies");
  const std::string remedy = "bake it with all options of the atlas but --bounces";
  if (fewer.patches != all.patches)
    throw Error(where,
                fmt::format("has texels of {:g} m, and the atlas of {:g} m, or other patches", fewer.patches.texel_m,
                            all.patches.texel_m),
                remedy);
  const auto word = [](const atlas::AtlasDescription& description, const std::string& key) {
    const auto found = description.settings.find(key);
    return found == description.settings.end() ? std::string("none") : found->second;
  };
  for (const auto& settings : {fewer.settings, all.settings}) {
    for (const auto& [key, value] : settings) {
      if (key == "max_bounces" || word(fewer, key) == word(all, key)) continue;
      throw Error(where,
                  fmt::format("was baked with {} {}, and the atlas with {}", key, word(fewer, key), word(all, key)),
                  remedy);
    }
  }
}

/// The store of echoes over at most so many surfaces.
atlas::Store opened_bounces(const DatasetSpec& spec, std::size_t most, const std::string& scene_hash,
                            const atlas::AtlasDescription& all) {
  auto store = opened_store(spec, spec.bounce_atlases[most - 1], spec.bounce_atlases_key, scene_hash);
  const auto& settings = store.description().settings;
  const auto bounces = settings.find("max_bounces");
  const std::string where =
      fmt::format("{}: {}", spec.file.string(), spec.bounce_atlases[most - 1].filename().string());
  if (bounces == settings.end() || bounces->second != std::to_string(most))
    throw Error(where,
                fmt::format("does not hold the echoes over {} surface{} and no more", most, most == 1 ? "" : "s"),
                fmt::format("bake it with --bounces {}", most));
  check_same_bake(store.description(), all, where);
  return store;
}

/// Throws Error for orders of bounces that bakes with shared noise do not tell. Up to two surfaces they do, for echoes
/// of one are not shared. Of two bakes that share, each by the doubt in its own texels, one less the other is less than
/// nothing in places.
void check_tells_orders(const DatasetSpec& spec, std::size_t bounces, const atlas::AtlasDescription& all) {
  const auto noise = all.settings.find("noise");
  if (bounces <= 2 || noise == all.settings.end() || noise->second != "shared") return;
  throw Error(
      spec.file.string() + ": dataset.layers",
      fmt::format("asks for bounce{}, which bakes with --noise shared do not tell, for each shares its own noise",
                  bounces),
      "bake atlas and bounce_atlases without it, or ask for bounce1, bounce2 and multibounce alone");
}

std::string description_hash(const atlas::Store& store) {
  return sha256_of(atlas::described(store.description()).dump());
}

/// Whole, and read as samples come to it.
atlas::Atlas opened_atlas(const atlas::Store& store) {
  atlas::Atlas atlas = atlas::load_atlas(store, {.reading = atlas::Reading::AsAsked});
  atlas.check_whole();
  return atlas;
}

}  // namespace

DatasetAtlases opened_atlases(const DatasetSpec& spec, const std::string& scene_hash) {
  const auto store = opened_store(spec, *spec.atlas, "atlas", scene_hash);
  DatasetAtlases opened{.all = opened_atlas(store), .of_bounces = {}, .hashes = {description_hash(store)}};
  const std::size_t bounces = spec.bounce_atlases.size();
  check_tells_orders(spec, bounces, store.description());
  for (std::size_t most = 1; most <= bounces; ++most) {
    const auto fewer = opened_bounces(spec, most, scene_hash, store.description());
    opened.of_bounces.push_back(opened_atlas(fewer));
    opened.hashes.push_back(description_hash(fewer));
  }
  return opened;
}

}  // namespace sigmascape::dataset
