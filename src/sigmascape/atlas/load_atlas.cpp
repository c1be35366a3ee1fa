#include <bit>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <utility>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/base/parallel.h"

namespace sigmascape::atlas {
namespace {

constexpr std::size_t channels = radar::Channels::count;

/// Goes on below the stored levels, from 256 texels a side down to one. Means are not brighter than the brightest, so
/// the scale fits on.
void add_levels_down_to_one(HalfTexture& texture) {
  const HalfTexture last{texture.side >> (texture.levels.size() - 1), texture.scale, {texture.levels.back()}};
  HalfTexture rest = encoded(mip_chain(decoded(last).front(), 1), texture.scale, 10);
  texture.levels.insert(texture.levels.end(), std::make_move_iterator(rest.levels.begin() + 1),
                        std::make_move_iterator(rest.levels.end()));
}

}  // namespace

/// Fills an Atlas from a store, look by look.
class AtlasLoader {
 public:
  AtlasLoader(const Store& store, const LoadOptions& options) : store_(store), options_(options) {
    const AtlasDescription& description = store.description();
    const auto patches = description.patches.covering(description.extent);
    atlas_.aspects_ = selected_grid(description.aspects, options.aspects);
    stored_looks_ = selected_looks(description.aspects, options.aspects);
    atlas_.patches_ = description.patches;
    const auto all_levels = static_cast<std::size_t>(std::bit_width(description.patches.texels_per_side));
    if (options.finest_level >= all_levels) {
      throw Error("finest level", fmt::format("{} is not in this atlas", options.finest_level),
                  fmt::format("give 0 to {}", all_levels - 1));
    }
    atlas_.finest_level_ = options.finest_level;
    atlas_.levels_ = all_levels - options.finest_level;
    atlas_.north_west_ = patches.front();
    atlas_.patch_columns_ = patches.back().x - patches.front().x + 1;
    atlas_.patch_rows_ = patches.front().y - patches.back().y + 1;
  }

  Atlas loaded() && {
    check_whole();
    make_room();
    const std::size_t looks = stored_looks_.size();
    // Patches come in the order of the table.
    const auto patches = atlas_.patches_.covering(store_.description().extent);
    parallel_for(patches.size() * looks, options_.threads, [&](std::size_t index, unsigned) {
      const auto look = static_cast<LookIndex>(index % looks);
      HalfTexture texture = store_.read_halves(patches[index / looks], stored_looks_[look]);
      add_levels_down_to_one(texture);
      place(texture, atlas_.patch_table_[index / looks], look);
    });
    if (keeps_ground_apart(store_)) {
      atlas_.ground_layers_ = std::make_shared<const GroundLayers>(load_ground_layers(store_, options_));
    }
    return std::move(atlas_);
  }

 private:
  /// Better one sentence at once than a failure after minutes of reading.
  void check_whole() const {
    std::vector<StoreFault> faults = store_.verify(Scrutiny::Size);
    std::erase_if(faults, [wanted = wanted_files()](const StoreFault& fault) {
      return !wanted.contains(std::filesystem::path(fault.file).replace_extension());
    });
    if (faults.empty()) return;
    throw Error((store_.folder() / faults.front().file).string(),
                fmt::format("{}; {} of {} textures are not there or not whole", faults.front().what, faults.size(),
                            wanted_files().size()),
                "finish the bake by starting it again with the same settings");
  }

  /// Textures and their items, without their endings.
  [[nodiscard]] std::set<std::filesystem::path> wanted_files() const {
    std::set<std::filesystem::path> files;
    for (const PatchIndex& patch : atlas_.patches_.covering(store_.description().extent)) {
      for (const LookIndex look : stored_looks_) files.insert(store_.texture_path(patch, look).replace_extension());
    }
    return files;
  }

  void check_room(std::size_t places, std::size_t looks) const {
    double texels = 0.0;
    for (std::size_t level = atlas_.finest_level_; level <= atlas_.coarsest_level(); ++level) {
      const auto side = static_cast<double>(atlas_.patches_.texels_per_side >> level);
      texels += side * side;
    }
    const double bytes = static_cast<double>(places) * texels * static_cast<double>(looks * channels * sizeof(Half));
    if (const double memory_bytes = machine_memory_bytes(); bytes > memory_bytes) {
      throw Error(
          store_.folder().string(),
          fmt::format("holds textures of {} patches and {} looks that take {:.3g} GB of memory, and there are {:.3g}",
                      places, looks, bytes / 1e9, memory_bytes / 1e9),
          "bake what is mapped into an atlas of its own, or take live frames, which read what they look at");
    }
  }

  void make_room() {
    const std::size_t looks = atlas_.aspects_.look_count();
    check_room(static_cast<std::size_t>(atlas_.patch_columns_) * static_cast<std::size_t>(atlas_.patch_rows_), looks);
    atlas_.patch_table_.resize(static_cast<std::size_t>(atlas_.patch_columns_) *
                               static_cast<std::size_t>(atlas_.patch_rows_));
    for (Atlas::Patch& patch : atlas_.patch_table_) {
      patch.scales.resize(looks);
      for (std::size_t level = atlas_.finest_level_; level <= atlas_.coarsest_level(); ++level) {
        const std::size_t side = atlas_.patches_.texels_per_side >> level;
        patch.levels.emplace_back(side * side * looks * channels);
      }
    }
  }

  void place(const HalfTexture& texture, Atlas::Patch& patch, LookIndex look) const {
    const std::size_t looks = patch.scales.size();
    patch.scales[look] = static_cast<float>(texture.scale);
    for (std::size_t level = 0; level < patch.levels.size(); ++level) {
      const std::vector<Half>& source = texture.levels[level + atlas_.finest_level_];
      std::vector<Half>& target = patch.levels[level];
      for (std::size_t texel = 0; texel < source.size() / channels; ++texel) {
        std::copy_n(&source[texel * channels], channels, &target[(texel * looks + look) * channels]);
      }
    }
  }

  const Store& store_;
  LoadOptions options_;
  std::vector<LookIndex> stored_looks_;  ///< a look of the atlas: its number in the store
  Atlas atlas_;
};

Atlas load_atlas(const Store& store, const LoadOptions& options) {
  return AtlasLoader(store, options).loaded();
}

}  // namespace sigmascape::atlas
