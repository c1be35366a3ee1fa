#include "sigmascape/bake/tile_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <span>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::bake {
namespace {

/// A tile of a few cells that all lie in one texel. Sample s brings 1 m² from there and, if it is odd, 2 m² more.
class MadeTile : public trace::TilePaths {
 public:
  explicit MadeTile(std::size_t cells) : cells_(cells) {}

  [[nodiscard]] std::span<const trace::LaunchCell> cells() const override { return cells_; }
  void follow(std::span<const trace::PathStart> starts) override {
    starts_ = starts;
    most_at_once = std::max(most_at_once, starts.size());
    followed += starts.size();
  }
  [[nodiscard]] std::span<const radar::Echo> echoes(std::size_t, std::size_t start) const override {
    return std::span(echoes_).first(1 + starts_[start].sample % 2);
  }
  [[nodiscard]] std::span<const radar::ComplexChannels> amplitudes_m(std::size_t, std::size_t) const override {
    return {};
  }

  std::size_t most_at_once = 0, followed = 0;

 private:
  static radar::Echo echo_of(float m2, std::uint8_t bounces) {
    radar::Echo echo;
    echo.rcs_m2 = {m2, 0.0F, 0.0F, 0.0F};
    echo.bounces = bounces;
    return echo;
  }

  std::vector<trace::LaunchCell> cells_;
  std::span<const trace::PathStart> starts_;
  std::array<radar::Echo, 2> echoes_{echo_of(1.0F, 1), echo_of(2.0F, 2)};
};

constexpr radar::GroundGrid one_texel{-8.0, 8.0, 16.0, 1, 1};

/// What one texel of 256 m² gets of a tile.
struct Sampled {
  double sigma0, variance;
};
Sampled sampled(MadeTile& tile, const Sampling& sampling) {
  std::vector<PatchSums> patch;
  patch.push_back({receiver::GroundAccumulator(one_texel), {}});
  const EchoLanding landing({0.0, radians_from_deg(45.0)});
  const BakeSettings settings{.sampling = sampling, .shadows = Shadows::Baked};
  TileSampler(settings, landing, patch).sample(tile, 1.0);
  return {static_cast<double>(patch.front().all.sigma0()(0, 0).vv), patch.front().all.sigma0_variances()(0, 0)};
}

// A cell may have a million: what all its paths bring at once would be hundreds of megabytes a thread.
TEST(TileSampler, OfACellOfManySamplesSomeAreFollowedAtATime) {
  for (const std::uint32_t samples : {2U, 20'000U, 99'991U}) {
    MadeTile tile(3);
    const double n = samples, odd = samples / 2;
    const Sampled texel = sampled(tile, {.samples_per_texel = samples});
    EXPECT_EQ(tile.followed, 3U * samples);
    EXPECT_LE(tile.most_at_once, 16'384U);
    EXPECT_NEAR(texel.sigma0, 3.0 * (n + 2.0 * odd) / n / one_texel.cell_area_m2(), 1e-6) << samples;
  }
}

TEST(TileSampler, PilotsCountAmongTheSamplesOfACell) {
  MadeTile tile(3);
  // Powers of 1 and 3 m²: mean 2, and of eight pilots a variance of 8/7.
  const double wanted = 40'000.0, target = std::sqrt(8.0 / 7.0 / wanted) / 2.0;
  const Sampled texel = sampled(tile, {.target_db = db_from_linear(1.0 + target), .most_samples = most_samples_a_cell});
  EXPECT_NEAR(static_cast<double>(tile.followed), 3.0 * wanted, 3.0 * 2.0);
  EXPECT_LE(tile.most_at_once, 16'384U);
  EXPECT_NEAR(texel.sigma0, 3.0 * 2.0 / one_texel.cell_area_m2(), 1e-6);
}

}  // namespace
}  // namespace sigmascape::bake
