#include "sigmascape/bake/look_baker.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::bake {
namespace {

constexpr double level_side_m = 64.0;

/// Level ground with two blocks side by side: edges, layover, shadow and paths of several bounces.
/// Its south-western corner is at (corner_m, corner_m).
scene::Scene scene_with_block(double corner_m = 0.0) {
  scene::Scene scene;
  scene.name = "block";
  scene.extent = {corner_m, corner_m, corner_m + level_side_m, corner_m + level_side_m};
  scene.terrain = {corner_m, corner_m + level_side_m, level_side_m, Array2D<float>(2, 2, 0.0F)};
  const scatter::Material ground{.name = "ground", .model = scatter::LambertParameters{0.3, {0.1, 0.5}}, .source = {}};
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.7, {0.1, 0.5}}, .source = {}};
  scene.ground = {{corner_m, corner_m + level_side_m, level_side_m, 1, 1},
                  Array2D<scene::MaterialIndex>(1, 1, scene.material_index(ground))};
  for (const float x : {20.0F, 42.0F}) {
    scene.prototypes.push_back(scene::box_mesh({8, 20, 9}, scene.material_index(wall)));
    scene.instances.push_back({.prototype = static_cast<std::uint32_t>(scene.prototypes.size() - 1),
                               .x_m = static_cast<float>(corner_m) + x,
                               .y_m = static_cast<float>(corner_m) + 32.0F,
                               .yaw_rad = 0.3F});
  }
  return scene;
}

/// Dark ground with one small bright post to each 8 m square, which few rays find.
scene::Scene scene_with_posts() {
  scene::Scene scene = scene_with_block();
  scene.instances.clear();
  scene.prototypes.clear();
  scene.materials[scene.ground.material(0, 0)].model = scatter::LambertParameters{0.01, {0.1, 0.5}};
  const scatter::Material post{.name = "post", .model = scatter::LambertParameters{0.9, {0.1, 0.5}}, .source = {}};
  scene.prototypes.push_back(scene::box_mesh({0.8F, 0.8F, 1.0F}, scene.material_index(post)));
  for (float y = 4.0F; y < 64.0F; y += 8.0F) {
    for (float x = 4.0F; x < 64.0F; x += 8.0F) scene.instances.push_back({.x_m = x, .y_m = y});
  }
  return scene;
}

BakeSettings settings_with(const Sampling& sampling) {
  BakeSettings settings;
  settings.aspects = {{radians_from_deg(60.0)}, {radians_from_deg(30.0)}, {10e9}};
  settings.patches = {2.0, 256};
  settings.sampling = sampling;
  settings.shadows = Shadows::Baked;
  return settings;
}

/// From the first of its aspects.
BakedLook baked_patch(const LookBaker& baker, const BakeSettings& settings, const atlas::PatchIndex& patch) {
  SilentProgress silent;
  return baker.bake(patch, settings.aspects.look(0).aspect, silent).front();
}

BakedLook baked_look(const scene::Scene& scene, BakeSettings settings, std::uint64_t seed) {
  settings.seed = seed;
  return baked_patch(LookBaker(scene, settings), settings, {0, 0});
}

double power(const BakedLook& look, std::size_t texel) {
  return static_cast<double>(look.sigma0.values()[texel].power(radar::Polarization::Sum));
}

/// Of the texel under a point.
double power_at(const BakedLook& look, const radar::GroundGrid& texels, Vec2d point) {
  const Vec2d cell = texels.cells_from(point);
  return power(look, static_cast<std::size_t>(cell.y) * texels.columns + static_cast<std::size_t>(cell.x));
}

double squared_error(const BakedLook& look, std::size_t texel) {
  return std::pow(static_cast<double>(look.relative_errors.values()[texel]) * power(look, texel), 2.0);
}

/// Bakes with independent scrambles against what each said of its own error.
struct Honesty {
  double predicted_over_actual = 0.0;  ///< root mean square of the predicted over that of the actual relative errors
  double covered = 0.0;  ///< part of the 95 % intervals that hold the truth, of texels that most of their samples light
  std::size_t texels = 0;
};

/// One texel's total power over a number of bakes.
struct Scatter {
  double mean = 0.0, variance = 0.0;
  double predicted = 0.0;  ///< the variance that the bakes give themselves, mean over them

