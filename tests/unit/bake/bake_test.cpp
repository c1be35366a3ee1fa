#include "sigmascape/bake/bake.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "scratch_folder.h"

#include "sigmascape/atlas/atlas_summary.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"
#include "sigmascape/terrain/pyramid_builder.h"

namespace sigmascape::bake {
namespace {

constexpr double gamma = 0.03;

/// Level ground of constant gamma, one patch of 512 m or less.
scene::Scene bare_scene(double side_m = 512.0) {
  scene::Scene scene;
  scene.name = "bare";
  scene.extent = {0, 0, side_m, side_m};
  scene.terrain = {0, side_m, side_m, Array2D<float>(2, 2, 120.0F)};
  const scatter::Material ground{
      .name = "ground", .model = scatter::ConstantGammaParameters{gamma, {0.1, 0.5}}, .source = {}};
  scene.ground = {{0, side_m, side_m, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, scene.material_index(ground))};
  return scene;
}

scene::Scene scene_with_box() {
  scene::Scene scene = bare_scene(100.0);
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.5, {0.1, 0.5}}, .source = {}};
  scene.prototypes.push_back(scene::box_mesh({20, 20, 20}, scene.material_index(wall)));
  scene.instances.push_back({.x_m = 50.0F, .y_m = 50.0F});
  return scene;
}

BakeSettings small_bake(std::vector<double> elevations_deg = {13.0, 40.0}) {
  BakeSettings settings;
  settings.aspects.azimuths_rad = {0.0, radians_from_deg(130.0)};
  settings.aspects.elevations_rad.clear();
  for (const double degrees : elevations_deg) settings.aspects.elevations_rad.push_back(radians_from_deg(degrees));
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 4;
  settings.shadows = Shadows::Baked;
  return settings;
}

BakeReport baked(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder) {
  SilentProgress silent;
  return bake(scene, settings, folder, silent);
}

/// Takes down what is waited for, each once.
class WaitedFor final : public ProgressListener {
 public:
  void advanced(std::string_view, double, double, std::string_view) override {}
  void waiting(std::string_view task, std::string_view what) override {
    const std::scoped_lock lock(guard_);
    told_.insert(std::string(task) + ": " + std::string(what));
    is_told_.notify_all();
  }
  /// What has been told, as soon as there is anything.
  [[nodiscard]] std::set<std::string> told() {
    std::unique_lock lock(guard_);
    is_told_.wait_for(lock, std::chrono::minutes(1), [&] { return !told_.empty(); });
    return told_;
  }

 private:
  std::mutex guard_;
  std::condition_variable is_told_;
  std::set<std::string> told_;
};

TEST(Bake, BareConstantGammaGroundIsGammaTimesSine) {
  const ScratchFolder folder;
  BakeSettings settings = small_bake();
  // What polarizations have to one another is surer than what each is.
  settings.digits = atlas::Digits::All;
  const BakeReport report = baked(bare_scene(), settings, folder.path("a"));
  EXPECT_EQ(report.looks, 4U);
  EXPECT_EQ(report.already, 0U);
  EXPECT_LT(report.errors.relative().value(), 0.01);
  const auto store = atlas::Store::open(folder.path("a"));
  for (const atlas::Unit& unit : store.units()) {
    const double elevation_rad = store.description().aspects.look(unit.look).aspect.elevation_rad;
    const auto levels = store.read(unit.patch, unit.look);
    ASSERT_FALSE(levels.empty());
    double mean = 0.0;
    std::size_t off = 0;
    for (const radar::Channels& texel : levels.front().values()) {
      const double sigma0 = static_cast<double>(texel.vv);
      if (std::abs(db_from_linear(sigma0 / (gamma * std::sin(elevation_rad)))) > 0.05) ++off;
      mean += sigma0 / static_cast<double>(levels.front().size());
      EXPECT_NEAR(static_cast<double>(texel.hv) / sigma0, 0.1, 1e-3);
    }
    EXPECT_NEAR(db_from_linear(mean / (gamma * std::sin(elevation_rad))), 0.0, 0.01);
    // Each texel has its four samples, but for the few on an edge that rounding puts on its other side.
    EXPECT_LT(off, levels.front().size() / 1000);
  }
}

