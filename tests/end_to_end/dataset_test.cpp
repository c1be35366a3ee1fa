#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <vector>

#include "end_to_end/made_scene.h"
#include "end_to_end/process.h"
#include "scratch_folder.h"

#include "sigmascape/bake/bake.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/dataset_run.h"
#include "sigmascape/dataset/sample_files.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/scene/scene_file.h"

namespace sigmascape::end_to_end {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t count = 20, cells = 48;

/// The paper's landscape at a tenth of its size, baked coarsely once, and specifications of datasets of it.
class Dataset : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    folder_->write("scene.toml", "[paper]\nscale = 0.1\nseed = 1\nmaterials = \"paper\"\n");
    folder_->write("radar.toml",
                   "[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 4.0\nbeam_width_deg = 0.023\n"
                   "[position]\nslant_range_km = 15.0\nazimuth_deg = 130.0\nelevation_deg = 13.0\n");
    bake_into("atlas", 2);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static void bake_into(const std::string& atlas, std::uint32_t samples_per_texel,
                        bake::Noise noise = bake::Noise::Own) {
    bake::BakeSettings settings;
    settings.noise = noise;
    settings.aspects.azimuths_rad = {0.0, pi};
    settings.aspects.elevations_rad = {radians_from_deg(8.0), radians_from_deg(21.0)};
    settings.patches = {.texel_m = 4.0, .texels_per_side = 256};
    settings.sampling.samples_per_texel = samples_per_texel;
    SilentProgress silent;
    bake::bake(scene::read_scene(folder_->path("scene.toml")), settings, folder_->path(atlas), silent);
  }

  struct Wish {
    std::string files = "folders", azimuth = "[0, 360]", elevation = "[8, 21]", range = "[14, 15]";
    std::string snr = "[60, 60]", more = "";
    std::string sections = "", target = "", number = "[1, 1]";
    std::size_t looks = 0;
    double rcs_db = 45.0;
    std::size_t cells = end_to_end::cells;
    std::string atlas = "atlas", radar = "radar.toml";
  };

  static dataset::DatasetSpec spec(const Wish& wish, const std::string& layer = "") {
    const auto file = folder_->write(
        "spec.toml",
        fmt::format("[dataset]\nscene = \"scene.toml\"\natlas = \"{}\"\nradar = \"{}\"\ncount = {}\nseed = 7\n"
                    "cells = {}\ncell_m = 4.0\nfiles = \"{}\"\nsamples_per_shard = 3\n"
                    "layers = [\"shadow\", \"layover\", \"incidence\", \"range\", \"class\", \"height\"{}]\n{}"
                    "[view]\nazimuth_deg = {}\nelevation_deg = {}\nslant_range_km = {}\n"
                    "[speckle]\nlooks = {}\n[noise]\nsnr_db = {}\n"
                    "{}[[targets]]\nname = \"reflector\"\nnumber = {}\nrcs_dbsm = [{}, {}]\nheight_m = 2.0\n{}",
                    wish.atlas, wish.radar, count, wish.cells, wish.files, layer.empty() ? "" : ", " + layer, wish.more,
                    wish.azimuth, wish.elevation, wish.range, wish.looks, wish.snr, wish.sections, wish.number,
                    wish.rcs_db, wish.rcs_db, wish.target));
    return dataset::read_dataset_spec(file);
  }

  static dataset::DatasetReport made(const dataset::SampleMaker& maker, const fs::path& folder,
                                     dataset::DatasetShare share = {}) {
    SilentProgress silent;
    return dataset::make_dataset(maker, folder, share, silent);
  }

  static ScratchFolder* folder_;
};
ScratchFolder* Dataset::folder_ = nullptr;

TEST_F(Dataset, HasTheSameBytesForAnyThreadsSharesAndInterruptions) {
  for (const char* files : {"folders", "webdataset"}) {
    const dataset::SampleMaker maker(spec({.files = files, .looks = 1}));
    const fs::path one = folder_->path(std::string("one_") + files), two = folder_->path(std::string("two_") + files),
                   shared = folder_->path(std::string("shared_") + files);
    EXPECT_TRUE(made(maker, one, {.threads = 1}).is_complete);
    const auto expected = files_of(one);
    EXPECT_GT(expected.size(), 9U);
    made(maker, two, {.threads = 2});
    EXPECT_EQ(difference_of(files_of(two), expected), "") << files << ", two threads";

    EXPECT_FALSE(made(maker, shared, {.index = 1, .count = 2}).is_complete);
    EXPECT_TRUE(made(maker, shared, {.index = 0, .count = 2}).is_complete);
    EXPECT_EQ(difference_of(files_of(shared), expected), "") << files << ", two shares";

    // As a kill leaves it: a lot without its index, and nothing told of the whole.
    fs::remove(shared / "index/000002.json");
    fs::remove(shared / "manifest.json");
    const fs::path half_written =
        folder_->write(std::string("shared_") + files + "/.manifest.json.0123456789abcdef-1-0.tmp", "half of it");
    fs::last_write_time(half_written, fs::file_time_type::clock::now() - std::chrono::hours(48));
    const auto report = made(maker, shared);
    EXPECT_EQ(report.already, count - 3);
    EXPECT_EQ(difference_of(files_of(shared), expected), "") << files << ", gone on with";

    // As a careless hand leaves it: one lot without its samples, another with an index that tells nothing.
    const bool in_folders = std::string(files) == "folders";
    fs::remove_all(shared / (in_folders ? "samples/000004" : "shard-000001.tar"));
    folder_->write(fs::path(std::string("shared_") + files) / "index/000000.json", "{}");
    EXPECT_EQ(made(maker, shared).already, count - 6);
    EXPECT_EQ(difference_of(files_of(shared), expected), "") << files << ", mended";
  }
}

