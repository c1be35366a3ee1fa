#include "sigmascape/render/ground_scatterers.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/radar/target_shadows.h"
#include "sigmascape/render/line_of_sight.h"
#include "sigmascape/render/reflecting_ground.h"
#include "sigmascape/render/sight_map.h"

namespace sigmascape::render {
namespace {

/// A scatterer, and where an image that is made of it has it, twice.
constexpr double bytes_a_cell = 136.0;
static_assert(sizeof(radar::Scatterer) == 56);

constexpr double numbered_cells = 0x1p27;

/// That numbers and memory can hold.
double most_cells() {
  return std::min(numbered_cells, machine_memory_bytes() / bytes_a_cell);
}

/// σ0 of a point on the terrain as the radar sees it: nothing where it is hidden.
using SeenSigma0 = std::function<radar::Channels(Vec3d point, ReflectingGround::Looks& looks)>;

SeenSigma0 seen(const ReflectivityField& field, const terrain::HeightField& terrain, const ScattererRequest& request,
                double) {
  return [&, lowest_m = static_cast<double>(terrain.lowest_m()), highest_m = static_cast<double>(terrain.highest_m())](
             Vec3d point, ReflectingGround::Looks&) {
    const Vec3d radar = request.vantage.place_for({point.x, point.y});
    if (!line_of_sight(terrain, lowest_m, highest_m, radar, point, request.earth)) return radar::Channels{};
    const Vec3d away = radar - point;
    const double distance_m = std::hypot(away.x, away.y);
    return field({point.x, point.y},
                 {azimuth_of(radar - point), std::atan2(away.z - request.earth.drop_m(distance_m), distance_m)});
  };
}

SeenSigma0 seen(const AtlasReflectivity& textures, const terrain::HeightField& terrain, const ScattererRequest& request,
                double side_m) {
  const Vec2d middle = request.area.centre();
  // Scatterers lie anywhere within their cells.
  textures.atlas->prepare(radar::widened(request.area, side_m), textures.level);
  const auto buildings = building_layer(*textures.atlas, terrain,
                                        {request.vantage, textures.frequency_hz, radar::widened(request.area, side_m),
                                         textures.level, request.earth, request.threads});
  const ReflectingGround ground =
      ReflectingGround(*textures.atlas, terrain, request.vantage.place_for(middle), textures.frequency_hz,
                       textures.level, SlopeModel::Upright, request.earth)
          .with_buildings(buildings.get());
  // What hides is known no finer than its cells: two steps a cell find its edges.
  const double step_m = std::max(side_m, ground.told_cell_m() / 2.0);
  const auto sights = std::make_shared<const SightMap>(ground, request.vantage, terrain.extent(), request.area, step_m,
                                                       request.threads);
  return [&request, ground, buildings, sights](Vec3d point, ReflectingGround::Looks& looks) {
    const Vec3d radar = request.vantage.place_for({point.x, point.y});
    return ground.seen_from(radar).sigma0(point, wrapped_azimuth(azimuth_of(radar - point)),
                                          sights->at({point.x, point.y}), looks);
  };
}

}  // namespace

Reflectivity reflectivity_of(const atlas::Atlas& atlas, double frequency_hz, double cell_m) {
  atlas.check_frequency(frequency_hz);
  return AtlasReflectivity{&atlas, frequency_hz, atlas.level_for(cell_m)};
}

void check_scatterers(const radar::Rectangle& area, double side_m) {
  if (!(area.width_m() > 0.0 && area.height_m() > 0.0) ||
      area.width_m() / side_m * (area.height_m() / side_m) > most_cells()) {
    throw Error("ground scatterers",
                fmt::format("an area of {:.0f} m by {:.0f} m in cells of {} m is asked for", area.width_m(),
                            area.height_m(), side_m),
                fmt::format("give an area of at most {:.0f} cells, {}, or larger cells by pulses over a shorter "
                            "interval or an image of coarser resolution",
                            most_cells(), most_cells() < numbered_cells ? "which memory holds" : "2²⁷"));
  }
}

std::vector<radar::Scatterer> ground_scatterers(const terrain::HeightField& terrain, const Reflectivity& sigma0,
                                                const radar::ScattererLattice& lattice, const ScattererRequest& request,
                                                std::span<const radar::Target> targets) {
  const double side_m = lattice.cell_m(request.level);
  const radar::Rectangle& area = request.area;
  check_scatterers(area, side_m);
  // Cells belong to the area whole or not at all, by their middle: neighbouring areas share none.
  const auto first_of = [side_m](double edge_m) { return static_cast<std::int32_t>(std::ceil(edge_m / side_m - 0.5)); };
  const std::int32_t west = first_of(area.west_m), east = first_of(area.east_m);
  const std::int32_t south = first_of(area.south_m), north = first_of(area.north_m);
  const SeenSigma0 sigma0_seen =
      std::visit([&](const auto& source) { return seen(source, terrain, request, side_m); }, sigma0);
  const radar::TargetShadows shadows(targets, request.vantage, request.earth);
  const auto cell_area = static_cast<float>(side_m * side_m);

  std::vector<std::vector<radar::Scatterer>> rows(static_cast<std::size_t>(std::max(0, north - south)));
  parallel_for(rows.size(), request.threads, [&](std::size_t index, unsigned) {
    const std::int32_t row = south + static_cast<std::int32_t>(index);
    ReflectingGround::Looks looks;
    for (std::int32_t column = west; column < east; ++column) {
      const Vec2d place = lattice.position_in({column, row}, request.level);
      if (!terrain.extent().contains(place)) continue;
      const Vec3d point{place.x, place.y, terrain.height_at(place)};
      if (shadows.hide(point)) continue;
      const radar::Channels mean = sigma0_seen(point, looks) * cell_area;
      if (mean == radar::Channels{}) continue;
      rows[index].push_back({point, polarized(lattice.drawn({column, row}, request.level), mean)});
    }
  });
  std::size_t count = 0;
  for (const auto& row : rows) count += row.size();
  std::vector<radar::Scatterer> all;
  all.reserve(count);
  for (auto& row : rows) {
    Interruption::heed();
    all.insert(all.end(), row.begin(), row.end());
    row = {};
  }
  return all;
}

}  // namespace sigmascape::render
