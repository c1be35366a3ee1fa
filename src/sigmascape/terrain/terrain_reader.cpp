#include "sigmascape/terrain/terrain_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/terrain/fitting_spacing.h"

namespace sigmascape::terrain {
namespace {

/// What reading takes of memory for every height: the height, and what filling and smoothing have of it meanwhile.
constexpr double bytes_a_height = 12.0;

std::size_t count_holes(const Array2D<float>& heights) {
  return static_cast<std::size_t>(std::ranges::count_if(heights.values(), [](float h) { return std::isnan(h); }));
}

NodeMask holes_in(const Array2D<float>& heights) {
  NodeMask holes(heights.columns(), heights.rows());
  std::ranges::transform(heights.values(), holes.values().begin(),
                         [](float h) -> std::uint8_t { return std::isnan(h) ? 1 : 0; });
  return holes;
}

/// Whether a place on a line lies between where that goes into the raster and out again.
bool is_inside(const std::vector<double>& crossings_m, double x_m) {
  return (std::ranges::upper_bound(crossings_m, x_m) - crossings_m.begin()) % 2 == 1;
}

/// Tells holes from what lies outside the raster, of which nobody wants to hear as of holes.
void tell_apart(NodeMask& holes, const geo::Lattice& nodes, const geo::RasterOutline& outline, double cell_m) {
  if (outline.empty()) return;
  for (std::size_t row = 0; row < holes.rows(); ++row) {
    if (std::ranges::count(holes.row(row), 0) == std::ssize(holes.row(row))) continue;
    const double y_m = nodes.north_m - static_cast<double>(row) * nodes.spacing_m;
    const std::array lines{outline.crossings_m(y_m), outline.crossings_m(y_m - cell_m),
                           outline.crossings_m(y_m + cell_m)};
    for (std::size_t column = 0; column < holes.columns(); ++column) {
      const double x_m = nodes.west_m + static_cast<double>(column) * nodes.spacing_m;
      if (holes(column, row) == 0 || is_inside(lines.front(), x_m)) continue;
      const bool is_near = std::ranges::any_of(lines, [&](const std::vector<double>& line) {
        return is_inside(line, x_m - cell_m) || is_inside(line, x_m) || is_inside(line, x_m + cell_m);
      });
      holes(column, row) = is_near ? at_the_edge : beyond_the_raster;
    }
  }
}

/// Half as many nodes a side, each the mean of the up to four it stands for that have a height.
Array2D<float> halved(const Array2D<float>& fine) {
  Array2D<float> coarse((fine.columns() + 1) / 2, (fine.rows() + 1) / 2);
  for (std::size_t row = 0; row < coarse.rows(); ++row) {
    for (std::size_t column = 0; column < coarse.columns(); ++column) {
      float sum = 0.0F, found = 0.0F;
      for (std::size_t j = 2 * row; j < std::min(2 * row + 2, fine.rows()); ++j) {
        for (std::size_t i = 2 * column; i < std::min(2 * column + 2, fine.columns()); ++i) {
          if (std::isnan(fine(i, j))) continue;
          sum += fine(i, j);
          found += 1.0F;
        }
      }
      coarse(column, row) = sum / found;  // NaN where all four are
    }
  }
  return coarse;
}

struct Node {
  std::size_t column, row;
};

/// The mean of a node's neighbours inside the field.
float neighbour_mean(const Array2D<float>& heights, Node node) {
  float sum = 0.0F, found = 0.0F;
  const auto add = [&](std::size_t column, std::size_t row) {
    sum += heights(column, row);
    found += 1.0F;
  };
  if (node.column > 0) add(node.column - 1, node.row);
  if (node.column + 1 < heights.columns()) add(node.column + 1, node.row);
  if (node.row > 0) add(node.column, node.row - 1);
  if (node.row + 1 < heights.rows()) add(node.column, node.row + 1);
  return sum / found;
}

/// One sweep of successive over-relaxation towards the surface of least squared slope.
template <typename Limit>
void relax(Array2D<float>& heights, Node node, const Limit& limited) {
  constexpr float over_relaxation = 1.7F;
  float& height = heights(node.column, node.row);
  height = limited(height + over_relaxation * (neighbour_mean(heights, node) - height));
}

/// Calls `visit` for the holes of some rows, row by row.
template <typename Visit>
void for_each_hole(const NodeMask& is_hole, const std::vector<std::size_t>& rows, const Visit& visit) {
  for (const std::size_t row : rows) {
    for (std::size_t column = 0; column < is_hole.columns(); ++column) {
      if (is_hole(column, row) != 0) visit(Node{column, row});
    }
  }
}

/// Throws Error, which names a spacing that would do, when reading the heights of a rectangle takes more memory than
/// there is.
void require_room(const radar::Rectangle& wanted, double spacing_m, const TerrainSource& source) {
  const double columns = std::floor(wanted.width_m() / spacing_m) + 1.0,
               rows = std::floor(wanted.height_m() / spacing_m) + 1.0;
  const double bytes = columns * rows * bytes_a_height, memory = machine_memory_bytes();
  if (bytes <= memory) return;
  throw Error(source.where.empty() ? source.raster.file.string() : source.where + ".spacing_m",
              fmt::format("heights every {:g} m over {:.0f} × {:.0f} m are {:.0f} × {:.0f}, which take {:.3g} GB of "
                          "memory to read, and there are {:.3g}",
                          spacing_m, wanted.width_m(), wanted.height_m(), columns, rows, bytes / 1e9, memory / 1e9),
              fmt::format("choose a spacing of {:g} m or more, or a smaller extent",
                          fitting_spacing_m(spacing_m, bytes, memory)));
}

/// ", in degrees -3.008 to -2.966 east and 43.297 to 43.328 north", where the raster lies; nothing of one so large that
/// no box about its middle tells.
std::string in_degrees(const geo::Raster& raster) {
  constexpr double largest_m = 200e3;
  const geo::GeographicPosition middle = raster.centre();
  const geo::LocalFrame about(middle.latitude_deg, middle.longitude_deg);
  const geo::Extent around = raster.outline_in(about).extent_around();
  if (!(std::max(around.east_m - around.west_m, around.north_m - around.south_m) < largest_m)) return "";
  const auto south_west = geo::place_on_globe(about, {around.west_m, around.south_m});
  const auto north_east = geo::place_on_globe(about, {around.east_m, around.north_m});
  // Across 180° longitudes count on.
  const double east_deg =
      north_east.longitude_deg + (north_east.longitude_deg < south_west.longitude_deg ? 360.0 : 0.0);
  return fmt::format(", in degrees {:.3f} to {:.3f} east and {:.3f} to {:.3f} north", south_west.longitude_deg,
                     east_deg, south_west.latitude_deg, north_east.latitude_deg);
}

}  // namespace

std::size_t fill_holes(Array2D<float>& heights) {
  const std::size_t holes = count_holes(heights);
  if (holes == 0 || holes == heights.size()) return holes;
  const NodeMask is_hole = holes_in(heights);
  Array2D<float> coarse = halved(heights);
  fill_holes(coarse);
  // A list of the holes themselves would take several times as much memory as heights that are mostly holes.
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < heights.rows(); ++row) {
    if (std::ranges::find(is_hole.row(row), 1) != is_hole.row(row).end()) rows.push_back(row);
  }
  for_each_hole(is_hole, rows,
                [&](Node node) { heights(node.column, node.row) = coarse(node.column / 2, node.row / 2); });
  for (int sweep = 0; sweep < 30; ++sweep) {
    Interruption::heed();
    for_each_hole(is_hole, rows, [&](Node node) { relax(heights, node, [](float height) { return height; }); });
  }
  return holes;
}