TEST_F(Dataset, ManifestTellsTheSha256OfEveryFile) {
  const dataset::SampleMaker maker(spec({.looks = 4}));
  const fs::path folder = folder_->path("told");
  made(maker, folder);
  std::ifstream stream(folder / "manifest.json");
  const auto manifest = nlohmann::json::parse(stream);
  ASSERT_EQ(manifest.at("samples").size(), count);
  for (const auto& sample : manifest.at("samples")) {
    for (const auto& file : sample.at("files")) {
      const fs::path path = folder / "samples" / fmt::format("{:06}", sample.at("sample").get<int>()) /
                            file.at("name").get<std::string>();
      EXPECT_EQ(fs::file_size(path), file.at("bytes").get<std::size_t>()) << path;
      EXPECT_EQ(sha256_of_file(path), file.at("sha256").get<std::string>()) << path;
    }
  }
  const std::string message = message_of_error([&] { made(dataset::SampleMaker(spec({.looks = 5})), folder); });
  EXPECT_NE(message.find("another dataset"), std::string::npos) << message;
}

TEST_F(Dataset, GoesOnWithTheSameRadarAndAtlasOnly) {
  const Wish wish{.atlas = "changing_atlas", .radar = "changing.toml"};
  const auto radar_of_width = [&](double width_deg) {
    folder_->write("changing.toml", fmt::format("[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 4.0\n"
                                                "beam_width_deg = {}\n",
                                                width_deg));
  };
  const auto begun = [&] {
    return message_of_error([&] { made(dataset::SampleMaker(spec(wish)), folder_->path("begun"), {.count = 7}); });
  };
  radar_of_width(0.023);
  fs::copy(folder_->path("atlas"), folder_->path("changing_atlas"), fs::copy_options::recursive);
  EXPECT_EQ(begun(), "");
  EXPECT_EQ(begun(), "");
  radar_of_width(0.03);
  EXPECT_NE(begun().find("holds another dataset: begun with another radar file; choose an empty folder"),
            std::string::npos)
      << begun();
  radar_of_width(0.023);
  EXPECT_EQ(begun(), "");

  std::string told;
  std::getline(std::ifstream(folder_->path("begun") / "dataset.json"), told, '\0');
  std::string older = told;
  older.replace(older.find("\"revision\": "), 13, "\"revision\": 1");
  folder_->write("begun/dataset.json", older);
  EXPECT_NE(begun().find("begun with another version of the program;"), std::string::npos) << begun();
  folder_->write("begun/dataset.json", told);
  EXPECT_EQ(begun(), "");

  fs::remove_all(folder_->path("changing_atlas"));
  bake_into("changing_atlas", 3);
  EXPECT_NE(begun().find("holds another dataset: begun with another atlas;"), std::string::npos) << begun();
  radar_of_width(0.03);
  EXPECT_NE(begun().find("begun with another radar file and atlas;"), std::string::npos) << begun();
}

TEST_F(Dataset, NeverGoesIntoAnAtlasNorAnAtlasIntoIt) {
  const dataset::SampleMaker maker(spec({}));
  EXPECT_EQ(message_of_error([&] { made(maker, folder_->path("atlas")); }),
            folder_->path("atlas").string() + ": holds an atlas; choose an empty folder");
  EXPECT_FALSE(fs::exists(folder_->path("atlas") / "dataset.json"));
  made(maker, folder_->path("samples"), {.index = 0, .count = 20});
  EXPECT_EQ(message_of_error([&] { bake_into("samples", 2); }),
            folder_->path("samples").string() + ": holds a dataset; choose an empty folder");
}

// A killed run has written its own dataset.json before all of them.
TEST_F(Dataset, NeverTakesThePlaceOfFilesOfOthers) {
  const dataset::SampleMaker maker(spec({}));
  for (const auto& [file, told] :
       {std::pair("annotations.json", "annotations.json"), std::pair("manifest.json", "manifest.json"),
        std::pair("contact_sheet.png", "contact_sheet.png"), std::pair("samples/000000/map.npy", "samples"),
        std::pair("index/000000.json", "index"), std::pair("shard-000002.tar", "shard-000002.tar")}) {
    const fs::path folder = folder_->path(std::string("of_others_") + told);
    fs::create_directories((folder / file).parent_path());
    std::ofstream(folder / file) << "of others";
    EXPECT_EQ(message_of_error([&] { made(maker, folder, {.index = 0, .count = 20}); }),
              folder.string() + ": holds " + told +
                  ", which is of no dataset begun here, and would be lost; choose an empty folder");
    EXPECT_EQ(files_of(folder), (std::map<std::string, std::string>{{file, "of others"}}));
  }
  const fs::path beside = folder_->path("beside_others");
  fs::create_directories(beside);
  std::ofstream(beside / "spec.toml") << "of others";
  EXPECT_EQ(message_of_error([&] { made(maker, beside, {.index = 0, .count = 20}); }), "");
}

// What the first of them writes is not taken for a file of others by the next.
TEST_F(Dataset, SharesThatBeginAtOnceAllComeToTheirEnd) {
  const dataset::SampleMaker maker(spec({}));
  const fs::path folder = folder_->path("at_once");
  std::vector<std::string> said(4);
  {
    std::vector<std::jthread> shares;
    for (std::size_t share = 0; share < said.size(); ++share) {
      shares.emplace_back([&, share] {
        said[share] = message_of_error([&] { made(maker, folder, {.index = share, .count = 4, .threads = 1}); });
      });
    }
  }
  for (const std::string& words : said) EXPECT_EQ(words, "");
  EXPECT_EQ(made(maker, folder).already, count);
}

