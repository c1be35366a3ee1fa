#include "sigmascape/bake/job_share.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::bake {
namespace {

constexpr std::size_t aspects = 10;

/// Five azimuths at each of two elevations of so many patches.
JobList jobs_of(std::size_t columns, std::size_t rows) {
  atlas::AtlasDescription atlas;
  atlas.patches = {.texel_m = 1.0, .texels_per_side = 256};
  atlas.extent = {0.0, 0.0, 256.0 * static_cast<double>(columns), 256.0 * static_cast<double>(rows)};
  atlas.aspects = {{}, {radians_from_deg(5.0), radians_from_deg(37.0)}, {10e9}};
  for (int i = 0; i < 5; ++i) atlas.aspects.azimuths_rad.push_back(radians_from_deg(72.0 * i));
  return JobList(atlas);
}

/// The share that each job falls to; fails where that is not exactly one.
std::vector<std::size_t> owners_of(const JobList& jobs, std::size_t shares) {
  std::vector<std::size_t> owners(jobs.size(), shares);
  for (std::size_t index = 0; index < shares; ++index) {
    const JobShare share(jobs, {index, shares});
    for (std::size_t job = 0; job < jobs.size(); ++job) {
      if (!share.has(job)) continue;
      EXPECT_EQ(owners[job], shares) << "job " << job << " is in two shares of " << shares;
      owners[job] = index;
    }
  }
  EXPECT_EQ(std::ranges::count(owners, shares), 0) << "in no share of " << shares;
  return owners;
}

TEST(JobShare, EveryJobIsInExactlyOneShare) {
  for (const std::size_t shares : {1U, 2U, 3U, 6U, 8U, 12U, 40U, 1000U}) {
    for (const JobList& jobs : {jobs_of(1, 1), jobs_of(13, 21), jobs_of(300, 1)}) owners_of(jobs, shares);
  }
}

TEST(JobShare, OfManyPatchesEachIsWhole) {
  const JobList jobs = jobs_of(13, 21);
  for (const std::size_t shares : {1U, 2U, 3U, 5U}) {
    EXPECT_TRUE(JobShare(jobs, {0, shares}).has_whole_patches()) << shares;
    const std::vector<std::size_t> owners = owners_of(jobs, shares);
    for (std::size_t job = 0; job < owners.size(); ++job)
      ASSERT_EQ(owners[job], owners[job / aspects * aspects]) << job << " of " << shares;
  }
}

TEST(JobShare, EveryPatchIsInOneShareAndWithItsLooksWhereThoseAreTogether) {
  const JobList jobs = jobs_of(13, 21);
  for (const std::size_t shares : {1U, 2U, 5U, 6U, 40U}) {
    std::vector<std::size_t> owners(jobs.patches().size(), 0);
    for (std::size_t index = 0; index < shares; ++index) {
      const JobShare share(jobs, {index, shares});
      for (std::size_t patch = 0; patch < owners.size(); ++patch) {
        owners[patch] += share.has_patch(patch) ? 1 : 0;
        if (share.has_whole_patches()) {
          ASSERT_EQ(share.has_patch(patch), share.has(patch * aspects)) << patch << " of " << shares;
        }
      }
    }
    EXPECT_EQ(std::ranges::count(owners, 1U), std::ssize(owners)) << shares;
  }
}

TEST(JobShare, OfFewPatchesTheJobsAreDealtOneByOne) {
  const JobList jobs = jobs_of(13, 21);
  for (const std::size_t shares : {6U, 20U, 100U}) {
    EXPECT_FALSE(JobShare(jobs, {0, shares}).has_whole_patches()) << shares;
    const std::vector<std::size_t> owners = owners_of(jobs, shares);
    for (std::size_t job = 0; job < owners.size(); ++job) ASSERT_TRUE((Shard{owners[job], shares}.has(job)));
  }
}

/// How much longer the slowest share takes than all of them on the mean, if patches take so long.
template <typename SecondsOf>
double slowest_over_mean(std::size_t columns, std::size_t rows, std::size_t shares, const SecondsOf& seconds_of) {
  const std::vector<std::size_t> owners = owners_of(jobs_of(columns, rows), shares);
  std::vector<double> seconds(shares, 0.0);
  for (std::size_t patch = 0; patch < columns * rows; ++patch)
    seconds[owners[patch * aspects]] += seconds_of(patch % columns, patch / columns);
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  return std::ranges::max(seconds) * static_cast<double>(shares) / all;
}

// Dealt like cards from a row of patches on, shares as many as a row is long get a column each.
TEST(JobShare, SharesGetTownAndSeaAlike) {
  const struct {
    std::size_t columns, rows, shares;
  } places[] = {{16, 50, 16}, {28, 29, 16}, {22, 23, 10}, {9, 56, 10},
                {57, 57, 64}, {45, 45, 40}, {52, 52, 54}, {68, 68, 90}};
  for (const auto& [columns, rows, shares] : places) {
    const auto coast = [half = columns / 2](std::size_t column, std::size_t) { return column < half ? 0.3 : 1.5; };
    const auto town = [&](std::size_t column, std::size_t row) {
      const bool is_in_town = 2 * column > columns && 3 * column < 2 * columns && 2 * row > rows && 3 * row < 2 * rows;
      return is_in_town ? 3.0 : 1.0;
    };
    const auto slanted = [&](std::size_t column, std::size_t row) {
      return 2 * (column + row) < columns + rows ? 0.3 : 1.5;
    };
    EXPECT_LT(slowest_over_mean(columns, rows, shares, coast), 1.15) << columns << " × " << rows << ", " << shares;
    EXPECT_LT(slowest_over_mean(columns, rows, shares, slanted), 1.15) << columns << " × " << rows << ", " << shares;
    EXPECT_LT(slowest_over_mean(columns, rows, shares, town), 1.15) << columns << " × " << rows << ", " << shares;
  }
}

}  // namespace
}  // namespace sigmascape::bake
