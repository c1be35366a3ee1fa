#pragma once

#include <filesystem>
#include <memory>

#include "sigmascape/atlas/store.h"
#include "sigmascape/live/live_ground.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::bench {

/// A folder that is gone when the program ends.
class ScratchStore {
 public:
  ScratchStore();
  ~ScratchStore();
  ScratchStore(const ScratchStore&) = delete;
  ScratchStore& operator=(const ScratchStore&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

inline constexpr double frequency_hz = 10e9, texel_m = 2.0, gamma_vv = 0.1;

/// Where the ground of a store is, and the shadows on it: in its textures, or in layers of its own with houses and
/// trees on them.
enum class GroundOf { Textures, Layers };

/// A square of so many patches of 1024² texels a side, two azimuths × two elevations × two frequencies, γ the same
/// everywhere but for a grain from texel to texel. One patch is written; the others, and the levels above them, are
/// links to it: as large to whoever reads it as it is small on disk.
[[nodiscard]] atlas::Store made_store(const std::filesystem::path& folder, int patches_a_side,
                                      GroundOf kind = GroundOf::Textures);

/// Hills 150 m high under such a store, 3 and 7 km from one to the next: every tile of the terrain is reckoned when it
/// is wanted, which takes about as long as to read and decode it.
[[nodiscard]] std::shared_ptr<live::LiveGround> rolling_ground(const atlas::Store& store, std::size_t budget_bytes);

/// Ground about the origin, where four tiles of every level meet, between the paper's eight azimuths and five
/// elevations: 64 × 64 patches of 256² texels, made like those.
[[nodiscard]] atlas::Store made_store_of_many_looks(const std::filesystem::path& folder, GroundOf kind);

/// Level ground under such a store.
[[nodiscard]] std::shared_ptr<live::LiveGround> made_ground(const atlas::Store& store, std::size_t budget_bytes);

}  // namespace sigmascape::bench
