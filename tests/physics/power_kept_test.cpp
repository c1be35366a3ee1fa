#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "keep_worst.h"
#include "physics/level_scene.h"
#include "scratch_folder.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/scene/simple_scene.h"

namespace sigmascape::physics_test {
namespace {

constexpr const char* power_kept_group = "Power, kept";
constexpr std::array channel_names{"VV", "HH", "HV", "Re VV·HH*"};
using Sums = std::array<double, radar::Channels::count>;

Sums as_sums(const radar::Channels& c) {
  return {static_cast<double>(c.vv), static_cast<double>(c.hh), static_cast<double>(c.hv),
          static_cast<double>(c.re_vvhh)};
}

void expect_relative(const std::string& name, double expected, double measured, double tolerance, const char* source) {
  validation::expect_close({.group = power_kept_group,
                            .name = name,
                            .expected = 0.0,
                            .measured = measured / expected - 1.0,
                            .tolerance = tolerance,
                            .unit = "1",
                            .source = source});
}

/// Σ σ0 · A over all texels.
Sums power_of(const Array2D<radar::Channels>& texels, double texel_m) {
  Sums sums{};
  for (const radar::Channels& texel : texels.values()) {
    const Sums part = as_sums(texel);
    for (std::size_t c = 0; c < part.size(); ++c) sums[c] += part[c] * texel_m * texel_m;
  }
  return sums;
}

/// What lands on the grid and what does not, by the place of each echo on flat ground.
struct InsideAndOutside {
  Sums inside{}, outside{};
};

InsideAndOutside inside_and_outside(const std::vector<radar::Echo>& echoes, const radar::Aspect& aspect,
                                    const radar::Rectangle& grid) {
  const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad);
  const Vec2d right{-towards.y, towards.x};
  InsideAndOutside sums;
  for (const radar::Echo& echo : echoes) {
    const Vec2d place = towards * (-echo.range_m / std::cos(aspect.elevation_rad)) + right * echo.cross;
    Sums& to = grid.contains(place) ? sums.inside : sums.outside;
    const Sums part = as_sums(echo.rcs_m2);
    for (std::size_t c = 0; c < part.size(); ++c) to[c] += part[c];
  }
  return sums;
}

// A box and a cylinder whose layover, shadows and double bounces reach over the edges of the texels.
TEST(PowerKept, FromEchoesToTexelsToHalves) {
  const scene::Scene scene = scene::simple_scene({.ground_material = "wooded_hills", .object_material = "paper_bark"});
  for (const double elevation_deg : {13.0, 37.0}) {
    const radar::Aspect aspect{radians_from_deg(130.0), radians_from_deg(elevation_deg)};
    const auto echoes = traced_echoes(scene, aspect, {.area = {-40, -40, 40, 40}, .cell_m = 0.5, .samples = 8});
    const radar::GroundGrid grid{-24, 24, 0.1875, 256, 256};
    const receiver::GroundAccumulator texels = landed(echoes, aspect, grid);
    const auto total = texels.bins().total();
    const InsideAndOutside sums = inside_and_outside(echoes, aspect, grid.extent());
    ASSERT_GT(std::min(sums.inside[2], sums.outside[2]), 0.1 * std::max(sums.inside[2], sums.outside[2]))
        << "too little on one side of the edge for the test to mean anything";
    const auto chain = atlas::mip_chain(texels.sigma0(), 1);
    const auto halves = atlas::decoded(atlas::encoded(chain, atlas::fitting_scale(chain.front()), 10));
    for (std::size_t c = 0; c < total.size(); ++c) {
      const std::string name = fmt::format("box and cylinder, elevation {}°, {}", elevation_deg, channel_names[c]);
      expect_relative(name + ": Σσ0·A plus spill over Σdσ", sums.inside[c] + sums.outside[c],
                      total[c] + sums.outside[c], 1e-5, "an echo lands in one texel or on none");
      double worst_mip = 0.0, worst_half = 0.0;
      for (std::size_t level = 0; level < chain.size(); ++level) {
        const double texel_m = grid.cell_m * std::pow(2.0, static_cast<double>(level));
        keep_worst(worst_mip, power_of(chain[level], texel_m)[c] / total[c] - 1.0);
        keep_worst(worst_half, power_of(halves[level], texel_m)[c] / total[c] - 1.0);
      }
      expect_relative(name + ": worst of nine mips over the bins", 1.0, 1.0 + worst_mip, 1e-6,
                      "a mip is the area mean");
      expect_relative(name + ": worst of nine mips in halves", 1.0, 1.0 + worst_half, 1e-3, "rounding to eleven bits");
    }
  }
}

/// Boxes of rough conductor on Lambert ground where the patches of a 4 × 4 mosaic meet, and on the seams between.
scene::Scene boxes_across_seams(double patch_m) {
  const scatter::Material ground{.name = "ground", .model = scatter::LambertParameters{0.2, {0.1, 0.5}}, .source = {}};
  scene::Scene scene = level_scene(ground, 8.0 * patch_m);
  scene.extent = {0, 0, 4.0 * patch_m, 4.0 * patch_m};
  scene.prototypes.push_back(scene::box_mesh({24.0F, 16.0F, 12.0F}, scene.material_index(rough_conductor("box", 0.6))));
  const auto add = [&](double x, double y) {
    scene.instances.push_back({.x_m = static_cast<float>(x * patch_m),
                               .y_m = static_cast<float>(y * patch_m),
                               .yaw_rad = static_cast<float>(x + 2.0 * y)});
  };
  for (int i = 1; i < 4; ++i) {
    for (int j = 1; j < 4; ++j) {
      add(i, j);
      add(i, j + 0.5);
      add(i + 0.5, j);
    }
  }
  return scene;
}

/// Level 0 of a whole bake in one array.
Array2D<radar::Channels> baked_texels(const scene::Scene& scene, const bake::BakeSettings& settings,
                                      const std::filesystem::path& folder) {
  SilentProgress silent;
  bake::bake(scene, settings, folder, silent);
  const auto store = atlas::Store::open(folder);
  const std::size_t side = settings.patches.texels_per_side;
  constexpr std::size_t whole = 1024;
  Array2D<radar::Channels> all(whole, whole);
  for (const atlas::Unit& unit : store.units()) {
    const auto texels = store.read(unit.patch, unit.look).front();
    const std::size_t west = static_cast<std::size_t>(unit.patch.x) * side;
    const std::size_t north = whole - (static_cast<std::size_t>(unit.patch.y) + 1) * side;
    for (std::size_t row = 0; row < side; ++row) {
      for (std::size_t column = 0; column < side; ++column) all(west + column, north + row) = texels(column, row);
    }
  }
  return all;
}

/// The same place twice: as one patch and as sixteen, level 0 of both.
struct TwoBakes {
  Array2D<radar::Channels> one, mosaic;
};

TwoBakes both_ways(int max_bounces) {
  const scene::Scene scene = boxes_across_seams(256.0);
  bake::BakeSettings settings;
  settings.aspects = {{radians_from_deg(130.0)}, {radians_from_deg(21.0)}, {frequency_hz}};
  settings.sampling.samples_per_texel = 2;
  settings.max_bounces = max_bounces;
  settings.shadows = bake::Shadows::Baked;
  const ScratchFolder folder;
  TwoBakes bakes;
  settings.patches = {1.0, 1024};
  bakes.one = baked_texels(scene, settings, folder.path("one"));
  settings.patches = {1.0, 256};
  bakes.mosaic = baked_texels(scene, settings, folder.path("mosaic"));
  return bakes;
}

// Without echoes of several bounces, which launched paths of either end may stand for, there is no noise between them:
// texels differ only where a ray in single precision meets the border between two exactly.
TEST(PowerKept, AMosaicOfSixteenPatchesIsOneBakeTexelByTexel) {
  const TwoBakes bakes = both_ways(1);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < bakes.one.size(); ++i) {
    const double a = static_cast<double>(bakes.one.values()[i].vv),
                 b = static_cast<double>(bakes.mosaic.values()[i].vv);
    if (std::abs(a - b) > 1e-3 * std::max(a, b)) ++differing;
  }
  validation::expect_at_most({.group = power_kept_group,
                              .name = "4 × 4 patches against one, single bounces, part of texels that differ by 0.1 %",
                              .limit = 1e-4,
                              .measured = static_cast<double>(differing) / static_cast<double>(bakes.one.size()),
                              .unit = "1",
                              .source = "the launch lattice is the world's, not the patch's"});
}

