#include "sigmascape/atlas/stac_catalog.h"

#include <fmt/format.h>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/layer_store.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/stac_description.h"
#include "sigmascape/atlas/stac_document.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/texture_name.h"

namespace sigmascape::atlas {
namespace {

/// What stands in the folder of every place, "az045.0_el13.0_f10.000GHz.json".
Json item_links(const AtlasDescription& description, const PyramidTile& tile) {
  Json links = Json::array();
  const auto look_count = static_cast<LookIndex>(description.aspects.look_count());
  for (LookIndex look = 0; look < look_count; ++look) {
    links.push_back(link("item", fmt::format("./{}.json", look_name(description.aspects.look(look)))));
  }
  if (keeps_ground_apart(description)) {
    links.push_back(link("item", "./" + item_path(obstacles_path(tile)).filename().string()));
  }
  return links;
}

std::string description_of(const PyramidTile& tile) {
  const auto [x, y] = tile.south_west;
  if (tile.level == 0) return fmt::format("Baked radar area reflectivity of patch ({}, {}), by look.", x, y);
  return fmt::format(
      "Baked radar area reflectivity of {0} x {0} patches, the south-western one ({1}, {2}), by look; under it the "
      "finer levels.",
      1 << tile.level, x, y);
}

void link_coarsest_level(const AtlasDescription& description, Json& links) {
  const PyramidTiles places(description.patches, description.extent);
  for (const PyramidTile& tile : places.tiles(places.levels())) {
    links.push_back(link("child", "./" + catalog_path(tile).generic_string()));
  }
}

Json former_links_of_collection(const AtlasDescription& description) {
  Json links = Json::array({link("root", fmt::format("./{}", collection_name))});
  link_coarsest_level(description, links);
  return links;
}

Json links_of_collection(const AtlasDescription& description) {
  if (is_layer_of_an_atlas(description)) {
    const std::string above = root_of(description).generic_string();
    Json links = Json::array({link("root", above), link("parent", above)});
    link_coarsest_level(description, links);
    return links;
  }
  Json links = former_links_of_collection(description);
  if (keeps_ground_apart(description))
    links.push_back(link("child", fmt::format("./{}/{}", ground_folder, collection_name)));
  if (keeps_building_textures(description))
    links.push_back(link("child", fmt::format("./{}/{}", building_textures_folder, collection_name)));
  links.push_back(link("item", "./" + item_path(terrain_name).generic_string()));
  if (keeps_buildings_apart(description))
    links.push_back(link("item", "./" + item_path(buildings_name).generic_string()));
  return links;
}

Json collection_with(const Json& links, const AtlasDescription& description) {
  const Footprint footprint(description, whole_grid(description));
  return {
      {"type", "Collection"},
      {"stac_version", stac_version},
      {"stac_extensions", Json::array()},
      {"id", description.name},
      {"description",
       "Baked radar area reflectivity (sigma0, linear, per horizontal area) by patch and look. "
       "The dates are not times: bakes carry no clock."},
      {"license", "various"},
      {"extent",
       {{"spatial", {{"bbox", Json::array({footprint.box})}}},
        {"temporal", {{"interval", Json::array({{no_time, no_time}})}}}}},
      {"sigmascape:atlas", described(description)},
      {"links", links},
  };
}

std::string sealed_collection(Json collection) {
  collection[collection_hash] = "";
  return sealed(written(collection, 2) + "\n", collection_hash);
}

std::string catalog_under(const std::filesystem::path& root, const AtlasDescription& description,
                          const PyramidTile& tile) {
  const PyramidTiles places(description.patches, description.extent);
  const auto above = places.parent_of(tile);
  Json links = Json::array({link("root", href_from(tile, root)),
                            link("parent", href_from(tile, above ? catalog_path(*above) : collection_name))});
  if (tile.level > 0) {
    for (const auto& part : places.parts_of(tile)) {
      if (part) links.push_back(link("child", href_from(tile, catalog_path(*part))));
    }
  }
  for (const Json& item : item_links(description, tile)) links.push_back(item);
  const Json catalog = {
      {"type", "Catalog"},      {"stac_version", stac_version},
      {"id", place_name(tile)}, {"description", description_of(tile)},
      {"links", links},
  };
  return written(catalog, 2) + "\n";
}

}  // namespace

std::filesystem::path catalog_path(const PyramidTile& tile) {
  return folder_of(tile) / catalog_name;
}

std::filesystem::path root_of(const AtlasDescription& description) {
  const std::filesystem::path collection = collection_name;
  return is_layer_of_an_atlas(description) ? ".." / collection : collection;
}

std::string collection_text(const AtlasDescription& description) {
  return sealed_collection(collection_with(links_of_collection(description), description));
}

std::vector<std::string> former_collection_texts(const AtlasDescription& description) {
  const Json former = collection_with(former_links_of_collection(description), description);
  return {sealed_collection(former), written(former, 2) + "\n"};
}

std::string catalog_text(const AtlasDescription& description, const PyramidTile& tile) {
  return catalog_under(root_of(description), description, tile);
}

std::string former_catalog_text(const AtlasDescription& description, const PyramidTile& tile) {
  return catalog_under(collection_name, description, tile);
}

}  // namespace sigmascape::atlas