  Scatter(const std::vector<BakedLook>& looks, std::size_t texel) {
    const auto count = static_cast<double>(looks.size());
    double squares = 0.0;
    for (const BakedLook& look : looks) {
      mean += power(look, texel) / count;
      squares += power(look, texel) * power(look, texel);
      predicted += squared_error(look, texel) / count;
    }
    variance = (squares - count * mean * mean) / (count - 1.0);
  }
};

class HonestyTally {
 public:
  /// `samples_of(texel, its scatter)`: how many samples a bake has of it.
  template <typename SamplesOf>
  HonestyTally(const std::vector<BakedLook>& looks, const SamplesOf& samples_of) : looks_(looks) {
    for (std::size_t texel = 0; texel < looks.front().sigma0.size(); ++texel) {
      const Scatter scatter(looks, texel);
      add(texel, scatter, samples_of(texel, scatter));
    }
  }

  [[nodiscard]] Honesty result() const {
    return {std::sqrt(predicted_ / actual_), static_cast<double>(covered_) / static_cast<double>(intervals_), texels_};
  }

 private:
  void add(std::size_t texel, const Scatter& scatter, double samples) {
    const auto count = static_cast<double>(looks_.size());
    const auto [mean, variance, predicted] = scatter;
    // Texels that vary at all, and not so seldom that a few bakes cannot tell how much.
    if (!(variance > 1e-6 * mean * mean) || predicted > mean * mean) return;
    predicted_ += predicted / (mean * mean);
    actual_ += variance / (mean * mean);
    ++texels_;
    // Where the scatter of single samples is about as large as their mean, most of them contribute: of so many samples
    // a hundred and more.
    const double of_one_sample = std::sqrt(variance * samples) / mean;
    if (samples < enough_samples || of_one_sample < 0.5 || of_one_sample > 1.5) return;
    for (const BakedLook& look : looks_) {
      // The mean of the others stands for the truth; its own error widens the interval.
      const double others = (mean * count - power(look, texel)) / (count - 1.0);
      const double error = std::sqrt(squared_error(look, texel) * count / (count - 1.0));
      covered_ += std::abs(power(look, texel) - others) <= interval * error ? 1U : 0U;
      ++intervals_;
    }
  }

  static constexpr double enough_samples = 200.0;
  /// Student's t for 95 % and the 128 degrees of freedom that so many pairs have.
  static constexpr double interval = 1.979;

  const std::vector<BakedLook>& looks_;
  double predicted_ = 0.0, actual_ = 0.0;
  std::size_t covered_ = 0, intervals_ = 0, texels_ = 0;
};

std::vector<BakedLook> bakes_of_the_block(const Sampling& sampling, int repetitions, Noise noise = Noise::Own) {
  const scene::Scene scene = scene_with_block();
  BakeSettings settings = settings_with(sampling);
  settings.noise = noise;
  std::vector<BakedLook> looks;
  for (int i = 0; i < repetitions; ++i) looks.push_back(baked_look(scene, settings, 1000U + unsigned(i)));
  return looks;
}

void expect_stated_error(const char* name, const Honesty& honesty) {
  validation::expect_close({.group = "Error of a bake",
                            .name = name,
                            .expected = 1.0,
                            .measured = honesty.predicted_over_actual,
                            .tolerance = 0.1,
                            .unit = "1",
                            .source = "estimator.md, Eq. (14)"});
}

void expect_coverage(const char* name, const Honesty& honesty) {
  validation::expect_close({.group = "Error of a bake",
                            .name = name,
                            .expected = 0.95,
                            .measured = honesty.covered,
                            // Sums of few hundred samples are skewed, which costs a hundredth.
                            .tolerance = 0.02,
                            .unit = "1",
                            .source = "estimator.md, Eq. (14)"});
}

TEST(LookBaker, ErrorsAreHonestWithAFixedNumberOfSamples) {
  const std::vector<BakedLook> looks = bakes_of_the_block({.samples_per_texel = 256}, 32);
  const Honesty honesty = HonestyTally(looks, [](std::size_t, const Scatter&) { return 256.0; }).result();
  expect_stated_error("standard error of a texel, predicted over actual, fixed sampling", honesty);
  expect_coverage("part of the 95 % intervals that hold the truth", honesty);
}

