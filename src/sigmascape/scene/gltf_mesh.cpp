#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <new>
#include <set>
#include <tiny_gltf.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/scene/imported_mesh.h"

namespace sigmascape::scene {
namespace {

/// Column-major 4 × 4 as glTF stores it, the last row left out: three columns and a translation.
struct NodePlacement {
  std::array<Vec3d, 3> axis{Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}};
  Vec3d origin;

  [[nodiscard]] Vec3d direction(Vec3d v) const { return axis[0] * v.x + axis[1] * v.y + axis[2] * v.z; }
  [[nodiscard]] Vec3d point(Vec3d v) const { return direction(v) + origin; }
  [[nodiscard]] NodePlacement then(const NodePlacement& inner) const {
    return {{direction(inner.axis[0]), direction(inner.axis[1]), direction(inner.axis[2])}, point(inner.origin)};
  }
};

NodePlacement placement_of(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    const auto& m = node.matrix;
    return {{Vec3d{m[0], m[1], m[2]}, Vec3d{m[4], m[5], m[6]}, Vec3d{m[8], m[9], m[10]}}, {m[12], m[13], m[14]}};
  }
  NodePlacement placement;
  if (node.rotation.size() == 4) {
    const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    placement.axis = {Vec3d{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)},
                      Vec3d{2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)},
                      Vec3d{2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)}};
  }
  if (node.scale.size() == 3) {
    for (std::size_t i = 0; i < 3; ++i) placement.axis[i] = placement.axis[i] * node.scale[i];
  }
  if (node.translation.size() == 3) placement.origin = {node.translation[0], node.translation[1], node.translation[2]};
  return placement;
}

/// Of the mesh of a node in several places at once.
constexpr const char* instancing = "EXT_mesh_gpu_instancing";

