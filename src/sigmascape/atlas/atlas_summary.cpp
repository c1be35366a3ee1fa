#include "sigmascape/atlas/atlas_summary.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "sigmascape/atlas/error_target.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"

namespace sigmascape::atlas {
namespace {

std::uint64_t bytes_in(const std::filesystem::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::error_code vanished;
    const auto size = entry.is_regular_file(vanished) ? entry.file_size(vanished) : 0;
    if (!vanished) bytes += size;
  }
  return bytes;
}

/// Calls `visit` with the record of each look that is done.
template <typename Visit>
void visit_looks_done(const Store& store, const Visit& visit) {
  const AtlasDescription& description = store.description();
  const PatchBlock patches = description.patches.block_over(description.extent);
  const std::size_t look_count = description.aspects.look_count();
  for (std::size_t number = 0; number < store.unit_count(); ++number) {
    const PatchIndex patch = patches[number / look_count];
    const auto look = static_cast<LookIndex>(number % look_count);
    if (!store.is_done(patch, look)) continue;
    if (const auto record = texture_record(store.folder(), store.texture_path(patch, look))) visit(*record);
  }
}

/// Nothing when no texel returns anything.
std::optional<double> part_of(const TexelsAboveTarget& counts) {
  if (counts.lit == 0) return std::nullopt;
  return static_cast<double>(counts.above) / static_cast<double>(counts.lit);
}

AtlasSummary::Spread spread_of(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::ranges::sort(errors);
  return {errors.front(), errors[errors.size() / 2], errors.back()};
}

void count_pyramid(const Store& store, AtlasSummary& summary) {
  const Pyramid pyramid(store);
  const LayerPyramid obstacles = obstacle_pyramid(store);
  const bool has_obstacles = keeps_ground_apart(store);
  const auto count = [&summary](bool is_done) {
    ++summary.pyramid_textures;
    summary.pyramid_done += is_done ? 1 : 0;
  };
  summary.pyramid_levels = pyramid.levels();
  for (std::size_t level = 1; level <= pyramid.levels(); ++level) {
    for (const PyramidTile& tile : pyramid.tiles(level)) {
      const std::size_t looks = store.description().aspects.look_count();
      for (LookIndex look = 0; look < looks; ++look) count(pyramid.is_done(tile, look));
      if (has_obstacles) count(obstacles.is_done(tile));
    }
  }
}

}  // namespace

AtlasSummary summary_of(const Store& store) {
  const AtlasDescription& description = store.description();
  AtlasSummary summary;
  summary.patches = description.patches.block_over(description.extent).size();
  summary.looks = store.unit_count();
  summary.bytes = bytes_in(store.folder());
  std::vector<double> errors;
  TexelsAboveTarget above_target;
  visit_looks_done(store, [&](const TextureRecord& record) {
    ++summary.looks_done;
    summary.bytes_per_look += static_cast<double>(record.size_bytes);
    errors.push_back(record.relative_standard_error);
    above_target += record.above_target.value_or(TexelsAboveTarget{});
  });
  summary.bytes_per_look /= static_cast<double>(std::max<std::size_t>(summary.looks_done, 1));
  summary.error = spread_of(std::move(errors));
  summary.above_target = part_of(above_target);

  count_pyramid(store, summary);
  return summary;
}

std::optional<double> part_above_target(const Store& store) {
  if (!error_target(store.description())) return std::nullopt;
  TexelsAboveTarget above_target;
  visit_looks_done(
      store, [&](const TextureRecord& record) { above_target += record.above_target.value_or(TexelsAboveTarget{}); });
  return part_of(above_target);
}

}  // namespace sigmascape::atlas
