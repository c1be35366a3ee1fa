#include "sigmascape/dataset/sample_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sigmascape/atlas/half.h"

namespace sigmascape::dataset {
namespace {

/// The numbers of a map of four cells with these powers, as a dataset writes them in halves.
std::vector<float> written_halves(std::array<float, 4> powers, bool in_decibels) {
  DatasetSpec spec;
  spec.polarizations = {radar::Polarization::VV};
  spec.is_half = true;
  spec.in_decibels = in_decibels;
  spec.with_preview = false;
  Sample sample;
  sample.map.grid = {0.0, 2.0, 1.0, 2, 2};
  sample.map.sigma0 = Array2D<radar::Channels>(2, 2);
  for (std::size_t k = 0; k < 4; ++k) sample.map.sigma0.values()[k].vv = powers.at(k);
  const std::string bytes = sample_files(spec, sample).at(0).bytes;
  std::array<atlas::Half, 4> halves{};
  std::memcpy(halves.data(), bytes.data() + bytes.size() - sizeof(halves), sizeof(halves));
  std::vector<float> numbers;
  for (const atlas::Half half : halves) numbers.push_back(atlas::float_from_half(half));
  return numbers;
}

TEST(SampleFiles, HalvesNeverBecomeInfinite) {
  const auto linear = written_halves({0.25F, 65504.0F, 1e6F, std::numeric_limits<float>::quiet_NaN()}, false);
  EXPECT_EQ(linear[0], 0.25F);
  EXPECT_EQ(linear[1], 65504.0F);
  EXPECT_EQ(linear[2], 65504.0F);
  EXPECT_TRUE(std::isnan(linear[3]));
  EXPECT_EQ(written_halves({1.0F, 10.0F, 1e6F, 1e20F}, true), (std::vector<float>{0.0F, 10.0F, 60.0F, 200.0F}));
}

nlohmann::json metadata_of(const DatasetSpec& spec, const Sample& sample) {
  const std::vector<SampleFile> files = sample_files(spec, sample);
  return nlohmann::json::parse(std::ranges::find(files, "metadata.json", &SampleFile::name)->bytes);
}

TEST(SampleFiles, TellHowEachMapWasMade) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  DatasetSpec spec;
  spec.polarizations = {radar::Polarization::HV, radar::Polarization::Sum, radar::Polarization::VV};
  spec.with_preview = false;
  spec.looks = 4;
  spec.targets = {{.name = "ship", .number = {}, .rcs_db = {}, .size_m = 30.0, .height_m = 5.0}};
  Sample sample;
  sample.plan.seed = 18446744073709551615U;
  sample.plan.noise_sigma0_db = -20.0;
  sample.noise_sigma0 = 0.01;
  sample.targets = {{}};
  sample.map.grid = {0.0, 2.0, 1.0, 2, 2};
  sample.map.sigma0 = Array2D<radar::Channels>(2, 2);
  sample.map.sigma0(1, 0) = {nan, nan, nan, nan};
  const auto told = metadata_of(spec, sample);
  EXPECT_EQ(told.at("noise_sigma0"), nlohmann::json({0.01, 0.04, 0.01})) << "HV and VH are in the sum";
  EXPECT_EQ(told.at("part_without_data"), 0.25);
  EXPECT_EQ(told.at("looks"), 4);
  EXPECT_EQ(told.at("seed"), "18446744073709551615");
  EXPECT_EQ(told.at("targets")[0].at("size_m"), 30.0);
  EXPECT_EQ(told.at("targets")[0].at("height_m"), 5.0);
}

}  // namespace
}  // namespace sigmascape::dataset