// Edges that first surfaces have in a cell are met more evenly than pairs can tell: what is stated of them is too much,
// never too little.
TEST(LookBaker, ErrorsOfFirstSurfacesAreStatedWithRoomToSpare) {
  const scene::Scene scene = scene_with_block();
  for (const std::uint32_t samples : {16U, 100U}) {
    BakeSettings settings = settings_with({.samples_per_texel = samples});
    settings.max_bounces = 1;
    std::vector<BakedLook> looks;
    for (unsigned i = 0; i < 16; ++i) looks.push_back(baked_look(scene, settings, 1000U + i));
    const double stated =
        HonestyTally(looks, [](std::size_t, const Scatter&) { return 0.0; }).result().predicted_over_actual;
    EXPECT_GT(stated, 1.0) << samples;
    EXPECT_LT(stated, 2.0) << samples;
  }
}

// Cells differ in their samples. How many a texel's power rests on is told by bakes whose number is known: variances
// are as one over it.
TEST(LookBaker, IntervalsAreHonestWithAnAdaptiveNumberOfSamples) {
  const std::vector<BakedLook> fixed = bakes_of_the_block({.samples_per_texel = 256}, 12);
  const std::vector<BakedLook> adaptive = bakes_of_the_block({.target_db = 0.02, .most_samples = 256}, 64);
  const auto samples_of = [&fixed](std::size_t texel, const Scatter& scatter) {
    return 256.0 * Scatter(fixed, texel).predicted / scatter.predicted;
  };
  const Honesty honesty = HonestyTally(adaptive, samples_of).result();
  expect_coverage("part of the 95 % intervals that hold the truth, adaptive sampling", honesty);
}

TEST(LookBaker, ErrorsAreHonestWithAnAdaptiveNumberOfSamples) {
  const std::vector<BakedLook> looks = bakes_of_the_block({.target_db = 0.2, .most_samples = 512}, 12);
  const Honesty honesty = HonestyTally(looks, [](std::size_t, const Scatter&) { return 0.0; }).result();
  expect_stated_error("standard error of a texel, predicted over actual, adaptive sampling", honesty);
}

double total(const BakedLook& look) {
  double sum = 0.0;
  for (std::size_t texel = 0; texel < look.sigma0.size(); ++texel) sum += power(look, texel);
  return sum;
}

/// What is stated of the squared error of all texels over what it is.
double stated_over_actual(const BakedLook& look, const BakedLook& truth) {
  double stated = 0.0, actual = 0.0;
  for (std::size_t texel = 0; texel < look.sigma0.size(); ++texel) {
    stated += squared_error(look, texel);
    actual += std::pow(power(look, texel) - power(truth, texel), 2.0);
  }
  return stated / actual;
}

double l1(const BakedLook& look, const BakedLook& truth) {
  double sum = 0.0;
  for (std::size_t texel = 0; texel < look.sigma0.size(); ++texel)
    sum += std::abs(power(look, texel) - power(truth, texel));
  return sum / total(truth);
}

TEST(LookBaker, SharedNoiseKeepsThePowerAndComesCloserToTheTruth) {
  const BakedLook truth = bakes_of_the_block({.samples_per_texel = 4096}, 1).front();
  const auto own = bakes_of_the_block({.samples_per_texel = 8}, 8);
  const auto shared = bakes_of_the_block({.samples_per_texel = 8}, 8, Noise::Shared);
  double l1_own = 0.0, l1_shared = 0.0, stated_own = 0.0, stated_shared = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_NEAR(total(shared[i]) / total(own[i]), 1.0, 1e-6);
    l1_own += l1(own[i], truth);
    l1_shared += l1(shared[i], truth);
    stated_own += stated_over_actual(own[i], truth);
    stated_shared += stated_over_actual(shared[i], truth);
  }
  EXPECT_LT(l1_shared, 0.9 * l1_own);
  validation::expect_close({.group = "Error of a bake",
                            .name = "standard error stated over that from the truth, of texels that share their noise "
                                    "over those that do not",
                            .expected = 1.0,
                            .measured = std::sqrt(stated_shared / stated_own),
                            .tolerance = 0.1,
                            .unit = "1",
                            .source = "estimator.md, Eq. (17)"});
}