template <typename T>
T value_at(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, std::string file) : model_(model), file_(std::move(file)) {}

  ImportedMesh read() {
    if (model_.scenes.empty()) throw damaged("it has no scene");
    const std::size_t scene = model_.defaultScene < 0 ? 0 : static_cast<std::size_t>(model_.defaultScene);
    for (const int root : checked(model_.scenes, scene, "scene").nodes) add_node(root, NodePlacement{}, 0);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] Error damaged(const std::string& what) const {
    return {file_, what, "export it again as plain glTF 2.0"};
  }

  template <typename T>
  const T& checked(const std::vector<T>& list, std::size_t index, const char* what) const {
    if (index >= list.size()) throw damaged(fmt::format("it refers to {} {} of {}", what, index, list.size()));
    return list[index];
  }
  template <typename T>
  const T& checked(const std::vector<T>& list, int index, const char* what) const {
    return checked(list, static_cast<std::size_t>(index), what);
  }

  void add_node(int index, const NodePlacement& parent, int depth) {
    if (depth > 64) throw damaged("its nodes are nested more than 64 deep");
    const tinygltf::Node& node = checked(model_.nodes, index, "node");
    // Each has one parent: under several, few nodes could stand for more than can be counted.
    if (!met_.insert(index).second) throw damaged(fmt::format("its node {} hangs under two others", index));
    const NodePlacement placement = parent.then(placement_of(node));
    if (node.mesh >= 0) {
      const auto& parts = checked(model_.meshes, node.mesh, "mesh").primitives;
      for (const NodePlacement& instance : instances_of(node)) {
        for (const tinygltf::Primitive& part : parts) add_primitive(part, placement.then(instance));
      }
    }
    for (const int child : node.children) add_node(child, placement, depth + 1);
  }

  /// Where the mesh of a node stands within the node: once at its origin, or wherever the extension says.
  [[nodiscard]] std::vector<NodePlacement> instances_of(const tinygltf::Node& node) const {
    const auto extension = node.extensions.find(instancing);
    if (extension == node.extensions.end() || !extension->second.Has("attributes")) return {NodePlacement{}};
    const tinygltf::Value& attributes = extension->second.Get("attributes");
    const auto translations = vectors_in(attributes, "TRANSLATION", TINYGLTF_TYPE_VEC3),
               rotations = vectors_in(attributes, "ROTATION", TINYGLTF_TYPE_VEC4),
               scales = vectors_in(attributes, "SCALE", TINYGLTF_TYPE_VEC3);
    const std::size_t count = std::max({std::size_t{1}, translations.size(), rotations.size(), scales.size()});
    const auto fits = [count](const auto& vectors) { return vectors.empty() || vectors.size() == count; };
    if (!fits(translations) || !fits(rotations) || !fits(scales)) {
      throw damaged(fmt::format("its node '{}' has instances with fewer of one attribute than of another", node.name));
    }
    std::vector<NodePlacement> instances;
    for (std::size_t i = 0; i < count; ++i) {
      tinygltf::Node instance;
      if (!translations.empty()) instance.translation = translations[i];
      if (!rotations.empty()) instance.rotation = rotations[i];
      if (!scales.empty()) instance.scale = scales[i];
      instances.push_back(placement_of(instance));
    }
    return instances;
  }

  /// The vectors of an attribute of instances; none where it is not stated.
  [[nodiscard]] std::vector<std::vector<double>> vectors_in(const tinygltf::Value& attributes, const char* name,
                                                            int type) const {
    if (!attributes.Has(name)) return {};
    const tinygltf::Accessor& accessor = checked(model_.accessors, attributes.Get(name).GetNumberAsInt(), "accessor");
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.type != type) {
      throw damaged(fmt::format("its {} states {} by other numbers than floats", instancing, name));
    }
    if (accessor.count == 0) throw damaged(fmt::format("its {} states no {}", instancing, name));
    const auto size = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    const auto [first, stride] = elements_of(accessor, size * sizeof(float));
    std::vector<std::vector<double>> vectors(accessor.count, std::vector<double>(size));
    for (std::size_t i = 0; i < accessor.count; ++i) {
      for (std::size_t k = 0; k < size; ++k)
        vectors[i][k] = static_cast<double>(value_at<float>(first + i * stride + k * sizeof(float)));
    }
    return vectors;
  }

  void add_primitive(const tinygltf::Primitive& part, const NodePlacement& placement) {
    if (part.mode >= TINYGLTF_MODE_POINTS && part.mode <= TINYGLTF_MODE_LINE_STRIP) return;
    const auto position = part.attributes.find("POSITION");
    if (position == part.attributes.end()) return;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const std::size_t count = add_vertices(checked(model_.accessors, position->second, "accessor"), placement);
    std::vector<std::uint32_t> corners;
    if (part.indices >= 0) {
      corners = indices_of(checked(model_.accessors, part.indices, "accessor"));
    } else {
      for (std::uint32_t i = 0; i < count; ++i) corners.push_back(i);
    }
    for (std::uint32_t& corner : corners) {
      if (corner >= count) throw damaged(fmt::format("a face names vertex {} of {}", corner, count));
      corner += first;
    }
    const std::string material = part.material < 0 ? "" : checked(model_.materials, part.material, "material").name;
    add_triangles(part.mode, corners, mesh_.material_index(material));
  }

  void add_triangles(int mode, const std::vector<std::uint32_t>& corners, std::size_t material) {
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      mesh_.triangles.push_back({corners[a], corners[b], corners[c]});
      mesh_.materials.push_back(material);
    };
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (std::size_t i = 0; i + 2 < corners.size(); ++i) i % 2 == 0 ? add(i, i + 1, i + 2) : add(i + 1, i, i + 2);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) add(0, i, i + 1);
    } else {
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) add(i, i + 1, i + 2);
    }
  }

  /// Where an accessor's elements lie: the first one's address and the distance from one to the next.
  struct Elements {
    const unsigned char* first;
    std::size_t stride;
  };
  [[nodiscard]] Elements elements_of(const tinygltf::Accessor& accessor, std::size_t element_bytes) const {
    if (accessor.sparse.isSparse) throw damaged("it uses sparse accessors, which are not supported");
    if (accessor.bufferView < 0) throw damaged("it uses accessors without a buffer view, which are not supported");
    const auto& view = checked(model_.bufferViews, accessor.bufferView, "buffer view");
    const auto& buffer = checked(model_.buffers, view.buffer, "buffer").data;
    const int stride = accessor.ByteStride(view);
    // A damaged file can state numbers that no sum of them holds: what is left is compared, not where it would end.
    const bool starts_within =
        view.byteOffset <= buffer.size() && accessor.byteOffset <= buffer.size() - view.byteOffset;
    const std::size_t left = starts_within ? buffer.size() - view.byteOffset - accessor.byteOffset : 0;
    const auto fits = [&] {
      return accessor.count == 0 ||
             (left >= element_bytes && accessor.count - 1 <= (left - element_bytes) / static_cast<std::size_t>(stride));
    };
    if (stride <= 0 || !starts_within || !fits()) throw damaged("its buffer is shorter than its contents say");
    return {buffer.data() + view.byteOffset + accessor.byteOffset, static_cast<std::size_t>(stride)};
  }

  std::size_t add_vertices(const tinygltf::Accessor& accessor, const NodePlacement& placement) {
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.type != TINYGLTF_TYPE_VEC3) {
      throw damaged("its vertices are not three floats each");
    }
    const auto [first, stride] = elements_of(accessor, 3 * sizeof(float));
    for (std::size_t i = 0; i < accessor.count; ++i) {
      const auto xyz = value_at<std::array<float, 3>>(first + i * stride);
      mesh_.vertices.push_back(placement.point(Vec3f{xyz[0], xyz[1], xyz[2]}.to<double>()));
    }
    return accessor.count;
  }

  [[nodiscard]] std::vector<std::uint32_t> indices_of(const tinygltf::Accessor& accessor) const {
    std::vector<std::uint32_t> indices;
    const auto bytes =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    const auto [first, stride] = elements_of(accessor, bytes);
    for (std::size_t i = 0; i < accessor.count; ++i) {
      const unsigned char* at = first + i * stride;
      switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
          indices.push_back(*at);
          break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
          indices.push_back(value_at<std::uint16_t>(at));
          break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
          indices.push_back(value_at<std::uint32_t>(at));
          break;
        default:
          throw damaged("its face indices are not unsigned whole numbers");
      }
    }
    return indices;
  }

  const tinygltf::Model& model_;
  std::string file_;
  ImportedMesh mesh_;
  std::set<int> met_;  ///< nodes
};

