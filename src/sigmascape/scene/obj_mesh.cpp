#include <fmt/format.h>
#include <fstream>
#include <map>
#include <sstream>
#include <tiny_obj_loader.h>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/imported_mesh.h"

namespace sigmascape::scene {
namespace {

/// A material file that merely names every material that the text uses: the loader forgets names that it finds in no
/// such file.
std::string material_file_for(const std::string& text) {
  std::istringstream lines(text);
  std::map<std::string, bool> names;
  for (std::string line; std::getline(lines, line);) {
    const auto start = line.find_first_not_of(" \t");
    if (start == std::string::npos || line.compare(start, 7, "usemtl ") != 0) continue;
    std::istringstream words(line.substr(start + 7));
    if (std::string name; words >> name) names[name] = true;
  }
  std::string file;
  for (const auto& [name, unused] : names) file += fmt::format("newmtl {}\n", name);
  return file;
}

}  // namespace

ImportedMesh read_obj(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw Error(file.string(), "cannot be read", "check that it is a readable file");
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString("mtllib names\n" + text.str(), material_file_for(text.str()))) {
    throw Error(file.string(), fmt::format("is not a Wavefront OBJ file ({})", reader.Error()), "export it again");
  }

  ImportedMesh mesh;
  const auto& coordinates = reader.GetAttrib().vertices;
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    mesh.vertices.push_back(Vec3<tinyobj::real_t>{coordinates[i], coordinates[i + 1], coordinates[i + 2]}.to<double>());
  }
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    for (std::size_t face = 0; 3 * face + 2 < shape.mesh.indices.size(); ++face) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const int index = shape.mesh.indices[3 * face + corner].vertex_index;
        if (index < 0 || static_cast<std::size_t>(index) >= mesh.vertices.size()) {
          throw Error(file.string(),
                      fmt::format("face {}{} names vertex {} of {}", face + 1,
                                  shape.name.empty() ? "" : " of " + shape.name, index + 1, mesh.vertices.size()),
                      "export it again");
        }
        triangle[corner] = static_cast<std::uint32_t>(index);
      }
      const int material = shape.mesh.material_ids[face];
      mesh.triangles.push_back(triangle);
      mesh.materials.push_back(
          mesh.material_index(material < 0 ? "" : reader.GetMaterials()[static_cast<std::size_t>(material)].name));
    }
  }
  return mesh;
}

}  // namespace sigmascape::scene