TEST(LookBaker, FirstSurfacesDoNotShare) {
  BakeSettings settings = settings_with({.samples_per_texel = 8});
  settings.max_bounces = 1;
  const scene::Scene scene = scene_with_block();
  const BakedLook own = baked_look(scene, settings, 1);
  settings.noise = Noise::Shared;
  const BakedLook shared = baked_look(scene, settings, 1);
  EXPECT_TRUE(std::ranges::equal(shared.sigma0.values(), own.sigma0.values()));
  EXPECT_TRUE(std::ranges::equal(shared.relative_errors.values(), own.relative_errors.values()));
}

/// Mean over bakes of what a whole patch returns, and the standard error of that.
std::pair<double, double> total_of(const Sampling& sampling, int repetitions) {
  const scene::Scene scene = scene_with_posts();
  BakeSettings settings = settings_with(sampling);
  settings.patches.texel_m = 8.0;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < repetitions; ++i) {
    const BakedLook look = baked_look(scene, settings, 50U + unsigned(i));
    sum += total(look);
    squares += total(look) * total(look);
  }
  const double mean = sum / repetitions;
  return {mean, std::sqrt((squares / repetitions - mean * mean) / (repetitions - 1))};
}

// Cells that their pilots call quiet must not be darker for it: so a cell's own pilots have no say.
TEST(LookBaker, AdaptiveSamplingHasTheMeanOfFixedSampling) {
  const auto [fixed, fixed_error] = total_of({.samples_per_texel = 1024}, 8);
  const auto [adaptive, adaptive_error] = total_of({.target_db = 1.0, .most_samples = 256}, 64);
  EXPECT_NEAR(adaptive, fixed, 3.0 * std::hypot(fixed_error, adaptive_error));
  EXPECT_LT(adaptive_error, 0.01 * fixed) << "too rough to tell";
}

TEST(LookBaker, AdaptiveSamplingSparesOpenGround) {
  const BakedLook look = baked_look(scene_with_block(), settings_with({.target_db = 0.4}), 1);
  EXPECT_GT(look.samples_per_texel, pilot_samples);
  EXPECT_LT(look.samples_per_texel, 4.0 * pilot_samples);
}

