#include "sigmascape/base/sobol.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace sigmascape {
namespace {

/// Whether every box of 2^-across by 2^-(k - across) holds exactly one of the 2^k points.
bool is_net(const std::vector<Vec2f>& points, unsigned k) {
  for (unsigned across = 0; across <= k; ++across) {
    const unsigned down = k - across;
    std::vector<int> boxes(std::size_t{1} << k, 0);
    for (const Vec2f point : points) {
      const auto column = static_cast<std::size_t>(std::ldexp(point.x, static_cast<int>(across)));
      const auto row = static_cast<std::size_t>(std::ldexp(point.y, static_cast<int>(down)));
      ++boxes[(row << across) + column];
    }
    if (std::ranges::any_of(boxes, [](int count) { return count != 1; })) return false;
  }
  return true;
}

std::vector<Vec2f> points_of(std::uint64_t key, std::uint32_t pair, std::uint32_t first, std::uint32_t count) {
  std::vector<Vec2f> points;
  for (std::uint32_t index = first; index < first + count; ++index) points.push_back(SobolPoint(key, index).pair(pair));
  return points;
}

TEST(SobolPoint, EveryAlignedRunIsANet) {
  for (const std::uint64_t key : {0ULL, 1ULL, 0xfeedfacecafebeefULL}) {
    for (const std::uint32_t pair : {0U, 1U, 7U}) {
      for (unsigned k = 0; k <= 10; ++k) {
        for (const std::uint32_t run : {0U, 1U, 2U, 5U, 1000U}) {
          EXPECT_TRUE(is_net(points_of(key, pair, run << k, 1U << k), k))
              << "key " << key << ", pair " << pair << ", 2^" << k << " points from " << (run << k);
        }
      }
    }
  }
}

TEST(SobolPoint, NetTestRefusesWhatIsNoNet) {
  auto points = points_of(3, 0, 0, 64);
  std::swap(points[1].x, points[2].y);
  EXPECT_FALSE(is_net(points, 6));
  // A run that is not aligned is made of halves of two nets.
  int nets = 0;
  for (std::uint64_t key = 0; key < 20; ++key) nets += is_net(points_of(key, 0, 7, 16), 4) ? 1 : 0;
  EXPECT_LT(nets, 5);
}

TEST(SobolPoint, NeighboursShareABoxOfTwoPoints) {
  for (unsigned k = 1; k <= 12; ++k) {
    const int down = static_cast<int>(k - 1) / 2, across = static_cast<int>(k) - 1 - down;
    const auto box_of = [&](std::uint64_t key, std::uint32_t index) {
      const Vec2f point = SobolPoint(key, index).pair(0);
      return std::pair(std::floor(std::ldexp(point.x, across)), std::floor(std::ldexp(point.y, down)));
    };
    for (const std::uint64_t key : {0ULL, 77ULL, 0xfeedfacecafebeefULL}) {
      for (const std::uint32_t run : {0U, 1U, 6U}) {
        for (std::uint32_t index = run << k; index < (run + 1) << k; ++index) {
          const std::uint32_t neighbour = SobolPoint::neighbour(index, k);
          ASSERT_NE(neighbour, index);
          ASSERT_EQ(neighbour >> k, run);
          ASSERT_EQ(SobolPoint::neighbour(neighbour, k), index);
          ASSERT_EQ(box_of(key, neighbour), box_of(key, index)) << "index " << index << " of 2^" << k;
        }
      }
    }
  }
}

TEST(SobolPoint, ScramblingMovesPointsAboutWithKeyAndPair) {
  const Vec2f first = SobolPoint(1, 0).pair(0);
  EXPECT_NE(first, SobolPoint(2, 0).pair(0));
  EXPECT_NE(first, SobolPoint(1, 0).pair(1));
  EXPECT_EQ(first, SobolPoint(1, 0).pair(0));
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return 12.0 * sum / static_cast<double>(a.size());
}

TEST(SobolPoint, PairsAndKeysAreUncorrelated) {
  constexpr std::uint32_t count = 1U << 14U;
  // The standard deviation of the correlation of N independent pairs is 1/√N.
  const double bound = 5.0 / std::sqrt(static_cast<double>(count));
  struct Numbers {
    std::uint32_t pair;
    std::vector<float> values;
  };
  std::vector<Numbers> numbers;
  for (const std::uint64_t key : {11ULL, 12ULL}) {
    for (std::uint32_t pair = 0; pair < 4; ++pair) {
      std::vector<float> x, y;
      for (const Vec2f point : points_of(key, pair, 0, count)) {
        x.push_back(point.x);
        y.push_back(point.y);
      }
      numbers.push_back({pair, std::move(x)});
      numbers.push_back({pair, std::move(y)});
    }
  }
  for (std::size_t a = 0; a < numbers.size(); ++a) {
    EXPECT_NEAR(correlation(numbers[a].values, numbers[a].values), 1.0, 1e-3);
    for (std::size_t b = 0; b < a; ++b) {
      // First pairs have one order of indices, whatever their key: see below.
      if (a / 8 != b / 8 && numbers[a].pair == 0 && numbers[b].pair == 0) continue;
      EXPECT_LT(std::abs(correlation(numbers[a].values, numbers[b].values)), bound) << a << " " << b;
    }
  }
}

TEST(SobolPoint, FirstPairsOfDifferentKeysAreUncorrelatedInTheMean) {
  constexpr std::uint32_t count = 64;
  constexpr int keys = 1000;
  double sum = 0.0;
  for (std::uint64_t key = 0; key < keys; ++key) {
    std::vector<float> of_one, of_other;
    for (const Vec2f point : points_of(2 * key, 0, 0, count)) of_one.push_back(point.x);
    for (const Vec2f point : points_of(2 * key + 1, 0, 0, count)) of_other.push_back(point.x);
    sum += correlation(of_one, of_other);
  }
  // Each is 3/4 up or down, for the first digit, and 3/16, 3/64 … for the next.
  EXPECT_LT(std::abs(sum / keys), 4.0 * 0.78 / std::sqrt(static_cast<double>(keys)));
}

// A product of four coordinates of two pairs has the mean 1/16 only if the pairs are joined at random.
TEST(SobolPoint, TwoPairsFillFourDimensions) {
  double sum = 0.0;
  constexpr int keys = 64;
  for (std::uint64_t key = 0; key < keys; ++key) {
    for (std::uint32_t index = 0; index < 256; ++index) {
      const SobolPoint point(key, index);
      const Vec2f a = point.pair(2), b = point.pair(3);
      sum += static_cast<double>(a.x * a.y * b.x * b.y);
    }
  }
  EXPECT_NEAR(sum / (keys * 256.0), 1.0 / 16.0, 1e-3);
}

TEST(SobolPoint, StaysBelowOne) {
  float highest = 0.0F, lowest = 1.0F;
  for (std::uint32_t index = 0; index < (1U << 18U); ++index) {
    const SobolPoint point(5, index);
    const Vec2f p = point.pair(0);
    const float independent = point.independent(3);
    highest = std::max({highest, p.x, p.y, independent});
    lowest = std::min({lowest, p.x, p.y, independent});
  }
  EXPECT_LT(highest, 1.0F);
  EXPECT_GE(lowest, 0.0F);
  EXPECT_GT(highest, 0.9999F);
  EXPECT_LT(lowest, 0.0001F);
}

TEST(SobolPoint, IndependentNumbersAreUniformAndUncorrelated) {
  std::vector<float> a, b;
  double sum = 0.0;
  constexpr std::uint32_t count = 1U << 14U;
  for (std::uint32_t index = 0; index < count; ++index) {
    a.push_back(SobolPoint(9, index).independent(0));
    b.push_back(SobolPoint(9, index).independent(1));
    sum += a.back();
  }
  EXPECT_NEAR(sum / count, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / count));
  EXPECT_LT(std::abs(correlation(a, b)), 5.0 / std::sqrt(static_cast<double>(count)));
}

}  // namespace
}  // namespace sigmascape
