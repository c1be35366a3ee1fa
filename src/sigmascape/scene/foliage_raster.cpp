#include "sigmascape/scene/foliage_raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sigmascape/radar/lines_across.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::scene {
namespace {

using Foliage = FoliageRaster::Foliage;

double plan_distance(Vec3d a, Vec3d b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return std::sqrt(x * x + y * y);
}

/// Lines at so many heights of a crown, each for a slice of it.
constexpr std::size_t slices = 16;
using Surface = std::array<double, slices>;  // of each slice, in m²

/// Of the space from a base to a top.
struct Slicing {
  double base_m, slice_m;

  void add(const Foliage& part, Surface& surface) const {
    const double from = (part.base_m - base_m) / slice_m, to = (part.top_m - base_m) / slice_m;
    const auto end = static_cast<double>(slices);
    if (part.area_m2 == 0.0) return;
    for (double slice = std::max(0.0, std::floor(from)); slice < std::min(to, end); slice += 1.0) {
      const double within = std::min(to, slice + 1.0) - std::max(from, slice);
      surface[static_cast<std::size_t>(slice)] += part.area_m2 * within / (to - from);
    }
  }
};

/// The surface along lines across a square in one direction, over it and with the squares before and behind it.
struct AlongLines {
  std::array<Surface, FoliageRaster::most_parts_per_side> across{}, with_neighbours{};
};

std::size_t parts_on_side(double square_m) {
  const double parts = std::ceil(square_m / FoliageRaster::part_m - 1e-6);
  return static_cast<std::size_t>(std::clamp(parts, 1.0, static_cast<double>(FoliageRaster::most_parts_per_side)));
}

/// The squares and those next to them.
radar::GroundGrid with_rim(const radar::GroundGrid& squares) {
  return {squares.west_m - squares.cell_m, squares.north_m + squares.cell_m, squares.cell_m, squares.columns + 2,
          squares.rows + 2};
}

}  // namespace

double StandingCrown::half_chord_m(Vec2d place) const {
  const double x = place.x - centre.x, y = place.y - centre.y;
  const double u = (x * cos_yaw - y * sin_yaw) / radii_m.x, v = (x * sin_yaw + y * cos_yaw) / radii_m.y;
  return radii_m.z * std::sqrt(std::max(0.0, 1.0 - u * u - v * v));
}

FoliageRaster::FoliageRaster(const radar::GroundGrid& squares, std::size_t most_rows)
    : parts_per_side_(parts_on_side(squares.cell_m)),
      parts_{parts_of(with_rim(squares), parts_per_side_)},
      foliage_(parts_.grid.columns, (most_rows + 2) * parts_per_side_),
      is_there_(squares.columns + 2, most_rows + 2) {}

std::size_t FoliageRaster::bytes(const radar::GroundGrid& squares, std::size_t most_rows) {
  const std::size_t parts = parts_on_side(squares.cell_m);
  return (squares.columns + 2) * (most_rows + 2) * (parts * parts * sizeof(Foliage) + sizeof(std::uint8_t));
}

void FoliageRaster::move_to(std::size_t first_row, std::size_t rows) {
  for (std::size_t row = 0; row < is_there_.rows(); ++row) {
    for (std::size_t column = 0; column < is_there_.columns(); ++column) {
      if (is_there_(column, row) == 0) continue;
      is_there_(column, row) = 0;
      for (std::size_t j = row * parts_per_side_; j < (row + 1) * parts_per_side_; ++j)
        std::ranges::fill(foliage_.row(j).subspan(column * parts_per_side_, parts_per_side_), Foliage());
    }
  }
  parts_.first_row = first_row * parts_per_side_;
  parts_.rows = (rows + 2) * parts_per_side_;
}

void FoliageRaster::add(const Corners& triangle, const terrain::HeightField& ground) {
  if (!radar::meet(plan_of(triangle), parts_.extent())) return;
  const auto [a, b, c] = triangle;
  const std::array<double, 3> sides{plan_distance(a, b), plan_distance(b, c), plan_distance(c, a)};
  const auto longest = std::ranges::max_element(sides);
  // Squares that are no larger than parts have nothing that would even out where pieces fall.
  const double small_enough_m = parts_per_side_ == 1 ? parts_.grid.cell_m / 2.0 : parts_.grid.cell_m;
  if (*longest <= small_enough_m) {
    add_piece(triangle, ground);
    return;
  }
  const auto first = static_cast<std::size_t>(longest - sides.begin());
  const Vec3d from = triangle[first], to = triangle[(first + 1) % 3], opposite = triangle[(first + 2) % 3];
  const Vec3d middle = (from + to) * 0.5;
  add({from, middle, opposite}, ground);
  add({middle, to, opposite}, ground);
}

void FoliageRaster::add(const StandingCrown& crown, const terrain::HeightField& ground) {
  constexpr std::size_t points_per_side = 3;  // of a part
  const double reach_m = std::max(crown.radii_m.x, crown.radii_m.y);
  const auto& [x, y, z] = crown.centre;
  const RasterWindow points{parts_of(parts_.grid, points_per_side), parts_.first_row * points_per_side,
                            parts_.rows * points_per_side};
  points.for_cells_under(
      {x - reach_m, y - reach_m, x + reach_m, y + reach_m}, [&](std::size_t column, std::size_t row) {
        const Vec2d place = points.grid.centre_of(column, row);
        const double half_m = crown.half_chord_m(place);
        if (half_m == 0.0) return;
        const double middle_m = crown.centre.z - ground.height_at(place);
        add_surface(
            column / points_per_side, row / points_per_side,
            {4.0 * crown.extinction_per_m * half_m * points.grid.cell_area_m2(), middle_m - half_m, middle_m + half_m});
      });
}