void smooth_within(Array2D<float>& heights, double tolerance_m) {
  // A node waits for the one before it in its row. Sweeps that go together, each a row behind the one before, come to
  // the same as one after another, and the processor has other nodes to work on meanwhile.
  constexpr std::size_t together = 4, times = 25;
  const Array2D<float> original = heights;
  const auto tolerance = static_cast<float>(tolerance_m);
  const auto relax_within = [&](Node node) {
    const float from = original(node.column, node.row);
    relax(heights, node, [&](float h) { return std::clamp(h, from - tolerance, from + tolerance); });
  };
  const std::size_t rows = heights.rows();
  for (std::size_t time = 0; time < times; ++time) {
    for (std::size_t foremost = 0; foremost < rows + together - 1; ++foremost) {
      Interruption::heed();
      const std::size_t first = foremost < rows ? 0 : foremost - rows + 1, end = std::min(together, foremost + 1);
      for (std::size_t column = 0; column < heights.columns(); ++column) {
        for (std::size_t sweep = first; sweep < end; ++sweep) relax_within({column, foremost - sweep});
      }
    }
  }
}

ReadTerrain read_terrain(const TerrainSource& source, const geo::LocalFrame& frame,
                         std::optional<radar::Rectangle> wanted) {
  const std::string name = source.raster.file.string();
  const geo::Raster raster(source.raster);
  const geo::RasterOutline outline = raster.outline_in(frame);
  ReadTerrain result;
  if (!wanted) {
    const geo::Extent inside = outline.extent_inside();
    if (inside.empty()) {
      throw Error(name, "reaches too far for a scene of all of it", "state the extent of the scene");
    }
    wanted = radar::Rectangle{inside.west_m, inside.south_m, inside.east_m, inside.north_m};
    result.left_out_share = std::max(0.0, 1.0 - wanted->width_m() * wanted->height_m() / outline.enclosed_m2());
  }
  const geo::Extent available = outline.extent_around();
  const bool overlap = wanted->west_m < available.east_m && wanted->east_m > available.west_m &&
                       wanted->south_m < available.north_m && wanted->north_m > available.south_m;
  if (!overlap) {
    throw Error(
        name, "does not overlap the scene's extent",
        fmt::format("move the extent into {:.0f} to {:.0f} m east and {:.0f} to {:.0f} m north of the origin{}",
                    available.west_m, available.east_m, available.south_m, available.north_m, in_degrees(raster)));
  }

  const double cell_m = raster.cell_m(frame, wanted->centre()), spacing_m = source.spacing_m.value_or(cell_m);
  require_room(*wanted, spacing_m, source);
  const auto columns = static_cast<std::size_t>(wanted->width_m() / spacing_m + 1e-6) + 1;
  const auto rows = static_cast<std::size_t>(wanted->height_m() / spacing_m + 1e-6) + 1;
  if (columns < 2 || rows < 2) {
    throw Error(name,
                fmt::format("a spacing of {:g} m leaves no cell in an extent of {:.1f} × {:.1f} m", spacing_m,
                            wanted->width_m(), wanted->height_m()),
                "choose a smaller spacing_m or a larger extent");
  }
  result.unit_is_guess = raster.height_unit().is_guess;
  const geo::Lattice nodes{wanted->west_m, wanted->north_m, spacing_m, columns, rows};
  Array2D<float> heights = raster.heights_on(nodes, frame, source.plausible);
  const auto holes = count_holes(heights);
  const double share = static_cast<double>(holes) / static_cast<double>(heights.size());
  if (share > source.largest_hole_share || holes == heights.size()) {
    throw Error(name,
                fmt::format("{:.0f} % of the scene's terrain has no height between {:g} and {:g} m", 100.0 * share,
                            source.plausible.lowest_m, source.plausible.highest_m),
                holes == heights.size() ? "give terrain that covers the extent"
                                        : "give terrain that covers the extent, make the extent smaller, or raise "
                                          "max_flawed_share to have the rest interpolated");
  }
  result.filled = holes_in(heights);
  tell_apart(result.filled, nodes, outline, cell_m);
  result.filled_nodes = fill_holes(heights);
  if (source.smooth_within_m > 0.0) smooth_within(heights, source.smooth_within_m);
  result.field = {wanted->west_m, wanted->north_m, spacing_m, std::move(heights)};
  return result;
}

}  // namespace sigmascape::terrain