/// The JSON of a glTF file: all of it, or the first part of a binary one. Empty where there is none.
std::string json_of(const std::filesystem::path& file, bool binary) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 20> head{};
  if (!binary) return {std::istreambuf_iterator<char>(stream), {}};
  if (!stream.read(head.data(), head.size())) return {};
  std::uint32_t stated = 0;
  std::memcpy(&stated, head.data() + 12, sizeof(stated));
  // A damaged file may state more than it holds.
  std::string json(static_cast<std::size_t>(std::min<std::uintmax_t>(stated, std::filesystem::file_size(file))), '\0');
  stream.read(json.data(), static_cast<std::streamsize>(json.size()));
  json.resize(static_cast<std::size_t>(stream.gcount()));
  return json;
}

/// How deep lists and objects are nested within one another.
std::size_t nesting_of(const std::string& json) {
  std::size_t depth = 0, deepest = 0;
  bool is_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (json[i] == '"') is_text = !is_text;
    if (is_text && json[i] == '\\') ++i;
    if (is_text) continue;
    if (json[i] == '[' || json[i] == '{') deepest = std::max(deepest, ++depth);
    if ((json[i] == ']' || json[i] == '}') && depth > 0) --depth;
  }
  return deepest;
}

/// The loader goes down by its own calls.
constexpr std::size_t most_nesting = 256;

}  // namespace

ImportedMesh read_gltf(const std::filesystem::path& file) {
  tinygltf::TinyGLTF loader;
  // Textures do not scatter: they are not decoded.
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string faults, warnings;
  const bool binary = file_ending(file) == ".glb";
  if (nesting_of(json_of(file, binary)) > most_nesting) {
    throw Error(file.string(), fmt::format("nests lists more than {} deep", most_nesting),
                "export it again without extras");
  }
  const auto load = [&] {
    try {
      return binary ? loader.LoadBinaryFromFile(&model, &faults, &warnings, file.string())
                    : loader.LoadASCIIFromFile(&model, &faults, &warnings, file.string());
    } catch (const std::bad_alloc&) {
      faults = "a buffer that it names is no file, or larger than memory";
      return false;
    }
  };
  if (!load()) {
    std::string first = faults.substr(0, faults.find('\n'));
    throw Error(file.string(), fmt::format("is not a glTF file ({})", first), "export it again as glTF 2.0");
  }
  std::vector<std::string>& required = model.extensionsRequired;
  std::erase(required, instancing);
  if (!required.empty()) {
    throw Error(file.string(), fmt::format("requires {}", fmt::join(required, ", ")),
                "export it again without these extensions (without mesh compression)");
  }
  return GltfReader(model, file.string()).read();
}

}  // namespace sigmascape::scene
