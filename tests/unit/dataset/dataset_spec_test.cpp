#include "sigmascape/dataset/dataset_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace sigmascape::dataset {
namespace {

using ::testing::HasSubstr;

class DatasetSpecFile : public ::testing::Test {
 protected:
  /// What is said to a traced dataset of so many samples with these sections; empty when it is taken.
  std::string fault_of(const std::string& count, const std::string& sections = "") {
    folder_.write("scene.toml", "[paper]\n");
    folder_.write("radar.toml", "[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 4.0\n" + radar_);
    const auto file =
        folder_.write("spec.toml", "[dataset]\nscene = \"scene.toml\"\nradar = \"radar.toml\"\ncount = " + count +
                                       "\n[view]\nazimuth_deg = [0, 360]\nelevation_deg = [8, 21]\n"
                                       "slant_range_km = [10, 20]\n" +
                                       sections);
    return message_of_error([&] { static_cast<void>(read_dataset_spec(file)); });
  }
  ScratchFolder folder_;
  std::string radar_ = "beam_width_deg = 0.1\n";  // the rest of the radar file
};

TEST_F(DatasetSpecFile, TakesWholeNumbersOfSamples) {
  EXPECT_EQ(fault_of("4"), "");
  EXPECT_THAT(fault_of("1.5"), HasSubstr("spec.toml: dataset.count: is 1.5; give a whole number"));
  EXPECT_THAT(fault_of("0"), HasSubstr("dataset.count: is 0; give a number from 1"));
}

TEST_F(DatasetSpecFile, SaysWhichRangeIsMissing) {
  EXPECT_THAT(fault_of("4", "[[targets]]\nname = \"car\"\nnumber = [1, 2]\n"),
              HasSubstr("rcs_dbsm: is missing; give its least and its greatest number, as in [10, 20]"));
  EXPECT_THAT(fault_of("4", "[[targets]]\nname = \"car\"\nnumber = 3\nrcs_dbsm = [3, 9]\n"),
              HasSubstr("number: is not a range; give its least and its greatest number, as in [10, 20]"));
  EXPECT_THAT(fault_of("4\npolarizations = []"), HasSubstr("dataset.polarizations: names none; choose among VV"));
}

TEST_F(DatasetSpecFile, KeepsSequencesWithinReach) {
  EXPECT_EQ(fault_of("4", "[sequence]\nframes = 4\ninterval_s = 2\nspeed_mps = [100, 200]\n"), "");
  EXPECT_THAT(fault_of("4", "[sequence]\nframes = 4\ninterval_s = 10\nspeed_mps = [0, 40000]\n"),
              HasSubstr("sequence.speed_mps"));
  EXPECT_THAT(fault_of("4", "[sequence]\nframes = 4\ninterval_s = 100\nspeed_mps = [0, 10000]\n"),
              HasSubstr("sequence.speed_mps: takes the radar as far as 3020 km away; stay within 1000 km"));
}

TEST_F(DatasetSpecFile, RefusesKeysThatWouldDoNothing) {
  EXPECT_THAT(fault_of("4", "[sequence]\ninterval_s = 5\n"),
              HasSubstr("sequence.interval_s: stands without frames; add frames or remove it"));
  EXPECT_THAT(fault_of("4", "[sequence]\nspeed_mps = [100, 200]\n"),
              HasSubstr("sequence.speed_mps: stands without frames"));
  EXPECT_THAT(fault_of("4", "[sequence]\nframes = 2\ncourse_deg = [0, 90]\n"),
              HasSubstr("sequence.course_deg: stands without speed_mps"));
  EXPECT_THAT(fault_of("4", "[[targets]]\nname = \"car\"\nnumber = [1, 2]\nrcs_dbsm = [3, 9]\nheading_deg = [0, 9]\n"),
              HasSubstr("heading_deg: stands without speed_mps"));
}

TEST_F(DatasetSpecFile, RefusesRadarsOfOtherModes) {
  radar_ = "beam_width_deg = 2.0\n[platform]\nspeed_mps = 150\n[mode]\nkind = \"spotlight\"\n";
  EXPECT_THAT(
      fault_of("4"),
      HasSubstr("radar.toml: mode.kind: is spotlight, and datasets are made of real-beam maps; take the [mode]"));
  radar_ = "beam_width_deg = 2.0\n[mode]\nkind = \"spotlight\"\n";
  EXPECT_THAT(fault_of("4"), HasSubstr("radar.toml: mode.kind: is spotlight, and datasets are made"))
      << "whose platform would have to move";
  radar_ = "beam_width_deg = 2.0\n[mode]\nkind = \"real-beam\"\n";
  EXPECT_EQ(fault_of("4"), "");
  radar_ = "beam_width_deg = 2.0\nearth_refraction = 1.333\n";
  EXPECT_THAT(fault_of("4"), HasSubstr("radar.toml: radar.earth_refraction: is given, and real-beam maps are made over "
                                       "a flat Earth"));
}

TEST_F(DatasetSpecFile, RefusesABeamThatPointsToOneSide) {
  radar_ = "beam_width_deg = 2.0\n[scan]\nkind = \"sector\"\nazimuth_deg = 90\nsector_deg = 40\nrate_deg_per_s = 10\n";
  EXPECT_THAT(fault_of("4"), HasSubstr("radar.toml: scan.azimuth_deg: is given, and a dataset's radar looks from many "
                                       "sides; leave it out"));
  radar_ = "beam_width_deg = 2.0\n[scan]\nkind = \"sector\"\nsector_deg = 40\nrate_deg_per_s = 10\n";
  EXPECT_EQ(fault_of("4"), "");
}

TEST_F(DatasetSpecFile, RefusesASecondWidthOfAMeasuredBeam) {
  const std::string width = "[radar]\nbeam_width_deg = [1, 2]\n";
  EXPECT_EQ(fault_of("4", width), "");
  folder_.write("cut.csv", "offset_deg,gain_db\n-4,10\n-2,26.98970004336\n0,30\n2,26.98970004336\n4,10\n");
  radar_ = "[antenna]\nazimuth_shape = \"table\"\nazimuth_csv = \"cut.csv\"\n";
  EXPECT_EQ(fault_of("4"), "");
  EXPECT_THAT(fault_of("4", width), HasSubstr("spec.toml: radar.beam_width_deg: and the radar file's "
                                              "antenna.azimuth_csv both give the beam its width"));
}

TEST_F(DatasetSpecFile, RefusesResolutionsThatAStatedPulseCannotHave) {
  const std::string upto_9_m = "[radar]\nrange_resolution_m = [1, 9]\n";
  EXPECT_EQ(fault_of("4", upto_9_m), "") << "a pulse as short as can be goes with the resolution";
  radar_ = "beam_width_deg = 0.1\n[waveform]\npulse_length_us = 0.04\n";
  EXPECT_EQ(fault_of("4", "[radar]\nrange_resolution_m = [1, 5.3]\n"), "");
  EXPECT_THAT(fault_of("4", upto_9_m),
              HasSubstr("spec.toml: radar.range_resolution_m: reaches 9 m, coarser than the radar file's "
                        "waveform.pulse_length_us can be; stay within "));
}

TEST_F(DatasetSpecFile, RefusesPulsesForWhoseBandACarrierHasNoRoom) {
  const auto drawn = [&](const std::string& frequencies_ghz, const std::string& resolutions_m) {
    return fault_of("4",
                    "[radar]\nfrequency_ghz = " + frequencies_ghz + "\nrange_resolution_m = " + resolutions_m + "\n");
  };
  EXPECT_EQ(drawn("[1, 9]", "[0.1, 9]"), "");
  // 1.2479 c/(4 f) for the usual window.
  EXPECT_THAT(drawn("[0.5, 9]", "[0.1, 9]"),
              HasSubstr("spec.toml: radar.range_resolution_m: lets a pulse of 0.1 m be drawn, whose band about 0.5 GHz "
                        "reaches down to no frequency at all; stay above 0.187"));
}

TEST_F(DatasetSpecFile, TellsHowToWriteBearingsAcrossNorth) {
  const auto course = [&](const char* ends) {
    return fault_of("4", std::string("[sequence]\nframes = 2\nspeed_mps = [90, 90]\ncourse_deg = ") + ends + "\n");
  };
  EXPECT_THAT(course("[350, 10]"), HasSubstr("sequence.course_deg: begins at 350 and ends before that, at 10; write "
                                             "[350, 370] for what leads across north, or else put the smaller number "
                                             "first"));
  EXPECT_THAT(course("[10, -20]"), HasSubstr("write [10, 340] for"));
  EXPECT_THAT(course("[360, 0]"), HasSubstr("ends before that, at 0; write [0, 360] for all bearings"));
  EXPECT_THAT(course("[700, 10]"), HasSubstr("write [340, 370] for what leads across north"));
  EXPECT_THAT(course("[720, 0]"), HasSubstr("write [0, 360] for all bearings"));
  EXPECT_EQ(course("[350, 370]"), "");
  EXPECT_THAT(fault_of("4", "[noise]\nsnr_db = [20, 10]\n"),
              HasSubstr("noise.snr_db: begins at 20 and ends before that, at 10; put the smaller number first"));
}

TEST_F(DatasetSpecFile, NamesAllLayersThatThereAre) {
  folder_.write("scene.toml", "[paper]\n");
  folder_.write("radar.toml", "[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 4.0\nbeam_width_deg = 0.1\n");
  const auto file = folder_.write(
      "spec.toml", "[dataset]\nscene = \"scene.toml\"\nradar = \"radar.toml\"\ncount = 1\nlayers = [\"bounce\"]\n");
  EXPECT_THAT(
      message_of_error([&] { static_cast<void>(read_dataset_spec(file)); }),
      HasSubstr("dataset.layers: layer \"bounce\": is not known; choose among shadow, layover, incidence, range, "
                "class, height; of bounces there are bounce1 to bounce9 and multibounce"));
}

TEST_F(DatasetSpecFile, TakesNoFolderForAFile) {
  std::filesystem::create_directories(folder_.path("flat"));
  folder_.write("scene.toml", "[paper]\n");
  for (const auto& [key, file] : {std::pair("radar", "scene = \"scene.toml\"\nradar = \"flat\"\n"),
                                  std::pair("scene", "scene = \"flat\"\nradar = \"scene.toml\"\n")}) {
    const auto spec = folder_.write("spec.toml", std::string("[dataset]\ncount = 4\n") + file);
    EXPECT_EQ(message_of_error([&] { static_cast<void>(read_dataset_spec(spec)); }),
              spec.string() + ": dataset." + key + ": " + folder_.path("flat").string() +
                  " is a folder; give the path of a TOML file");
  }
}

TEST_F(DatasetSpecFile, TakesNothingTwice) {
  EXPECT_EQ(fault_of("4\nlayers = [\"shadow\", \"class\"]\npolarizations = [\"VV\", \"HV\"]"), "");
  EXPECT_THAT(fault_of("4\nlayers = [\"shadow\", \"class\", \"shadow\"]"),
              HasSubstr("dataset.layers: names \"shadow\" twice; leave out one of them"));
  EXPECT_THAT(fault_of("4\nlayers = [\"bounce1\", \"bounce1\"]"), HasSubstr("dataset.layers: names \"bounce1\" twice"));
  EXPECT_THAT(fault_of("4\npolarizations = [\"VV\", \"VV\"]"), HasSubstr("dataset.polarizations: names \"VV\" twice"));
}

TEST_F(DatasetSpecFile, TakesNoTwoClassesOfOneName) {
  const std::string boat = "[[targets]]\nname = \"boat\"\nnumber = [1, 2]\nrcs_dbsm = [10, 20]\n";
  EXPECT_EQ(fault_of("4", boat), "");
  EXPECT_THAT(fault_of("4", boat + boat), HasSubstr("name: 'boat' is that of another class of targets; give each"));
}

TEST_F(DatasetSpecFile, TakesNoTargetsThatNoImageShows) {
  const std::string boat = "[[targets]]\nname = \"boat\"\nnumber = [1, 2]\nrcs_dbsm = [10, 20]\n";
  EXPECT_THAT(
      fault_of("4\npolarizations = [\"HV\"]", boat),
      HasSubstr("rcs_dbsm: is in VV and HH, and images of HV alone show nothing of it; add one of the others to "
                "dataset.polarizations"));
  for (const char* other : {"VV", "HH", "sum"})
    EXPECT_EQ(fault_of(std::string("4\npolarizations = [\"HV\", \"") + other + "\"]", boat), "") << other;
  EXPECT_EQ(fault_of("4\npolarizations = [\"HV\"]"), "");
}

TEST_F(DatasetSpecFile, FillsVariablesIntoThePathsOfAllAtlases) {
  std::filesystem::create_directories(folder_.path("atlas"));
  const std::string bounces =
      "4\natlas = \"atlas\"\nlayers = [\"bounce2\"]\n"
      "bounce_atlases = [\"${SIGMASCAPE_NO_SUCH_NAME:-once}/of\", \"twice\"]";
  EXPECT_THAT(fault_of(bounces), HasSubstr("dataset.bounce_atlases: the folder " + folder_.path("once/of").string() +
                                           " does not exist; correct the path"));
  std::filesystem::create_directories(folder_.path("once/of"));
  std::filesystem::create_directories(folder_.path("twice"));
  EXPECT_EQ(fault_of(bounces), "");
  EXPECT_THAT(read_dataset_spec(folder_.path("spec.toml")).bounce_atlases,
              ::testing::ElementsAre(folder_.path("once/of"), folder_.path("twice")));
  EXPECT_THAT(fault_of("4\natlas = \"atlas\"\nbounce_atlases = [\"${SIGMASCAPE_NO_SUCH_NAME}\"]"),
              HasSubstr("bounce_atlases: the environment variable SIGMASCAPE_NO_SUCH_NAME is not set"));
}

TEST_F(DatasetSpecFile, TakesNoKeyThatWouldDoNothing) {
  for (const char* atlas : {"atlas", "first"}) std::filesystem::create_directories(folder_.path(atlas));
  const std::string baked = "4\natlas = \"atlas\"\n", first = "first_bounce_atlas = \"first\"\n",
                    list = "bounce_atlases = [\"first\"]\n", layers = "layers = [\"bounce1\"]\n";
  EXPECT_EQ(fault_of(baked + first + layers), "");
  EXPECT_EQ(fault_of(baked + list + layers), "");
  EXPECT_THAT(fault_of(baked + first), HasSubstr("dataset.first_bounce_atlas: stands without a layer of bounces; add a "
                                                 "layer of bounces or remove it"));
  EXPECT_THAT(fault_of(baked + list + "layers = [\"shadow\"]\n"),
              HasSubstr("dataset.bounce_atlases: stands without a layer of bounces"));
  EXPECT_THAT(fault_of("4\n" + first + layers), HasSubstr("dataset.first_bounce_atlas: stands without atlas"));
  EXPECT_THAT(fault_of("4\n" + list + layers), HasSubstr("dataset.bounce_atlases: stands without atlas"));
  EXPECT_THAT(fault_of(baked + "bounce_atlases = [\"first\", \"atlas\"]\n" + layers),
              HasSubstr("dataset.bounce_atlases: names 2, of which the layers take the first 1; leave out the others"));
  EXPECT_EQ(fault_of("4\nsamples_per_cell = 8"), "");
  EXPECT_THAT(fault_of(baked + "samples_per_cell = 8"),
              HasSubstr("dataset.samples_per_cell: stands beside atlas, with which no rays are traced; leave one of"));
}

TEST_F(DatasetSpecFile, TakesNoClassWithoutAName) {
  EXPECT_THAT(fault_of("4", "[[targets]]\nname = \"\"\nnumber = [1, 2]\nrcs_dbsm = [10, 20]\n"),
              HasSubstr("name: is empty; give the class a name"));
}

TEST_F(DatasetSpecFile, KeepsThePiecesToFiftyThousand) {
  EXPECT_EQ(fault_of("100000000\nsamples_per_shard = 2000"), "");
  EXPECT_EQ(fault_of("50000\nsamples_per_shard = 1"), "");
  EXPECT_THAT(fault_of("100000000\nsamples_per_shard = 1999"),
              HasSubstr("dataset.samples_per_shard: is 1999, which makes more than 50000 pieces of 100000000 samples; "
                        "give 2000 or more, or ask for fewer samples in count"));
  EXPECT_THAT(fault_of("50001\nsamples_per_shard = 1"), HasSubstr("give 2 or more"));
}

// Which parts of a radar are the same is told by the bytes of its file and of its tables.
TEST_F(DatasetSpecFile, TellsRadarsApartByFileAndTables) {
  const auto hash = [&] {
    EXPECT_EQ(fault_of("4"), "");
    return read_dataset_spec(folder_.path("spec.toml")).radar_hash;
  };
  const std::string even = hash();
  EXPECT_EQ(hash(), even);
  radar_ = "beam_width_deg = 0.2\n";
  EXPECT_NE(hash(), even);
  radar_ = "[antenna]\nazimuth_shape = \"table\"\nazimuth_csv = \"cut.csv\"\n";
  folder_.write("cut.csv", "offset_deg,gain_db\n-4,10\n-2,26.98970004336\n0,30\n2,26.98970004336\n4,10\n");
  const std::string measured = hash();
  folder_.write("cut.csv", "offset_deg,gain_db\n-4,10\n-1,26.98970004336\n0,30\n1,26.98970004336\n4,10\n");
  EXPECT_NE(hash(), measured);
}

}  // namespace
}  // namespace sigmascape::dataset
