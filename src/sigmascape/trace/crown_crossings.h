#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::trace {

/// The part of a ray that lies within one crown of a tree.
struct CrownCrossing {
  float enter_m = 0.0F;
  float leave_m = 0.0F;
  float extinction_scale = 1.0F;  ///< of this tree's medium, by its size
  scene::MaterialIndex medium = 0;
  unsigned tree = 0;   ///< tells instances apart
  unsigned crown = 0;  ///< tells apart the crowns of one instance
};

/// Where the crowns along a ray intercept it.
struct Interception {
  float distance_m = 0.0F;
  scene::MaterialIndex medium = 0;
  float extinction_per_m = 0.0F;  ///< of that medium in that tree
};

/// The crowns along one ray. Each is homogeneous, so that everything follows in closed form; where several overlap,
/// their extinctions add. docs/physics/vegetation.md, Eqs. (2), (3).
class CrownCrossings {
 public:
  /// Forgets all crossings; `surfaces` hold the media and have to outlive this.
  void begin(const std::vector<scatter::SurfaceModel>& surfaces);
  /// A ray that meets the same crown twice counts it once.
  void add(const CrownCrossing& crossing);

  /// ∫ κ ds from the start of the ray to `distance_m`.
  [[nodiscard]] float optical_depth(float distance_m = std::numeric_limits<float>::infinity()) const;
  /// The same for the way back by which the wave came: crowns that share their gaps do not weaken it again.
  [[nodiscard]] float return_depth(float distance_m) const;
  /// Where the optical depth reaches `depth` before `distance_m`; `choice` in [0, 1) decides between crowns that
  /// overlap there.
  [[nodiscard]] std::optional<Interception> interception(float depth, float distance_m, float choice);

 private:
  [[nodiscard]] float extinction_of(const CrownCrossing& crossing) const;
  [[nodiscard]] float extinction_at(float distance_m) const;
  /// Chooses among the crowns of the stretch that begins at `border_m`.
  [[nodiscard]] Interception chosen_at(float distance_m, float border_m, float choice) const;

  const std::vector<scatter::SurfaceModel>* surfaces_ = nullptr;
  std::vector<CrownCrossing> crossings_;
  std::vector<float> borders_m_;
};

}  // namespace sigmascape::trace
