#include "sigmascape/scene/crown.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plain_scene.h"
#include "validation/validation_record.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::trace {
namespace {

scatter::Material medium(const scatter::CrownParameters& parameters) {
  return {.name = "medium", .model = parameters, .source = {}};
}

/// Scatters without changing polarization.
constexpr scatter::Depolarization none{0.0, 1.0};

/// Ground of that albedo beneath one crown; the prototype's mesh is a speck under the ground.
scene::Scene crown_scene(const scene::Ellipsoid& shape, const scatter::CrownParameters& parameters,
                         double ground_albedo = 0.0) {
  scene::Scene scene = plain_scene(ground_albedo);
  scene.prototypes.push_back(scene::wall_mesh(0.001F, 0.001F, 0));
  scene.crowns.push_back({.prototype = 0, .shape = shape, .medium = scene.material_index(medium(parameters))});
  scene.instances.push_back({.x_m = 400.0F, .y_m = 400.0F});
  scene.crowns[0].shape.centre += {-400.0F, -400.0F, 0.0F};
  return scene;
}

/// An ellipsoid so wide that it is a slab above the middle of the scene, from 2 m upwards.
constexpr scene::Ellipsoid slab(float thickness_m) {
  return {{0.0F, 0.0F, 2.0F + 0.5F * thickness_m}, {2000.0F, 2000.0F, 0.5F * thickness_m}};
}

/// Mean σ0 of the middle of the scene.
radar::Channels sigma0(const scene::Scene& scene, double elevation_deg, const PathOptions& options, double half_m = 8.0,
                       std::uint32_t samples = 64) {
  const double elevation = radians_from_deg(elevation_deg);
  const auto viewpoint = Viewpoint::distant({pi, elevation});
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const PathTracer tracer(geometry, surface_models(scene, x_band_hz), viewpoint, options, 3);
  const double launched_m = half_m + 12.0;
  const LaunchArea launch = launch_area(viewpoint, {-launched_m, -launched_m, launched_m, launched_m}, 1.0, 0.0,
                                        geometry.highest_m() + 1.0, {});
  std::array<double, radar::Channels::count> sum{};
  tracer.trace(launch, {0, samples, samples}, 1, [&](std::span<const radar::Echo> echoes, unsigned) {
    for (const radar::Echo& echo : echoes) {
      const double along = -echo.range_m / std::cos(elevation);
      if (std::abs(echo.cross) > half_m || std::abs(along) > half_m) continue;
      sum[0] += echo.rcs_m2.vv;
      sum[1] += echo.rcs_m2.hh;
      sum[2] += echo.rcs_m2.hv;
    }
  });
  const double area = 4.0 * half_m * half_m;
  return {static_cast<float>(sum[0] / area), static_cast<float>(sum[1] / area), static_cast<float>(sum[2] / area),
          0.0F};
}

void expect_db(std::string_view name, double expected, double measured, double tolerance_db, std::string_view source) {
  validation::expect_close({.group = "Vegetation",
                            .name = name,
                            .expected = db_from_linear(expected),
                            .measured = db_from_linear(measured),
                            .tolerance = tolerance_db,
                            .unit = "dB",
                            .source = source});
}

TEST(Crown, RaysCrossScaledEllipsoidsAlongTheirChords) {
  scene::Scene scene = crown_scene({{400.0F, 400.0F, 4.0F}, {2.0F, 2.0F, 3.0F}}, {.extinction_per_m = 0.5});
  scene.instances[0] = {.x_m = -795.0F, .y_m = 0.0F, .yaw_rad = 0.0F, .scale = {2.0F, 1.0F, 1.0F}};
  scene.crowns[0].shape.centre = {400.0F, 0.0F, 4.0F};  // at x = 5, with radii of 4, 2 and 3
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const auto surfaces = surface_models(scene, x_band_hz);
  const auto depth = [&](Vec3f from, Vec3f towards) {
    CrownCrossings crowns;
    crowns.begin(surfaces);
    EXPECT_FALSE(geometry.occluded(from, towards, crowns));
    return crowns.optical_depth();
  };
  EXPECT_NEAR(depth({-50, 0, 4}, {1, 0, 0}), 0.5 * 8.0, 1e-4);
  EXPECT_NEAR(depth({5, -50, 4}, {0, 1, 0}), 0.5 * 4.0, 1e-4);
  EXPECT_NEAR(depth({5, 0, 4}, {0, 0, 1}), 0.5 * 3.0, 1e-4) << "from its middle";
  EXPECT_NEAR(depth({-50, 0, 4.0F + 1.5F}, {1, 0, 0}), 0.5 * 8.0 * std::sqrt(0.75), 1e-4) << "half way up";
  EXPECT_EQ(depth({-50, 0, 7.1F}, {1, 0, 0}), 0.0F);
  EXPECT_EQ(depth({50, 0, 4}, {1, 0, 0}), 0.0F) << "behind the ray";
}

// 4 m and 6 m of chord above one another; each once, whichever way the ray goes.
TEST(Crown, EveryCrownOfATreeCounts) {
  scene::Scene scene = crown_scene({{400.0F, 400.0F, 5.0F}, {2.0F, 2.0F, 2.0F}}, {.extinction_per_m = 0.5});
  scene.instances[0] = {.x_m = 10.0F, .y_m = 0.0F};
  scene.crowns[0].shape.centre = {0.0F, 0.0F, 5.0F};
  scene::Crown upper = scene.crowns[0];
  upper.shape = {{0.0F, 0.0F, 12.0F}, {2.0F, 2.0F, 3.0F}};
  scene.crowns.push_back(upper);
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const auto surfaces = surface_models(scene, x_band_hz);
  for (const float up : {1.0F, -1.0F}) {
    CrownCrossings crowns;
    crowns.begin(surfaces);
    EXPECT_FALSE(geometry.occluded({10.0F, 0.0F, up > 0.0F ? 1.0F : 30.0F}, {0.0F, 0.0F, up}, crowns, 29.0F));
    EXPECT_NEAR(crowns.optical_depth(), 0.5 * (4.0 + 6.0), 1e-4) << up;
  }
}

// The same line through the same leaves, whatever their size; a medium that is stated knows metres of the world.
TEST(Crown, OfATallTreeLetsPassWhatThatOfASmallOneDoes) {
  const auto depth_at = [](float scale, bool grows) {
    scene::Scene scene = crown_scene({{400.0F, 400.0F, 4.0F}, {4.0F, 2.0F, 3.0F}}, {0.3, 0.5, {}, true, none});
    scene.crowns[0].grows_with_tree = grows;
    scene.crowns[0].shape.centre = {0.0F, 0.0F, 4.0F};
    scene.instances = {{.x_m = 0.0F, .y_m = 0.0F, .scale = {scale, scale, scale}}};
    const SceneGeometry geometry(scene, Footing::LevelPlane);
    const auto surfaces = surface_models(scene, x_band_hz);
    CrownCrossings crowns;
    crowns.begin(surfaces);
    EXPECT_FALSE(geometry.occluded({-100.0F, 0.5F * scale, 4.5F * scale}, {1.0F, 0.0F, 0.0F}, crowns));
    return crowns.optical_depth();
  };
  EXPECT_NEAR(depth_at(1.0F, true), depth_at(1.0F, false), 1e-5F);
  EXPECT_NEAR(depth_at(2.5F, true), depth_at(1.0F, true), 1e-4F);
  EXPECT_NEAR(depth_at(2.5F, false), 2.5F * depth_at(1.0F, false), 1e-4F);
}

TEST(Crown, GroundBeneathIsWeakenedByTheWayThrough) {
  for (const bool shares_gaps : {true, false}) {
    for (const double elevation_deg : {30.0, 60.0}) {
      const double length_m = 4.0 / std::sin(radians_from_deg(elevation_deg));
      const scatter::CrownParameters leaves{.extinction_per_m = 0.2, .albedo = 0.0, .shares_gaps = shares_gaps};
      const double open = sigma0(crown_scene(slab(4.0F), {.extinction_per_m = 0.0}, 0.5), elevation_deg, {}).vv;
      const double beneath = sigma0(crown_scene(slab(4.0F), leaves, 0.5), elevation_deg, {}).vv;
      expect_db(fmt::format("ground beneath a slab of κ = 0.2/m and 4 m at {:.0f}°, {}", elevation_deg,
                            shares_gaps ? "one way" : "both ways"),
                std::exp(-0.2 * length_m * (shares_gaps ? 1.0 : 2.0)), beneath / open, 0.1, "exp(−κd)");
    }
  }
}

TEST(Crown, HalfSpaceScattersOnceAsDerived) {
  for (const bool shares_gaps : {true, false}) {
    for (const double elevation_deg : {15.0, 45.0}) {
      const scatter::CrownParameters leaves{.extinction_per_m = 3.0,
                                            .albedo = 0.6,
                                            .leaf = {},
                                            .shares_gaps = shares_gaps,
                                            .depolarization = {0.25, 0.5}};
      const auto measured = sigma0(crown_scene(slab(20.0F), leaves), elevation_deg, {.max_bounces = 1});
      // ω sin ψ / m over both receive polarizations, m ways weakened; of it 1/(1 + x) co-polarized.
      const double total = 0.6 * std::sin(radians_from_deg(elevation_deg)) / (shares_gaps ? 1.0 : 2.0);
      const auto report = [&](const char* channel, double expected, double got) {
        expect_db(fmt::format("half space of albedo 0.6 at {:.0f}°, one bounce, {}, {}", elevation_deg,
                              shares_gaps ? "shared gaps" : "no shared gaps", channel),
                  expected, got, 0.05, "integral over depth");
      };
      report("VV", total / 1.25, measured.vv);
      report("HV", total * 0.25 / 1.25, measured.hv);
    }
  }
}

/// Chandrasekhar's H of isotropic scattering, by iteration of its integral equation on Gaussian abscissae.
double chandrasekhar_h(double albedo, double mu) {
  constexpr int n = 400;
  std::vector<double> h(n, 1.0);
  const auto at = [](int i) { return (i + 0.5) / n; };
  const auto next = [&](double m) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += at(i) * h[static_cast<std::size_t>(i)] / (m + at(i)) / n;
    return 1.0 / (std::sqrt(1.0 - albedo) + 0.5 * albedo * sum);
  };
  for (int iteration = 0; iteration < 60; ++iteration) {
    std::vector<double> better(n);
    for (int i = 0; i < n; ++i) better[static_cast<std::size_t>(i)] = next(at(i));
    h = better;
  }
  return next(mu);
}

