#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "live_ground_example.h"

#include "sigmascape/live/coarse_look.h"
#include "sigmascape/live/extent_cells.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

constexpr double gamma_of_all = 0.1;

/// A scene that fills a part of its only patch of three levels: texels of 1, 2 and 4 m, across whose edges the border
/// runs.
ExampleGround scene_within_a_patch(const radar::Rectangle& extent) {
  ExampleGround ground;
  ground.texel_m = 1.0;
  ground.patches_a_side = 1;
  ground.texels_a_patch = 1024;
  ground.azimuths = 1;
  ground.elevations_deg = ground.ground_elevations_deg = {10.0, 20.0};
  ground.terrain_spacing_m = 32.0;
  ground.extent = extent;
  ground.sigma0 = [](const radar::Look& look) { return constant_gamma(gamma_of_all, look); };
  return ground;
}

/// The same of an atlas that keeps the ground apart. Of what returns six tenths are the ground's, which patches have to
/// their edges, and the rest that of things on it, which end with the scene.
ExampleGround scene_apart_within_a_patch(const radar::Rectangle& extent) {
  ExampleGround ground = scene_within_a_patch(extent);
  ground.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(0.6 * gamma_of_all, look); };
  ground.sigma0 = [](const radar::Look& look) { return constant_gamma(0.4 * gamma_of_all, look); };
  ground.pattern = [extent, middle = ground.middle()](const radar::Look&, Vec2d from_middle) {
    return extent.contains(middle + from_middle) ? 1.0F : 0.0F;
  };
  return ground;
}

/// All of a scene in its bins, and ground about it; from the west-south-west.
struct WholeView {
  radar::Rectangle extent;
  double bin_m = 2.0;
  double azimuth_deg = 250.0, distance_m = 4000.0, height_m = 900.0;

  [[nodiscard]] Vec3d radar() const {
    const Vec2d away = radar::horizontal_direction(radians_from_deg(azimuth_deg)) * distance_m;
    return {extent.centre().x + away.x, extent.centre().y + away.y, height_m};
  }
  /// Of ground and bins alike: the diagonal of the scene and some bins.
  [[nodiscard]] double side_m() const { return std::hypot(extent.width_m(), extent.height_m()) + 24.0 * bin_m; }
  [[nodiscard]] LiveSettings settings(FrameContent content) const {
    LiveSettings settings;
    settings.content = content;
    settings.beams = settings.ranges = static_cast<std::size_t>(std::ceil(side_m() / bin_m));
    settings.beam_step_rad = bin_m / distance_m;
    settings.range_step_m = bin_m * distance_m / std::hypot(distance_m, height_m);
    settings.cells_per_bin = 1.8;
    settings.threads = 2;
    settings.refraction = 1e9;
    return settings;
  }
  [[nodiscard]] Pose pose() const {
    const LiveSettings bins = settings(FrameContent::Powers);
    Pose pose;
    pose.position = radar();
    pose.first_azimuth_rad =
        radians_from_deg(azimuth_deg) + pi - bins.beam_step_rad * static_cast<double>(bins.beams) / 2.0;
    pose.first_range_m = std::hypot(distance_m, height_m) - bins.range_step_m * static_cast<double>(bins.ranges) / 2.0;
    return pose;
  }

  /// What level ground of one γ within the extent returns: ∫ γ sin ψ dA, by squares of a metre or so.
  [[nodiscard]] double closed_form_m2() const {
    const auto steps_of = [](double side_m) { return static_cast<int>(std::ceil(side_m)); };
    const int across = steps_of(extent.width_m()), down = steps_of(extent.height_m());
    double sum = 0.0;
    for (int j = 0; j < down; ++j) {
      for (int i = 0; i < across; ++i) {
        const double x = extent.west_m + (i + 0.5) * extent.width_m() / across - radar().x;
        const double y = extent.south_m + (j + 0.5) * extent.height_m() / down - radar().y;
        sum += gamma_of_all * height_m / std::hypot(x, y, height_m);
      }
    }
    return sum * extent.width_m() * extent.height_m() / (across * down);
  }
};

double vv_of(const Frame& frame) {
  double sum = 0.0;
  for (std::size_t bin = 0; bin < frame.grid.azimuths * frame.grid.ranges; ++bin) {
    sum += frame.powers_m2.empty() ? static_cast<double>(std::norm(frame.amplitudes_m[bin * 4]))
                                   : static_cast<double>(frame.powers_m2[bin * 4]);
  }
  return sum;
}