// Lots of three samples each, of which another run is at the second.
TEST_F(Dataset, RefusesToMakeWhatAnotherRunIsMaking) {
  const dataset::SampleMaker maker(spec({}));
  const fs::path folder = folder_->path("two_runs");
  made(maker, folder, {.index = 2, .count = 7});
  const auto said = [&](dataset::DatasetShare share) { return message_of_error([&] { made(maker, folder, share); }); };
  {
    const bake::Claims other(folder);
    const auto claim = other.take_if_free(1);
    ASSERT_TRUE(claim);
    EXPECT_EQ(said({}), folder.string() +
                            ": is being filled with the same samples by another run; wait until that has "
                            "ended, or give each run a --shard of its own");
    EXPECT_EQ(said({.index = 1, .count = 2}), said({}));
    EXPECT_EQ(said({.index = 0, .count = 2}), "");
  }
  EXPECT_TRUE(made(maker, folder).is_complete);
  const bake::Claims other(folder);
  const auto claim = other.take_if_free(1);
  EXPECT_EQ(said({}), "") << "nothing of it is lacking";
}

// What an index tells may be damaged where nobody looks until all is told together.
TEST_F(Dataset, NamesADamagedIndex) {
  const dataset::SampleMaker maker(spec({.files = "webdataset"}));
  const fs::path folder = folder_->path("damaged");
  made(maker, folder);
  std::ifstream stream(folder / "index/000001.json");
  const auto whole = nlohmann::json::parse(stream);
  const auto said_of = [&](const nlohmann::json& index) {
    folder_->write("damaged/index/000001.json", index.dump());
    return message_of_error([&] { made(maker, folder, {.index = 0, .count = 2}); });
  };
  EXPECT_EQ(said_of(whole), "");
  const std::string expected = (folder / "index/000001.json").string() +
                               ": is damaged; remove the file and run its share again, which makes its samples anew";
  auto without_files = whole, without_pixels = whole, with_half_a_box = whole;
  without_files["samples"][2].erase("files");
  without_pixels["samples"][0]["thumbnail"] = "no pixels";
  with_half_a_box["samples"][1]["boxes"] = {{0, 1.0}};
  EXPECT_EQ(said_of(without_files), expected);
  EXPECT_EQ(said_of(without_pixels), expected);
  EXPECT_EQ(said_of(with_half_a_box), expected);
  fs::remove(folder / "index/000001.json");
  EXPECT_TRUE(made(maker, folder).is_complete);
}

// Each of two bakes that share their noise does so in its own way; what comes over one surface is not shared.
TEST_F(Dataset, RefusesOrdersOfBouncesThatSharedNoiseHides) {
  bake_into("shared_noise", 2, bake::Noise::Shared);
  const auto said_of = [&](const char* layer, const std::string& atlases) {
    return message_of_error([&] {
      dataset::SampleMaker maker(
          spec({.more = "bounce_atlases = [" + atlases + "]\n", .atlas = "shared_noise"}, layer));
    });
  };
  const std::string two = "\"shared_noise\", \"shared_noise\"", three = two + ", \"shared_noise\"";
  EXPECT_NE(said_of("\"bounce3\"", three)
                .find("spec.toml: dataset.layers: asks for bounce3, which bakes with --noise shared do "
                      "not tell"),
            std::string::npos)
      << said_of("\"bounce3\"", three);
  EXPECT_NE(said_of("\"bounce2\"", two).find("does not hold the echoes over 1 surface and no more"), std::string::npos);
}

// Behind crowns a part of a target's power comes through, and far enough above them all of it, whatever hides the
// ground.
TEST_F(Dataset, TargetsAreSeenAlongTheirOwnLinesOfSight) {
  const auto targets_at = [&](double height_m) {
    dataset::DatasetSpec asked = spec({.elevation = "[9, 9]", .number = "[60, 60]", .rcs_db = 70.0});
    asked.targets.front().height_m = height_m;
    std::vector<dataset::SampleTarget> all;
    const dataset::SampleMaker maker(asked);
    for (std::size_t i = 0; i < 3; ++i) std::ranges::move(maker.make(i).targets, std::back_inserter(all));
    return all;
  };
  const auto low = targets_at(2.0), high = targets_at(200.0);
  const auto is_weakened = [](const dataset::SampleTarget& target) {
    return target.part_seen > 1e-3 && target.part_seen < 0.9;
  };
  EXPECT_GT(std::ranges::count_if(low, is_weakened), 5);
  EXPECT_TRUE(std::ranges::any_of(low, [](const auto& target) { return target.part_seen == 0.0; }));
  EXPECT_TRUE(std::ranges::none_of(
      low, [](const auto& target) { return target.is_seen && target.part_seen < dataset::least_part_seen; }));
  EXPECT_TRUE(std::ranges::all_of(high, [](const auto& target) { return target.part_seen == 1.0; }));
}

TEST_F(Dataset, PicturesShowTargetsInAPolarizationThatHasThem) {
  const auto pictured = [&](const char* polarizations) {
    return dataset::pictured_polarization(spec({.more = fmt::format("polarizations = {}\n", polarizations)}));
  };
  EXPECT_EQ(pictured("[\"HV\", \"HH\", \"VV\"]"), radar::Polarization::HH);
  EXPECT_EQ(pictured("[\"VV\", \"HV\"]"), radar::Polarization::VV);
  dataset::DatasetSpec of_hv = spec({});
  of_hv.polarizations = {radar::Polarization::HV};
  EXPECT_EQ(dataset::pictured_polarization(of_hv), radar::Polarization::HV);
}

// Whoever puts the file of another specification in place of the one that refuses it does not get the samples of the
// first as those of the other.
TEST_F(Dataset, LotsOfAnotherDatasetDoNotCount) {
  const fs::path folder = folder_->path("adopted"), other = folder_->path("other");
  const dataset::SampleMaker mine(spec({.snr = "[20, 20]"}));
  made(dataset::SampleMaker(spec({})), folder);
  made(mine, other);
  fs::copy_file(other / "dataset.json", folder / "dataset.json", fs::copy_options::overwrite_existing);
  EXPECT_EQ(made(mine, folder).already, 0U);
  EXPECT_EQ(made(mine, folder).already, count);
}

