#include "sigmascape/atlas/building_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sigmascape/atlas/stac_document.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::atlas {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian, and numbers are copied as they are");

/// glTF 2.0, 4.4.3 and 5.1: chunks of a binary file, and what its numbers are called.
constexpr std::uint32_t magic = 0x46546C67, version = 2, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr int of_floats = 5126, of_unsigned = 5125;
constexpr const char* reflectivity_key = "sigmascape:reflectivity";
constexpr const char* angles_key = "sigmascape:off_normal_rad";

/// Numbers of a buffer one after the other, and what tells of them.
class Accessors {
 public:
  /// Returns its number.
  template <typename Element>
  std::size_t add(std::span<const Element> elements, int component, const char* type) {
    const auto bytes = std::as_bytes(elements);
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t count = component == of_unsigned ? elements.size() * sizeof(Element) / 4 : elements.size();
    accessors_.push_back(
        {{"bufferView", views_.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors_.size() - 1;
  }
  [[nodiscard]] Json& operator[](std::size_t number) { return accessors_[number]; }

  void put_into(Json& document) const {
    document["accessors"] = accessors_;
    document["bufferViews"] = views_;
    document["buffers"] = Json::array();
    document["buffers"].push_back(Json::object({{"byteLength", bytes_.size()}}));
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  Json accessors_ = Json::array(), views_ = Json::array();
  std::string bytes_;
};

/// glTF wants to be told between what positions lie.
void tell_extremes(Json& accessor, const std::vector<Vec3f>& positions) {
  Vec3f least{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
  Vec3f most = -least;
  for (const Vec3f& position : positions) {
    least = {std::min(least.x, position.x), std::min(least.y, position.y), std::min(least.z, position.z)};
    most = {std::max(most.x, position.x), std::max(most.y, position.y), std::max(most.z, position.z)};
  }
  accessor["min"] = {least.x, least.y, least.z};
  accessor["max"] = {most.x, most.y, most.z};
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const Buildings& buildings, std::size_t material) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i < buildings.triangles.size(); ++i) {
    if (buildings.material_of[i] == material) triangles.push_back(buildings.triangles[i]);
  }
  return triangles;
}

void append(std::string& to, std::uint32_t number) {
  to.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

void append_chunk(std::string& to, std::uint32_t kind, std::string content, char padding) {
  content.append((4 - content.size() % 4) % 4, padding);
  append(to, static_cast<std::uint32_t>(content.size()));
  append(to, kind);
  to += content;
}

std::string glb_bytes(const Buildings& buildings) {
  Accessors accessors;
  Json primitives = Json::array(), materials = Json::array();
  if (!buildings.vertices.empty()) {
    const std::size_t positions = accessors.add(std::span(buildings.vertices), of_floats, "VEC3");
    tell_extremes(accessors[positions], buildings.vertices);
    for (std::size_t material = 0; material < buildings.materials.size(); ++material) {
      const auto triangles = triangles_of(buildings, material);
      if (triangles.empty()) continue;
      const std::size_t corners = accessors.add(std::span(triangles), of_unsigned, "SCALAR");
      primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"indices", corners}, {"material", material}});
    }
  }
  std::vector<float> angles;
  for (std::size_t node = 0; node < radar::FaceReflectivity::node_count; ++node)
    angles.push_back(static_cast<float>(radar::FaceReflectivity::off_normal_rad(node)));
  const std::size_t off_normal = accessors.add(std::span<const float>(angles), of_floats, "SCALAR");
  for (const FaceMaterial& material : buildings.materials) {
    Json by_frequency = Json::array();
    for (const radar::FaceReflectivity& reflectivity : material.reflectivity)
      by_frequency.push_back(accessors.add(std::span(reflectivity.at_node), of_floats, "VEC4"));
    materials.push_back(
        {{"name", material.name}, {"extras", {{reflectivity_key, by_frequency}, {angles_key, off_normal}}}});
  }
  Json document = {{"asset", {{"version", "2.0"}, {"generator", "Sigmascape"}}}};
  if (!primitives.empty()) {
    // East, north, up; glTF's y is up and its z points to the south.
    Json node = {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}}};
    document["nodes"] = Json::array();
    document["nodes"].push_back(std::move(node));
    document["meshes"] = Json::array();
    document["meshes"].push_back(Json::object({{"primitives", primitives}}));
    document["scene"] = 0;
    document["scenes"] = Json::array();
    document["scenes"].push_back(Json::object({{"nodes", Json::array({0})}}));
  }
  if (!materials.empty()) document["materials"] = materials;
  accessors.put_into(document);

  std::string chunks;
  append_chunk(chunks, json_chunk, written(document, -1), ' ');
  append_chunk(chunks, binary_chunk, accessors.bytes(), '\0');
  std::string bytes;
  append(bytes, magic);
  append(bytes, version);
  append(bytes, static_cast<std::uint32_t>(chunks.size() + 12));
  return bytes + chunks;
}

