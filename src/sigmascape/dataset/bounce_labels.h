#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/radar/layer_stack.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/simulate/simulate.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::dataset {

/// The part of a cell's power that came over more than one surface; 0 where there is none.
inline constexpr std::string_view multibounce = "multibounce";

/// k of "bounce<k>", from 1 to 9; 0 for another name.
[[nodiscard]] std::size_t bounce_order(std::string_view name);
/// Whether the layer tells bounces apart: "bounce<k>" or "multibounce".
[[nodiscard]] bool tells_bounces(std::string_view name);

/// What an atlas must be baked with, beside one with all bounces, for a layer to be known from both: k bounces for
/// "bounce<k>", one for "multibounce".
[[nodiscard]] std::size_t bounces_to_know(std::string_view name);

/// Those layers among `names` that tell bounces apart, in their order: σ0 of what came back over k surfaces in the
/// radar's own polarization, and the part of several bounces. By rays, laid onto the ground as the map is.
/// Throws Error for a k of more bounces than the settings trace. `image`, when given, gets the sum of all orders, which
/// is the image that `simulate::traced_image` would have made.
[[nodiscard]] std::vector<radar::Layer> traced_bounce_layers(
    std::span<const std::string> names, const scene::Scene& scene, const trace::SceneGeometry& geometry,
    const radar::Radar& radar, const radar::GroundGrid& grid, const simulate::TraceSettings& settings,
    ProgressListener* progress = nullptr, radar::RangeAzimuthImage* image = nullptr);

/// The same from images of the same bins: of all echoes, and in `up_to` of those over one surface, over two at most,
/// and so on, as many as the names need. What came over exactly k is the difference of two of them, nothing where noise
/// makes it negative.
[[nodiscard]] std::vector<radar::Layer> baked_bounce_layers(std::span<const std::string> names,
                                                            const radar::RangeAzimuthImage& all,
                                                            std::span<const radar::RangeAzimuthImage> up_to,
                                                            const terrain::HeightField& terrain,
                                                            const radar::GroundGrid& grid,
                                                            radar::Polarization polarization);

}  // namespace sigmascape::dataset
