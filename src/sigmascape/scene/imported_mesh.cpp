#include "sigmascape/scene/imported_mesh.h"

#include <algorithm>

namespace sigmascape::scene {

std::size_t ImportedMesh::material_index(const std::string& name) {
  const auto known = std::ranges::find(material_names, name);
  if (known != material_names.end()) return static_cast<std::size_t>(known - material_names.begin());
  material_names.push_back(name);
  return material_names.size() - 1;
}

}  // namespace sigmascape::scene