// The terrain is not there in a bake: objects stand on the level plane and lie over from there.
TEST(Bake, AWallIsBrightInItsLayoverAndDarkInItsShadow) {
  const ScratchFolder folder;
  BakeSettings settings = small_bake({40.0});
  settings.aspects.azimuths_rad = {0.0};
  settings.sampling.samples_per_texel = 16;
  baked(scene_with_box(), settings, folder.path("a"));
  const auto store = atlas::Store::open(folder.path("a"));
  const auto texels = store.read({0, 0}, 0).front();
  const radar::GroundGrid grid = settings.patches.texels_of({0, 0});
  const auto sigma0_at = [&](Vec2d p) {
    const Vec2d cell = grid.cells_from(p);
    return static_cast<double>(texels(static_cast<std::size_t>(cell.x), static_cast<std::size_t>(cell.y)).vv);
  };
  const double open_ground = gamma * std::sin(radians_from_deg(40.0));
  // Seen from the north: layover from y = 60 to 60 + 20 tan ψ, shadow from y = 40 down to 60 − 20 − 20 / tan ψ.
  EXPECT_GT(sigma0_at({50, 68}), 3.0 * open_ground);
  EXPECT_LT(sigma0_at({50, 30}), 0.1 * open_ground);
  EXPECT_LT(sigma0_at({50, 20}), 0.1 * open_ground);
  EXPECT_NEAR(sigma0_at({50, 13}) / open_ground, 1.0, 0.1);
  EXPECT_NEAR(sigma0_at({20, 50}) / open_ground, 1.0, 0.1);
}

TEST(Bake, ResumesWithTheSameBytes) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_box();
  baked(scene, small_bake(), folder.path("a"));
  const auto whole = files_of(folder.path("a"));

  const auto store = atlas::Store::open(folder.path("a"));
  const auto unit = store.units()[2];
  std::filesystem::remove(folder.path("a") / store.texture_path(unit.patch, unit.look));
  const BakeReport again = baked(scene, small_bake(), folder.path("a"));
  EXPECT_EQ(again.already, 3U);
  EXPECT_GT(again.counts.paths, 0U);
  EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");

  const BakeReport nothing_left = baked(scene, small_bake(), folder.path("a"));
  EXPECT_EQ(nothing_left.already, 4U);
  EXPECT_EQ(nothing_left.counts.paths, 0U);
  EXPECT_FALSE(nothing_left.errors.relative()) << "of nothing there is no error";
  EXPECT_TRUE(nothing_left.mended.empty());
}

TEST(Bake, ThreadsDoNotMatter) {
  const ScratchFolder folder;
  BakeSettings settings = small_bake();
  settings.threads = 1;
  baked(scene_with_box(), settings, folder.path("one"));
  settings.threads = 3;
  baked(scene_with_box(), settings, folder.path("three"));
  const auto one = files_of(folder.path("one"));
  EXPECT_EQ(one.size(), 20U)
      << "collection, catalog, claims, terrain and its item, its pyramid of one tile, and three files a look";
  EXPECT_EQ(difference_of(one, files_of(folder.path("three"))), "");
  settings.seed = 2;
  baked(scene_with_box(), settings, folder.path("other"));
  EXPECT_NE(one, files_of(folder.path("other")));
}

TEST(Bake, SharesMakeTheSameFilesAsOneRun) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_box();
  BakeSettings settings = small_bake();
  settings.aspects.frequencies_hz = {9e9, 10e9};
  baked(scene, settings, folder.path("one"));
  SilentProgress silent;
  std::size_t looks = 0;
  for (const std::size_t index : {2U, 0U, 1U}) {
    const BakeReport report = bake(scene, settings, folder.path("three"), silent, {{index, 3}});
    EXPECT_EQ(report.already + report.elsewhere, 0U);
    looks += report.looks;
  }
  EXPECT_EQ(looks, 8U);
  EXPECT_EQ(difference_of(files_of(folder.path("one")), files_of(folder.path("three"))), "");
}

