#pragma once

#include <string>

#include "sigmascape/product/picture.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::cli {

/// The scene from straight above as an eye would see it: every surface in a colour of its material, in the light of a
/// sun 40° high in the south-east, where the paper's radar stands, with shadows. `geometry` is that of the scene on its
/// terrain.
[[nodiscard]] product::Picture optical_view(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                            std::size_t pixels_wide, unsigned threads);

/// What the bare ground is made of.
struct MaterialView {
  /// In the colours of the paper's Figure 6: concrete black, trees green, grass red, water white, soil blue; and in
  /// others what the paper does not have.
  product::Picture picture;
  std::string legend;       ///< "grey asphalt, red grass": of what occurs
  std::size_t classes = 0;  ///< that occur
};

[[nodiscard]] MaterialView material_view(const scene::Scene& scene, std::size_t pixels_wide);

}  // namespace sigmascape::cli
