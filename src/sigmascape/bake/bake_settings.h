#pragma once

#include <cstdint>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/sampling.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::bake {

/// Where the shadows come from that objects throw on the ground.
enum class Shadows {
  RunTime,  ///< made when a map is rendered: ground and obstacles are stored apart from the echoes of objects
  Baked,    ///< in the textures, with the length they have on level ground: the paper's way
};

/// Where what buildings return directly comes from.
enum class Buildings {
  Baked,  ///< from the textures, as all else that stands on the ground
  Apart,  ///< from the buildings themselves when a map is rendered, seen from where the radar is:
          ///< docs/decisions/0171-buildings-apart.md
  Both,   ///< so, and from textures of their own for live frames: docs/decisions/0173-live-frames-of-buildings-apart.md
};

/// What becomes of the noise that few rays leave in what comes over several surfaces.
enum class Noise {
  Own,     ///< every texel keeps what its own rays brought
  Shared,  ///< texels share with those around them what their own rays leave in doubt: bake/noise_sharing.h
};

/// Elevations of looks: a level plane is not lit at 0° and has no ground range at 90°.
inline constexpr double lowest_elevation_deg = 0.5, highest_elevation_deg = 89.0;

/// By which revision of the physics texels are made. To be raised by one with every change after which the same scene
/// and settings give other textures, ground or obstacles than before, be it in scattering, in paths, in what stands for
/// an obstacle or in how texels are summed and rounded: atlases that were begun before are refused then, rather than
/// gone on with half and half. Not with changes in how a scene is read, which its hash tells, nor with those of formats
/// (atlas::newest_format_version).
inline constexpr int physics_revision = 11;

/// Of smaller texels, cross-sections come near the units in which they and their variances are summed
/// (receiver/power_bins.h, receiver/variance_bins.h).
inline constexpr double smallest_texel_m = 0.01;

/// What to bake and how finely.
struct BakeSettings {
  atlas::AspectGrid aspects = atlas::paper_aspect_grid();
  /// The paper's texel (2 km over 1024); the side is a power of two of them.
  atlas::PatchGrid patches{.texel_m = 2000.0 / 1024.0, .texels_per_side = 512};
  Sampling sampling;
  int max_bounces = 8;  ///< N_b of the paper
  std::uint64_t seed = 1;
  Shadows shadows = Shadows::RunTime;
  /// What objects stand on while they are baked. With Shadows::Baked it is the level plane always.
  trace::Footing footing = trace::Footing::Terrain;
  /// All but Baked want shadows made at run time and objects on their own terrain.
  Buildings buildings = Buildings::Baked;
  Noise noise = Noise::Own;
  int mantissa_bits = 10;  ///< of the stored half floats, see atlas::AtlasDescription
  atlas::Digits digits = atlas::Digits::ToNoise;
  unsigned threads = 0;  ///< 0: one a hardware thread; has no effect on the result
};

/// What objects stand on by these settings, whatever the ground.
[[nodiscard]] trace::Footing footing_of(const BakeSettings& settings);

/// Throws Error, naming the setting, when one is out of range.
void check(const BakeSettings& settings);

}  // namespace sigmascape::bake