// Of all orders: H² (Chandrasekhar), with every path of two and more vertices doubled by its reversal.
TEST(Crown, HalfSpaceScattersManyTimesAsChandrasekharSays) {
  for (const Estimator estimator : {Estimator::Reciprocal, Estimator::OneWay}) {
    for (const double elevation_deg : {20.0, 60.0}) {
      const double mu = std::sin(radians_from_deg(elevation_deg)), albedo = 0.7;
      const scatter::CrownParameters leaves{
          .extinction_per_m = 3.0, .albedo = albedo, .shares_gaps = false, .depolarization = none};
      const auto measured =
          sigma0(crown_scene(slab(20.0F), leaves), elevation_deg, {.max_bounces = 60, .estimator = estimator});
      const double h = chandrasekhar_h(albedo, mu);
      expect_db(fmt::format("half space of albedo 0.7 at {:.0f}°, all orders, {}", elevation_deg,
                            estimator == Estimator::Reciprocal ? "reciprocal weights" : "one way"),
                0.5 * albedo * mu * (1.0 + 2.0 * (h * h - 1.0)), measured.vv, 0.1, "Chandrasekhar 1960, H function");
    }
  }
}

TEST(Crown, KeepsAllPowerThatItDoesNotAbsorb) {
  const auto books = [](double albedo) {
    const scene::Scene scene = crown_scene({{0.0F, 0.0F, 6.0F}, {5.0F, 5.0F, 5.0F}},
                                           {.extinction_per_m = 1.0, .albedo = albedo, .depolarization = {0.3, 0.2}});
    const auto viewpoint = Viewpoint::distant({pi, 0.7});
    const SceneGeometry geometry(scene, Footing::LevelPlane);
    const PathTracer tracer(geometry, surface_models(scene, x_band_hz), viewpoint,
                            {.max_bounces = 200, .power_books = true}, 1);
    const LaunchArea launch = launch_area(viewpoint, {-12, -12, 12, 12}, 1.0, 0.0, geometry.highest_m() + 1.0, {});
    return tracer.trace(launch, {0, 128, 128}, 1, [](std::span<const radar::Echo>, unsigned) {}).power;
  };
  for (const double albedo : {0.3, 1.0}) {
    const PowerBooks kept = books(albedo);
    EXPECT_LT(std::abs(kept.imbalance()), 3.0 * kept.imbalance_error() + 1e-4) << albedo;
    EXPECT_LT(kept.imbalance_error(), 0.004);
  }
}

