#pragma once

#include <memory>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/buildings.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// For whom and where buildings are laid over the ground.
struct LayerRequest {
  radar::Vantage vantage;
  double frequency_hz;
  radar::Rectangle area;
  double level;  ///< of the atlas; squares are those of the finer one of two levels
  radar::CurvedEarth earth = radar::CurvedEarth::flat();
  unsigned threads = 0;
};

/// What buildings that an atlas keeps apart return directly to a radar, laid over the ground as a look is that was
/// baked from just there: σ0 over map area, square by square, walls and roofs lying over towards the radar.
///
/// Every face is taken in pieces, each with what its material returns by angle, and what of that passes terrain and
/// obstacles (FaceSight). It belongs to the ground of its range: docs/physics/estimator.md, Eq. (5).
/// docs/decisions/0171-buildings-apart.md.
class BuildingLayer {
 public:
  /// Of an atlas whose ground layers hold buildings.
  BuildingLayer(const atlas::Atlas& atlas, const terrain::HeightField& terrain, const LayerRequest& request);

  /// σ0 at a point of the area: each square's own, blended with its neighbours' about the edges between them as texels
  /// are. Nothing is hidden of it any more.
  [[nodiscard]] radar::Channels sigma0_at(Vec2d point) const;

 private:
  radar::GroundGrid grid_;
  Array2D<radar::Channels> sigma0_;
};

/// The layer of an atlas that keeps its buildings apart, null of another.
[[nodiscard]] std::shared_ptr<const BuildingLayer> building_layer(const atlas::Atlas& atlas,
                                                                  const terrain::HeightField& terrain,
                                                                  const LayerRequest& request);

}  // namespace sigmascape::render
