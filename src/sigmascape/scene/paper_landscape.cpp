#include "sigmascape/scene/paper_landscape.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/scene/value_noise.h"

namespace sigmascape::scene {
namespace {

constexpr double water_level_m = 12.0;
constexpr double bridge_height_m = 2.0;
constexpr double embankment_m = 2.0;  // level ground on either side of a road that crosses water
constexpr double embankment_slope_m = 7.0;
constexpr double forest_share = 0.38;

terrain::HeightField empty_field(const PaperSceneSize& size) {
  return {.west_m = -size.side_m / 2.0,
          .north_m = size.side_m / 2.0,
          .spacing_m = size.side_m / static_cast<double>(size.height_nodes - 1),
          .height_m = Array2D<float>(size.height_nodes, size.height_nodes)};
}

/// Calls `body` for every row below `rows`, several at a time.
template <typename Body>
void for_each_row(std::size_t rows, const Body& body) {
  parallel_for(rows, thread_count(0), [&](std::size_t row, unsigned) { body(row); });
}

/// Fills a field node by node from a function of the place.
template <typename Function>
terrain::HeightField field_of(const PaperSceneSize& size, const Function& function) {
  terrain::HeightField field = empty_field(size);
  for_each_row(size.height_nodes, [&](std::size_t row) {
    for (std::size_t column = 0; column < size.height_nodes; ++column) {
      const Vec2d p{field.west_m + field.spacing_m * static_cast<double>(column),
                    field.north_m - field.spacing_m * static_cast<double>(row)};
      field.height_m(column, row) = static_cast<float>(function(p));
    }
  });
  return field;
}

/// Distance to the shore, negative in the water.
double shore_distance_m(const PaperLayout& layout, Vec2d p) {
  double distance = layout.river.nearest_to(p).distance_m - layout.river_half_width_m;
  for (const Lake& lake : layout.lakes) {
    const Vec2d from_centre = p - lake.centre;
    const double ragged = 1.3 * (fractal_noise(hashed(layout.seed, 1), from_centre * (1.6 / lake.radius_m), 4) - 0.5);
    distance = std::min(distance, length(from_centre) - lake.radius_m * (1.0 + ragged));
  }
  return distance + 6.0 * (value_noise(hashed(layout.seed, 2), p * (1.0 / 45.0)) - 0.5);
}

/// 1 in the town, 0 well outside.
double town_share(const PaperLayout& layout, Vec2d p) {
  return 1.0 - smooth_step(0.6 * layout.town_radius_m, 1.8 * layout.town_radius_m, length(p - layout.town_centre));
}

double hill_m(const PaperLayout& layout, Vec2d p) {
  const double side = layout.size.side_m;
  const double relief_m = 75.0 * std::pow(side / 2000.0, 0.8);
  const double hills = fractal_noise(hashed(layout.seed, 3), p * (3.2 / side), 6);
  const double ripples = 0.8 * value_noise(hashed(layout.seed, 4), p * (1.0 / 35.0));
  return relief_m * smooth_step(0.1, 0.95, hills) * (1.0 - 0.75 * town_share(layout, p)) + ripples;
}

double distance_to_roads_m(const PaperLayout& layout, Vec2d p) {
  double distance = layout.highway.nearest_to(p).distance_m - highway_half_width_m;
  for (const SmoothLine& road : layout.main_roads)
    distance = std::min(distance, road.nearest_to(p).distance_m - main_road_half_width_m);
  return distance;
}

/// Whether one of the nodes that share a cell with the node at p lies in the water. Such nodes are level, so that no
/// water slopes.
bool touches_water(const terrain::HeightField& shore, Vec2d p) {
  for (const double east : {-1.0, 0.0, 1.0}) {
    for (const double north : {-1.0, 0.0, 1.0}) {
      if (shore.height_at(p + Vec2d{east, north} * shore.spacing_m) < 0.0) return true;
    }
  }
  return false;
}

terrain::HeightField relief(const PaperLayout& layout, const terrain::HeightField& shore) {
  const double side = layout.size.side_m, spacing = shore.spacing_m;
  return field_of(layout.size, [&](Vec2d p) {
    const double inland = touches_water(shore, p) ? 0.0 : std::max(0.0, shore.height_at(p) - 2.0 * spacing);
    const double bank = 1.5 * smooth_step(0.0, 15.0, inland);
    double height = water_level_m + bank;
    if (inland > 0.0) height += hill_m(layout, p) * smooth_step(0.0, 0.22 * side, inland);
    if (inland < 40.0) {
      const double off_road_m = distance_to_roads_m(layout, p) - embankment_m;
      height =
          std::max(height, water_level_m + bridge_height_m * (1.0 - smooth_step(0.0, embankment_slope_m, off_road_m)));
    }
    return height;
  });
}

/// How much a place lends itself to forest: high ground away from the town, with ragged borders.
terrain::HeightField forest_fitness(const PaperLayout& layout) {
  const double side = layout.size.side_m;
  return field_of(layout.size, [&](Vec2d p) {
    const double regions = fractal_noise(hashed(layout.seed, 5), p * (4.0 / side), 5);
    const double ragged = 0.10 * value_noise(hashed(layout.seed, 6), p * (1.0 / 28.0));
    const double clearing = 0.6 * smooth_step(0.66, 0.76, fractal_noise(hashed(layout.seed, 7), p * (1.0 / 120.0), 4));
    return regions + ragged - clearing - 0.22 * town_share(layout, p);
  });
}

/// The value that the given share of the field's nodes exceed.
double exceeded_by(const terrain::HeightField& field, double share) {
  std::vector<float> values(field.height_m.values().begin(), field.height_m.values().end());
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>((1.0 - share) * static_cast<double>(values.size()));
  std::ranges::nth_element(values, nth);
  return *nth;
}

void paint_fields(PaperLandscape& landscape, const PaperLayout& layout, const terrain::HeightField& fitness,
                  double threshold) {
  for (std::size_t i = 0; i < landscape.fields.size(); ++i) {
    Interruption::heed();
    const ConvexPolygon& field = landscape.fields[i];
    const float kind = unit_float(hashed(layout.seed, 8, i));
    const double drawn = 0.05 * unit_float(hashed(layout.seed, 9, i));
    if (fitness.height_at(middle_of(field)) > threshold + drawn) {
      landscape.ground.paint(field, GroundClass::ForestFloor);
    } else if (kind < 0.4F) {
      landscape.ground.paint(inset(field, 1.5), GroundClass::Dirt);
    }
  }
}

/// Tracks between fields and into the forests.
void paint_tracks(PaperLandscape& landscape, const PaperLayout& layout) {
  constexpr double half_width_m = 1.6;
  for (std::size_t i = 0; i < landscape.fields.size(); ++i) {
    Interruption::heed();
    const ConvexPolygon& field = landscape.fields[i];
    for (std::size_t edge = 0; edge < field.size(); ++edge) {
      if (unit_float(hashed(layout.seed, 11, i, edge)) > 0.15F) continue;
      const ConvexPolygon track = strip(field[edge], field[(edge + 1) % field.size()], half_width_m);
      if (!track.empty())
        landscape.ground.paint(track, GroundClass::Dirt, {GroundClass::Grass, GroundClass::ForestFloor});
    }
  }
}

void paint_forest_and_water(PaintedGround& ground, const terrain::HeightField& shore,
                            const terrain::HeightField& fitness, double threshold) {
  constexpr double beach_m = 2.0;
  for_each_row(ground.grid().rows, [&](std::size_t row) {
    for (std::size_t column = 0; column < ground.grid().columns; ++column) {
      const Vec2d p = ground.grid().centre_of(column, row);
      const double inland = shore.height_at(p);
      if (inland < 0.0) {
        ground.set(column, row, GroundClass::Water);
      } else if (inland < beach_m) {
        ground.set(column, row, GroundClass::Dirt);
      } else if (inland < 9.0) {
        ground.set(column, row, GroundClass::Grass);
      } else {
        const double fit = fitness.height_at(p);
        if (fit > threshold + 0.03) ground.set(column, row, GroundClass::ForestFloor);
        if (fit < threshold - 0.35 && ground.cell(column, row) == GroundClass::ForestFloor)
          ground.set(column, row, GroundClass::Grass);
      }
    }
  });
}

void paint_roads(PaintedGround& ground, const PaperLayout& layout, double node_spacing_m) {
  const double shoulder_m = embankment_m + embankment_slope_m + 1.5 * node_spacing_m;
  const auto pave = [&](const SmoothLine& road, double half_width_m, double verge_m) {
    ground.paint_along(road, half_width_m + shoulder_m, GroundClass::Dirt, {GroundClass::Water});
    ground.paint_along(road, half_width_m + verge_m, GroundClass::Grass, {GroundClass::ForestFloor, GroundClass::Dirt});
  };
  pave(layout.highway, highway_half_width_m, 7.0);
  for (const SmoothLine& road : layout.main_roads) pave(road, main_road_half_width_m, 3.0);
  for (const SmoothLine& road : layout.main_roads)
    ground.paint_along(road, main_road_half_width_m, GroundClass::Asphalt);
  ground.paint_along(layout.highway, highway_half_width_m, GroundClass::Asphalt);
  ground.paint_along(layout.highway, highway_median_half_width_m, GroundClass::Grass);
}

}  // namespace

PaperLandscape paper_landscape(const PaperLayout& layout) {
  const PaperSceneSize& size = layout.size;
  const terrain::HeightField shore = field_of(size, [&](Vec2d p) { return shore_distance_m(layout, p); });
  const terrain::HeightField fitness = forest_fitness(layout);
  const double threshold = exceeded_by(fitness, forest_share);
  const radar::GroundGrid grid{.west_m = -size.side_m / 2.0,
                               .north_m = size.side_m / 2.0,
                               .cell_m = size.side_m / static_cast<double>(size.material_cells),
                               .columns = size.material_cells,
                               .rows = size.material_cells};
  PaperLandscape landscape{.terrain = relief(layout, shore), .ground = {grid, GroundClass::Grass}, .fields = {}};
  const double field_area_m2 = std::min(16'000.0, size.side_m * size.side_m / 40.0);
  landscape.fields = partitioned(
      layout.square(), 0.3,
      {.target_area_m2 = field_area_m2, .district_area_m2 = 12.0 * field_area_m2, .district_turn_rad = 0.35},
      hashed(layout.seed, 10));
  paint_fields(landscape, layout, fitness, threshold);
  paint_forest_and_water(landscape.ground, shore, fitness, threshold);
  paint_tracks(landscape, layout);
  paint_roads(landscape.ground, layout, landscape.terrain.spacing_m);
  return landscape;
}

}  // namespace sigmascape::scene