constexpr radar::Rectangle amidst_texels{37.3, 101.7, 702.15, 641.4};
/// Texels of 1 m end where it does, those of 2 and 4 m do not.
constexpr radar::Rectangle amidst_coarse_texels{37.0, 101.0, 702.0, 642.0};

struct Kind {
  const char* name;
  ExampleGround ground;
  radar::Rectangle extent;
};

std::vector<Kind> both_kinds() {
  return {{"baked shadows", scene_within_a_patch(amidst_texels), amidst_texels},
          {"ground apart", scene_apart_within_a_patch(amidst_coarse_texels), amidst_coarse_texels}};
}

TEST(LiveExtent, FramesHoldThePowerOfTheSceneAtEveryLevel) {
  for (const Kind& kind : both_kinds()) {
    const ScratchFolder folder;
    const auto ground = kind.ground.over(kind.ground.store(folder.path("atlas")));
    for (const std::size_t level : {0U, 1U, 2U}) {
      const WholeView view{.extent = kind.extent, .bin_m = 2.0 * std::ldexp(1.0, static_cast<int>(level))};
      for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
        LiveRenderer renderer(ground, view.settings(content));
        const Frame& frame = settled_frame(renderer, *ground, view.pose());
        const std::string what = fmt::format("{}, level {}", kind.name, level);
        ASSERT_EQ(frame.report.level, level) << what;
        ASSERT_EQ(frame.report.coarse, 0U) << what;
        // Speckle leaves four times what as many bins as hold something have of it.
        const double bins = view.extent.width_m() * view.extent.height_m() / (view.bin_m * view.bin_m);
        const double tolerance_db =
            content == FrameContent::Powers ? 0.02 : db_from_linear(1.0 + 4.0 / std::sqrt(bins));
        EXPECT_NEAR(db_from_linear(vv_of(frame) / view.closed_form_m2()), 0.0, tolerance_db) << what;
      }
    }
  }
}

TEST(LiveExtent, WhatStandsAlongTheBorderKeepsItsPowerWhereTexelsGoBeyondIt) {
  const radar::Rectangle extent = amidst_coarse_texels, inner = radar::widened(extent, -2.0);
  ExampleGround example = scene_apart_within_a_patch(extent);
  example.bare_sigma0 = [](const radar::Look&) { return radar::Channels{}; };
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(gamma_of_all, look); };
  example.pattern = [extent, inner, middle = example.middle()](const radar::Look&, Vec2d from_middle) {
    const Vec2d place = middle + from_middle;
    return extent.contains(place) && !inner.contains(place) ? 1.0F : 0.0F;
  };
  const ScratchFolder folder;
  const auto ground = example.over(example.store(folder.path("atlas")));
  const WholeView view{.extent = extent, .bin_m = 8.0};
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  ASSERT_EQ(frame.report.level, 2U);
  const WholeView without_border{.extent = inner};
  EXPECT_NEAR(db_from_linear(vv_of(frame) / (view.closed_form_m2() - without_border.closed_form_m2())), 0.0, 0.05);
}

TEST(LiveExtent, WhatStandsInHoldsThatPowerToo) {
  for (Kind& kind : both_kinds()) {
    const ScratchFolder folder;
    kind.ground.cache.budget_bytes = std::size_t{12} << 20U;
    const auto ground = kind.ground.over(kind.ground.store(folder.path("atlas")));
    ASSERT_GE(ground->stand_in().levels_above(), 1U) << kind.name;
    const WholeView view{.extent = kind.extent};
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = renderer.render(view.pose());
    ASSERT_EQ(frame.report.coarse + frame.report.dark, frame.report.cells) << "nothing else is there yet";
    EXPECT_NEAR(db_from_linear(vv_of(frame) / view.closed_form_m2()), 0.0, 0.05) << kind.name;
  }
}

