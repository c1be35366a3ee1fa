#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// What buildings that are kept apart return directly, baked from the looks of the atlas: textures of their own, in a
/// store in the folder `buildings`. With those of the atlas they add up to what one that bakes its buildings has. Maps
/// make these echoes from where the radar is (building_file.h); live frames take them from here.
/// docs/decisions/0173-live-frames-of-buildings-apart.md.
inline constexpr std::string_view building_textures_folder = "buildings";

/// The setting of a store that has them, and what it says then. Programs that do not know it make maps as they should.
inline constexpr const char* building_textures_setting = "building_textures";
inline constexpr const char* building_textures_kept = "kept";

/// Whether an atlas, which keeps its buildings apart then, has them.
[[nodiscard]] bool keeps_building_textures(const AtlasDescription& description);

/// Made when it is not there; a collection that does not say what follows from the atlas is written anew and added to
/// `mended`.
[[nodiscard]] Store create_building_textures(const Store& atlas, std::vector<StoreFault>* mended = nullptr);

/// Throws Error when there are none.
[[nodiscard]] Store open_building_textures(const Store& atlas);

/// What is wrong with their collection, if anything: by itself, and held against the atlas.
[[nodiscard]] std::optional<StoreFault> building_textures_fault(const Store& atlas);

/// The stores in which a look of an atlas is: its own and, where it keeps such, that of its buildings.
class LookStores {
 public:
  /// Without that of the buildings nothing is in both.
  explicit LookStores(const Store& atlas);

  /// Whether a look is in all of them.
  [[nodiscard]] bool is_done(PatchIndex patch, LookIndex look, Scrutiny scrutiny = Scrutiny::Size) const;
  [[nodiscard]] const std::vector<Store>& all() const { return stores_; }

 private:
  std::vector<Store> stores_;  // the atlas first
  bool is_complete_ = true;
};

}  // namespace sigmascape::atlas
