#include "sigmascape/bake/shard.h"

#include <charconv>
#include <fmt/format.h>
#include <optional>

#include "sigmascape/base/error.h"

namespace sigmascape::bake {
namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

void check(const Shard& shard) {
  const std::string where = fmt::format("shard {}/{}", shard.index, shard.count);
  if (shard.count == 0) throw Error(where, "there are no shards", "give the number of shards after the stroke, as 0/1");
  if (shard.index < shard.count) return;
  throw Error(where, "is not one of them",
              fmt::format("shards are counted from 0: give 0/{0} to {1}/{0}", shard.count, shard.count - 1));
}

Shard shard_from(std::string_view text) {
  const std::size_t stroke = text.find('/');
  const auto index = whole_number(text.substr(0, stroke));
  const auto count = stroke < text.size() ? whole_number(text.substr(stroke + 1)) : std::nullopt;
  if (!index || !count) {
    throw Error(fmt::format("shard {}", text), "is not two whole numbers", "write it as 0/8, 1/8, up to 7/8");
  }
  const Shard shard{*index, *count};
  check(shard);
  return shard;
}

}  // namespace sigmascape::bake
