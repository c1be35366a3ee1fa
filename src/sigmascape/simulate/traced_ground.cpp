#include "sigmascape/simulate/traced_ground.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/simulate/launch_for_map.h"

namespace sigmascape::simulate {
namespace {

/// Steps towards where an echo lands; each takes off all but tan ψ times the slope of what is missing.
constexpr int landing_steps = 6;

trace::LaunchArea launch_for(const TracedView& view) {
  radar::Radar radar;
  radar.name = "of a traced frame";
  radar.position = view.radar;
  auto launch = launch_for_map(view.scene, view.geometry, radar, view.area, view.cell_m);
  // The area is the rectangle about a sector, which may be much larger.
  const double half = 0.5 * static_cast<double>(view.beams), step_rad = view.bins.azimuth_step_rad;
  trace::narrow_to(
      launch,
      {.radar = view.radar,
       .middle_azimuth_rad = view.bins.first_azimuth_rad + (static_cast<double>(view.first_beam) + half) * step_rad,
       .half_width_rad = (half + view.rim_beams) * step_rad,
       .near_range_m = view.bins.first_range_m - view.bins.range_step_m,
       .far_range_m = view.bins.first_range_m + static_cast<double>(view.bins.ranges + 1) * view.bins.range_step_m});
  return launch;
}

radar::LatticeCell cell_at(Vec2d point, double cell_m) {
  return {static_cast<std::int32_t>(std::floor(point.x / cell_m)),
          static_cast<std::int32_t>(std::floor(point.y / cell_m))};
}

}  // namespace

TracedGround::TracedGround(const TracedView& view)
    : view_(view),
      launch_(launch_for(view)),
      tracer_(view.geometry, view.surfaces, launch_.viewpoint, {.max_bounces = view.max_bounces}, view.seed),
      bins_(view.beams * view.bins.ranges),
      cells_(view.cell_m),
      answers_(launch_.cells.size(), 0) {}

std::size_t TracedGround::answering() const {
  return static_cast<std::size_t>(std::ranges::count(answers_, std::uint8_t{1}));
}

void TracedGround::add_passes(std::uint64_t count, std::span<const radar::Target> targets, double time_s) {
  UnhiddenEchoes unhidden(view_.scene.extent, targets, view_.radar, thread_count(view_.threads), time_s);
  for (std::uint64_t pass = 0; pass < count; ++pass) add_pass(unhidden);
}

void TracedGround::add_pass(UnhiddenEchoes& unhidden) {
  receiver::PowerBins pass(view_.bins.ranges, view_.beams);
  const auto sequence = static_cast<std::uint32_t>(bins_.passes());
  tracer_.trace_tiles(launch_, view_.threads, [&](trace::TilePaths& tile, unsigned worker) {
    std::vector<trace::PathStart> starts;
    std::vector<std::size_t> cells;  // [start]
    const auto first = static_cast<std::size_t>(tile.cells().data() - launch_.cells.data());
    for (std::size_t number = 0; number < tile.cells().size(); ++number) {
      const trace::LaunchCell& cell = tile.cells()[number];
      const trace::SampleRange samples =
          trace::samples_for(cell, {sequence * rays_a_pass, rays_a_pass, rays_a_pass}, view_.seed);
      for (std::uint32_t sample = 0; sample < samples.count; ++sample) {
        starts.push_back({.cell = cell, .sequence = sequence, .sample = sample});
        cells.push_back(first + number);
      }
    }
    tile.follow(starts);
    for (std::size_t start = 0; start < starts.size(); ++start) {
      for (radar::Echo echo : unhidden.among(tile.echoes(0, start), worker)) {
        echo.rcs_m2 = echo.rcs_m2 * (1.0F / (static_cast<float>(rays_a_pass) * starts[start].cell.share));
        add(echo, pass);
        answers_[cells[start]] = 1;
      }
    }
  });
  if (pass.overflows() + cells_.overflows() > 0) {
    throw Error("traced frame", "a bin is brighter than the sums can hold", "use finer bins or rougher materials");
  }
  bins_.add(pass);
  cells_.make_room();
}

double TracedGround::beam_of(double azimuth_rad) const {
  const double half = 0.5 * static_cast<double>(view_.bins.azimuths);
  const double middle = view_.bins.first_azimuth_rad + half * view_.bins.azimuth_step_rad;
  return half + turned_by_least(azimuth_rad - middle) / view_.bins.azimuth_step_rad;
}

void TracedGround::add(const radar::Echo& echo, receiver::PowerBins& pass) {
  const Vec3d place = place_of(echo, view_.radar);
  if (!view_.scene.extent.contains({place.x, place.y})) return;
  const double beam = beam_of(echo.cross), range = (echo.range_m - view_.bins.first_range_m) / view_.bins.range_step_m;
  const auto first = static_cast<double>(view_.first_beam), count = static_cast<double>(view_.beams);
  const double round = static_cast<double>(view_.bins.azimuths);
  bool in_reach = false;
  // Where beams go round, what lies beyond the last has its share in the first.
  for (const double turn : {0.0, round, -round}) {
    if (turn != 0.0 && !view_.bins.goes_round()) break;
    const double row = beam + turn - first;
    pass.add_shared(range, row, echo.rcs_m2);
    in_reach = in_reach || (row > -view_.rim_beams && row < count + view_.rim_beams);
  }
  if (view_.with_cells && in_reach && range > -0.5 && range < static_cast<double>(view_.bins.ranges) + 0.5)
    add_to_cells(echo, place, beam, range);
}

void TracedGround::add_to_cells(const radar::Echo& echo, Vec3d place, double beam, double range) {
  const radar::LatticeCell cell = cell_at(landing_of(echo, place), view_.cell_m);
  const LatticeSums::Place middle = middle_of(cell);
  const double turns = view_.bins.azimuth_step_rad * (beam - middle.beam);
  cells_.add(cell, echo.rcs_m2, {turned_by_least(turns) / view_.bins.azimuth_step_rad, range - middle.range});
}

Vec2d TracedGround::landing_of(const radar::Echo& echo, Vec3d place) const {
  const Vec2d foot{place.x, place.y};
  if (echo.from_ground) return foot;
  const Vec2d radar{view_.radar.x, view_.radar.y}, outwards{std::sin(echo.cross), std::cos(echo.cross)};
  Vec2d landing = foot;
  for (int step = 0; step < landing_steps; ++step) {
    const double below_m = view_.radar.z - view_.scene.terrain.height_at(landing);
    landing = radar + outwards * std::sqrt(std::max(echo.range_m * echo.range_m - below_m * below_m, 0.0));
  }
  return landing;
}

LatticeSums::Place TracedGround::middle_of(radar::LatticeCell cell) const {
  const Vec2d middle{(static_cast<double>(cell.column) + 0.5) * view_.cell_m,
                     (static_cast<double>(cell.row) + 0.5) * view_.cell_m};
  const double east = middle.x - view_.radar.x, north = middle.y - view_.radar.y;
  const double below = view_.radar.z - view_.scene.terrain.height_at(middle);
  return {
      beam_of(std::atan2(east, north)),
      (std::sqrt(east * east + north * north + below * below) - view_.bins.first_range_m) / view_.bins.range_step_m};
}

}  // namespace sigmascape::simulate
