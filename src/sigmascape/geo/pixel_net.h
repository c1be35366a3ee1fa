#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/lattice.h"

namespace sigmascape::geo {

/// Points of a lattice that lie side by side.
struct LatticeBlock {
  std::size_t column = 0, row = 0, columns = 0, rows = 0;
};

/// Positions from the least to the greatest; none while they are the other way round.
struct PixelBox {
  Vec2d least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
      greatest = least * -1.0;

  void take_in(Vec2d pixel);
  [[nodiscard]] bool empty() const { return !(least.x <= greatest.x && least.y <= greatest.y); }
};

/// Positions in source pixels at the points of a lattice: exact on a net of at most 100 m mesh and linear between,
/// where no projection bends by more than a millimetre; exact everywhere in meshes that a projection tears, as at the
/// meridian where its map ends.
class PixelNet {
 public:
  /// Replaces positions in the CRS by positions in pixels, which it takes for neighbours of each other.
  using ToPixels = std::function<void(std::span<Vec2d>)>;

  /// `transform` must outlive it.
  PixelNet(const Lattice& lattice, const CoordinateTransform& transform, ToPixels to_pixels);

  /// At a place between the lattice points, which may lie half a spacing outside them.
  [[nodiscard]] Vec2d at(double column, double row) const {
    const Place place = place_of(column, row);
    return is_torn(place.i, place.j) ? exact_at(column, row) : between_knots(place);
  }

  /// What `at` may be asked for at the points of a block and half a spacing round them.
  [[nodiscard]] PixelBox box_of(const LatticeBlock& block) const;

  /// Whether a mesh under a block, or half a spacing round it, is torn: of that `box_of` tells little.
  [[nodiscard]] bool is_torn(const LatticeBlock& block) const;

 private:
  /// A mesh of the net and a place within it, from 0 to 1 both ways.
  struct Place {
    std::size_t i = 0, j = 0;
    double u = 0.0, v = 0.0;
  };
  [[nodiscard]] Place place_of(double column, double row) const;
  [[nodiscard]] Vec2d between_knots(const Place& place) const {
    const auto [i, j, u, v] = place;
    const Vec2d upper = knots_(i, j) * (1.0 - u) + knots_(i + 1, j) * u;
    const Vec2d lower = knots_(i, j + 1) * (1.0 - u) + knots_(i + 1, j + 1) * u;
    return upper * (1.0 - v) + lower * v;
  }
  [[nodiscard]] bool is_torn(std::size_t i, std::size_t j) const { return !torn_.empty() && torn_(i, j) != 0; }
  [[nodiscard]] Vec2d in_frame(double column, double row) const {
    return {lattice_.west_m + column * lattice_.spacing_m, lattice_.north_m - row * lattice_.spacing_m};
  }
  [[nodiscard]] Vec2d exact_at(double column, double row) const;
  void find_torn_meshes();
  [[nodiscard]] std::vector<double> lines_across(std::size_t first, std::size_t count) const;

  Lattice lattice_;
  const CoordinateTransform& transform_;
  ToPixels to_pixels_;
  std::size_t stride_;
  Array2D<Vec2d> knots_;
  Array2D<std::uint8_t> torn_;  ///< [column, row] of the meshes; empty where none is
};

}  // namespace sigmascape::geo