/// Square cards of side `side_m`, spread evenly over an ellipsoid and turned every way.
scene::Mesh cards(const scene::Ellipsoid& shape, int count, float side_m, scene::MaterialIndex material) {
  scene::Mesh mesh;
  for (std::uint64_t card = 0; mesh.triangles.size() < 2 * static_cast<std::size_t>(count); ++card) {
    const auto u = [&](int n) { return 2.0F * unit_float(hashed(card, n)) - 1.0F; };
    const Vec3f place{u(0), u(1), u(2)};
    if (dot(place, place) > 1.0F) continue;
    const float z = u(3), phi = static_cast<float>(pi) * u(4), turn = static_cast<float>(pi) * u(5);
    const float radius = std::sqrt(1.0F - z * z);
    const Basis basis(Vec3f{radius * std::cos(phi), radius * std::sin(phi), z});
    const Vec3f a = (basis.tangent * std::cos(turn) + basis.bitangent * std::sin(turn)) * (0.5F * side_m);
    const Vec3f b = cross(basis.normal, a);
    const Vec3f middle =
        shape.centre + Vec3f{place.x * shape.radii_m.x, place.y * shape.radii_m.y, place.z * shape.radii_m.z};
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3f corner : {middle - a - b, middle + a - b, middle + a + b, middle - a + b})
      mesh.vertices.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.materials.insert(mesh.materials.end(), 2, material);
  }
  return mesh;
}