// A cell has the same number of samples, and the same rays, whichever patch asks.
TEST(LookBaker, PatchesOfAMosaicAgreeWithOnePatchOverAll) {
  const scene::Scene scene = scene_with_block(96.0);
  BakeSettings settings = settings_with({.target_db = 0.5});
  settings.max_bounces = 1;
  settings.patches = {0.5, 512};
  const LookBaker whole(scene, settings);
  BakeSettings quarters = settings;
  quarters.patches.texels_per_side = 256;
  const LookBaker part(scene, quarters);
  SilentProgress silent;
  const auto aspect = settings.aspects.look(0).aspect;
  const BakedLook all = whole.bake({0, 0}, aspect, silent).front();
  for (const atlas::PatchIndex patch : {atlas::PatchIndex{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    const BakedLook quarter = part.bake(patch, aspect, silent).front();
    const std::size_t left = patch.x == 0 ? 0 : 256, top = patch.y == 0 ? 256 : 0;
    std::size_t differing = 0;
    for (std::size_t row = 0; row < 256; ++row) {
      for (std::size_t column = 0; column < 256; ++column) {
        differing += quarter.sigma0(column, row) == all.sigma0(left + column, top + row) ? 0U : 1U;
      }
    }
    EXPECT_EQ(differing, 0U) << "patch " << patch.x << " " << patch.y;
  }
}

/// Level ground that reaches 4096 m north of a tower 326 m high, whose foot is 40 m wide.
scene::Scene scene_with_high_tower() {
  scene::Scene scene = scene_with_block();
  scene.extent = {-256.0, -512.0, 256.0, 4096.0};
  scene.terrain = {-1024.0, 5120.0, 6144.0, Array2D<float>(2, 2, 0.0F)};
  scene.ground.grid = {.west_m = -1024.0, .north_m = 5120.0, .cell_m = 6144.0, .columns = 1, .rows = 1};
  const scatter::Material concrete{
      .name = "concrete", .model = scatter::LambertParameters{0.7, {0.1, 0.5}}, .source = {}};
  const scene::MaterialIndex wall = scene.material_index(concrete);
  scene.prototypes = {scene::box_mesh({40, 40, 326}, wall)};
  scene.instances = {{.x_m = 0.0F, .y_m = -20.0F}};
  return scene;
}

// h / tan 5° = 3726 m: seven patches away, and nothing else stands there.
TEST(LookBaker, ATowerSeveralPatchesAwayShadesThisOne) {
  const scene::Scene scene = scene_with_high_tower();
  BakeSettings settings = settings_with({.samples_per_texel = 4});
  settings.aspects = {{radians_from_deg(180.0)}, {radians_from_deg(5.0)}, {10e9}};
  const LookBaker baker(scene, settings);
  const atlas::PatchIndex patch = settings.patches.patch_at({1.0, 3700.0});
  const BakedLook look = baked_patch(baker, settings, patch);
  const radar::GroundGrid texels = settings.patches.texels_of(patch);
  const double open = power_at(look, texels, {101.0, 3651.0}), shadow_m = 326.0 / std::tan(radians_from_deg(5.0));
  EXPECT_GT(open, 0.0);
  for (double y = 3587.0; y < shadow_m - 3.0; y += 8.0) EXPECT_EQ(power_at(look, texels, {1.0, y}), 0.0) << y;
  for (double y = shadow_m + 3.0; y < 4090.0; y += 8.0)
    EXPECT_NEAR(power_at(look, texels, {1.0, y}), open, 1e-3 * open) << y;
}

// Far from the patch a cell gets two rays where its share of them would be less than one.
TEST(LookBaker, StatesRaysAsOfCellsWithAWholeShare) {
  const scene::Scene scene = scene_with_high_tower();
  BakeSettings settings = settings_with({.samples_per_texel = 2});
  settings.patches = {8.0, 64};
  settings.aspects = {{radians_from_deg(180.0)}, {radians_from_deg(5.0)}, {10e9}};
  const LookBaker baker(scene, settings);
  const atlas::PatchIndex patch = settings.patches.patch_at({1.0, 2000.0});
  const BakedLook look = baked_patch(baker, settings, patch);
  const trace::LaunchArea area = baker.area_of(settings.patches.texels_of(patch), settings.aspects.look(0).aspect);
  EXPECT_GT(static_cast<double>(look.counts.paths), 2.1 * area.whole_cells());
  EXPECT_EQ(look.samples_per_texel, 2.0);
}

/// A strip of level ground, 20 km long, with a box every 40 m.
scene::Scene long_street() {
  scene::Scene scene = scene_with_block();
  scene.extent = {-256.0, -512.0, 256.0, 19'968.0};
  scene.terrain = {-1024.0, 20'992.0, 22'016.0, Array2D<float>(2, 2, 0.0F)};
  scene.ground.grid = {.west_m = -1024.0, .north_m = 20'992.0, .cell_m = 22'016.0, .columns = 1, .rows = 1};
  scene.prototypes = {scene::box_mesh({8, 8, 6}, 0)};
  scene.instances.clear();
  for (float y = -500.0F; y < 19'960.0F; y += 40.0F) scene.instances.push_back({.y_m = y});
  return scene;
}

TEST(LookBaker, RaysNeedOnlyWhatStandsAboutAPatch) {
  const scene::Scene scene = long_street();
  const BakeSettings settings = settings_with({.samples_per_texel = 4});
  const LookBaker baker(scene, settings);
  const auto bytes_about = [&](double y) {
    return baker.geometry_about(settings.patches.texels_of(settings.patches.patch_at({1.0, y}))).memory_bytes();
  };
  const std::size_t whole = trace::SceneGeometry(scene, trace::Footing::LevelPlane).memory_bytes();
  const std::size_t in_the_middle = bytes_about(9'000.0);
  EXPECT_LT(in_the_middle, whole / 2);
  EXPECT_NEAR(static_cast<double>(bytes_about(14'000.0)), static_cast<double>(in_the_middle),
              0.1 * static_cast<double>(in_the_middle));
  EXPECT_GE(baker.geometry_bytes(), in_the_middle);
  EXPECT_LT(baker.geometry_bytes(), whole / 2);
}

// Its top lies over to h · tan 5° = 28.5 m before its foot, here into the patch before it.
TEST(LookBaker, ATowerOfTheNextPatchLiesOverIntoThisOne) {
  scene::Scene scene = scene_with_high_tower();
  scene.instances.front().y_m = 21.0F;
  BakeSettings settings = settings_with({.samples_per_texel = 16});
  settings.aspects = {{radians_from_deg(180.0)}, {radians_from_deg(5.0)}, {10e9}};
  settings.max_bounces = 1;
  const LookBaker baker(scene, settings);
  const atlas::PatchIndex patch = settings.patches.patch_at({1.0, -1.0});
  const BakedLook look = baked_patch(baker, settings, patch);
  const radar::GroundGrid texels = settings.patches.texels_of(patch);
  const auto column_power = [&](double y) { return power_at(look, texels, {1.0, y}); };
  const double top_m = 1.0 - 326.0 * std::tan(radians_from_deg(5.0)), open = column_power(-101.0);
  for (double y = -1.0; y > top_m + 2.0; y -= 2.0) EXPECT_GT(column_power(y), 3.0 * open) << y;
  for (double y = top_m - 3.0; y > -100.0; y -= 2.0) EXPECT_NEAR(column_power(y), open, 1e-3 * open) << y;
}

// From 80° a top lies over by h · tan 80° = 1849 m: its roof, as large as its foot, lands three patches before it.
TEST(LookBaker, ATowerSeveralPatchesAwayLiesOverIntoThisOne) {
  scene::Scene scene = scene_with_high_tower();
  scene.instances.front().y_m = 2600.0F;
  BakeSettings settings = settings_with({.samples_per_texel = 16});
  settings.aspects = {{radians_from_deg(180.0)}, {radians_from_deg(80.0)}, {10e9}};
  settings.max_bounces = 1;
  const LookBaker baker(scene, settings);
  const double roof_m = 2600.0 - 326.0 * std::tan(radians_from_deg(80.0));
  const atlas::PatchIndex patch = settings.patches.patch_at({1.0, roof_m});
  const BakedLook look = baked_patch(baker, settings, patch);
  const radar::GroundGrid texels = settings.patches.texels_of(patch);
  const auto column_power = [&](double y) { return power_at(look, texels, {1.0, y}); };
  const double open = column_power(roof_m - 40.0);
  EXPECT_GT(open, 0.0);
  for (double y = roof_m - 17.0; y < roof_m + 18.0; y += 2.0) EXPECT_GT(column_power(y), 2.0 * open) << y;
}

// Of single bounces, whose weights do not ask where else rays are aimed.
TEST(LookBaker, PartsOfALaunchAreaAddUpToTheWhole) {
  const scene::Scene scene = scene_with_block();
  BakeSettings settings = settings_with({.samples_per_texel = 8});
  settings.max_bounces = 1;
  const LookBaker baker(scene, settings);
  const auto aspect = settings.aspects.look(0).aspect;
  const auto texels = settings.patches.texels_of({0, 0});
  const auto whole = baker.area_of(texels, aspect);
  trace::LaunchArea first = whole, second = whole;
  const auto middle = static_cast<std::ptrdiff_t>(whole.tiles() / 2 * trace::cells_per_tile);
  first.cells.erase(first.cells.begin() + middle, first.cells.end());
  second.cells.erase(second.cells.begin(), second.cells.begin() + middle);
  SilentProgress silent;
  const BakedLook all = baker.bake(texels, whole, aspect, silent).front();
  const BakedLook one = baker.bake(texels, first, aspect, silent).front();
  const BakedLook other = baker.bake(texels, second, aspect, silent).front();
  EXPECT_EQ(one.counts.paths + other.counts.paths, all.counts.paths);
  double ones = 0.0, others = 0.0;
  for (std::size_t texel = 0; texel < all.sigma0.size(); ++texel) {
    ASSERT_NEAR(power(one, texel) + power(other, texel), power(all, texel), 1e-6 * power(all, texel));
    ones += power(one, texel);
    others += power(other, texel);
  }
  EXPECT_GT(ones, 0.0);
  EXPECT_GT(others, 0.0);
}

}  // namespace
}  // namespace sigmascape::bake
