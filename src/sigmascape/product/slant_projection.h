#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/slant_image.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::product {

/// Brings a coherent image back onto the terrain: every cell of the map is given the power of the bins where its centre
/// is to be found, bilinearly, over the horizontal area that a resolution cell has there:
///
///     σ0 = |bin|² / A,   A = δ₁ δ₂ / |∂(place₁, place₂)/∂(x, y)|                docs/physics/doppler.md, Eq. (11)
///
/// Right at any squint; towards the nose A grows without bounds, and left and right of it look alike. NaN where there
/// is no bin. Speckle stays in, that of so many looks as the image has.
[[nodiscard]] radar::GroundMap projected_to_ground(const radar::RangeDopplerImage& image,
                                                   const terrain::HeightField& terrain, const radar::GroundGrid& grid);
[[nodiscard]] radar::GroundMap projected_to_ground(const radar::StripmapImage& image,
                                                   const terrain::HeightField& terrain, const radar::GroundGrid& grid);
[[nodiscard]] radar::GroundMap projected_to_ground(const radar::PowerImage<radar::RangeDopplerImage>& image,
                                                   const terrain::HeightField& terrain, const radar::GroundGrid& grid);
[[nodiscard]] radar::GroundMap projected_to_ground(const radar::PowerImage<radar::StripmapImage>& image,
                                                   const terrain::HeightField& terrain, const radar::GroundGrid& grid);

}  // namespace sigmascape::product