/// The same stand of trees twice: its crowns of leaves, and as the media that follow from those leaves.
struct Stand {
  scene::Scene leaves, media;
};

void plant(Stand& stand, int trees_a_side) {
  for (int i = 0; i < trees_a_side; ++i) {
    for (int j = 0; j < trees_a_side; ++j) {
      const auto place = [&](int n) {
        return 5.0F * (static_cast<float>(n) - 0.5F * static_cast<float>(trees_a_side - 1));
      };
      const scene::Instance tree{.x_m = place(i), .y_m = place(j), .yaw_rad = static_cast<float>(i + 3 * j)};
      stand.leaves.instances.push_back(tree);
      stand.media.instances.push_back(tree);
    }
  }
}

void give_crown(scene::Scene& scene, const scene::Ellipsoid& shape, double extinction_per_m) {
  const auto material = scene::crown_material(scatter::library_material("leaf"), extinction_per_m);
  scene.crowns.push_back({.prototype = 0, .shape = shape, .medium = scene.material_index(material)});
}

constexpr scene::Ellipsoid even_shape{{0.0F, 0.0F, 4.6F}, {2.9F, 2.9F, 3.2F}};

/// Of cards spread as evenly as the medium takes them to be.
Stand stand(int trees_a_side) {
  Stand stand{plain_scene(0.1), plain_scene(0.1)};
  const scene::MaterialIndex leaf = stand.leaves.material_index(scatter::library_material("leaf"));
  const scene::Mesh mesh = cards(even_shape, 6000, 0.12F, leaf);
  stand.leaves.prototypes.push_back(mesh);
  stand.media.prototypes.push_back(scene::wall_mesh(0.001F, 0.001F, 0));
  give_crown(stand.media, even_shape,
             scene::even_extinction_per_m(scene::surface_area_m2(mesh, leaf), scene::volume_m3(even_shape)));
  plant(stand, trees_a_side);
  return stand;
}

/// Of the trees that scene files plant.
Stand built_in_stand(scene::TreeForm form, int trees_a_side) {
  Stand stand{plain_scene(0.1), plain_scene(0.1)};
  const scatter::Material bark = scatter::library_material("bark");
  const scene::TreeMaterials materials{stand.leaves.material_index(bark),
                                       stand.leaves.material_index(scatter::library_material("leaf"))};
  const scene::Mesh tree = scene::tree_mesh(form, materials, 1);
  stand.leaves.prototypes.push_back(tree);
  stand.media.prototypes.push_back(scene::bare_tree_mesh(form, stand.media.material_index(bark), 1));
  const scene::Ellipsoid shape = scene::crown_ellipsoid(form);
  give_crown(stand.media, shape, scene::effective_extinction_per_m(tree, materials.leaf, shape));
  plant(stand, trees_a_side);
  return stand;
}

