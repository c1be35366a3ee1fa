#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/render/reflecting_ground.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

struct RenderSettings {
  /// Level of detail, 1 or more: level k reads textures from mip k − 1 on.
  int level_of_detail = 1;
  SlopeModel slope = SlopeModel::Upright;  ///< of the textures; ground that is kept apart is Tilted always
  unsigned threads = 0;
  /// At which the textures are looked up; that of the radar when it is not said.
  std::optional<double> texture_frequency_hz = {};
  /// Targets whose boxes hide what stands behind them, at time zero. Their echoes are added by others.
  std::span<const radar::Target> targets = {};
};

struct RenderCounts {
  std::size_t ground_samples = 0;  ///< points of ground in the sector
  std::size_t visible = 0;         ///< of them not wholly hidden
};

/// LOD ≥ 1: the ground map from terrain and baked reflectivity alone.
///
/// Sweeps outwards along every azimuth with the steepest line of sight so far; ground that rises above it is seen and
/// sends its σ0 · dA to the receiver at its true slant range. Objects and their layover stand in the textures.
///
/// Where the atlas keeps the ground apart (atlas::GroundLayers), the ground answers with its grazing angle above the
/// local slope and its true area, behind terrain and obstacles as they stand here; objects answer with the part of
/// their height (radar::AnsweringTops) that rises above the terrain's horizon, and hide one another as they were baked.
/// Otherwise the shadows of objects too are those of the textures, and what hides here is the bare earth.
class GroundRenderer {
 public:
  GroundRenderer(const atlas::Atlas& atlas, const terrain::HeightField& terrain) : atlas_(&atlas), terrain_(&terrain) {}

  /// Renders what of `area` the bins of `grid` hold. Throws Error when the atlas has not been baked near the radar's
  /// frequency.
  [[nodiscard]] radar::RangeAzimuthImage render(const radar::Radar& radar, const radar::Rectangle& area,
                                                const radar::RangeAzimuthGrid& grid, const RenderSettings& settings,
                                                RenderCounts& counts) const;

 private:
  const atlas::Atlas* atlas_;
  const terrain::HeightField* terrain_;
};

}  // namespace sigmascape::render