TEST(LiveExtent, TexelsThatStandInAreMeansOfWhatTheyHaveOfIt) {
  // Whole texels of 4 m, which is the coarsest level; those that stand in have 64 m.
  const radar::Rectangle extent{36.0, 100.0, 700.0, 640.0};
  ExampleGround example = scene_within_a_patch(extent);
  example.pattern = [extent, middle = example.middle()](const radar::Look&, Vec2d from_middle) {
    return extent.contains(middle + from_middle) ? 1.0F : 5.0F;
  };
  const ScratchFolder folder;
  const atlas::Store store = example.store(folder.path("atlas"));
  const atlas::TileReader tiles(store);
  constexpr std::size_t side = 16;
  const CoarseLook look = coarse_look(tiles, {2, 0, 0}, 0, side);
  const double sigma0 = static_cast<double>(example.sigma0(store.description().aspects.look(0)).vv);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      const double west_m = 64.0 * static_cast<double>(column), north_m = 1024.0 - 64.0 * static_cast<double>(row);
      const radar::Rectangle within = radar::common_part({west_m, north_m - 64.0, west_m + 64.0, north_m}, extent);
      const bool has_some = within.width_m() > 0.0 && within.height_m() > 0.0;
      const double mean =
          static_cast<double>(atlas::float_from_finite_half(look.halves[(row * side + column) * 4])) * look.scale;
      EXPECT_NEAR(mean, has_some ? sigma0 : 0.0, 2e-3 * sigma0) << row << ", " << column;
    }
  }
}

TEST(LiveExtent, NothingComesBackFromBeyond) {
  for (const Kind& kind : both_kinds()) {
    const ScratchFolder folder;
    const auto ground = kind.ground.over(kind.ground.store(folder.path("atlas")));
    // Due west of it, so that a range is a line across the scene.
    const WholeView view{.extent = kind.extent, .azimuth_deg = 270.0};
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = settled_frame(renderer, *ground, view.pose());
    const auto range_of = [&](double x) { return std::hypot(x - view.radar().x, view.height_m); };
    const double spare_m = 2.0 * (frame.grid.range_step_m + kind.ground.texel_m);
    const double first_m = range_of(kind.extent.west_m) - spare_m;
    const double last_m =
        std::hypot(kind.extent.east_m - view.radar().x, kind.extent.height_m() / 2.0, view.height_m) + spare_m;
    std::size_t beyond = 0, within = 0;
    for (std::size_t range = 0; range < frame.grid.ranges; ++range) {
      const double middle_m = frame.grid.first_range_m + (static_cast<double>(range) + 0.5) * frame.grid.range_step_m;
      const bool is_beyond = middle_m < first_m || middle_m > last_m;
      ++(is_beyond ? beyond : within);
      if (!is_beyond) continue;
      EXPECT_EQ(vv_of_range(frame, range, 0), 0.0) << kind.name << ", " << middle_m << " m";
    }
    EXPECT_GT(beyond, 20U);
    EXPECT_GT(within, 200U);
  }
}

TEST(LiveExtent, CellsBeyondItAreCountedAsDark) {
  const ScratchFolder folder;
  const ExampleGround example = scene_within_a_patch(amidst_texels);
  const auto ground = example.over(example.store(folder.path("atlas")));
  const WholeView view{.extent = amidst_texels};
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const FrameReport& report = settled_frame(renderer, *ground, view.pose()).report;
  const double extent_cells = amidst_texels.width_m() * amidst_texels.height_m();
  // Sectors side by side have a rim in common.
  EXPECT_NEAR(static_cast<double>(report.cells - report.dark), extent_cells, 0.05 * extent_cells);
  EXPECT_NEAR(static_cast<double>(report.cells), view.side_m() * view.side_m(), 0.05 * view.side_m() * view.side_m());
}

TEST(ExtentCells, HaveTogetherTheAreaOfTheExtent) {
  for (const double cell_m : {0.3, 1.0, 4.0, 700.0, 5000.0}) {
    const ExtentCells cells({-120.3, -7.1, 512.0, 1033.7}, cell_m);
    double across = 0.0, down = 0.0;
    for (double column = cells.columns.first(); column < cells.columns.end(); ++column) {
      EXPECT_GT(cells.columns.part_of(column), 0.0);
      across += cells.columns.part_of(column) * cell_m;
    }
    for (double row = cells.rows.first(); row < cells.rows.end(); ++row) down += cells.rows.part_of(row) * cell_m;
    EXPECT_NEAR(across, 632.3, 1e-9) << cell_m;
    EXPECT_NEAR(down, 1040.8, 1e-9) << cell_m;
    EXPECT_EQ(cells.columns.part_of(cells.columns.first() - 1.0), 0.0);
    EXPECT_EQ(cells.columns.part_of(cells.columns.end()), 0.0);
    EXPECT_EQ(cells.cells_of_row(cells.rows.first(), cells.columns.first() - 5.0, cells.columns.end() + 5.0),
              cells.columns.end() - cells.columns.first());
    EXPECT_EQ(cells.cells_of_row(cells.rows.end(), cells.columns.first(), cells.columns.end()), 0.0);
  }
}

}  // namespace
}  // namespace sigmascape::live
