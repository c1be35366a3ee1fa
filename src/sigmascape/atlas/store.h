#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/mip_chain.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/atlas/power_error.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// Of what kind the files of an atlas are that is begun now; docs/store.md tells what the others lack. The newest are
/// those whose textures say the less that programs know which stop at the usual ones: buildings are kept apart.
inline constexpr int usual_format_version = 2, newest_format_version = 3;

/// Which of the mantissa bits that may be kept of a texel are kept.
enum class Digits {
  All,
  ToNoise,  ///< those that its standard error does not drown: worthwhile_bits.h
};

/// The setting that tells by which revision of the physics texels were made, where that is not the first:
/// AtlasDescription::physics_revision.
inline constexpr const char* physics_revision_setting = "physics_revision";

/// As files and options spell it.
[[nodiscard]] constexpr const char* word_for(Digits digits) {
  return digits == Digits::ToNoise ? "to-noise" : "all";
}

/// What an atlas is of: everything that all of its files have in common. Bakes with equal descriptions give equal
/// files, so they may be spread over processes and machines, and broken off and resumed.
struct AtlasDescription {
  std::string name;
  geo::LocalFrame frame;
  radar::Rectangle extent;  ///< what the patches must cover
  PatchGrid patches;
  AspectGrid aspects;
  std::string scene_hash;
  /// Whatever else decides the texels (seed, samples, bounces, SIMD setting…), by name, in words that a person
  /// understands.
  std::map<std::string, std::string> settings;
  /// Mantissa bits that are kept, 1 to 10. 10 keeps all that a half holds.
  int mantissa_bits = 10;
  Digits digits = Digits::All;
  std::string attribution;  ///< of the data that the scene was made from
  /// An atlas keeps that with which it was begun.
  int format_version = usual_format_version;

  /// By which revision of the physics the texels were made, as the settings tell: "1" where they do not.
  [[nodiscard]] std::string physics_revision() const;
};

/// Halves of a chain as such an atlas stores them. `relative_errors`, if not empty, are those of the total power of the
/// finest level.
[[nodiscard]] HalfTexture encoded_as(const AtlasDescription& description, const MipChain& chain,
                                     const Array2D<float>& relative_errors);

/// How one (patch, look) came about: goes into its item, so that a reading can be traced back.
struct BakeFacts {
  std::uint64_t seed = 0;
  double samples_per_texel = 0.0;               ///< mean
  std::string simd;                             ///< the instruction set that the numbers were made with
  std::map<std::string, std::uint64_t> counts;  ///< what was skipped or lost on the way, by name
  std::optional<PowerError> error = {};         ///< of the finest texels; nothing where nothing was sampled
};

/// One file of the store.
struct Unit {
  PatchIndex patch;
  LookIndex look = 0;

  friend constexpr bool operator==(const Unit&, const Unit&) = default;
};

/// How closely a file is looked at: Size compares its length with the recorded one, Content its SHA-256 too.
enum class Scrutiny { Size, Content };

/// One thing that is wrong with a store.
struct StoreFault {
  std::filesystem::path file;  ///< relative to the store
  std::string what;            ///< "is missing", "is truncated", "was altered", …
  /// Nothing of it is there, as before it was made for the first time, or it is being made or was a moment ago: no
  /// damage to tell of when it is made.
  bool is_absent = false;
};

/// The terrain that the scene stands on, in the folder of the atlas, so that maps can be rendered without the scene.
inline constexpr std::string_view terrain_name = "terrain.tif";
/// The same as tiles of all levels of detail, for terrain of any size; a folder.
inline constexpr std::string_view terrain_pyramid_name = "terrain";

/// Reflectivity textures at rest: a folder with a STAC collection, and for each (patch, look) a half-float
/// cloud-optimised GeoTIFF with its STAC item beside it. docs/store.md describes the format.
///
/// A texture counts as there only when its item is there and its file is as the item says; all files appear whole or
/// not at all. Any number of processes may read and write one store at once.
class Store {
 public:
  /// Makes a new store, or opens the one in `folder` when its description is the same: so a bake resumes. Throws Error
  /// when the description makes no sense, the store there has another one, naming what differs, or there is none but
  /// something of others by a name of a store's files, which would be lost.
  [[nodiscard]] static Store create(const std::filesystem::path& folder, const AtlasDescription& description);

  /// The store in `folder`, if there is one. Writes nothing; throws Error as `create` does.
  [[nodiscard]] static std::optional<Store> find(const std::filesystem::path& folder,
                                                 const AtlasDescription& description);

  /// Opens a store that exists. Throws Error when there is none or its collection.json cannot be understood.
  [[nodiscard]] static Store open(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const AtlasDescription& description() const { return description_; }
  /// Every (patch, look) that a whole atlas has, patch by patch.
  [[nodiscard]] std::vector<Unit> units() const;
  /// How many those are.
  [[nodiscard]] std::size_t unit_count() const;

  [[nodiscard]] bool is_done(PatchIndex patch, LookIndex look, Scrutiny scrutiny = Scrutiny::Size) const;

  /// Writes σ0 of one patch seen from one look, with all levels. `texels` is level 0, north up, as PatchGrid::texels_of
  /// says. `relative_errors`, if not empty, is the standard error of each texel's total power over that power and is
  /// stored beside it in steps of 0.2 dB. Throws Error when one has another size, holds a number that is not finite, or
  /// cannot be written.
  void write(PatchIndex patch, LookIndex look, const Array2D<radar::Channels>& texels, const BakeFacts& facts,
             const Array2D<float>& relative_errors = {}) const;

  /// All stored levels of σ0. Throws Error when the texture is not there or its file is not as its item says.
  [[nodiscard]] MipChain read(PatchIndex patch, LookIndex look) const;

  /// The relative standard errors of level 0, [column, row]; 0 where nothing returns. Throws Error when the texture is
  /// not there, was baked without them, or a file is not as its item says.
  [[nodiscard]] Array2D<float> read_errors(PatchIndex patch, LookIndex look) const;

  /// The same as it is stored, for readers that keep halves in memory.
  [[nodiscard]] HalfTexture read_halves(PatchIndex patch, LookIndex look) const;

  /// A texture of the pyramid above the patches (atlas/pyramid.h): of its level `level`, 1 and up, the one that covers
  /// `patch`; one level of 256² texels. Throws Error when it is not there or not as its item says.
  [[nodiscard]] HalfTexture read_halves(std::size_t level, PatchIndex patch, LookIndex look) const;

  /// Everything that keeps the patches from being whole, by file; empty when all is well. Tells `progress`, where there
  /// is one, of each texture that it has looked at.
  [[nodiscard]] std::vector<StoreFault> verify(Scrutiny scrutiny = Scrutiny::Content,
                                               ProgressListener* progress = nullptr) const;

  /// Path of the texture relative to the store, "patch_+000_-001/az045.0_el13.0_f10.000GHz.tif"; its item has the
  /// ending .json.
  [[nodiscard]] std::filesystem::path texture_path(PatchIndex patch, LookIndex look) const;

 private:
  Store(const std::filesystem::path& folder, AtlasDescription description);

  std::filesystem::path folder_;  ///< absolute: what is read when it is asked for is found wherever the process went
  AtlasDescription description_;
};

}  // namespace sigmascape::atlas