TEST_F(Dataset, TargetsThatTheGateLeavesOutAreNotSeen) {
  folder_->write("gate.toml",
                 "[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 4.0\nbeam_width_deg = 0.023\n"
                 "[position]\nslant_range_km = 15.0\nazimuth_deg = 130.0\nelevation_deg = 13.0\n"
                 "[receiver]\nfirst_range_km = 14.48\nlast_range_km = 14.53\n");
  const auto maker_with = [&](const std::string& radar) {
    return dataset::SampleMaker(spec({.range = "[14.5, 14.5]", .number = "[60, 60]", .rcs_db = 70.0, .radar = radar}));
  };
  const dataset::SampleMaker open = maker_with("radar.toml"), gated = maker_with("gate.toml");
  std::size_t seen = 0, seen_through_gate = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const dataset::Sample all = open.make(i), within = gated.make(i);
    for (std::size_t k = 0; k < all.targets.size(); ++k) {
      const Vec2d at = all.targets[k].planned.position;
      const Vec3d place{at.x, at.y, open.scene().terrain.height_at(at) + 2.0};
      const double range_m = length(place - all.radar_position);
      EXPECT_EQ(within.targets[k].is_seen, all.targets[k].is_seen && range_m >= 14480.0 && range_m <= 14530.0)
          << range_m;
      seen += all.targets[k].is_seen ? 1 : 0;
      seen_through_gate += within.targets[k].is_seen ? 1 : 0;
    }
  }
  EXPECT_GT(seen_through_gate, 10U);
  EXPECT_GT(seen, seen_through_gate + 10U);
}

// Maps of 192 m a side, 14 to 15 km away: 136 m from their middles to their corners, and hills.
TEST_F(Dataset, RefusesAGateThatIsShutOverEveryMap) {
  const auto said = [&](const char* gate) {
    folder_->write("shut.toml", std::string("[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 4.0\n"
                                            "beam_width_deg = 0.023\n[receiver]\n") +
                                    gate);
    return message_of_error([&] { dataset::SampleMaker maker(spec({.radar = "shut.toml"})); });
  };
  EXPECT_EQ(said("first_range_km = 14.4\nlast_range_km = 14.5\n"), "") << "open to neither end, but between them";
  EXPECT_EQ(said("last_range_km = 14.1\n"), "");
  EXPECT_EQ(said("first_range_km = 14.9\n"), "");
  const std::string shut = "spec.toml: view.slant_range_km: leads to maps from 13.8";
  EXPECT_NE(said("last_range_km = 13\n").find(shut), std::string::npos) << said("last_range_km = 13\n");
  EXPECT_NE(said("first_range_km = 15.5\n").find("range gate is open from 15.5 to "), std::string::npos);
}

// What is there already is looked through by no parallel loop, and told together by none.
TEST_F(Dataset, IsToldToStopWhileItLooksThroughWhatIsThere) {
  const dataset::SampleMaker maker(spec({.number = "[0, 0]"}));
  const fs::path folder = folder_->path("looked_through");
  EXPECT_TRUE(made(maker, folder).is_complete);
  const Interruption at_once([] { return true; });
  EXPECT_THROW(made(maker, folder), Interrupted);
}

TEST_F(Dataset, AStrongTargetIsTheBrightestCellAndLiesInItsBox) {
  const dataset::SampleMaker maker(spec({.rcs_db = 70.0}));
  std::size_t seen = 0;
  for (std::size_t i = 0; i < 3 * count; ++i) {
    const dataset::Sample sample = maker.make(i);
    const auto& target = sample.targets.at(0);
    if (!target.is_seen) continue;
    ++seen;
    std::size_t column = 0, row = 0;
    float brightest = 0.0F;
    for (std::size_t y = 0; y < cells; ++y) {
      for (std::size_t x = 0; x < cells; ++x) {
        if (sample.map.sigma0(x, y).vv > brightest) brightest = sample.map.sigma0(x, y).vv, column = x, row = y;
      }
    }
    const double x = static_cast<double>(column) + 0.5, y = static_cast<double>(row) + 0.5;
    EXPECT_GE(x, target.box.x) << i;
    EXPECT_LE(x, target.box.x + target.box.width) << i;
    EXPECT_GE(y, target.box.y) << i;
    EXPECT_LE(y, target.box.y + target.box.height) << i;
    EXPECT_LT(target.box.width, 8.0) << "a box that holds everything says nothing";
  }
  EXPECT_GE(seen, 6U) << "of which half the landscape is wood";
}

TEST_F(Dataset, CellsInShadowThatNothingLiesOverAreDark) {
  // A look that was baked: between looks a map has the walls of all of them.
  const dataset::SampleMaker maker(
      spec({.azimuth = "[0, 0]", .elevation = "[21, 21]", .snr = "[120, 120]", .rcs_db = -60.0}));
  std::array<std::vector<double>, 2> powers;  // in the light, in shadow
  for (std::size_t i = 0; i < count; ++i) {
    const dataset::Sample sample = maker.make(i);
    const auto& shadow = sample.labels.layers.at(0).values;
    const auto& layover = sample.labels.layers.at(1).values;
    // A cell at the edge gets its neighbour's power through the response, so that whole neighbourhoods count.
    for (std::size_t y = 1; y + 1 < cells; ++y) {
      for (std::size_t x = 1; x + 1 < cells; ++x) {
        float shadows = 0.0F, overs = 0.0F;
        for (std::size_t k = 0; k < 9; ++k) {
          shadows += shadow(x + k % 3 - 1, y + k / 3 - 1);
          overs += layover(x + k % 3 - 1, y + k / 3 - 1);
        }
        if (overs > 0.0F || (shadows > 0.0F && shadows < 9.0F)) continue;
        powers[shadows > 0.0F ? 1 : 0].push_back(static_cast<double>(sample.map.sigma0(x, y).vv));
      }
    }
  }
  // Medians, for a few cells in shadow are lit by walls around them.
  std::array<double, 2> median{};
  for (std::size_t kind = 0; kind < 2; ++kind) {
    ASSERT_GT(powers[kind].size(), 100U);
    const auto middle = powers[kind].begin() + static_cast<std::ptrdiff_t>(powers[kind].size() / 2);
    std::ranges::nth_element(powers[kind], middle);
    median[kind] = *middle;
  }
  fmt::print("  {} cells in shadow have {:.2e}, {} others {:.2e}\n", powers[1].size(), median[1], powers[0].size(),
             median[0]);
  EXPECT_LT(median[1], 0.15 * median[0]);
}

