#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "sigmascape/base/array2d.h"
#include "sigmascape/scene/convex_polygon.h"
#include "sigmascape/scene/smooth_line.h"

namespace sigmascape::scene {

/// What a cell of a made-up landscape is.
enum class GroundClass : std::uint8_t { Concrete, Asphalt, Grass, Water, Dirt, ForestFloor };
inline constexpr std::size_t ground_class_count = 6;

/// A set of ground classes.
class GroundClasses {
 public:
  constexpr GroundClasses(std::initializer_list<GroundClass> members) {
    for (const GroundClass member : members) bits_ |= bit(member);
  }
  [[nodiscard]] constexpr bool has(GroundClass member) const { return (bits_ & bit(member)) != 0U; }

 private:
  static constexpr unsigned bit(GroundClass member) { return 1U << static_cast<unsigned>(member); }
  unsigned bits_ = 0U;
};

inline constexpr GroundClasses every_ground_class{GroundClass::Concrete, GroundClass::Asphalt,
                                                  GroundClass::Grass,    GroundClass::Water,
                                                  GroundClass::Dirt,     GroundClass::ForestFloor};
inline constexpr GroundClasses soft_ground{GroundClass::Grass, GroundClass::Dirt, GroundClass::ForestFloor};

/// The ground of a made-up landscape while it is laid out: a class for every cell, and whether a building stands there.
class PaintedGround {
 public:
  PaintedGround(radar::GroundGrid grid, GroundClass fill);

  [[nodiscard]] const radar::GroundGrid& grid() const { return grid_; }
  [[nodiscard]] GroundClass cell(std::size_t column, std::size_t row) const;
  void set(std::size_t column, std::size_t row, GroundClass ground);

  /// Whether the point lies on the map, on one of these classes, with no building on it.
  [[nodiscard]] bool is_free(Vec2d p, GroundClasses wanted) const;
  /// Whether that holds for the point and eight points around it.
  [[nodiscard]] bool is_free_around(Vec2d p, double radius_m, GroundClasses wanted) const;
  /// Whether that holds for every cell of the polygon, all of which must lie on the map.
  [[nodiscard]] bool is_free(const ConvexPolygon& polygon, GroundClasses wanted) const;

  /// Paints the cells of a polygon that now are of one of the classes `over` and carry no building.
  void paint(const ConvexPolygon& polygon, GroundClass ground, GroundClasses over = every_ground_class);
  void paint_along(const SmoothLine& line, double half_width_m, GroundClass ground,
                   GroundClasses over = every_ground_class);
  void mark_built(const ConvexPolygon& polygon);

 private:
  radar::GroundGrid grid_;
  Array2D<std::uint8_t> cells_;  // the class, and a flag where a building stands
};

}  // namespace sigmascape::scene