TEST(PowerKept, AMosaicOfSixteenPatchesIsOneBakeAtItsSeams) {
  constexpr std::size_t side = 64;
  const TwoBakes bakes = both_ways(8);
  // Squares half on this and half on that side of a seam.
  const auto sum_of = [](const Array2D<radar::Channels>& texels, std::size_t column, std::size_t row) {
    Sums sums{};
    for (std::size_t y = row; y < row + side; ++y) {
      for (std::size_t x = column; x < column + side; ++x) {
        const Sums part = as_sums(texels(x, y));
        for (std::size_t c = 0; c < part.size(); ++c) sums[c] += part[c];
      }
    }
    return sums;
  };
  Sums worst{};
  for (std::size_t seam = 256; seam < 1024; seam += 256) {
    for (std::size_t along = 0; along < 1024; along += side) {
      for (const bool upright : {false, true}) {
        const std::size_t across = seam - side / 2;
        const std::size_t column = upright ? across : along, row = upright ? along : across;
        const Sums a = sum_of(bakes.one, column, row), b = sum_of(bakes.mosaic, column, row);
        for (std::size_t c = 0; c < 3; ++c) {
          const double error_db = db_from_linear(b[c] / a[c]);
          keep_worst(worst[c], error_db);
        }
      }
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    validation::expect_close(
        {.group = power_kept_group,
         .name = fmt::format("4 × 4 patches against one, squares of {} m astride the seams, worst, {}", side,
                             channel_names[c]),
         .expected = 0.0,
         .measured = worst[c],
         .tolerance = 0.1,
         .unit = "dB",
         .source = "the launch lattice is the world's, not the patch's"});
  }
  expect_relative("4 × 4 patches against one, all power, VV", power_of(bakes.one, 1.0)[0],
                  power_of(bakes.mosaic, 1.0)[0], 1e-3, "rounding to eleven bits");
}

}  // namespace
}  // namespace sigmascape::physics_test
