#pragma once

#include <cstddef>

#include "sigmascape/base/array2d.h"
#include "sigmascape/product/band_interpolation.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/slant_image.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::product {

/// Brings coherent images back onto the terrain: every cell of the map is given the power that the image has where the
/// cell's centre is to be found, over the horizontal area that a resolution cell has there:
///
///     σ0 = |a|² / A,   A = δ₁ δ₂ / |∂(place₁, place₂)/∂(x, y)|                  docs/physics/doppler.md, Eq. (11)
///
/// The amplitude a is interpolated between bins before it becomes power, so that speckle keeps its law: an exponential
/// one of a single look, and the mean of several looks has that of so many. Right at any squint; towards the nose A
/// grows without bounds, and left and right of it look alike. NaN where there is no bin; Doppler begins anew after its
/// last bin and has one everywhere.
class LooksOnGround {
 public:
  LooksOnGround(const terrain::HeightField& terrain, const radar::GroundGrid& grid, unsigned threads = 0);

  /// Looks must be of one image, with the same bins.
  void add(const radar::RangeDopplerImage& look);
  void add(const radar::StripmapImage& look);

  /// The mean of the looks.
  [[nodiscard]] radar::GroundMap map() const;

 private:
  /// Where in the image a cell of the map is, and how many resolution cells a square metre has there.
  struct Found {
    Vec2d place;
    double cells_per_m2 = 0.0;
  };
  template <typename Image>
  void find_places(const Image& image);
  template <typename Image>
  void add_look(const Image& look);

  const terrain::HeightField& terrain_;
  radar::GroundGrid grid_;
  unsigned threads_;
  BandInterpolation interpolation_;
  Array2D<Found> found_;
  Array2D<radar::Channels> sums_;
  std::size_t looks_ = 0;
};

/// A map of one look.
[[nodiscard]] radar::GroundMap projected_to_ground(const radar::RangeDopplerImage& image,
                                                   const terrain::HeightField& terrain, const radar::GroundGrid& grid);
[[nodiscard]] radar::GroundMap projected_to_ground(const radar::StripmapImage& image,
                                                   const terrain::HeightField& terrain, const radar::GroundGrid& grid);

}  // namespace sigmascape::product