TEST(Bake, AlteredLooksAreFoundWhenAsked) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_box();
  baked(scene, small_bake(), folder.path("a"));
  const auto whole = files_of(folder.path("a"));
  const auto store = atlas::Store::open(folder.path("a"));
  {
    std::fstream file(store.folder() / store.texture_path({0, 0}, 1), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(-1, std::ios::end);
    file.put('?');
  }
  EXPECT_EQ(baked(scene, small_bake(), folder.path("a")).already, 4U);
  SilentProgress silent;
  EXPECT_EQ(bake(scene, small_bake(), folder.path("a"), silent, {{}, atlas::Scrutiny::Content}).already, 3U);
  EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");
}

// Whoever comes to a look that another process is at leaves it to that one and waits at the end.
TEST(Bake, TwoAtOnceShareTheWork) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_box();
  baked(scene, small_bake(), folder.path("one"));
  BakeReport first, second;
  {
    const std::jthread other([&] { first = baked(scene, small_bake(), folder.path("both")); });
    second = baked(scene, small_bake(), folder.path("both"));
  }
  EXPECT_THAT(first.mended, ::testing::IsEmpty());
  EXPECT_THAT(second.mended, ::testing::IsEmpty());
  EXPECT_EQ(first.looks - first.already - first.elsewhere + second.looks - second.already - second.elsewhere, 4U);
  EXPECT_EQ(difference_of(files_of(folder.path("one")), files_of(folder.path("both"))), "");
}

/// What a bake says that it has mended, "file what".
std::vector<std::string> words_of(const std::vector<atlas::StoreFault>& faults) {
  std::vector<std::string> words;
  for (const atlas::StoreFault& fault : faults) words.push_back(fault.file.string() + " " + fault.what);
  return words;
}

TEST(Bake, AHeadingOfTheTerrainThatCannotBeUnderstoodIsMendedAndTold) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  baked(scene, small_bake({40.0}), folder.path("a"));
  const auto whole = files_of(folder.path("a"));
  SilentProgress silent;
  for (const atlas::Scrutiny scrutiny : {atlas::Scrutiny::Size, atlas::Scrutiny::Content}) {
    std::filesystem::resize_file(folder.path("a") / "terrain/pyramid.toml", 30);
    const BakeReport report = bake(scene, small_bake({40.0}), folder.path("a"), silent, {{}, scrutiny});
    EXPECT_THAT(words_of(report.mended), ::testing::ElementsAre("terrain/pyramid.toml is truncated or was altered"));
    EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");
  }
  std::filesystem::remove_all(folder.path("a") / "terrain");
  EXPECT_THAT(baked(scene, small_bake({40.0}), folder.path("a")).mended, ::testing::IsEmpty()) << "it was absent";
  EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");
}

TEST(Bake, FilesOfTheTerrainThatAreMissingAreMendedAndTold) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  baked(scene, small_bake({40.0}), folder.path("a"));
  const auto whole = files_of(folder.path("a"));
  for (const char* file : {"terrain/level_0.tif", "terrain/level_0/0_0.tif"}) {
    std::filesystem::remove(folder.path("a") / file);
    EXPECT_THAT(words_of(baked(scene, small_bake({40.0}), folder.path("a")).mended),
                ::testing::ElementsAre(std::string(file) + " is missing"));
    EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");
  }
}

// Killed between the heading of the finished pyramid and the removal of that of the unfinished one.
TEST(Bake, OfTerrainThatIsWholeNothingSaysThatItIsUnfinished) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  baked(scene, small_bake({40.0}), folder.path("a"));
  const auto whole = files_of(folder.path("a"));
  const auto terrain = folder.path("a") / "terrain";
  std::filesystem::copy(terrain / "pyramid.toml", terrain / "unfinished.toml");
  EXPECT_THAT(words_of(baked(scene, small_bake({40.0}), folder.path("a")).mended), ::testing::IsEmpty());
  EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");
}

