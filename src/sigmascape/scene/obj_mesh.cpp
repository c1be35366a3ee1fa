#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <tiny_obj_loader.h>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/face_triangles.h"
#include "sigmascape/scene/imported_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr std::string_view blanks = " \t\r";
/// Of a faulty line, in an error.
constexpr std::size_t longest_quote = 60;

/// Takes the first line off a text.
std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

/// Takes the first word, none at the end, off a line.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/// The text with materials by number, for the loader ends their names at the first blank.
struct NumberedMaterials {
  std::string text;
  std::vector<std::string> names;

  /// A material file that merely names them all: the loader forgets what it finds in no such file.
  [[nodiscard]] std::string file() const {
    std::string file;
    for (std::size_t number = 0; number < names.size(); ++number) file += fmt::format("newmtl {}\n", number);
    return file;
  }
};

NumberedMaterials with_numbered_materials(std::string_view text) {
  NumberedMaterials numbered;
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    std::string_view name = line;
    if (next_word(name) != "usemtl" || name.find_first_not_of(blanks) == std::string_view::npos) {
      numbered.text += fmt::format("{}\n", line);
      continue;
    }
    name.remove_prefix(name.find_first_not_of(blanks));
    name = name.substr(0, name.find(" #"));
    name = name.substr(0, name.find_last_not_of(blanks) + 1);
    const auto known = std::ranges::find(numbered.names, name);
    numbered.text += fmt::format("usemtl {}\n", known - numbered.names.begin());
    if (known == numbered.names.end()) numbered.names.emplace_back(name);
  }
  return numbered;
}

/// Whether a word is one number that single precision, in which the loader counts, can hold.
bool is_coordinate(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stopped, fault] = std::from_chars(word.data(), end, value);
  return fault == std::errc{} && stopped == end &&
         std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

/// The loader takes what it cannot read for 0. Throws Error that names the first line of a vertex whose three
/// coordinates are not all there as finite numbers.
void check_vertices(std::string_view text, const std::filesystem::path& file) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = next_line(text);
    std::string_view words = line;
    if (next_word(words) != "v") continue;
    for (int axis = 0; axis < 3; ++axis) {
      if (is_coordinate(next_word(words))) continue;
      throw Error(fmt::format("{}:{}", file.string(), number),
                  fmt::format("'{}' does not hold three finite numbers",
                              line.substr(0, std::min(line.find_last_not_of(blanks) + 1, longest_quote))),
                  "write a vertex as v x y z with decimal points, such as v 0.5 1 0");
    }
  }
}

}  // namespace

ImportedMesh read_obj(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw Error(file.string(), "cannot be read", "check that it is a readable file");
  check_vertices(text.str(), file);
  tinyobj::ObjReader reader;
  // Its own triangles of faces that are not convex do not fill them.
  tinyobj::ObjReaderConfig faces_as_they_are;
  faces_as_they_are.triangulate = false;
  const NumberedMaterials numbered = with_numbered_materials(text.str());
  if (!reader.ParseFromString("mtllib names\n" + numbered.text, numbered.file(), faces_as_they_are)) {
    std::string_view reason = reader.Error();
    reason.remove_suffix(reason.size() - (reason.find_last_not_of(" \r\n") + 1));
    throw Error(file.string(), fmt::format("is not a Wavefront OBJ file ({})", reason), "export it again");
  }

  ImportedMesh mesh;
  const auto& coordinates = reader.GetAttrib().vertices;
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    mesh.vertices.push_back(Vec3<tinyobj::real_t>{coordinates[i], coordinates[i + 1], coordinates[i + 2]}.to<double>());
  }
  std::vector<std::uint32_t> numbers;
  std::vector<Vec3d> corners;
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    std::size_t first = 0;
    for (std::size_t face = 0; face < shape.mesh.num_face_vertices.size(); ++face) {
      const auto face_name = [&] {
        return fmt::format("face {}{}", face + 1, shape.name.empty() ? "" : " of " + shape.name);
      };
      numbers.clear();
      corners.clear();
      for (std::size_t corner = 0; corner < shape.mesh.num_face_vertices[face]; ++corner) {
        const int index = shape.mesh.indices[first + corner].vertex_index;
        if (index < 0 || static_cast<std::size_t>(index) >= mesh.vertices.size()) {
          throw Error(file.string(),
                      fmt::format("{} names vertex {} of {}", face_name(), index + 1, mesh.vertices.size()),
                      "export it again");
        }
        numbers.push_back(static_cast<std::uint32_t>(index));
        corners.push_back(mesh.vertices[static_cast<std::size_t>(index)]);
      }
      first += numbers.size();
      const auto triangles = triangles_of_face(corners);
      if (!triangles) {
        throw Error(file.string(), fmt::format("{} has an outline that crosses or meets itself", face_name()),
                    "export it as triangles");
      }
      const int material = shape.mesh.material_ids[face];
      const auto of_material =
          mesh.material_index(material < 0 ? "" : numbered.names[static_cast<std::size_t>(material)]);
      for (const auto& [a, b, c] : *triangles) {
        mesh.triangles.push_back({numbers[a], numbers[b], numbers[c]});
        mesh.materials.push_back(of_material);
      }
    }
  }
  return mesh;
}

}  // namespace sigmascape::scene
