#include "sigmascape/scene/painted_ground.h"

#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

constexpr std::uint8_t built_flag = 0x80;

GroundClass class_of(std::uint8_t cell) {
  return static_cast<GroundClass>(cell & ~built_flag);
}

}  // namespace

PaintedGround::PaintedGround(radar::GroundGrid grid, GroundClass fill)
    : grid_(grid), cells_(grid.columns, grid.rows, static_cast<std::uint8_t>(fill)) {}

GroundClass PaintedGround::cell(std::size_t column, std::size_t row) const {
  return class_of(cells_(column, row));
}

void PaintedGround::set(std::size_t column, std::size_t row, GroundClass ground) {
  cells_(column, row) = static_cast<std::uint8_t>(ground);
}

bool PaintedGround::is_free(Vec2d p, GroundClasses wanted) const {
  if (!grid_.extent().contains(p)) return false;
  const Vec2d cells = grid_.cells_from(p);
  const auto column = std::min(static_cast<std::size_t>(cells.x), grid_.columns - 1);
  const auto row = std::min(static_cast<std::size_t>(cells.y), grid_.rows - 1);
  const std::uint8_t found = cells_(column, row);
  return (found & built_flag) == 0 && wanted.has(class_of(found));
}

bool PaintedGround::is_free_around(Vec2d p, double radius_m, GroundClasses wanted) const {
  if (!is_free(p, wanted)) return false;
  for (int direction = 0; direction < 8; ++direction) {
    const double angle = pi / 4.0 * direction;
    if (!is_free(p + Vec2d{std::cos(angle), std::sin(angle)} * radius_m, wanted)) return false;
  }
  return true;
}

bool PaintedGround::is_free(const ConvexPolygon& polygon, GroundClasses wanted) const {
  for (const Vec2d corner : polygon) {
    if (!grid_.extent().contains(corner)) return false;
  }
  bool free = true;
  for_each_cell(grid_, polygon, [&](std::size_t column, std::size_t row) {
    const std::uint8_t found = cells_(column, row);
    free = free && (found & built_flag) == 0 && wanted.has(class_of(found));
  });
  return free;
}

void PaintedGround::paint(const ConvexPolygon& polygon, GroundClass ground, GroundClasses over) {
  for_each_cell(grid_, polygon, [&](std::size_t column, std::size_t row) {
    const std::uint8_t found = cells_(column, row);
    if ((found & built_flag) == 0 && over.has(class_of(found))) set(column, row, ground);
  });
}

void PaintedGround::paint_along(const SmoothLine& line, double half_width_m, GroundClass ground, GroundClasses over) {
  for (std::size_t i = 0; i + 1 < line.points().size(); ++i) {
    const Vec2d from = line.points()[i], to = line.points()[i + 1];
    const Vec2d along = (to - from) * (1.0 / length(to - from));
    // A little longer than the piece, so that no wedge stays open on the outer side of a bend.
    paint(oriented_rectangle((from + to) * 0.5, along, length(to - from) + 0.3 * half_width_m, 2.0 * half_width_m),
          ground, over);
  }
}

void PaintedGround::mark_built(const ConvexPolygon& polygon) {
  for_each_cell(grid_, polygon, [&](std::size_t column, std::size_t row) {
    cells_(column, row) = static_cast<std::uint8_t>(cells_(column, row) | built_flag);
  });
}

}  // namespace sigmascape::scene