// As it is between a shard's terrain.tif and the item that vouches for it.
TEST(Bake, WaitsForTheTerrainThatAnotherIsAt) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  const BakeSettings settings = small_bake({40.0});
  baked(scene, settings, folder.path("whole"));
  const auto copy = [&](const char* name) {
    std::filesystem::copy(folder.path("whole") / name, folder.path("a") / name,
                          std::filesystem::copy_options::recursive);
  };
  const auto store = atlas::Store::create(folder.path("a"), description_of(scene, settings));
  copy("terrain.tif");
  const std::size_t jobs = 2, patches = 1;
  BakeReport report;
  WaitedFor waits;
  {
    const Claims claims(folder.path("a"));
    auto claim = claims.take_if_free(jobs + patches);
    ASSERT_TRUE(claim);
    const std::jthread other([&] { report = bake(scene, settings, folder.path("a"), waits); });
    EXPECT_THAT(waits.told(), ::testing::ElementsAre("bake: another process that makes the terrain"));
    EXPECT_FALSE(std::filesystem::exists(folder.path("a") / "terrain.json")) << "it did not wait";
    EXPECT_FALSE(std::filesystem::exists(folder.path("a") / "terrain"));
    copy("terrain.json");
    copy("terrain");
    const Claims::Claim given_back = std::move(*claim);
  }
  EXPECT_THAT(words_of(report.mended), ::testing::IsEmpty());
  EXPECT_EQ(difference_of(files_of(folder.path("a")), files_of(folder.path("whole"))), "");
}

TEST(Bake, TellsWhichLookAnotherIsAt) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  const BakeSettings settings = small_bake({40.0});
  static_cast<void>(atlas::Store::create(folder.path("a"), description_of(scene, settings)));
  WaitedFor waits;
  {
    const Claims claims(folder.path("a"));
    auto claim = claims.take_if_free(1);
    ASSERT_TRUE(claim);
    const std::jthread other([&] { static_cast<void>(bake(scene, settings, folder.path("a"), waits)); });
    EXPECT_THAT(waits.told(), ::testing::ElementsAre(
                                  "bake: another process that is at az130.0_el40.0_f10.000GHz of patch_+000_+000"));
    const Claims::Claim given_back = std::move(*claim);
  }
}

// Who removes the collection alone keeps what is below it, which may be of another scene.
TEST(Bake, TilesOfTheTerrainOfAnotherSceneAreMadeAnew) {
  const ScratchFolder folder;
  baked(bare_scene(20.0), small_bake({40.0}), folder.path("a"));
  std::filesystem::remove(folder.path("a") / "collection.json");
  scene::Scene higher = bare_scene(20.0);
  higher.terrain.height_m = Array2D<float>(2, 2, 150.0F);
  const BakeReport report = baked(higher, small_bake({40.0}), folder.path("a"));
  EXPECT_THAT(words_of(report.mended),
              ::testing::Contains("terrain/pyramid.toml is of other heights than the scene's"));
  EXPECT_TRUE(terrain::holds_pyramid_of(folder.path("a") / "terrain", higher.terrain, higher.frame));
}

// As docs/store.md has it of a collection that was damaged: terrain, ground and looks are kept.
TEST(Bake, WithItsCollectionRemovedAnAtlasIsGoneOnWithAndNotTakenForFilesOfOthers) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  BakeSettings settings = small_bake({40.0});
  settings.shadows = Shadows::RunTime;
  baked(scene, settings, folder.path("a"));
  const auto whole = files_of(folder.path("a"));
  for (const char* removed : {"collection.json", "ground/collection.json"}) {
    std::filesystem::remove(folder.path("a") / removed);
    const BakeReport report = baked(scene, settings, folder.path("a"));
    EXPECT_EQ(report.already, report.looks) << removed;
    EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "") << removed;
  }
  for (const char* removed : {"collection.json", "ground/collection.json"})
    std::filesystem::remove(folder.path("a") / removed);
  baked(scene, settings, folder.path("a"));
  EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");
}

