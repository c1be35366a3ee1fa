#include "sigmascape/trace/ray_sorter.h"

#include <array>
#include <utility>

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::trace {
namespace {

constexpr unsigned digit_bits = 8, key_bits = 3 * digit_bits;

/// The last five bits of a number with two places between each two.
std::uint32_t spread_in_three(std::uint32_t number) {
  std::uint32_t bits = number & 0x1fU;
  bits = (bits | bits << 8U) & 0x100fU;
  bits = (bits | bits << 4U) & 0x10c3U;
  return (bits | bits << 2U) & 0x1249U;
}

std::uint32_t along_curve(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return spread_in_three(x) | spread_in_three(y) << 1U | spread_in_three(z) << 2U;
}

std::uint32_t whole_metres(float coordinate_m) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(coordinate_m + 65536.0F));
}

/// Which quarter of −1 to 1 a coordinate of a direction lies in.
std::uint32_t quarter(float coordinate) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(coordinate * 1.999F + 2.0F));
}

/// First the cube of 4 m, then the direction, then the metre within the cube. Of a cube's number as much is sorted by
/// as tells apart those of 64 m, and hardly any rays of a tile are farther from one another.
std::uint32_t key_of(const Ray& ray) {
  const auto& [o, d] = ray;
  const std::uint32_t x = whole_metres(o.x), y = whole_metres(o.y), z = whole_metres(o.z);
  const std::uint32_t cube = along_curve(x >> 2U, y >> 2U, z >> 2U), within = along_curve(x & 3U, y & 3U, z & 3U);
  const std::uint32_t way = along_curve(quarter(d.x), quarter(d.y), quarter(d.z));
  return cube << 12U | way << 6U | within;
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void find_keys(std::span<const Ray> rays, std::span<std::uint32_t> keys) {
  for (std::size_t i = 0; i < rays.size(); ++i) keys[i] = key_of(rays[i]);
}

}  // namespace

std::span<const std::uint32_t> RaySorter::sorted(std::span<const Ray> rays) {
  keys_.resize(rays.size());
  find_keys(rays, keys_);
  entries_.resize(rays.size());
  moved_.resize(rays.size());
  std::array<std::array<std::uint32_t, 1U << digit_bits>, key_bits / digit_bits> next{};
  const auto digit = [](std::uint32_t key, std::size_t place) {
    return key >> (place * digit_bits) & ((1U << digit_bits) - 1U);
  };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    entries_[i] = {keys_[i], static_cast<std::uint32_t>(i)};
    for (std::size_t place = 0; place < next.size(); ++place) ++next[place][digit(keys_[i], place)];
  }
  for (std::size_t place = 0; place < next.size(); ++place) {
    std::uint32_t before = 0;
    for (std::uint32_t& count : next[place]) before += std::exchange(count, before);
    for (const Entry& entry : entries_) moved_[next[place][digit(entry.key, place)]++] = entry;
    std::swap(entries_, moved_);
  }
  numbers_.clear();
  for (const Entry& entry : entries_) numbers_.push_back(entry.number);
  return numbers_;
}

}  // namespace sigmascape::trace
