#include "sigmascape/atlas/atlas_summary.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/interruption.h"

namespace sigmascape::atlas {
namespace {

std::uint64_t bytes_in(const std::filesystem::path& folder) {
  using Files = std::filesystem::recursive_directory_iterator;
  std::uint64_t bytes = 0;
  std::error_code error;
  // Folders that may not be looked into are left out: atlas::verify names them.
  for (Files files(folder, std::filesystem::directory_options::skip_permission_denied, error);
       !error && files != Files(); files.increment(error)) {
    std::error_code vanished;
    const auto size = files->is_regular_file(vanished) ? files->file_size(vanished) : 0;
    if (!vanished) bytes += size;
  }
  return bytes;
}

std::optional<AtlasSummary::Spread> spread_of(std::vector<double> errors) {
  if (errors.empty()) return std::nullopt;
  std::ranges::sort(errors);
  return AtlasSummary::Spread{errors.front(), errors[errors.size() / 2], errors.back()};
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
  const PatchBlock patches = description.patches.block_over(description.extent);
  const std::size_t look_count = description.aspects.look_count();
  summary.patches = patches.size();
  summary.looks = store.unit_count();
  summary.bytes = bytes_in(store.folder());
  std::vector<double> errors;
  TexelsAboveTarget above_target;
  for (std::size_t number = 0; number < summary.looks; ++number) {
    Interruption::heed();
    const PatchIndex patch = patches[number / look_count];
    const auto look = static_cast<LookIndex>(number % look_count);
    if (!store.is_done(patch, look)) continue;
    const auto record = texture_record(store, store.texture_path(patch, look));
    if (!record) continue;
    ++summary.looks_done;
    summary.bytes_per_look += static_cast<double>(record->size_bytes);
    if (record->relative_standard_error) errors.push_back(*record->relative_standard_error);
    above_target += record->above_target.value_or(TexelsAboveTarget{});
  }
  summary.bytes_per_look /= static_cast<double>(std::max<std::size_t>(summary.looks_done, 1));
  summary.error = spread_of(std::move(errors));
  summary.above_target = above_target.part();

  count_pyramid(store, summary);
  return summary;
}

}  // namespace sigmascape::atlas