TEST(Bake, ATerrainFolderThatIsAFileIsToldPlainly) {
  const ScratchFolder folder;
  static_cast<void>(atlas::Store::create(folder.path("a"), description_of(bare_scene(20.0), small_bake({40.0}))));
  std::ofstream(folder.path("a") / "terrain") << "not a folder";
  EXPECT_THAT(message_of_error([&] { baked(bare_scene(20.0), small_bake({40.0}), folder.path("a")); }),
              ::testing::AllOf(::testing::HasSubstr("a/terrain"), ::testing::HasSubstr("(Not a directory)"),
                               ::testing::Not(::testing::HasSubstr("filesystem"))));
}

// Six digits would not tell these from one another.
TEST(Bake, TargetsThatDifferAreNotTakenForOneAnother) {
  const ScratchFolder folder;
  BakeSettings settings = small_bake({40.0});
  settings.sampling = {.target_db = 0.5, .most_samples = 8};
  EXPECT_EQ(description_of(bare_scene(20.0), settings).settings.at("target_db"), "0.5");
  static_cast<void>(atlas::Store::create(folder.path("a"), description_of(bare_scene(20.0), settings)));
  settings.sampling.target_db = 0.50000001;
  EXPECT_THAT(message_of_error([&] { baked(bare_scene(20.0), settings, folder.path("a")); }),
              ::testing::HasSubstr("settings.target_db is \"0.5\" there and \"0.50000001\" here"));
}

// What a killed writer left is cleared away when its look is baked again, and nothing that another host may be writing.
TEST(Bake, LeftoversOfKilledWritersGo) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_box();
  baked(scene, small_bake(), folder.path("a"));
  const auto whole = files_of(folder.path("a"));
  const auto store = atlas::Store::open(folder.path("a"));
  const auto texture = folder.path("a") / store.texture_path({0, 0}, 2);
  const auto leftover = texture.parent_path() / ("." + texture.filename().string() + ".99-0.tmp");
  std::filesystem::rename(texture, leftover);
  std::filesystem::last_write_time(leftover, std::filesystem::file_time_type::clock::now() - std::chrono::hours(30));
  const auto another_s = texture.parent_path() / ("." + texture.filename().string() + ".0123456789abcdef-99-0.tmp");
  std::ofstream(another_s) << "half";
  EXPECT_EQ(baked(scene, small_bake(), folder.path("a")).already, 3U);
  EXPECT_TRUE(std::filesystem::remove(another_s));
  EXPECT_EQ(difference_of(files_of(folder.path("a")), whole), "");
}

// As another host leaves it for a moment whose locks do not reach here, between a texture and its item.
TEST(Bake, ATextureWhoseItemIsOnItsWayIsNoDamage) {
  const ScratchFolder folder;
  const scene::Scene scene = scene_with_box();
  baked(scene, small_bake(), folder.path("a"));
  const auto store = atlas::Store::open(folder.path("a"));
  const auto texture = folder.path("a") / store.texture_path({0, 0}, 2);
  const auto item = std::filesystem::path(texture).replace_extension(".json");
  const auto mended_after = [&](std::chrono::minutes age) {
    std::filesystem::remove(item);
    std::filesystem::last_write_time(texture, std::filesystem::file_time_type::clock::now() - age);
    return words_of(baked(scene, small_bake(), folder.path("a")).mended);
  };
  EXPECT_THAT(mended_after(std::chrono::minutes(0)), ::testing::IsEmpty());
  EXPECT_TRUE(std::filesystem::exists(item));
  EXPECT_THAT(mended_after(std::chrono::minutes(5)),
              ::testing::ElementsAre(::testing::HasSubstr(
                  ".json is missing, so the file that it vouches for does not count: unfinished, or it was removed")));
}

// A sliver of the extent may reach into a patch that has nothing else.
TEST(Bake, APatchWithNothingInItIsBlackAndDone) {
  const ScratchFolder folder;
  const BakeReport report = baked(bare_scene(512.001), small_bake({40.0}), folder.path("a"));
  EXPECT_EQ(report.looks, 8U);
  const auto store = atlas::Store::open(folder.path("a"));
  EXPECT_TRUE(store.verify().empty());
  // But for a rim about its south-western corner, to which rays are sent for paths of several bounces.
  const auto texels = store.read({1, 1}, 0).front();
  for (std::size_t row = 0; row < 128; ++row) {
    for (std::size_t column = 128; column < 256; ++column) ASSERT_EQ(texels(column, row).vv, 0.0F);
  }
  EXPECT_TRUE(std::isfinite(report.errors.relative().value()));
}