TEST_F(Dataset, TracksFollowTargetsFromFrameToFrame) {
  const dataset::SampleMaker maker(
      spec({.elevation = "[9, 19]",
            .sections = "[sequence]\nframes = 5\ninterval_s = 2.0\nspeed_mps = [100, 100]\n",
            .target = "speed_mps = [4, 4]\n",
            .number = "[8, 8]",
            .rcs_db = 70.0}));
  const fs::path folder = folder_->path("tracks");
  made(maker, folder);
  std::ifstream stream(folder / "annotations.json");
  const auto labels = nlohmann::json::parse(stream);
  EXPECT_EQ(labels.at("videos").size(), count / 5);
  std::map<int, std::map<int, std::array<double, 2>>> middles;  // by track and image
  for (const auto& box : labels.at("annotations")) {
    const auto& b = box.at("bbox");
    middles[box.at("track_id").get<int>()][box.at("image_id").get<int>()] = {
        b[0].get<double>() + b[2].get<double>() / 2.0, b[1].get<double>() + b[3].get<double>() / 2.0};
  }
  std::size_t steps = 0;
  for (const auto& [track, places] : middles) {
    EXPECT_EQ(places.begin()->first / 5, places.rbegin()->first / 5) << "a track stays in its video";
    for (auto it = places.begin(); it != places.end(); ++it) {
      const auto next = std::next(it);
      if (next == places.end() || next->first != it->first + 1) continue;
      ++steps;
      // 8 m at cells of 4 m; boxes at the rim are cut, and ground that slopes moves what stands above it.
      const double moved = std::hypot(next->second[0] - it->second[0], next->second[1] - it->second[1]);
      EXPECT_NEAR(moved, 2.0, 1.2) << "track " << track << ", image " << it->first;
    }
  }
  EXPECT_GE(steps, 4U);
  const dataset::Sample first = maker.make(5), last = maker.make(9);
  EXPECT_NEAR(length(last.radar_position - first.radar_position), 800.0, 1e-6);
  EXPECT_EQ(first.plan.targets[0].rcs_m2, last.plan.targets[0].rcs_m2);
}

/// Over the cells that the radar sees.
double sum_of(const radar::GroundMap& map, float radar::Channels::*channel) {
  double sum = 0.0;
  for (const radar::Channels& cell : map.sigma0.values())
    sum += std::isnan(cell.vv) ? 0.0 : static_cast<double>(cell.*channel);
  return sum;
}

double mean_of(const radar::GroundMap& map, float radar::Channels::*channel) {
  const auto unseen =
      std::ranges::count_if(map.sigma0.values(), [](const radar::Channels& cell) { return std::isnan(cell.vv); });
  return sum_of(map, channel) / (static_cast<double>(map.sigma0.size()) - static_cast<double>(unseen));
}

// Powers of ground and noise add in the mean, in every polarization; 64 looks, all of one speckle, leave 2 % of doubt.
TEST_F(Dataset, HasTheNoiseThatItIsToldOf) {
  const auto sample = [&](std::size_t looks, std::optional<double> snr_db, std::optional<double> noise_sigma0_db) {
    dataset::DatasetSpec of = spec({.number = "[0, 0]", .looks = looks});
    const auto just = [](std::optional<double> db) {
      return db ? std::optional<dataset::Range>({*db, *db}) : std::nullopt;
    };
    of.snr_db = just(snr_db);
    of.noise_sigma0_db = just(noise_sigma0_db);
    return dataset::SampleMaker(of).make(2);
  };
  const dataset::Sample mean = sample(0, {}, {}), clean = sample(64, {}, {});
  EXPECT_EQ(clean.noise_sigma0, 0.0);
  const double ground = mean_of(mean.map, &radar::Channels::vv), drawn = mean_of(clean.map, &radar::Channels::vv);
  ASSERT_GT(ground, 0.0);

  const dataset::Sample as_strong = sample(64, 0.0, {});
  EXPECT_NEAR(as_strong.noise_sigma0 / ground, 1.0, 1e-5);
  EXPECT_NEAR(mean_of(as_strong.map, &radar::Channels::vv) / drawn, 2.0, 0.1);
  EXPECT_NEAR(sample(0, 10.0, {}).noise_sigma0 / ground, 0.1, 1e-6);

  const dataset::Sample stated = sample(64, {}, -20.0);
  EXPECT_NEAR(stated.noise_sigma0, 0.01, 1e-9);
  for (const auto channel : {&radar::Channels::vv, &radar::Channels::hh, &radar::Channels::hv}) {
    EXPECT_NEAR(mean_of(stated.map, channel) - mean_of(clean.map, channel), 0.01, 5e-4);
  }
}

