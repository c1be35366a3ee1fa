#pragma once

#include <cstddef>
#include <memory>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/atlas/patch_table.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::atlas {

struct GroundLayers;
struct LoadOptions;

/// Reflectivity textures in memory: σ0 (linear, per horizontal area) of any ground point from any look.
///
/// Level 0 is the baked resolution; each next has texels of twice the side, down to one texel a patch. Reading is
/// const, never allocates and never throws: any number of threads may read at once.
class Atlas {
 public:
  [[nodiscard]] const AspectGrid& aspects() const { return aspects_; }
  [[nodiscard]] const PatchGrid& patches() const { return patches_; }
  [[nodiscard]] std::size_t finest_level() const { return finest_level_; }
  /// The last level, at which a patch is one texel.
  [[nodiscard]] std::size_t coarsest_level() const { return finest_level_ + levels_ - 1; }
  [[nodiscard]] std::size_t memory_bytes() const;

  /// The ground that the textures do not hold, or nullptr when they hold it with its shadows.
  [[nodiscard]] const GroundLayers* ground_layers() const { return ground_layers_.get(); }

  /// Whether a point lies on the atlas, its edges included. σ0 is zero where it does not.
  [[nodiscard]] bool covers(Vec2d point_m) const;

  /// Throws Error when the frequency lies outside the baked ones (by more than 1 %). For the door: readings do not
  /// look.
  void check_frequency(double frequency_hz) const;

  /// The level whose texels are as large as `cell_side_m`, the smaller side of a resolution cell; fractions lie between
  /// two levels.
  [[nodiscard]] double level_for(double cell_side_m) const;

  /// Reads what is not in memory yet of what readings at `level` of points within `area` come to: for atlases that are
  /// read as they are asked for (LoadOptions), which know nothing elsewhere. What was read is kept. Any number of
  /// threads may ask at once, and read where they have asked before. Throws Error as load_atlas does.
  void prepare(const radar::Rectangle& area, double level) const;

  /// Throws Error when any texture that it may be asked for is missing or not as long as its item says: better at once
  /// than when hours of work come to it.
  void check_whole() const;

  /// See atlas::weights_for. Do this once for all points that are seen under nearly the same aspect.
  [[nodiscard]] AspectWeights weights_for(const radar::Aspect& aspect, double frequency_hz) const {
    return atlas::weights_for(aspects_, aspect, frequency_hz);
  }

  /// σ0 at a point: each texel's own, blended with its neighbours' over half a texel about the edges between them,
  /// across the borders of patches too (docs/decisions/0163-texels-blend-over-half-their-width.md), and linear between
  /// two levels. `level` is drawn to the levels there are. Where a neighbouring patch is not there the other texels
  /// stand in for its own.
  [[nodiscard]] radar::Channels sigma0_at(Vec2d point_m, const AspectWeights& weights, double level) const;
  [[nodiscard]] radar::Channels sigma0_at(Vec2d point_m, const radar::Aspect& aspect, double frequency_hz,
                                          double level) const {
    return sigma0_at(point_m, weights_for(aspect, frequency_hz), level);
  }

 private:
  friend Atlas load_atlas(const Store& store, const LoadOptions& options);

  Atlas() = default;
  /// Nothing where there is none, and where this level of it was not asked for.
  [[nodiscard]] const PatchTexels* patch_at(int column, int row, std::size_t level) const;
  [[nodiscard]] double drawn_to_levels(double level) const;
  [[nodiscard]] radar::Channels at_level(Vec2d point_m, const AspectWeights& weights, std::size_t level) const;

  AspectGrid aspects_;
  PatchGrid patches_;
  std::size_t finest_level_ = 0;
  std::size_t levels_ = 0;
  PatchIndex north_west_;
  int patch_columns_ = 0;
  int patch_rows_ = 0;
  std::shared_ptr<PatchTable> table_;
  const PatchTexels* patches_in_memory_ = nullptr;  ///< the table's, [row][column] from the north-west
  std::shared_ptr<const GroundLayers> ground_layers_;
};

/// When the textures of an atlas are read.
enum class Reading {
  AtOnce,   ///< all that the options leave
  AsAsked,  ///< those that Atlas::prepare is asked for: a map of a small part of a large atlas takes no more
};

struct LoadOptions {
  /// Leave out the levels below: a quarter of the memory for each. A renderer that never reads finer cells than 4
  /// texels needs 2.
  std::size_t finest_level = 0;
  unsigned threads = 0;  ///< 0: one a hardware thread
  /// Leave out the other looks: the atlas is then as one baked on that coarser grid.
  AspectSelection aspects = {};
  Reading reading = Reading::AtOnce;
};

/// Reads a store into memory, at once or as it is asked for. Throws Error when a wanted texture is not there (the bake
/// is not finished) or is not as its item says, when they take more memory than there is, and when the options name
/// levels or looks that the store does not have.
[[nodiscard]] Atlas load_atlas(const Store& store, const LoadOptions& options = {});

}  // namespace sigmascape::atlas