/// A file as it is written here, read back. Throws where it is none: its item vouches for the rest.
class GlbReader {
 public:
  explicit GlbReader(const std::string& bytes) {
    constexpr std::size_t header = 12, of_chunk = 8;
    const std::size_t of_json = number_at(bytes, header);
    document_ = Json::parse(bytes.substr(header + of_chunk, of_json));
    const std::size_t second = header + of_chunk + of_json;
    binary_ = bytes.substr(second + of_chunk, number_at(bytes, second));
  }

  /// Nothing when what materials return is told otherwise than here.
  [[nodiscard]] std::optional<Buildings> buildings() const {
    Buildings all;
    for (const Json& material : document_.value("materials", Json::array())) {
      FaceMaterial& read = all.materials.emplace_back();
      read.name = material.at("name").get<std::string>();
      const Json& extras = material.at("extras");
      static_cast<void>(extras.at(angles_key));  // those of radar::FaceReflectivity, which files of no other kind have
      for (const Json& number : extras.at(reflectivity_key)) {
        read.reflectivity.push_back({elements<radar::Channels>(number.get<std::size_t>())});
        if (read.reflectivity.back().at_node.size() != radar::FaceReflectivity::node_count) return std::nullopt;
      }
    }
    for (const Json& mesh : document_.value("meshes", Json::array())) {
      for (const Json& primitive : mesh.at("primitives")) {
        if (all.vertices.empty())
          all.vertices = elements<Vec3f>(primitive.at("attributes").at("POSITION").get<std::size_t>());
        const auto triangles = elements<std::array<std::uint32_t, 3>>(primitive.at("indices").get<std::size_t>());
        all.triangles.insert(all.triangles.end(), triangles.begin(), triangles.end());
        all.material_of.resize(all.triangles.size(), primitive.at("material").get<std::uint8_t>());
      }
    }
    return all;
  }

 private:
  static std::uint32_t number_at(const std::string& bytes, std::size_t place) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.substr(place, sizeof(number)).data(), sizeof(number));
    return number;
  }

  template <typename Element>
  [[nodiscard]] std::vector<Element> elements(std::size_t accessor) const {
    const auto number = document_.at("accessors").at(accessor).at("bufferView").get<std::size_t>();
    const Json& view = document_.at("bufferViews").at(number);
    const std::string part =
        binary_.substr(view.at("byteOffset").get<std::size_t>(), view.at("byteLength").get<std::size_t>());
    std::vector<Element> read(part.size() / sizeof(Element));
    std::memcpy(read.data(), part.data(), read.size() * sizeof(Element));
    return read;
  }

  Json document_;
  std::string binary_;
};

}  // namespace

bool keeps_buildings_apart(const AtlasDescription& description) {
  const auto setting = description.settings.find(buildings_setting);
  return setting != description.settings.end() && setting->second == buildings_apart;
}

void write_buildings(const Store& atlas, const Buildings& buildings) {
  const std::string bytes = glb_bytes(buildings);
  geo::write_atomically(atlas.folder() / buildings_name, bytes);
  geo::write_atomically(atlas.folder() / item_path(buildings_name),
                        buildings_item_text(atlas.description(), {bytes.size(), sha256_of(bytes)}));
}

std::optional<StoreFault> buildings_fault(const Store& atlas, Scrutiny scrutiny) {
  return texture_fault(atlas, buildings_name, scrutiny);
}

Buildings read_buildings(const Store& atlas) {
  if (const auto fault = buildings_fault(atlas, Scrutiny::Content))
    throw Error((atlas.folder() / fault->file).string(), fault->what, bake_again);
  const std::string file = (atlas.folder() / buildings_name).string();
  const auto text = text_of(file).text;
  try {
    auto buildings = text ? GlbReader(*text).buildings() : std::nullopt;
    if (buildings) return *std::move(buildings);
  } catch (const Json::exception&) {
  }
  throw Error(file, "cannot be understood", bake_again);
}

}  // namespace sigmascape::atlas