void FoliageRaster::write_to(radar::Obstacle& obstacle, std::size_t column, std::size_t row) const {
  const std::size_t west = (column + 1) * parts_per_side_, north = (row + 1) * parts_per_side_;
  if (is_there_(column + 1, row + 1 - parts_.first_row / parts_per_side_) == 0) return;
  radar::LinesAcross upward;
  double base_m = 0.0, top_m = 0.0;
  bool is_bare = true;
  for (std::size_t j = 0; j < parts_per_side_; ++j) {
    for (std::size_t i = 0; i < parts_per_side_; ++i) {
      const Foliage part = foliage_of(west + i, north + j);
      const double depth = part.area_m2 / (2.0 * parts_.grid.cell_area_m2());
      upward.add(depth, depth);
      if (part.area_m2 == 0.0) continue;
      base_m = is_bare ? part.base_m : std::min(base_m, part.base_m);
      top_m = std::max(top_m, part.top_m);
      is_bare = false;
    }
  }
  if (!(top_m > base_m)) return;

  const Slicing slicing{base_m, (top_m - base_m) / static_cast<double>(slices)};
  AlongLines eastward, northward;
  for (std::size_t line = 0; line < parts_per_side_; ++line) {
    for (std::size_t i = 0; i < parts_per_side_; ++i) {
      slicing.add(foliage_of(west + i, north + line), eastward.across[line]);
      slicing.add(foliage_of(west + line, north + i), northward.across[line]);
    }
    eastward.with_neighbours[line] = eastward.across[line];
    northward.with_neighbours[line] = northward.across[line];
    for (std::size_t i = 1; i <= parts_per_side_; ++i) {
      for (const std::size_t beside : {west - i, west + parts_per_side_ - 1 + i})
        slicing.add(foliage_of(beside, north + line), eastward.with_neighbours[line]);
      for (const std::size_t beside : {north - i, north + parts_per_side_ - 1 + i})
        slicing.add(foliage_of(west + line, beside), northward.with_neighbours[line]);
    }
  }

  // κ = A / (2 · part · slice) on the way across a part, and the mean of κ from all three ways of looking.
  const double side_m = parts_.grid.cell_m * static_cast<double>(parts_per_side_);
  const double depth_of_surface = 1.0 / (2.0 * parts_.grid.cell_m * slicing.slice_m);
  double extinction_per_m = upward.depth() / (top_m - base_m);
  for (const AlongLines* lines : {&eastward, &northward}) {
    radar::LinesAcross passage;
    for (std::size_t line = 0; line < parts_per_side_; ++line) {
      for (std::size_t slice = 0; slice < slices; ++slice)
        passage.add(depth_of_surface * lines->across[line][slice],
                    depth_of_surface * lines->with_neighbours[line][slice]);
    }
    extinction_per_m += passage.depth() / side_m;
  }
  obstacle.crown_base_m = static_cast<float>(base_m);
  obstacle.crown_top_m = static_cast<float>(top_m);
  obstacle.crown_extinction_per_m = static_cast<float>(extinction_per_m / 3.0);
}

void FoliageRaster::add_piece(const Corners& piece, const terrain::HeightField& ground) {
  const auto [a, b, c] = piece;
  const Vec2d middle{(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0};
  const Vec2d part = parts_.grid.cells_from(middle);
  if (part.x < 0.0 || part.x >= static_cast<double>(parts_.grid.columns)) return;
  if (part.y < static_cast<double>(parts_.first_row) || part.y >= static_cast<double>(parts_.first_row + parts_.rows)) {
    return;
  }
  const double ground_m = ground.height_at(middle);
  const auto [lowest, highest] = std::minmax({a.z, b.z, c.z});
  add_surface(static_cast<std::size_t>(part.x), static_cast<std::size_t>(part.y),
              {length(cross(b - a, c - a)) / 2.0, lowest - ground_m, highest - ground_m});
}

void FoliageRaster::add_surface(std::size_t column, std::size_t row, const Foliage& more) {
  if (more.area_m2 == 0.0 || more.top_m <= 0.0) return;  // nothing, or below the ground
  row -= parts_.first_row;
  Foliage& foliage = foliage_(column, row);
  const double base_m = std::max(0.0, more.base_m);
  foliage.base_m = foliage.area_m2 == 0.0 ? base_m : std::min(foliage.base_m, base_m);
  foliage.top_m = std::max(foliage.top_m, more.top_m);
  foliage.area_m2 += more.area_m2;
  is_there_(column / parts_per_side_, row / parts_per_side_) = 1;
}

/// As thick as a part is wide at least: of a sheet, lines between those that are laid would pass above or below it. Not
/// of what lies on the ground, which hides nothing.
Foliage FoliageRaster::foliage_of(std::size_t column, std::size_t row) const {
  Foliage part = foliage_(column, row - parts_.first_row);
  const double least_m = std::min(parts_.grid.cell_m, part_m);
  if (const double lacking_m = least_m - (part.top_m - part.base_m); lacking_m > 0.0 && part.top_m > least_m / 2.0) {
    part.base_m = std::max(0.0, part.base_m - lacking_m / 2.0);
    part.top_m += lacking_m / 2.0;
  }
  return part;
}

}  // namespace sigmascape::scene
