#pragma once

#include <cstddef>
#include <string_view>

namespace sigmascape::bake {

/// One of several equal shares of a bake, for a machine or process of its own. Shares are counted from 0, as the tasks
/// of job arrays are. Which share a job falls to shows in nothing that is written.
struct Shard {
  std::size_t index = 0;
  std::size_t count = 1;

  friend constexpr bool operator==(const Shard&, const Shard&) = default;

  /// Whether job number `job` is in this share, where jobs are dealt one by one. It is done like cards, each round
  /// beginning one place further: neighbouring jobs differ in azimuth, those some way apart in elevation, on which
  /// their time depends most, and without the shift a share could get the same elevation of every patch.
  [[nodiscard]] constexpr bool has(std::size_t job) const { return (job + job / count) % count == index; }
};

/// A share written "2/8". Throws Error when it is not two whole numbers, or the first not below the second.
[[nodiscard]] Shard shard_from(std::string_view text);

/// Throws Error when the index is not below the count.
void check(const Shard& shard);

}  // namespace sigmascape::bake
