#include "sigmascape/dataset/sample_files.h"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
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

}  // namespace
}  // namespace sigmascape::dataset
