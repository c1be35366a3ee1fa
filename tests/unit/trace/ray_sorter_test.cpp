#include "sigmascape/trace/ray_sorter.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"

namespace sigmascape::trace {
namespace {

/// Rays that begin within 2 m of four corners of a square of 40 m and go up or down, all mixed up.
std::vector<Ray> mixed_rays(std::size_t count) {
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto drawn = [i](int n) { return unit_float(hashed(i, n)); };
    const Vec3f corner{drawn(1) < 0.5F ? -20.0F : 20.0F, drawn(2) < 0.5F ? -20.0F : 20.0F, 0.0F};
    rays.push_back({corner + Vec3f{2.0F * drawn(3), 2.0F * drawn(4), 2.0F * drawn(5)},
                    {0.0F, 0.0F, drawn(6) < 0.5F ? -1.0F : 1.0F}});
  }
  return rays;
}

std::size_t turns(const std::vector<Ray>& rays, std::span<const std::uint32_t> numbers) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const Ray &a = rays[numbers[i - 1]], &b = rays[numbers[i]];
    const bool is_same_corner =
        (a.origin.x < 0.0F) == (b.origin.x < 0.0F) && (a.origin.y < 0.0F) == (b.origin.y < 0.0F);
    count += is_same_corner && a.direction.z == b.direction.z ? 0U : 1U;
  }
  return count;
}

TEST(RaySorter, EveryRayHasItsTurn) {
  RaySorter sorter;
  for (const std::size_t count : {5000U, 3U, 0U}) {
    const std::vector<Ray> rays = mixed_rays(count);
    const auto numbers = sorter.sorted(rays);
    std::vector<std::uint32_t> all(numbers.begin(), numbers.end());
    std::ranges::sort(all);
    ASSERT_EQ(all.size(), count);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(all[i], i);
  }
}

// Eight kinds of rays have seven borders between them.
TEST(RaySorter, PlacesAndDirectionsComeOneAfterAnother) {
  const std::vector<Ray> rays = mixed_rays(5000);
  RaySorter sorter;
  EXPECT_EQ(turns(rays, sorter.sorted(rays)), 7U);
}

}  // namespace
}  // namespace sigmascape::trace
