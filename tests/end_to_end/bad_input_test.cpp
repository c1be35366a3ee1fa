#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <utility>

#include "end_to_end/made_scene.h"
#include "scratch_folder.h"

namespace sigmascape::end_to_end {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The program with what it cannot do anything with: it says in one sentence what and where, and leaves nothing behind.
class BadInput : public ::testing::Test {
 protected:
  /// What it says; empty when it took the line.
  [[nodiscard]] std::string said_to(const std::string& arguments) const {
    const auto said = folder_.path("said");
    const int status = std::system(
        fmt::format("cd '{}' && ('{}' {}) > said 2>&1", folder_.path(".").string(), SIGMASCAPE_CLI, arguments).c_str());
    EXPECT_TRUE(WIFEXITED(status)) << arguments << " was killed";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    std::ifstream stream(said);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write_radar() const {
    folder_.write("radar.toml",
                  "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                  "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n");
  }
  [[nodiscard]] bool is_there(const std::string& name) const { return std::filesystem::exists(folder_.path(name)); }

  ScratchFolder folder_;
};

TEST_F(BadInput, NotANumberIsNoNumberOfAnOption) {
  write_radar();
  const auto refused = [](const char* option) {
    return AllOf(StartsWith(option), HasSubstr("is nan; give a number from"));
  };
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --span-db nan"), refused("--span-db"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --top-db nan"), refused("--top-db"));
  EXPECT_THAT(said_to("plot antenna radar.toml --reach-deg nan --out plot.svg"), refused("--reach-deg"));
  EXPECT_THAT(said_to("plot response radar.toml --widths nan --out plot.svg"), refused("--widths"));
  EXPECT_THAT(said_to("plot histogram map.tif --looks nan --out plot.svg"), refused("--looks"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --samples 0"),
              HasSubstr("--samples: is 0; give a whole number from 1 to"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --bounces 256"),
              HasSubstr("--bounces: is 256; give a whole number from 1 to 255"));
  EXPECT_FALSE(is_there("plot.svg"));
}

TEST_F(BadInput, PicturesOfAnotherKindAreRefusedBeforeTheWork) {
  write_radar();
  std::filesystem::create_directory(folder_.path("folder.png"));
  for (const char* option : {"--png", "--ppi", "--b-scope"}) {
    EXPECT_THAT(said_to(fmt::format("render radar.toml --scene none.toml {} map.jpg", option)),
                HasSubstr("map.jpg: is no kind of file that maps are drawn into; end the name in .png"));
    EXPECT_THAT(said_to(fmt::format("render radar.toml --scene none.toml {} folder.png", option)),
                HasSubstr("folder.png: is a folder; name a file"));
  }
  EXPECT_FALSE(is_there("folder.pgw"));
}

TEST_F(BadInput, TwoOptionsMayNotNameOneFile) {
  write_radar();
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --out map.tif --power ./map.tif"),
              HasSubstr("--power: names ./map.tif, as --out does; give each of them a file of its own"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --png a.png --ppi x/../a.png"),
              HasSubstr("--ppi: names x/../a.png, as --png does"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --out map.npy --snr map.NPY"),
              HasSubstr("--snr: names map.NPY, which has map.json beside it, as --out does"));
  std::filesystem::create_directory(folder_.path("d"));
  std::filesystem::create_directory_symlink("d", folder_.path("link"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --out d/map.tif --power link/map.tif"),
              HasSubstr("--power: names link/map.tif, as --out does"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --out map.tif --power power.tif"), HasSubstr("none.toml"));
}

TEST_F(BadInput, WhatAMapIsMadeFromIsNotWrittenOver) {
  write_radar();
  folder_.write("town.json", "{}");
  folder_.write("dem.tif", "heights");
  folder_.write("town.toml", "[terrain]\nfile = \"dem.tif\"\n[[buildings]]\nfile = \"town.json\"\n");
  EXPECT_THAT(said_to("render radar.toml --scene town.toml --out ./dem.tif"),
              HasSubstr("--out: names ./dem.tif, of what this is made from; give it a file of its own"));
  EXPECT_THAT(said_to("render radar.toml --scene town.toml --out town.npy"),
              HasSubstr("--out: names town.npy, which has town.json beside it, of what this is made from"));
  EXPECT_THAT(said_to("render radar.toml --scene town.toml --out map.npy"), Not(HasSubstr("is made from")));
}

// In a shell, seq -w and printf %03d write numbers like this.
TEST_F(BadInput, LeadingZerosMakeNoOtherNumber) {
  write_radar();
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --seed 08 --samples 0010 --out map.tif"),
              HasSubstr("none.toml: the file does not exist"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --bounces 0256 --out map.tif"),
              HasSubstr("--bounces: is 256; give a whole number from 1 to 255"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --bounces 0 --out map.tif"), HasSubstr("--bounces: is 0;"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --bounces 2 --layers bounce3 --layers-out a.tif"),
              HasSubstr("layer \"bounce3\": is of more bounces than are traced, 2; raise --bounces"));
}

TEST_F(BadInput, FilesThatCannotBeWrittenAreRefusedBeforeTheWork) {
  write_radar();
  for (const auto& [option, name] : {std::pair("--out", "radar.toml/map.tif"), {"--png", "radar.toml/map.png"}}) {
    EXPECT_THAT(said_to(fmt::format("render radar.toml --scene none.toml {} {}", option, name)),
                HasSubstr(fmt::format("{}: cannot be written (Not a directory); choose a folder that exists", name)));
  }
}

TEST_F(BadInput, WhatAMapCannotBeIsRefusedBeforeItIsTraced) {
  write_radar();
  const auto scene = write_made_scene(folder_.path("scene"), 200.0, 200.0);
  // So many rays would take an hour.
  const auto said_of = [&](const std::string& options) {
    return said_to(
        fmt::format("render radar.toml --scene '{}' --samples 1000000 --out map.tif {}", scene.string(), options));
  };
  EXPECT_THAT(said_of("--crs EPSG:99999"), AllOf(HasSubstr("--crs"), HasSubstr("EPSG:99999")));
  EXPECT_THAT(said_of("--snr power.bin"), HasSubstr("power.bin: would not be known for a NumPy file"));
  EXPECT_THAT(said_of("--video video.tif"), HasSubstr("video.tif: would not be known for a NumPy file"));
  EXPECT_THAT(said_of("--snr power.npy --polarization sum"), HasSubstr("cannot give the sum of polarizations"));
  EXPECT_THAT(said_of("--layers shadow,range,shadow --layers-out layers.tif"),
              HasSubstr("--layers: names shadow twice"));
  EXPECT_THAT(said_of("--layers bounce --layers-out layers.tif"),
              HasSubstr("class, height; at level of detail 0 there are bounce1 to bounce9 and multibounce too"));
  EXPECT_THAT(said_of("--layers shadow --layers-out layers.png"), HasSubstr("layers.png: would not be known for"));
  EXPECT_THAT(said_to("results --small --finer-samples 1 --out results"), HasSubstr("--finer-samples: is 1"));
  EXPECT_THAT(said_to("results --small --bounces 300 --out results"), HasSubstr("--bounces: is 300; give a whole"));
  EXPECT_THAT(said_to("results --small --measured none.json --out results"), HasSubstr("none.json: cannot be read"));
  EXPECT_THAT(said_to("results --small --out radar.toml"),
              HasSubstr("radar.toml/results.json: cannot be written (Not a directory); choose a folder"));
  EXPECT_THAT(said_to(fmt::format("results --small --scene '{}' --out results", scene.string())),
              HasSubstr("asks for 400 m, and the scene is 200 m wide; give one of at most 0.1"));
}

TEST_F(BadInput, EmptyNamesAreNotTheFolderOneStandsIn) {
  EXPECT_THAT(said_to("bake none.toml --out ''"), StartsWith("--out: is empty; give a name or a value"));
  EXPECT_THAT(said_to("bake none.toml --out="), StartsWith("--out: is empty"));
  EXPECT_THAT(said_to("atlas info ''"), StartsWith("word 3 of the command line: is empty"));
  EXPECT_THAT(said_to("bake none.toml --out atlas"), StartsWith("sigmascape: none.toml"));
}

TEST_F(BadInput, ListsHaveNothingBetweenTwoCommas) {
  for (const char* list : {"10,,20", ",10", "10,", ","}) {
    const std::string told = fmt::format("has an empty item in {}; put one comma between two", list);
    EXPECT_THAT(said_to(fmt::format("bake none.toml --out atlas --elevations-deg {}", list)),
                StartsWith("--elevations-deg: " + told));
    EXPECT_THAT(said_to(fmt::format("bake none.toml --out atlas --frequencies-ghz={}", list)),
                StartsWith("--frequencies-ghz: " + told));
    EXPECT_THAT(said_to(fmt::format("compare a.tif b.tif --cells-m {}", list)), StartsWith("--cells-m: " + told));
  }
}

TEST_F(BadInput, WhatCannotBePrintedIsNotLostWithoutAWord) {
  write_made_scene(folder_.path("scene"), 200.0, 200.0);
  for (const char* arguments : {"scene info scene/scene.toml", "scene info --json scene/scene.toml", "bake --help"}) {
    EXPECT_THAT(said_to(fmt::format("{} > /dev/full", arguments)),
                AllOf(StartsWith("sigmascape: standard output: cannot be written"),
                      HasSubstr("; send it to where there is room\n")))
        << arguments;
  }
}

TEST_F(BadInput, NamesOfFilesMayBeOfAnyBytesInASummaryToo) {
  write_made_scene(folder_.path("scene"), 200.0, 200.0);
  EXPECT_EQ(
      said_to(
          "bake scene/scene.toml --out $(printf 'at\\377las') --texel-m 4 --patch-texels 256 --samples 2 --azimuths 1 "
          "--elevations-deg 20 --json"),
      "");
}

TEST_F(BadInput, TexelsOfAnotherSizeThanTheSceneAreRefusedBeforeTheWork) {
  write_made_scene(folder_.path("scene"), 200.0, 200.0);
  EXPECT_THAT(said_to("bake scene/scene.toml --out atlas --texel-m 1e6"),
              HasSubstr("texels of 1e+06 m make patches of 512000 km; use texels of 1953"));
  for (const char* plan : {"", " --plan"}) {
    EXPECT_THAT(said_to(fmt::format("bake scene/scene.toml --out atlas --texel-m 0.01 --patch-texels 16384 "
                                    "--frequencies-ghz 1,2,3,4,5,6,7,8,9,10,11,12{}",
                                    plan)),
                AllOf(HasSubstr("a patch of 16384 × 16384 texels at 12 frequencies takes 258 GB"),
                      HasSubstr("use fewer texels a patch")));
  }
  EXPECT_FALSE(is_there("atlas"));
}

TEST_F(BadInput, MapsInDegreesAreNotComparedByMetres) {
  write_radar();
  write_made_scene(folder_.path("town"), 120, 120);
  ASSERT_EQ(said_to("render radar.toml --scene town/scene.toml --lod 0 --samples 1 --crs EPSG:4326 --out map.tif"), "");
  EXPECT_THAT(said_to("compare map.tif map.tif"), HasSubstr("map.tif: has cells of degrees"));
}

TEST_F(BadInput, ListsOfWhatAreNoNumbersAreRefused) {
  EXPECT_THAT(said_to("compare a.tif b.tif --cells-m 2,abc"),
              StartsWith("--cells-m: is 2,abc; give numbers, as --help shows them"));
}

TEST_F(BadInput, OptionsThatContradictOneAnotherAreRefused) {
  EXPECT_THAT(said_to("bake none.toml --out atlas --samples 4 --target-db 1"),
              HasSubstr("--target-db excludes --samples"));
  EXPECT_THAT(said_to("bake none.toml --out atlas --samples 4 --preset paper"), HasSubstr("excludes"));
  EXPECT_THAT(said_to("bake none.toml --out atlas --bounces 100"),
              HasSubstr("--bounces: is 100; give a whole number from 1 to 64"));
}

TEST_F(BadInput, OptionsOfWhatIsNotMadeAreRefused) {
  write_radar();
  const auto said_of = [&](const std::string& options) {
    return said_to("render radar.toml --scene none.toml " + options);
  };
  EXPECT_THAT(said_of("--interval-s 1"),
              HasSubstr("--interval-s: is of --iq, which is not asked for; name it or leave this out"));
  EXPECT_THAT(said_of("--iq-unit m --out map.tif"), HasSubstr("--iq-unit: is of --iq, "));
  for (const char* look : {"--style grey", "--span-db 40", "--top-db -30"}) {
    EXPECT_THAT(said_of(fmt::format("{} --out map.tif", look)), HasSubstr("is of --png, --ppi or --b-scope, "));
    for (const char* picture : {"--png", "--ppi", "--b-scope"})
      EXPECT_THAT(said_of(fmt::format("{} {} map.png", look, picture)), HasSubstr("none.toml"));
  }
  EXPECT_THAT(said_of("--up heading --png map.png"), HasSubstr("--up: is of --ppi, "));
  EXPECT_THAT(said_of("--db --png map.png"), HasSubstr("--db: is of --out or --power, "));
  EXPECT_THAT(said_of("--db --power power.tif"), HasSubstr("none.toml"));
  for (const char* traced : {"--samples 4", "--bounces 2"}) {
    EXPECT_THAT(said_of(fmt::format("{} --atlas atlas --out map.tif", traced)), HasSubstr("is of --lod 0, "));
    EXPECT_THAT(said_of(fmt::format("{} --atlas atlas --lod 0 --out map.tif", traced)), HasSubstr("none.toml"));
  }
}

// At level 0 these modes have no map, so that it is no way out.
TEST_F(BadInput, LayersOfBouncesAreRefusedByModeAndLevel) {
  write_radar();
  const auto said_of = [&](const std::string& radar) {
    return said_to(
        fmt::format("render {} --scene none.toml --atlas atlas --layers bounce1 --layers-out layers.tif", radar));
  };
  EXPECT_THAT(said_of("radar.toml"), HasSubstr("layer \"bounce1\": is not in an atlas, where all bounces are one sum; "
                                               "use --lod 0"));
  folder_.write("spotlight.toml",
                "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n"
                "[platform]\nspeed_mps = 100\nheading_deg = 90\n[mode]\nkind = \"spotlight\"\n");
  EXPECT_THAT(said_of("spotlight.toml"),
              AllOf(HasSubstr("spotlight"), HasSubstr("sigmascape.layers"), Not(HasSubstr("--lod 0"))));
}

TEST_F(BadInput, WordsThatAnOptionDoesNotKnowAreToldWithThoseThatItKnows) {
  EXPECT_THAT(said_to("bake none.toml --out atlas --shadows x"),
              HasSubstr("--shadows: is x; choose among baked, run-time"));
  EXPECT_THAT(said_to("compare a.tif b.tif --polarization 3"),
              HasSubstr("--polarization: is 3; choose among hh, hv, "));
}

TEST_F(BadInput, CommandsThatAreNotKnownAreToldWithTheNearest) {
  EXPECT_THAT(said_to("bakke town.toml"), HasSubstr("bakke: is no command; did you mean bake?"));
  EXPECT_THAT(said_to("photograph"), HasSubstr("photograph: is no command; choose among scene, bake, atlas"));
}

TEST_F(BadInput, WordsThatNoCommandOrOptionIsCalledAreToldWithTheNearest) {
  EXPECT_THAT(said_to("scene infos town.toml"), StartsWith("infos: is no command of scene; did you mean info?"));
  EXPECT_THAT(said_to("atlas merge a b"),
              StartsWith("merge: is no command of atlas; choose among info, verify, pyramid, terrain"));
  // Rather than that --scene is required, which somebody who wrote --scen believes to have given.
  EXPECT_THAT(said_to("render radar.toml --scen town.toml"),
              StartsWith("--scen: is no option of render; did you mean --scene?"));
  EXPECT_THAT(said_to("render radar.toml --scene town.toml --polarisation=vv"),
              StartsWith("--polarisation: is no option of render; did you mean --polarization?"));
  EXPECT_THAT(said_to("plot sigma0 grass -out a.svg"),
              StartsWith("-out: is no option of plot sigma0; did you mean --out?"));
  EXPECT_THAT(said_to("scene info town.toml --by-the-way"),
              StartsWith("--by-the-way: is no option of scene info; choose among those that --help tells"));
  EXPECT_THAT(said_to("render radar.toml --scene town.toml --png map.png --top-db -30"),
              StartsWith("sigmascape: radar.toml"));
}

// Before anything is traced: at this many rays it would take hours.
TEST_F(BadInput, SystemsThatAGeoTiffCannotTellAreRefusedAtOnce) {
  write_radar();
  write_made_scene(folder_.path("town"), 120, 120);
  EXPECT_THAT(
      said_to("render radar.toml --scene town/scene.toml --lod 0 --samples 100000 --crs EPSG:8857 --out map.tif"),
      HasSubstr("--crs: is in a coordinate reference system that GeoTIFF has no keys for; choose another one"));
  EXPECT_FALSE(is_there("map.tif"));
}

TEST_F(BadInput, MapsThatNobodyKeepsAreMadeWithAWarning) {
  write_radar();
  write_made_scene(folder_.path("town"), 120, 120);
  const auto warned = [&](const std::string& options) {
    EXPECT_EQ(said_to("render radar.toml --scene town/scene.toml --lod 0 " + options), "");
    std::ifstream stream(folder_.path("said"));
    const std::string said{std::istreambuf_iterator<char>(stream), {}};
    return said.find("warning: no file is written; name one with --out, --png") != std::string::npos;
  };
  EXPECT_TRUE(warned("--samples 1"));
  EXPECT_FALSE(warned("--samples 1 --png map.png"));
  EXPECT_FALSE(warned("--samples 1 --layers shadow --layers-out layers.tif"));
  EXPECT_FALSE(warned("--samples 1 --explain"));
  // Advice is had without the map: at this many rays it would take hours.
  EXPECT_FALSE(warned("--explain --samples 100000"));
}

TEST_F(BadInput, WhatADemoCannotMapIsRefusedBeforeItIsBaked) {
  const auto scene = write_made_scene(folder_.path("scene"), 200.0, 200.0);
  // So many rays would take an hour.
  const auto said_of = [&](const std::string& options) {
    return said_to(fmt::format("demo --scene '{}' --samples 1000000 --out demo {}", scene.string(), options));
  };
  EXPECT_THAT(said_of("--traced-samples 0"), StartsWith("--traced-samples: is 0; give a whole number from 1 to"));
  EXPECT_THAT(said_of("--radar none.toml"), HasSubstr("none.toml: the file does not exist"));
  write_radar();
  EXPECT_THAT(said_of("--radar radar.toml --frequencies-ghz 3"), HasSubstr("10 GHz is not in this atlas"));
  folder_.write("elsewhere.toml",
                "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n"
                "[map]\nwest_m = 500\nsouth_m = 500\neast_m = 600\nnorth_m = 600\n");
  EXPECT_THAT(said_of("--radar elsewhere.toml"),
              AllOf(HasSubstr("map area: has no cell in common with the scene"),
                    HasSubstr("scene's extent, x -100.0 to 100.0 m, y -100.0 to 100.0 m")));
  folder_.write("coarse.toml",
                "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n[map]\ncell_m = 500\n");
  EXPECT_THAT(said_of("--radar coarse.toml"), HasSubstr("and cells of 500 m; make cell_m smaller"));
  folder_.write("spotlight.toml",
                "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                "[platform]\nspeed_mps = 100\n[mode]\nkind = \"spotlight\"\n"
                "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n");
  EXPECT_THAT(said_of("--radar spotlight.toml"),
              HasSubstr("spotlight.toml: mode.kind: is spotlight, and the demo compares real-beam maps"));
  EXPECT_THAT(said_of("--scale 0.5"), HasSubstr("--scale"));
  EXPECT_FALSE(is_there("demo"));
}

TEST_F(BadInput, DecibelsOfAComparisonAreNumbers) {
  EXPECT_THAT(said_to("compare a.tif b.tif --floor-db nan"), StartsWith("--floor-db: is nan; give a number from"));
  EXPECT_THAT(said_to("compare a.tif b.tif --shadow-db inf"), StartsWith("--shadow-db: is inf; give a number from"));
}

TEST_F(BadInput, PulsesWithoutAnAtlasOrUnderAnotherNameAreRefusedBeforeTheWork) {
  write_radar();
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --iq pulses.npy"), HasSubstr("--iq: needs an atlas"));
  EXPECT_THAT(said_to("render radar.toml --scene none.toml --atlas none --iq pulses.wav"),
              HasSubstr("pulses.wav: is no kind of file that I/Q is written as"));
}

TEST_F(BadInput, AnAtlasAsksForItsLevelOfDetail) {
  write_radar();
  const auto scene = write_made_scene(folder_.path("scene"), 200.0, 200.0);
  EXPECT_THAT(said_to(fmt::format("render radar.toml --scene '{}' --atlas none", scene.string())),
              HasSubstr("none/collection.json: is not there"));
  EXPECT_THAT(said_to(fmt::format("render radar.toml --scene '{}' --atlas . --out map.tif", scene.string())),
              HasSubstr("collection.json: is not there"));
}

TEST_F(BadInput, RadarsBeyondTheHorizonOfEverythingAreRefused) {
  const auto scene = write_made_scene(folder_.path("scene"), 200.0, 200.0);
  folder_.write("far.toml",
                "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                "[position]\neast_m = 5e6\nnorth_m = 0\naltitude_m = 10000\n");
  EXPECT_THAT(said_to(fmt::format("render far.toml --scene '{}'", scene.string())),
              HasSubstr("stands 5000 km from the middle of the scene; place it within 1000 km"));
}

TEST_F(BadInput, FoldersAndAbsentFilesAreNamed) {
  EXPECT_THAT(said_to("render . --scene none.toml"), HasSubstr("is a folder; give the path of a TOML file"));
  for (const char* device : {"/dev/null", "/dev/zero"}) {
    EXPECT_THAT(said_to(fmt::format("scene info {}", device)),
                HasSubstr(fmt::format("{}: is no regular file, but a pipe or a device; give the path of", device)));
  }
  EXPECT_THAT(said_to("plot histogram none.tif --out plot.svg"), HasSubstr("none.tif: the file does not exist"));
  EXPECT_THAT(
      said_to("plot histogram pulses.h5 --out plot.svg"),
      HasSubstr("pulses.h5: is neither a ground map nor I/Q that can be read; give a map that ends in .tif or"));
}

TEST_F(BadInput, FrequenciesThatAMaterialIsNotKnownForAreRefusedBeforeTheFirstSample) {
  write_radar();
  write_made_scene(folder_.path("scene"), 200.0, 200.0);
  folder_.write("dataset.toml",
                "[dataset]\nscene = \"scene/scene.toml\"\nradar = \"radar.toml\"\ncount = 2\ncells = 16\n"
                "[view]\nazimuth_deg = [0, 360]\nelevation_deg = [8, 21]\nslant_range_km = [14, 15]\n"
                "[radar]\nfrequency_ghz = [0.2, 10]\n");
  EXPECT_THAT(said_to("dataset dataset.toml --out made"),
              AllOf(HasSubstr("dataset.toml: radar.frequency_ghz"), HasSubstr("do not hold at 0.2 GHz")));
  EXPECT_FALSE(is_there("made"));
  EXPECT_THAT(
      said_to("bake scene/scene.toml --out made --samples 2 --azimuths 1 --elevations-deg 20 --frequencies-ghz 0.2"),
      HasSubstr("do not hold at 0.2 GHz"));
  EXPECT_FALSE(is_there("made"));
}

TEST_F(BadInput, FaultsOfTerrainAndOfGroundThatIsKeptApartAreFound) {
  const auto scene = write_made_scene(folder_.path("scene"), 200.0, 200.0);
  const std::string bake =
      fmt::format("bake '{}' --out atlas --texel-m 4 --patch-texels 256 --samples 2 --azimuths 1 --elevations-deg 20",
                  scene.string());
  ASSERT_EQ(said_to(bake), "");
  EXPECT_EQ(said_to("atlas verify atlas"), "");

  std::filesystem::resize_file(folder_.path("atlas/terrain.tif"), 100);
  EXPECT_THAT(said_to("atlas verify atlas"), HasSubstr("terrain.tif is truncated: 100 of "));
  EXPECT_EQ(said_to(bake + " --verify"), "");
  EXPECT_EQ(said_to("atlas verify atlas"), "");
  std::filesystem::remove(folder_.path("atlas/terrain.tif"));
  EXPECT_THAT(said_to("atlas verify atlas"), HasSubstr("terrain.tif is missing"));
  EXPECT_EQ(said_to(bake), "");

  for (const auto& file : std::filesystem::recursive_directory_iterator(folder_.path("atlas/ground"))) {
    if (file.path().extension() == ".tif") std::filesystem::resize_file(file.path(), 100);
  }
  EXPECT_THAT(said_to("atlas verify atlas"), HasSubstr("ground/patch_"));
}

}  // namespace
}  // namespace sigmascape::end_to_end