// What is not there is not known to no percent.
TEST(Bake, WhereNothingReturnsThereIsNoError) {
  const ScratchFolder folder;
  scene::Scene black = bare_scene(100.0);
  black.materials.front().model = scatter::LambertParameters{0.0, {0.1, 0.5}};
  const BakeReport report = baked(black, small_bake(), folder.path("a"));
  EXPECT_GT(report.counts.rays, 0U);
  EXPECT_FALSE(report.errors.relative());
  const auto summary = atlas::summary_of(atlas::Store::open(folder.path("a")));
  EXPECT_EQ(summary.looks_done, 4U);
  EXPECT_FALSE(summary.errors.relative());
  EXPECT_FALSE(summary.errors.empty());
}

/// A box whose walls see the ground before them.
scene::Scene scene_with_corner() {
  scene::Scene scene = scene_with_box();
  scene.materials.front().model = scatter::LambertParameters{0.4, {0.1, 0.5}};
  return scene;
}

BakeSettings two_bounces(const Sampling& sampling) {
  BakeSettings settings = small_bake({25.0});
  settings.shadows = Shadows::RunTime;
  settings.sampling = sampling;
  settings.max_bounces = 2;
  return settings;
}

// Rounding to the noise moves a texel by an eighth of its error at most, and steps of 0.2 dB an error by 2.4 %.
TEST(Bake, ErrorsToldAreThoseOfTheStoredTextures) {
  const ScratchFolder folder;
  const Sampling sampling{.target_db = 0.4, .most_samples = 32};
  const BakeReport report = baked(scene_with_corner(), two_bounces(sampling), folder.path("a"));
  const auto store = atlas::Store::open(folder.path("a"));
  atlas::PowerErrors stored;
  for (const auto& [patch, look] : store.units()) {
    stored.add(look, atlas::power_error(store.read(patch, look).front(), store.read_errors(patch, look),
                                        sampling.relative_target()));
  }
  const double error = report.errors.relative().value();
  EXPECT_GT(error, 0.01);
  EXPECT_NEAR(stored.relative().value(), error, 0.03 * error);
  EXPECT_NEAR(stored.part_above_target().value(), report.errors.part_above_target().value(), 0.05);
  const atlas::PowerErrors told = atlas::summary_of(store).errors;
  EXPECT_EQ(told.relative(), report.errors.relative());
  EXPECT_EQ(told.part_above_target(), report.errors.part_above_target());
  EXPECT_EQ(told.part_of_all(), report.errors.part_of_all());
}

// Though more of them light more texels by one stray path.
TEST(Bake, MoreRaysBringALowerError) {
  const ScratchFolder folder;
  const auto errors_with = [&](std::uint32_t most_samples) {
    return baked(scene_with_corner(), two_bounces({.target_db = 0.1, .most_samples = most_samples}),
                 folder.path(std::to_string(most_samples)))
        .errors;
  };
  const atlas::PowerErrors few = errors_with(8), more = errors_with(64), most = errors_with(512);
  EXPECT_LT(more.relative().value(), 0.8 * few.relative().value());
  EXPECT_LT(most.relative().value(), 0.85 * more.relative().value());
  EXPECT_LT(more.part_above_target().value(), few.part_above_target().value());
  EXPECT_LT(most.part_above_target().value(), more.part_above_target().value());
}

TEST(Bake, AResumedBakeTellsOfItsOwnLooksAndTheSummaryOfAll) {
  const ScratchFolder folder;
  const BakeSettings settings = two_bounces({.samples_per_texel = 8});
  const scene::Scene scene = scene_with_corner();
  SilentProgress silent;
  const auto share = [&](std::size_t index) {
    return bake(scene, settings, folder.path("a"), silent, {{index, 2}}).errors.relative().value();
  };
  const double first = share(0), second = share(1);
  EXPECT_NE(first, second);
  const auto spread = atlas::summary_of(atlas::Store::open(folder.path("a"))).errors.spread().value();
  EXPECT_EQ(spread.smallest, std::min(first, second));
  EXPECT_EQ(spread.largest, std::max(first, second));
}