TEST_F(Dataset, RefusesWhatCannotBeWithTheReason) {
  const auto message = [&](const Wish& wish, const std::string& layer = "") {
    return message_of_error([&] { dataset::SampleMaker maker(spec(wish, layer)); });
  };
  EXPECT_EQ(message({}), "");
  EXPECT_NE(message({.elevation = "[21, 8]"}).find("view.elevation_deg: begins at 21"), std::string::npos);
  EXPECT_NE(message({.elevation = "[5, 21]"}).find("from 8 to 21"), std::string::npos);
  EXPECT_NE(message({.cells = 4096}).find("larger than the scene"), std::string::npos);
  EXPECT_NE(message({.more = "level_of_detial = 1\n"}).find("level_of_detail"), std::string::npos);
  EXPECT_NE(message({.more = "first_bounce_atlas = \"atlas\"\n"}, "\"multibounce\"").find("--bounces 1"),
            std::string::npos);
  EXPECT_NE(message({}, "\"multibounce\"").find("does not tell bounces apart"), std::string::npos);
  EXPECT_NE(message({}, "\"bounce2\"").find("level_of_detail = 0"), std::string::npos);
  EXPECT_NE(message({.more = "first_bounce_atlas = \"atlas\"\n"}, "\"bounce2\"").find("--bounces 1 to --bounces 2"),
            std::string::npos);
  EXPECT_NE(message({.sections = "[sequence]\nframes = 3\n"}).find("sequence.frames: is 3, of which 20"),
            std::string::npos);
  EXPECT_NE(message({.sections = "[radar]\nfrequency_ghz = [5, 10]\n"}).find("radar.frequency_ghz: leads outside"),
            std::string::npos);
  EXPECT_NE(message({.snr = "[5, 5]\nnoise_sigma0_db = [-40, -30]"}).find("both say"), std::string::npos);
  EXPECT_NE(message({.target = "east_m = [0, 500]\n"}).find("leads out of the map"), std::string::npos);
}

TEST_F(Dataset, RefusesFlightsOutOfTheAtlasAndOverTheMap) {
  const auto message = [&](const std::string& elevation, const std::string& range, int speed_mps, int course_deg) {
    const Wish wish{
        .azimuth = "[0, 0]",
        .elevation = elevation,
        .range = range,
        .sections = fmt::format("[sequence]\nframes = 20\nspeed_mps = [{0}, {0}]\ncourse_deg = [{1}, {1}]\n", speed_mps,
                                course_deg)};
    return message_of_error([&] { dataset::SampleMaker maker(spec(wish)); });
  };
  EXPECT_EQ(message("[12, 12]", "[14, 15]", 100, 180), "");
  EXPECT_EQ(message("[12, 12]", "[14, 15]", 100, 0), "");
  // To 29 km from 14.5: its last frame is the flattest.
  EXPECT_NE(message("[12, 12]", "[14, 15]", 760, 0)
                .find("sequence.speed_mps: leads outside the atlas, which was baked "
                      "from 8.00 to 21.00 degrees: frame 19 of sequence 0 is seen "
                      "under 5."),
            std::string::npos)
      << message("[12, 12]", "[14, 15]", 760, 0);
  // To the other side of the map, where it is seen as at the beginning.
  EXPECT_NE(message("[10, 10]", "[14, 15]", 1500, 180).find("leads outside the atlas"), std::string::npos);
  EXPECT_NE(message("[20, 20]", "[1.2, 1.2]", 120, 180)
                .find("sequence.speed_mps: takes the radar over the map, in frame 9 of sequence 0; fly less far"),
            std::string::npos)
      << message("[20, 20]", "[1.2, 1.2]", 120, 180);
}

/// Part of the power, over the cells that `belongs` picks.
template <typename Belongs>
double part_of_several(const dataset::Sample& sample, const Belongs& belongs) {
  const auto& part = sample.labels.layers.back().values;
  double several = 0.0, all = 0.0;
  for (std::size_t y = 6; y + 6 < part.rows(); ++y) {
    for (std::size_t x = 6; x + 6 < part.columns(); ++x) {
      if (!belongs(x, y)) continue;
      const auto power = static_cast<double>(sample.map.sigma0(x, y).vv);
      several += power * static_cast<double>(part(x, y));
      all += power;
    }
  }
  return several / all;
}

const char* const radar_in_the_south =
    "[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 2.0\nbeam_width_deg = 0.011\n"
    "[position]\nslant_range_km = 15.0\nazimuth_deg = 180.0\nelevation_deg = 21.0\n";

/// Looks from its elevation.
bake::BakeSettings seen_from_the_south(std::uint32_t samples_per_texel) {
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {0.0, pi};
  settings.aspects.elevations_rad = {radians_from_deg(21.0)};
  settings.patches = {.texel_m = 2.0, .texels_per_side = 256};
  settings.sampling.samples_per_texel = samples_per_texel;
  return settings;
}

// What should be known of a scene and of a radar is said once, before the samples.
TEST(DatasetCommand, WarnsOfItsSceneAndOfCellsThatAreTooCoarse) {
  const ScratchFolder folder;
  write_made_scene(folder.path("place"), 200, 200);
  std::ofstream(folder.path("place/scene.toml"), std::ios::app)
      << "[[buildings]]\nfile = \"houses.csv\"\ncrs = \"EPSG:25830\"\nheight_attribute = \"height\"\n"
         "where = \"height = 'unheard of'\"\n";
  folder.write("radar.toml", radar_in_the_south);
  folder.write("spec.toml",
               "[dataset]\nscene = \"place/scene.toml\"\nradar = \"radar.toml\"\ncount = 2\ncells = 8\ncell_m = 8.0\n"
               "samples_per_cell = 1\npreview = false\n[view]\nazimuth_deg = [180, 180]\nelevation_deg = [21, 21]\n"
               "slant_range_km = [15, 20]\n");
  const Ended ended =
      Process(fmt::format("cd '{}' && '{}' dataset spec.toml --out samples", folder.path("").string(), SIGMASCAPE_CLI),
              folder.path("printed.txt"))
          .ended();
  EXPECT_EQ(ended.code, 0) << ended.printed;
  const std::string& printed = ended.said;
  const auto times_said = [&](const std::string& words) {
    std::size_t times = 0;
    for (std::size_t at = printed.find(words); at != std::string::npos; at = printed.find(words, at + 1)) ++times;
    return times;
  };
  EXPECT_EQ(times_said("warning: scene: files without a feature that is asked for, of which nothing is used: 1"), 1U)
      << printed;
  EXPECT_EQ(times_said("warning: radar: in maps 15 km away the beam of 1.9 m is narrower than the map's cells of 8 m"),
            1U)
      << printed;
  EXPECT_EQ(times_said("in maps "), 1U) << printed;
}

