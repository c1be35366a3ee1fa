#include "atlas_faults.h"

#include <system_error>

#include "sigmascape/atlas/layer_store.h"
#include "sigmascape/atlas/terrain_file.h"

namespace sigmascape::cli {

nlohmann::ordered_json json_of(const std::vector<atlas::StoreFault>& faults) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const atlas::StoreFault& fault : faults) {
    list.push_back({{"file", fault.file.string()}, {"fault", fault.what}});
  }
  return list;
}

std::vector<atlas::StoreFault> in_list(const std::optional<atlas::StoreFault>& fault) {
  return fault ? std::vector{*fault} : std::vector<atlas::StoreFault>{};
}

std::vector<atlas::StoreFault> tile_faults(
    const atlas::Store& atlas,
    const std::function<std::vector<terrain::PyramidFault>(const std::filesystem::path&)>& faults_in) {
  if (atlas::is_layer_of_an_atlas(atlas.description())) return {};
  const std::filesystem::path name = atlas::terrain_pyramid_name;
  std::error_code error;
  if (!std::filesystem::exists(atlas.folder() / name, error) && !error) return {{name / "", "is missing", true}};
  std::vector<atlas::StoreFault> faults;
  for (const terrain::PyramidFault& fault : faults_in(atlas.folder() / name))
    faults.push_back({name / fault.file, fault.what});
  return faults;
}

}  // namespace sigmascape::cli
