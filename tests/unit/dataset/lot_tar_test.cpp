#include "sigmascape/dataset/lot_tar.h"

#include <array>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "peak_memory.h"
#include "scratch_folder.h"

namespace sigmascape::dataset {
namespace {

TEST(LotTar, HasTheSameBytesInWhateverOrderSamplesAreMade) {
  const ScratchFolder folder;
  const auto made = [&](std::array<std::size_t, 4> order) {
    LotTar tar(folder.path("lot.tar"), 8);
    for (const std::size_t sample : order) tar.add(sample, {{"map.npy", std::string(100 * sample, 'm')}, {"a", "b"}});
    return tar.put_in_place();
  };
  const LotTar::Written in_order = made({8, 9, 10, 11});
  const auto expected = files_of(folder.path(""));
  EXPECT_EQ(in_order.bytes, expected.at("lot.tar").size());
  EXPECT_EQ(in_order.sha256, sha256_of(expected.at("lot.tar")));
  for (const auto& order : {std::array<std::size_t, 4>{11, 10, 9, 8}, {9, 8, 11, 10}}) {
    EXPECT_EQ(made(order).sha256, in_order.sha256);
    EXPECT_EQ(difference_of(files_of(folder.path("")), expected), "");
  }
}

TEST(LotTar, LeavesNothingOfALotThatWasBrokenOff) {
  const ScratchFolder folder;
  {
    LotTar tar(folder.path("lot.tar"), 0);
    tar.add(0, {{"map.npy", "numbers"}});
    EXPECT_FALSE(std::filesystem::exists(folder.path("lot.tar")));
  }
  EXPECT_EQ(difference_of(files_of(folder.path("")), {}), "");
}

// Of 256 MiB, of which no more than one sample before its turn waits.
TEST(LotTar, KeepsInMemoryWhatWaitsAlone) {
  if (!memory_is_ours) GTEST_SKIP() << "sanitizers keep what is given back";
  const ScratchFolder folder;
  LotTar tar(folder.path("lot.tar"), 0);
  const long before_kib = peak_memory_kib();
  for (std::size_t pair = 0; pair < 32; ++pair) {
    for (const std::size_t sample : {2 * pair + 1, 2 * pair})
      tar.add(sample, {{"map.npy", std::string(1U << 22U, 'm')}});
  }
  EXPECT_GT(tar.put_in_place().bytes, 1U << 28U);
  EXPECT_LT(peak_memory_kib() - before_kib, 32 * 1024);
}

}  // namespace
}  // namespace sigmascape::dataset
