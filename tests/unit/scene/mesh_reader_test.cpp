#include "sigmascape/scene/mesh_reader.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>
#include <vector>

#include "scratch_folder.h"

namespace sigmascape::scene {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ObjMesh, ReadsFacesAndMaterialNamesWithoutAMaterialFile) {
  const ScratchFolder folder;
  const auto mesh =
      read_obj(folder.write("hut.obj",
                            "mtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl itu_brick\nf 1 2 3 4\n"
                            "usemtl roof\nf 1 2 3\n"));
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_THAT(mesh.material_names, ElementsAre("itu_brick", "roof"));
  EXPECT_EQ(mesh.materials[2], 1U);
}

TEST(ObjMesh, NamesOfMaterialsMayHoldBlanks) {
  const ScratchFolder folder;
  const auto mesh = read_obj(folder.write("hut.obj",
                                          "v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl my wall\r\nf 1 2 3\nusemtl\tmy roof # of "
                                          "tin\nf 1 2 3\nusemtl my wall\nf 1 2 3\n"));
  EXPECT_THAT(mesh.material_names, ElementsAre("my wall", "my roof"));
  EXPECT_THAT(mesh.materials, ElementsAre(0U, 1U, 0U));
}

TEST(ObjMesh, ReadsNumbersInEveryUsualSpelling) {
  const ScratchFolder folder;
  const auto mesh = read_obj(folder.write(
      "spelt.obj",
      "# v x\r\n\tv\t+1.5  -2. 3e1 1.0\r\nv .5 0 -1E-3 0.2 0.3 0.4\r\nv 0 0 0 # here\r\nvn a b c\r\nf 1 2 3\r\n"));
  ASSERT_EQ(mesh.vertices.size(), 3U);
  EXPECT_EQ(mesh.vertices[0], (Vec3d{1.5, -2.0, 30.0}));
  EXPECT_NEAR(mesh.vertices[1].z, -1e-3, 1e-9);
}

/// The vector area of all triangles, and the sum of their areas.
std::pair<Vec3d, double> areas_of(const ImportedMesh& mesh) {
  Vec3d together{};
  double sum_m2 = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d area = 0.5 * cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    together += area;
    sum_m2 += length(area);
  }
  return {together, sum_m2};
}

/// (x, y, z) brought round to (z, x, y) so many times: a roof becomes a wall.
Vec3d turned(Vec3d p, int times) {
  for (int i = 0; i < times; ++i) p = {p.z, p.x, p.y};
  return p;
}

/// Roofs and walls of an L, a U and an arrowhead, wherever they lie and whichever way they are turned.
TEST(ObjMesh, FacesThatAreNotConvexAreFilledExactly) {
  const ScratchFolder folder;
  struct Case {
    std::vector<Vec2d> outline;
    double area_m2;
  };
  const std::vector<Case> cases{{{{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}, 300.0},
                                {{{0, 0}, {30, 0}, {30, 20}, {20, 20}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}, 500.0},
                                {{{0, 0}, {10, 5}, {0, 10}, {8, 5}}, 10.0}};
  for (const auto& [outline, area_m2] : cases) {
    for (const auto& [place, turns] : {std::pair{Vec2d{0, 0}, 0}, {{-50, 20}, 0}, {{40, -70}, 1}, {{-50, 20}, 2}}) {
      for (std::size_t first = 0; first < outline.size(); ++first) {
        for (const bool backwards : {false, true}) {
          std::string text, face = "f";
          for (std::size_t i = 0; i < outline.size(); ++i) {
            const Vec2d at = outline[(first + (backwards ? outline.size() - i : i)) % outline.size()];
            const Vec3d corner = turned({place.x + at.x, place.y + at.y, 7.0 + 0.5 * at.x}, turns);
            text += fmt::format("v {} {} {}\n", corner.x, corner.y, corner.z);
            face += fmt::format(" {}", i + 1);
          }
          const auto mesh = read_obj(folder.write("roof.obj", text + face + "\n"));
          const auto [together, sum_m2] = areas_of(mesh);
          EXPECT_EQ(mesh.triangles.size(), outline.size() - 2);
          EXPECT_NEAR(sum_m2, area_m2 * std::hypot(1.0, 0.5), 1e-3);
          EXPECT_NEAR(dot(together, turned({0, 0, 1}, turns)), backwards ? -area_m2 : area_m2, 1e-3);
        }
      }
    }
  }
}

// The loader's own lists hold no face of more than 255 corners.
TEST(ObjMesh, FacesMayHaveAnyNumberOfCorners) {
  const ScratchFolder folder;
  constexpr int corners = 300;
  std::string text, roof = "o tank\nf";
  for (const double z : {0.0, 5.0}) {
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      text += fmt::format("v {} {} {}\n", 10.0 * std::cos(angle), 10.0 * std::sin(angle), z);
    }
  }
  for (int i = 0; i < corners; ++i) roof += fmt::format(" {}", i + 1 + corners);
  const auto mesh = read_obj(folder.write("tank.obj", text + roof + "\nf 1 2 302 301\n"));
  ASSERT_EQ(mesh.triangles.size(), corners - 2U + 2U);
  const double wall_m2 = 5.0 * 20.0 * std::sin(std::numbers::pi / corners);
  const double roof_m2 = 0.5 * corners * 100.0 * std::sin(2.0 * std::numbers::pi / corners);
  EXPECT_NEAR(areas_of(mesh).second, roof_m2 + wall_m2, 1e-3);
}