TEST(Bake, OfBareGroundThatIsKeptApartNextToNothingIsBaked) {
  const ScratchFolder folder;
  const BakeReport level = baked(bare_scene(512.0), two_bounces({.samples_per_texel = 8}), folder.path("level"));
  EXPECT_FALSE(level.errors.relative()) << "no path leaves level ground to meet it again";
  EXPECT_EQ(level.errors.part_of_all(), 0.0);
  BakeSettings all_in = two_bounces({.samples_per_texel = 8});
  all_in.shadows = Shadows::Baked;
  const BakeReport among_texels = baked(bare_scene(512.0), all_in, folder.path("all"));
  EXPECT_EQ(among_texels.errors.part_of_all(), 1.0);
}

TEST(Bake, OtherSettingsAreRefusedNamingTheDifference) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  baked(scene, small_bake({40.0}), folder.path("a"));
  const auto message_for = [&](const scene::Scene& other, const BakeSettings& settings) {
    return message_of_error([&] { baked(other, settings, folder.path("a")); });
  };
  BakeSettings settings = small_bake({40.0});
  settings.seed = 2;
  EXPECT_THAT(message_for(scene, settings), ::testing::HasSubstr("seed"));
  settings = small_bake({40.0});
  settings.sampling.samples_per_texel = 8;
  EXPECT_THAT(message_for(scene, settings), ::testing::HasSubstr("samples_per_texel"));
  EXPECT_THAT(message_for(scene, small_bake({41.0})), ::testing::HasSubstr("elevation"));
  scene::Scene changed = scene;
  changed.materials[0].model = scatter::LambertParameters{};
  EXPECT_THAT(message_for(changed, small_bake({40.0})), ::testing::HasSubstr("scene_hash"));
  BakeSettings more_threads = small_bake({40.0});
  more_threads.threads = 3;
  EXPECT_EQ(message_for(scene, more_threads), "");
}

TEST(Bake, AnAtlasOfOtherPhysicsIsRefused) {
  const ScratchFolder folder;
  const scene::Scene scene = bare_scene(20.0);
  const std::string here = std::to_string(physics_revision), later = std::to_string(physics_revision + 1);
  atlas::AtlasDescription description = description_of(scene, small_bake({40.0}));
  EXPECT_EQ(description.physics_revision(), here);
  description.settings[atlas::physics_revision_setting] = later;
  static_cast<void>(atlas::Store::create(folder.path("a"), description));
  EXPECT_THAT(message_of_error([&] { baked(scene, small_bake({40.0}), folder.path("a")); }),
              ::testing::HasSubstr("holds another atlas: settings.physics_revision is \"" + later + "\" there and \"" +
                                   here + "\" here"));
}

TEST(Bake, SettingsOutOfRangeAreRefused) {
  const ScratchFolder folder;
  const auto message_for = [&](const BakeSettings& settings) {
    return message_of_error([&] { baked(bare_scene(20.0), settings, folder.path("a")); });
  };
  EXPECT_THAT(message_for(small_bake({0.0, 13.0})), ::testing::HasSubstr("an elevation of 0.00°; use 0.5° to 89°"));
  EXPECT_THAT(message_for(small_bake({30.0, 30.0})), ::testing::HasSubstr("an elevation of 30.00° is given twice"));
  EXPECT_THAT(message_for(small_bake({13.0, 90.0})), ::testing::HasSubstr("an elevation of 90.00°; use 0.5° to 89°"));
  BakeSettings settings = small_bake();
  settings.sampling.samples_per_texel = 1;
  EXPECT_THAT(message_for(settings), ::testing::HasSubstr("1 samples a texel; use 2 to 1048576"));
  settings.sampling.samples_per_texel = (1U << 20U) + 1;
  EXPECT_THAT(message_for(settings), ::testing::HasSubstr("1048577 samples a texel; use 2 to 1048576"));
  settings.sampling = {.most_samples = (1U << 20U) + 1};
  EXPECT_THAT(message_for(settings), ::testing::HasSubstr("at most 1048577 samples a texel; use 8 to 1048576"));
  settings = small_bake();
  settings.max_bounces = 0;
  EXPECT_THAT(message_for(settings), ::testing::HasSubstr("0 bounces"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("a"))) << "a refused bake leaves a folder behind";
}