constexpr std::pair<scene::TreeForm, const char*> tree_forms[] = {{scene::TreeForm::Broadleaf, "broadleaf"},
                                                                  {scene::TreeForm::Conifer, "conifer"}};

/// Shrinks the branches to nothing, so that leaves alone stand in the way.
void without_bark(scene::Mesh& mesh) {
  const scene::MaterialIndex bark = mesh.materials.front();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.materials[i] == bark) mesh.triangles[i] = {0, 0, 0};
  }
}

void expect_equal_passage(const Stand& tree, const scene::Ellipsoid& shape, std::string_view name,
                          std::string_view source) {
  const SceneGeometry leaves(tree.leaves, Footing::LevelPlane), media(tree.media, Footing::LevelPlane);
  const auto surfaces = surface_models(tree.media, x_band_hz);
  for (const double elevation_deg : {0.0, 45.0}) {
    const double e = radians_from_deg(elevation_deg);
    const Vec3f direction = Vec3d{0.0, std::cos(e), -std::sin(e)}.to<float>();
    const Vec3f up = Vec3d{0.0, std::sin(e), std::cos(e)}.to<float>();
    double through_leaves = 0.0, through_medium = 0.0;
    int rays = 0;
    for (float x = -2.85F; x < 2.9F; x += 0.05F) {
      for (float y = -3.2F; y < 3.2F; y += 0.05F) {
        const Vec3f start = shape.centre + Vec3f{x, 0.0F, 0.0F} + up * y - direction * 20.0F;
        CrownCrossings crowns;
        crowns.begin(surfaces);
        EXPECT_FALSE(media.occluded(start, direction, crowns));
        if (crowns.optical_depth() == 0.0F) continue;
        through_medium += static_cast<double>(std::exp(-crowns.optical_depth()));
        through_leaves += leaves.occluded(start, direction) ? 0.0 : 1.0;
        ++rays;
      }
    }
    validation::expect_close({.group = "Vegetation",
                              .name = fmt::format("part that passes through {} at {:.0f}°", name, elevation_deg),
                              .expected = through_medium / rays,
                              .measured = through_leaves / rays,
                              .tolerance = 0.1 * through_medium / rays,
                              .unit = "1",
                              .source = source});
  }
}

TEST(Crown, LetsPassWhatItsLeavesLetPass) {
  expect_equal_passage(stand(1), even_shape, "evenly spread leaves", "exp(−κd), κ half the leaf area density");
  for (const auto& [form, name] : tree_forms) {
    Stand built_in = built_in_stand(form, 1);
    for (scene::Mesh* mesh : {&built_in.leaves.prototypes[0], &built_in.media.prototypes[0]}) without_bark(*mesh);
    expect_equal_passage(built_in, scene::crown_ellipsoid(form), fmt::format("a {} tree's leaves", name),
                         "exp(−κd), κ the effective one over all sides");
  }
}

void expect_equal_brightness(const Stand& trees, std::string_view name) {
  for (const double elevation_deg : {25.0, 50.0}) {
    const auto of_leaves = sigma0(trees.leaves, elevation_deg, {}, 10.0, 64);
    const auto of_media = sigma0(trees.media, elevation_deg, {}, 10.0, 64);
    const auto report = [&](const char* channel, float leaves, float media, double tolerance_db) {
      expect_db(fmt::format("stand of {} at {:.0f}°, {}: media against leaves", name, elevation_deg, channel), leaves,
                media, tolerance_db, "the same stand traced through its leaves");
    };
    report("VV + HH + 2·HV", of_leaves.power(radar::Polarization::Sum), of_media.power(radar::Polarization::Sum), 1.0);
    // Cards stand in each other's way in pairs, which a medium knows nothing of: single polarizations may differ more.
    report("VV", of_leaves.vv, of_media.vv, 1.5);
    report("HH", of_leaves.hh, of_media.hh, 1.5);
    report("HV", of_leaves.hv, of_media.hv, 1.5);
  }
}

TEST(Crown, StandOfMediaIsAsBrightAsOneOfLeaves) {
  expect_equal_brightness(stand(9), "evenly spread leaves");
  for (const auto& [form, name] : tree_forms) {
    expect_equal_brightness(built_in_stand(form, 9), fmt::format("{} trees", name));
  }
}

}  // namespace
}  // namespace sigmascape::trace