TEST(ObjMesh, CornersAreCountedFromTheFirstVertexOrBackFromTheLast) {
  const ScratchFolder folder;
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const auto mesh = read_obj(folder.write("both.obj", square + "f -3 -2 -1\nv 5 5 5\nf 1 2 4\n"));
  using Triangle = std::array<std::uint32_t, 3>;
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 3}));
  for (const auto& [corner, said] : {std::pair{"-4", "face 1 of shed names vertex -4 of 3"},
                                     {"0", "face 1 of shed names vertex 0 of 3"},
                                     {"4", "face 1 of shed names vertex 4 of 3"}}) {
    const auto file = folder.write("bad.obj", fmt::format("{}o shed\nf 1 2 {}\n", square, corner));
    EXPECT_THAT(message_of_error([&] { static_cast<void>(read_obj(file)); }), HasSubstr(said));
  }
}

TEST(ObjMesh, LinesThatEndOnABackslashGoOnInTheNext) {
  const ScratchFolder folder;
  for (const char* const end : {"\n", "\r\n"}) {
    const std::string on = std::string("\\") + end;
    const auto mesh =
        read_obj(folder.write("house.obj", std::string("# by C:\\") + end + "v 0 0 0" + end + "v 10 " + on + "0 0" +
                                               end + "v 10 10 0" + end + "v 5 15 0" + end + "v 0 10 0" + end +
                                               "f 1 2 " + on + " 3" + on + " 4 5" + end + "f 1 2 3" + on));
    EXPECT_EQ(mesh.vertices.size(), 5U);
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_NEAR(areas_of(mesh).second, 125.0 + 50.0, 1e-3);
  }
  const auto file = folder.write("bad.obj", "v 0 \\\n0 \\\n0\nv abc 1 0\n");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_obj(file)); }), HasSubstr("bad.obj:4: 'v abc 1 0'"));
}

TEST(ObjMesh, FacesThatCrossThemselvesAreRefused) {
  const ScratchFolder folder;
  const auto file = folder.write("bow.obj", "v 0 0 0\nv 3 0 0\nv 0 1 0\nv 2 1 0\nf 1 2 3 4\n");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_obj(file)); }),
              HasSubstr("face 1 has an outline that crosses or meets itself; export it as triangles"));
}

TEST(ObjMesh, AByteOrderMarkIsNoPartOfTheFirstVertex) {
  const ScratchFolder folder;
  const auto mesh = read_obj(folder.write("mark.obj", "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_EQ(mesh.vertices.size(), 3U);
  EXPECT_EQ(mesh.triangles.size(), 1U);
}

TEST(ObjMesh, VerticesBeyondThoseThatCanBeCountedAreRefused) {
  const ScratchFolder folder;
  const auto file = folder.write("many.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 4294967297 2 3//1\n");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_obj(file)); }),
              HasSubstr("many.obj:4: 'f 4294967297 2 3//1' names a vertex beyond those"));
}

TEST(ObjMesh, NumbersThatCannotBeReadNameTheirLine) {
  const ScratchFolder folder;
  for (const char* const vertex :
       {"v nan 1 0", "v inf 1 0", "v abc 1 0", "v 0,5 1 0", "v 1", "v", "v 1 2 3m", "v 1e39 0 0"}) {
    const auto file = folder.write("bad.obj", fmt::format("v 0 0 0\nv 1 0 0\n{}\nf 1 2 3\n", vertex));
    EXPECT_THAT(message_of_error([&] { static_cast<void>(read_obj(file)); }),
                AllOf(HasSubstr(fmt::format("bad.obj:3: '{}' does not hold three finite numbers", vertex)),
                      HasSubstr("write a vertex as v x y z with decimal points")));
  }
}

