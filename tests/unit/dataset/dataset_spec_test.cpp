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
    folder_.write("radar.toml",
                  "[radar]\nfrequency_ghz = 10.0\nrange_resolution_m = 4.0\nbeam_width_deg = 0.1\n"
                  "[position]\nslant_range_km = 15.0\nazimuth_deg = 130.0\nelevation_deg = 13.0\n");
    const auto file =
        folder_.write("spec.toml", "[dataset]\nscene = \"scene.toml\"\nradar = \"radar.toml\"\ncount = " + count +
                                       "\n[view]\nazimuth_deg = [0, 360]\nelevation_deg = [8, 21]\n"
                                       "slant_range_km = [10, 20]\n" +
                                       sections);
    return message_of_error([&] { static_cast<void>(read_dataset_spec(file)); });
  }
  ScratchFolder folder_;
};

TEST_F(DatasetSpecFile, TakesWholeNumbersOfSamples) {
  EXPECT_EQ(fault_of("4"), "");
  EXPECT_THAT(fault_of("1.5"), HasSubstr("spec.toml: dataset.count: is 1.5; give a whole number"));
  EXPECT_THAT(fault_of("0"), HasSubstr("dataset.count: is 0; give a number from 1"));
}

TEST_F(DatasetSpecFile, KeepsSequencesWithinReach) {
  EXPECT_EQ(fault_of("4", "[sequence]\nframes = 4\ninterval_s = 2\nspeed_mps = [100, 200]\n"), "");
  EXPECT_THAT(fault_of("4", "[sequence]\nframes = 4\ninterval_s = 10\nspeed_mps = [0, 40000]\n"),
              HasSubstr("sequence.speed_mps"));
  EXPECT_THAT(fault_of("4", "[sequence]\nframes = 4\ninterval_s = 100\nspeed_mps = [0, 10000]\n"),
              HasSubstr("sequence.speed_mps: takes the radar as far as 3020 km away; stay within 1000 km"));
}

}  // namespace
}  // namespace sigmascape::dataset
