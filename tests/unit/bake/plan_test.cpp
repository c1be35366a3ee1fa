#include "sigmascape/bake/plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

#include "scratch_folder.h"

#include "sigmascape/bake/bake.h"
#include "sigmascape/bake/job.h"
#include "sigmascape/bake/look_baker.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::bake {
namespace {

/// Level ground from the origin to the north-east, with a tower near the middle.
scene::Scene scene_with_tower(double side_m) {
  scene::Scene scene;
  scene.name = "tower";
  scene.extent = {0, 0, side_m, side_m};
  scene.terrain = {0, side_m, side_m, Array2D<float>(2, 2, 0.0F)};
  const scatter::Material stone{.name = "stone", .model = scatter::LambertParameters{0.3, {0.1, 0.5}}, .source = {}};
  scene.ground = {{0, side_m, side_m, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, scene.material_index(stone))};
  scene.prototypes.push_back(scene::box_mesh({20, 20, 60}, scene.material_index(stone)));
  const auto middle_m = static_cast<float>(0.45 * side_m);
  scene.instances.push_back({.x_m = middle_m, .y_m = middle_m});
  return scene;
}

/// So many azimuths, and patches of 512 m.
BakeSettings settings_with_azimuths(unsigned azimuths) {
  BakeSettings settings;
  settings.aspects = {{}, {radians_from_deg(15.0), radians_from_deg(40.0)}, {10e9}};
  for (unsigned i = 0; i < azimuths; ++i)
    settings.aspects.azimuths_rad.push_back(radians_from_deg(360.0 * i / azimuths));
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 2;
  settings.max_bounces = 2;
  settings.threads = 2;
  return settings;
}

/// Of all jobs, one by one.
double all_cells(const scene::Scene& scene, const BakeSettings& settings) {
  const LookBaker baker(scene, settings);
  const JobList jobs(description_of(scene, settings));
  double cells = 0.0;
  for (std::size_t number = 0; number < jobs.size(); ++number) {
    const Job job = jobs[number];
    cells += baker.area_of(settings.patches.texels_of(job.patch), job.aspect).whole_cells();
  }
  return cells;
}

BakePlan planned(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder,
                 const Shard& shard = {}) {
  SilentProgress silent;
  return plan(scene, settings, folder, silent, shard);
}

TEST(BakePlan, CountsTheCellsOfEachOfAFewJobs) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_tower(1000.0);
  const BakeSettings settings = settings_with_azimuths(3);
  const BakePlan whole = planned(scene, settings, folder.path("none"));
  EXPECT_EQ(whole.jobs, 4U * 3U * 2U);
  EXPECT_EQ(whole.jobs_counted, whole.jobs);
  const double cells = all_cells(scene, settings);
  EXPECT_NEAR(whole.cells, cells, 1e-9 * cells);

  double of_shares = 0.0;
  for (std::size_t index = 0; index < 5; ++index) {
    const BakePlan share = planned(scene, settings, folder.path("none"), {.index = index, .count = 5});
    EXPECT_GE(share.patches_of_share, 3U) << "of all four some";
    EXPECT_FALSE(share.has_whole_patches);
    of_shares += share.cells;
  }
  EXPECT_NEAR(of_shares, cells, 1e-9 * cells);
  EXPECT_FALSE(std::filesystem::exists(folder.path("none")));
}

// Else the plan of a large scene, which is to tell how long a bake takes, would itself take hours.
TEST(BakePlan, OfManyJobsSomeStandForTheOthers) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_tower(2300.0);
  const BakeSettings settings = settings_with_azimuths(8);
  const BakePlan many = planned(scene, settings, folder.path("none"));
  EXPECT_EQ(many.jobs, 25U * 8U * 2U);
  EXPECT_EQ(many.looks, many.jobs);
  EXPECT_EQ(many.patches_of_share, 25U);
  EXPECT_TRUE(many.has_whole_patches);
  EXPECT_EQ(many.jobs_counted, 2U * 64U);
  const double cells = all_cells(scene, settings);
  EXPECT_NEAR(many.cells, cells, 0.05 * cells);
}

TEST(BakePlan, OfWhatIsThereNothingIsLeft) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_tower(100.0);
  const BakeSettings settings = settings_with_azimuths(2);
  SilentProgress silent;
  bake(scene, settings, folder.path("a"), silent,
       {.shard = {.index = 0, .count = 2}, .scrutiny = atlas::Scrutiny::Size});
  const BakePlan half = planned(scene, settings, folder.path("a"));
  EXPECT_EQ(half.looks, 4U);
  EXPECT_EQ(half.already, 2U);
  EXPECT_EQ(half.jobs_counted, 2U);
  EXPECT_GT(half.seconds, 0.0);
  const BakePlan done = planned(scene, settings, folder.path("a"), {.index = 0, .count = 2});
  EXPECT_EQ(done.already, done.looks);
  EXPECT_EQ(done.cells, 0.0);
  EXPECT_EQ(done.seconds, 0.0);
  EXPECT_GT(done.bytes, 0.0);
}

/// Takes down what it hears.
class TrialListener final : public ProgressListener {
 public:
  void advanced(std::string_view task, double done, double total, std::string_view unit) override {
    EXPECT_EQ(task, "plan");
    EXPECT_EQ(unit, "looks");
    EXPECT_EQ(total, 2.0);
    told.push_back(done);
  }
  std::vector<double> told;
};

TEST(BakePlan, TellsHowFarItsTrialsAre) {
  const ScratchFolder folder;
  TrialListener listener;
  static_cast<void>(plan(scene_with_tower(100.0), settings_with_azimuths(2), folder.path("none"), listener));
  ASSERT_FALSE(listener.told.empty());
  EXPECT_TRUE(std::ranges::is_sorted(listener.told));
  EXPECT_EQ(listener.told.front(), 0.0);
  EXPECT_EQ(listener.told.back(), 2.0);
  const auto within_a_look = [](double done) { return done != std::floor(done); };
  EXPECT_TRUE(std::ranges::any_of(listener.told, within_a_look));
}

TEST(BakePlan, IsRefusedWhereTheBakeWouldBe) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path("a"));
  std::ofstream(folder.path("a") / "dataset.json") << "{}";
  EXPECT_EQ(message_of_error([&] {
              static_cast<void>(planned(scene_with_tower(100.0), settings_with_azimuths(2), folder.path("a")));
            }),
            folder.path("a").string() + ": holds a dataset; choose an empty folder");
}

}  // namespace
}  // namespace sigmascape::bake