/// One triangle (0 0 0), (1 0 0), (0 1 2) in a node moved by (10, 0, 0) and doubled, as JSON with its buffer inside.
const char* const gltf_triangle = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[10,0,0],"scale":[2,2,2]}],"materials":[{"name":"metal"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,2]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAABA"}]})";

TEST(GltfMesh, AppliesNodeTransforms) {
  const ScratchFolder folder;
  const auto mesh = read_gltf(folder.write("t.gltf", gltf_triangle));
  ASSERT_EQ(mesh.vertices.size(), 3U);
  EXPECT_EQ(mesh.vertices[0], (Vec3d{10, 0, 0}));
  EXPECT_EQ(mesh.vertices[1], (Vec3d{12, 0, 0}));
  EXPECT_EQ(mesh.vertices[2], (Vec3d{10, 2, 4}));
  EXPECT_THAT(mesh.material_names, ElementsAre("metal"));
}

/// The same triangle twice within its node: as it is, and moved by (5, 0, 0) and turned by 90° about z.
const char* const gltf_instances =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"extensionsUsed":["EXT_mesh_gpu_instancing"],
"nodes":[{"mesh":0,"translation":[10,0,0],"scale":[2,2,2],
"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"ROTATION":2}}}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,2]},
{"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"},{"bufferView":2,"componentType":5126,"count":2,"type":"VEC4"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},
{"buffer":0,"byteOffset":60,"byteLength":32}],
"buffers":[{"byteLength":92,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAABAAAAAAAAAAAAAAAAAAACgQAAAAAAAAAAAAAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA8wQ1P/MENT8="}]})";

TEST(GltfMesh, StandsWhereverItsNodeHasInstances) {
  const ScratchFolder folder;
  std::string text = gltf_instances;
  for (const char* const listed : {"extensionsUsed", "extensionsRequired"}) {
    text.replace(text.find("extensionsUsed"), 14, listed);
    const auto mesh = read_gltf(folder.write("twice.gltf", text));
    ASSERT_EQ(mesh.vertices.size(), 6U);
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_EQ(mesh.vertices[1], (Vec3d{12, 0, 0}));
    EXPECT_NEAR(length(mesh.vertices[3] - Vec3d{20, 0, 0}), 0.0, 1e-5);
    EXPECT_NEAR(length(mesh.vertices[4] - Vec3d{20, 2, 0}), 0.0, 1e-5);
    EXPECT_NEAR(length(mesh.vertices[5] - Vec3d{18, 0, 4}), 0.0, 1e-5);
  }
  text.replace(text.find("\"count\":2"), 9, "\"count\":1");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_gltf(folder.write("odd.gltf", text))); }),
              HasSubstr("has instances with fewer of one attribute than of another"));
}

TEST(GltfMesh, RefusesDamagedFiles) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_gltf(folder.write("bad.gltf", "{"))); }),
              HasSubstr("bad.gltf: is not a glTF file"));
  // 2^62 + 1 vertices of 12 bytes take 12 of 2^64 bytes, and 2^64 - 12 bytes on is 12 bytes before the buffer.
  for (const char* const stated :
       {"\"count\":9", "\"count\":4611686018427387905", "\"byteOffset\":18446744073709551604,\"count\":3",
        "\"byteOffset\":37,\"count\":1", "\"byteOffset\":36,\"count\":1"}) {
    std::string text = gltf_triangle;
    text.replace(text.find("\"count\":3"), 9, stated);
    EXPECT_THAT(message_of_error([&] { static_cast<void>(read_gltf(folder.write("short.gltf", text))); }),
                HasSubstr("its buffer is shorter"))
        << stated;
  }
}

// Under two parents each, 60 nodes would stand for 2^59.
TEST(GltfMesh, RefusesNodesUnderSeveralParents) {
  const ScratchFolder folder;
  std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)";
  for (int node = 1; node < 60; ++node) text += fmt::format(R"({{"children":[{0},{0}]}},)", node);
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_gltf(folder.write("shared.gltf", text + "{}]}"))); }),
              HasSubstr("its node 59 hangs under two others"));
}

TEST(GltfMesh, RefusesWhatItsLoaderDoesNotSurvive) {
  const ScratchFolder folder;
  std::string deep = gltf_triangle;
  deep.insert(1, R"("extras":)" + std::string(200'000, '[') + std::string(200'000, ']') + ",");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_gltf(folder.write("deep.gltf", deep))); }),
              HasSubstr("deep.gltf: nests lists more than 256 deep"));
  std::string in_text = gltf_triangle;
  in_text.replace(in_text.find("metal"), 5, std::string(1000, '[') + R"(\"{)");
  EXPECT_EQ(read_gltf(folder.write("text.gltf", in_text)).vertices.size(), 3U);
  std::string viewless = gltf_triangle;
  viewless.replace(viewless.find(R"("bufferView":0,)"), 15, "");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_gltf(folder.write("viewless.gltf", viewless))); }),
              HasSubstr("accessors without a buffer view"));
}

TEST(MeshReader, ModelsWithYUpStandUprightAndLookForward) {
  ImportedMesh mesh;
  mesh.vertices = {{0, 5, 0}, {0, 0, 2}, {1, 0, 0}};
  const auto vertices = vertices_in_scene_axes(mesh, UpAxis::Y, 2.0);
  EXPECT_EQ(vertices[0], (Vec3f{0, 0, 10}));  // up
  EXPECT_EQ(vertices[1], (Vec3f{0, 4, 0}));   // the model's front
  // A mirror image would have a negative triple product.
  EXPECT_GT(dot(vertices[2], cross(vertices[0], vertices[1])) *
                dot(mesh.vertices[2], cross(mesh.vertices[0], mesh.vertices[1])),
            0.0);
}

}  // namespace
}  // namespace sigmascape::scene