// Smooth houses on grass: a wall answers hardly by itself but by the corner that it makes with the ground, at its foot;
// open grass answers at once.
TEST(DatasetOfHouses, KnowsWhatPartCameOverSeveralSurfaces) {
  const ScratchFolder folder;
  const auto scene = write_made_scene(folder.path("place"), 200, 200);
  folder.write("radar.toml", radar_in_the_south);
  bake::BakeSettings settings = seen_from_the_south(8);
  SilentProgress silent;
  for (const auto& [name, bounces] : {std::pair{"atlas", 4}, {"first_bounce", 1}}) {
    settings.max_bounces = bounces;
    bake::bake(scene::read_scene(scene), settings, folder.path(name), silent);
  }
  const auto file = folder.write(
      "spec.toml",
      "[dataset]\nscene = \"place/scene.toml\"\natlas = \"atlas\"\nfirst_bounce_atlas = \"first_bounce\"\n"
      "radar = \"radar.toml\"\ncount = 1\ncells = 64\ncell_m = 2.0\n"
      "layers = [\"class\", \"bounce1\", \"multibounce\"]\n"
      "[view]\nazimuth_deg = [180, 180]\nelevation_deg = [21, 21]\nslant_range_km = [15, 15]\n[speckle]\nlooks = 0\n");
  const dataset::SampleMaker maker(dataset::read_dataset_spec(file));
  const dataset::Sample sample = maker.make(0);
  settings.seed = 5;
  fs::remove_all(folder.path("first_bounce"));
  bake::bake(scene::read_scene(scene), settings, folder.path("first_bounce"), silent);
  EXPECT_NE(message_of_error([&] {
              dataset::SampleMaker(dataset::read_dataset_spec(file));
            }).find("first_bounce: was baked with seed 5, and the atlas with 1; bake it with all options"),
            std::string::npos);
  ASSERT_EQ(sample.labels.layers.back().name, "multibounce");
  const auto& classes = sample.labels.layers.front().values;
  const auto solid = static_cast<float>(simulate::class_names(maker.scene()).size() - 2);
  const auto is_near = [&](std::size_t x, std::size_t y, std::size_t reach) {
    for (std::size_t row = y - reach; row <= y + reach; ++row) {
      for (std::size_t column = x - reach; column <= x + reach; ++column) {
        if (classes(column, row) == solid) return true;
      }
    }
    return false;
  };
  const double foot = part_of_several(sample, [&](std::size_t x, std::size_t y) {
    return classes(x, y) != solid && classes(x, y - 1) == solid;  // the next cell to the north is a house
  });
  const double open = part_of_several(sample, [&](std::size_t x, std::size_t y) { return !is_near(x, y, 4); });
  fmt::print("  part of several bounces: {:.3f} at the foot of walls, {:.3f} on open grass\n", foot, open);
  EXPECT_GT(foot, 0.6);
  EXPECT_LT(open, 0.1);

  // What came over one surface and what came over more are all there is.
  const auto& first = sample.labels.layers[1].values;
  const auto& part = sample.labels.layers.back().values;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const float all = sample.map.sigma0.values()[i].vv;
    if (!(part.values()[i] > 0.0F)) continue;
    EXPECT_NEAR(first.values()[i], all * (1.0F - part.values()[i]), 1e-5F * all) << i;
  }
}

// Texels of 8 m make houses of 17 × 12 m larger or smaller than cells of 1 m do, in the map and so in its labels.
TEST(DatasetOfHouses, HasTheLabelsOfTheSameMapThatIsRendered) {
  const ScratchFolder folder;
  const auto scene = write_made_scene(folder.path("place"), 200, 200);
  bake::BakeSettings settings = seen_from_the_south(2);
  settings.patches.texel_m = 8.0;
  SilentProgress silent;
  bake::bake(scene::read_scene(scene), settings, folder.path("atlas"), silent);
  folder.write("radar.toml", std::string(radar_in_the_south) +
                                 "[map]\ncell_m = 1.0\nwest_m = -32\nsouth_m = -32\neast_m = 32\nnorth_m = 32\n");
  const auto file = folder.write(
      "spec.toml",
      "[dataset]\nscene = \"place/scene.toml\"\natlas = \"atlas\"\nradar = \"radar.toml\"\ncount = 1\ncells = 64\n"
      "cell_m = 1.0\nlayers = [\"shadow\", \"layover\", \"class\", \"height\"]\n"
      "[view]\nazimuth_deg = [180, 180]\nelevation_deg = [21, 21]\nslant_range_km = [15, 15]\n"
      "target_east_m = [0, 0]\ntarget_north_m = [0, 0]\n[speckle]\nlooks = 0\n");
  const dataset::Sample sample = dataset::SampleMaker(dataset::read_dataset_spec(file)).make(0);
  const Ended ended = Process(fmt::format("cd '{}' && '{}' render radar.toml --scene place/scene.toml --atlas atlas "
                                          "--layers shadow,layover,class,height --layers-out layers.tif",
                                          folder.path("").string(), SIGMASCAPE_CLI),
                              folder.path("printed.txt"))
                          .ended();
  ASSERT_EQ(ended.code, 0) << ended.printed;
  const auto rendered = geo::read_geotiff(folder.path("layers.tif"));
  ASSERT_EQ(rendered.placement.west_m, sample.map.grid.west_m);
  ASSERT_EQ(rendered.placement.north_m, sample.map.grid.north_m);
  ASSERT_EQ(rendered.bands.size(), sample.labels.layers.size());
  for (std::size_t k = 0; k < rendered.bands.size(); ++k) {
    const auto& [labels, band] = std::pair{sample.labels.layers[k].values, rendered.bands[k].values};
    ASSERT_EQ(labels.size(), band.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < band.size(); ++i) differing += labels.values()[i] != band.values()[i] ? 1 : 0;
    // Radars that are placed by other sums may disagree about a cell at an edge.
    EXPECT_LE(differing, 8U) << rendered.bands[k].name << " of " << band.size();
  }
}