// Halves of an odd number of samples are not equal, which is no error of the mean.
TEST(Bake, StandardErrorDoesNotComeFromOddNumbersOfSamples) {
  const ScratchFolder folder;
  BakeSettings settings = small_bake({40.0});
  settings.sampling.samples_per_texel = 5;
  EXPECT_LT(baked(bare_scene(), settings, folder.path("a")).errors.relative().value(), 0.01);
}

// Atlases from before texels could share, or be rounded to, their noise know neither and go on as they began.
TEST(Bake, WithAllDigitsTheDescriptionIsThatOfBefore) {
  BakeSettings settings = small_bake();
  settings.digits = atlas::Digits::All;
  const ScratchFolder folder;
  const auto store = atlas::Store::create(folder.path("a"), description_of(bare_scene(), settings));
  std::ifstream file(store.folder() / "collection.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("\"noise\"")));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("\"digits\"")));
  EXPECT_THAT(text, ::testing::HasSubstr("\"mantissa_bits\": 10"));
}

/// Takes down what it hears.
class LookListener final : public ProgressListener {
 public:
  void advanced(std::string_view task, double done, double total, std::string_view unit) override {
    EXPECT_EQ(task, "bake");
    EXPECT_EQ(unit, "looks");
    EXPECT_EQ(total, 4.0);
    EXPECT_GE(done, last) << "progress went back";
    whole += done != last && done == std::floor(done) ? 1 : 0;
    parts += done != std::floor(done) ? 1 : 0;
    last = done;
  }
  std::size_t whole = 0, parts = 0;
  double last = 0.0;
};

/// Counts what it hears of one task.
class TaskCount final : public ProgressListener {
 public:
  explicit TaskCount(std::string_view task) : task_(task) {}
  void advanced(std::string_view task, double done, double total, std::string_view unit) override {
    if (task != task_) return;
    EXPECT_EQ(unit, "textures");
    ++times;
    last = done;
    whole = total;
  }
  std::size_t times = 0;
  double last = 0.0, whole = 0.0;

 private:
  std::string_view task_;
};

TEST(Bake, TellsOfTexturesThatItReadsToVerify) {
  const ScratchFolder folder;
  baked(bare_scene(20.0), small_bake(), folder.path("a"));
  TaskCount glance("verify"), reading("verify");
  bake(bare_scene(20.0), small_bake(), folder.path("a"), glance);
  EXPECT_EQ(glance.times, 0U);
  bake(bare_scene(20.0), small_bake(), folder.path("a"), reading, {{}, atlas::Scrutiny::Content});
  EXPECT_EQ(reading.times, 4U);
  EXPECT_EQ(reading.last, 4.0);
  EXPECT_EQ(reading.whole, 4.0);
}

TEST(Bake, VerifyTellsOfEachTexture) {
  const ScratchFolder folder;
  baked(bare_scene(20.0), small_bake(), folder.path("a"));
  TaskCount heard("verify");
  EXPECT_TRUE(atlas::Store::open(folder.path("a")).verify(atlas::Scrutiny::Content, &heard).empty());
  EXPECT_EQ(heard.times, 4U);
  EXPECT_EQ(heard.last, heard.whole);
}

TEST(Bake, TellsOfEachLook) {
  const ScratchFolder folder;
  LookListener listener;
  bake(bare_scene(20.0), small_bake(), folder.path("a"), listener);
  EXPECT_EQ(listener.whole, 4U);
  EXPECT_GT(listener.parts, 0U);
  EXPECT_EQ(listener.last, 4.0);
}

}  // namespace
}  // namespace sigmascape::bake