// A scene without a name of its own is called after its file, which may have been named in Latin-1. JSON is UTF-8, and
// what is told of all samples is written when the last of them is made.
TEST(DatasetOfHouses, IsToldOfAPlaceWhoseNameIsNotUtf8) {
  const ScratchFolder folder;
  const fs::path scene = write_made_scene(folder.path("place"), 200, 200), odd = folder.path("place/caf\xe9.toml");
  fs::rename(scene, odd);
  folder.write("place/scene.toml", "");
  folder.write("radar.toml", radar_in_the_south);
  auto spec = dataset::read_dataset_spec(folder.write(
      "spec.toml",
      "[dataset]\nscene = \"place/scene.toml\"\nradar = \"radar.toml\"\ncount = 1\ncells = 8\ncell_m = 2.0\n"
      "samples_per_cell = 1\n[view]\nazimuth_deg = [180, 180]\nelevation_deg = [21, 21]\nslant_range_km = [15, 15]\n"));
  spec.scene = odd;
  SilentProgress silent;
  EXPECT_TRUE(dataset::make_dataset(dataset::SampleMaker(spec), folder.path("told"), {}, silent).is_complete);
  std::ifstream manifest(folder.path("told/manifest.json")), boxes(folder.path("told/annotations.json"));
  EXPECT_EQ(nlohmann::json::parse(manifest).at("scene"), "caf\ufffd");
  EXPECT_EQ(nlohmann::json::parse(boxes).at("info").at("description"), "radar images of caf\ufffd");
}

// A scene's own targets are in the picture whether it is traced or rendered from an atlas, and as steady as a
// reflector: an exponential draw would leave the brightest of four samples some six times as bright as the darkest.
TEST(DatasetOfATarget, ShowsItSteadyAtEveryLevelOfDetail) {
  const ScratchFolder folder;
  const auto scene = write_made_scene(folder.path("place"), 200, 200);
  std::ofstream(scene, std::ios::app) << "\n[[point_targets]]\nposition_m = [21, 13]\nheight_m = 30\nrcs_dbsm = 50\n";
  folder.write("radar.toml", radar_in_the_south);
  SilentProgress silent;
  bake::bake(scene::read_scene(scene), seen_from_the_south(2), folder.path("atlas"), silent);
  const auto powers_of = [&](const std::string& atlas) {
    const auto file = folder.write(
        "spec.toml",
        "[dataset]\nscene = \"place/scene.toml\"\n" + atlas +
            "radar = \"radar.toml\"\ncount = 4\ncells = 64\ncell_m = 2.0\n[view]\nazimuth_deg = [180, 180]\n"
            "elevation_deg = [21, 21]\nslant_range_km = [15, 15]\ntarget_east_m = [0, 0]\ntarget_north_m = [0, 0]\n"
            "[speckle]\nlooks = 1\n");
    const dataset::SampleMaker maker(dataset::read_dataset_spec(file));
    std::array<double, 4> sums{};
    for (std::size_t i = 0; i < sums.size(); ++i) sums.at(i) = sum_of(maker.make(i).map, &radar::Channels::vv);
    std::ranges::sort(sums);
    return sums;
  };
  const auto baked = powers_of("atlas = \"atlas\"\n"), traced = powers_of("");
  EXPECT_GT(traced.front(), 1e4) << "a target of 50 dBsm in cells of 4 m²";
  EXPECT_NEAR(baked.front() / traced.front(), 1.0, 0.05);
  EXPECT_LT(baked.back() / baked.front(), 1.1);
  EXPECT_LT(traced.back() / traced.front(), 1.1);
}

// What a target adds to all cells together is its cross-section: σ0 times their area.
TEST(DatasetOfATarget, HasTheCrossSectionOfItsClass) {
  const ScratchFolder folder;
  const auto scene = write_made_scene(folder.path("place"), 200, 200);
  folder.write("radar.toml", radar_in_the_south);
  SilentProgress silent;
  bake::bake(scene::read_scene(scene), seen_from_the_south(2), folder.path("atlas"), silent);
  const auto power_m2 = [&](int number, double rcs_db) {
    const auto file = folder.write(
        "spec.toml",
        fmt::format("[dataset]\nscene = \"place/scene.toml\"\natlas = \"atlas\"\nradar = \"radar.toml\"\ncount = 1\n"
                    "cells = 64\ncell_m = 2.0\n[view]\nazimuth_deg = [180, 180]\nelevation_deg = [21, 21]\n"
                    "slant_range_km = [15, 15]\ntarget_east_m = [0, 0]\ntarget_north_m = [0, 0]\n[speckle]\nlooks = 0\n"
                    "[[targets]]\nname = \"reflector\"\nnumber = [{0}, {0}]\nrcs_dbsm = [{1}, {1}]\nheight_m = 30.0\n"
                    "east_m = [21, 21]\nnorth_m = [13, 13]\n",
                    number, rcs_db));
    const dataset::Sample sample = dataset::SampleMaker(dataset::read_dataset_spec(file)).make(0);
    for (const dataset::SampleTarget& target : sample.targets) EXPECT_EQ(target.part_seen, 1.0);
    return sum_of(sample.map, &radar::Channels::vv) * sample.map.grid.cell_m * sample.map.grid.cell_m;
  };
  const double ground = power_m2(0, 50.0);
  EXPECT_NEAR((power_m2(1, 50.0) - ground) / 1e5, 1.0, 0.05);
  EXPECT_NEAR((power_m2(1, 60.0) - ground) / 1e6, 1.0, 0.05);
}

}  // namespace
}  // namespace sigmascape::end_to_end
