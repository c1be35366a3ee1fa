#include "sigmascape/trace/tile_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sigmascape/base/units.h"
#include "sigmascape/trace/vertex.h"

namespace sigmascape::trace {
namespace {

using scatter::PolarizationBasis;

/// Enough that even the few that live long fill packets, and not too many for the second level of caches.
constexpr std::size_t paths_at_once = 2048;

/// From the block before the first vertex, which has no other use for it.
constexpr std::uint32_t hero_choice = 0;
/// Far from the blocks of all vertices.
constexpr std::uint32_t first_roughness_phase = 0x10000;
constexpr std::uint32_t first_crown = 0x18000;

}  // namespace

TileTracer::TileTracer(const SceneGeometry& geometry, const SpectralSurfaces& surfaces, const Viewpoint& viewpoint,
                       const PathOptions& options, const LaunchArea& area, std::span<const LaunchCell> cells,
                       std::uint64_t seed)
    : geometry_(geometry),
      surfaces_(surfaces),
      frequencies_(surfaces.size()),
      viewpoint_(viewpoint),
      options_(options),
      area_(area),
      cells_(cells),
      seed_(seed),
      books_(surfaces, options.power_books, counts_.power),
      echoes_(surfaces.size()),
      groups_(surfaces.size() * surfaces.front().size()),
      passages_(surfaces.size()) {}

void TileTracer::follow(std::span<const PathStart> starts) {
  for (EchoesByStart& list : echoes_) list.begin(starts.size());
  for (std::size_t first = 0; first < starts.size(); first += paths_at_once)
    follow_together(starts.subspan(first, std::min(paths_at_once, starts.size() - first)), first);
  for (EchoesByStart& list : echoes_) list.sort();
}

void TileTracer::follow_together(std::span<const PathStart> starts, std::size_t first) {
  launch(starts, first);
  for (int bounce = 1; bounce <= options_.max_bounces && !living_.empty(); ++bounce) {
    find_vertices(bounce);
    if (bounce == 1) leave_out_strangers();
    for (const std::uint32_t path : living_) arrive(paths_[path], bounce);
    group_by_surface();
    if (bounce == 1)
      add_direct_echoes();
    else
      add_connected_echoes(bounce);
    if (books_.keeps_books()) {
      for (const std::uint32_t path : living_) books_.is_scattered(paths_[path], waves_of(paths_[path]), bounce);
    }
    const bool is_last = bounce == options_.max_bounces;
    if (is_last && !books_.keeps_books()) break;
    carry_on(bounce);
    if (!is_last) continue;
    for (const std::uint32_t path : living_) books_.is_cut(paths_[path], waves_of(paths_[path]));
  }
  for (const Path& path : paths_) {
    if (path.counts) books_.path_ends(path);
  }
}

void TileTracer::launch(std::span<const PathStart> starts, std::size_t first) {
  counts_.paths += starts.size();
  paths_.assign(starts.size(), {});
  waves_.resize(starts.size() * frequencies_);
  living_.resize(starts.size());
  std::iota(living_.begin(), living_.end(), 0U);
  for (std::size_t begin = 0; begin < starts.size(); begin += lane_count) {
    const std::size_t count = std::min(lane_count, starts.size() - begin);
    SobolLanes points;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto& [cell, sequence, sample] = starts[begin + lane];
      const std::uint64_t key =
          hashed(seed_, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j), sequence);
      Path& path = paths_[begin + lane];
      path.start = static_cast<std::uint32_t>(first + begin + lane);
      path.point = SobolPoint(key, sample);
      points.set(lane, path.point);
    }
    const PairLanes within = drawn_pairs(points, 0);
    for (std::size_t lane = 0; lane < count; ++lane)
      launch_towards(paths_[begin + lane], within[lane], starts[begin + lane].cell);
  }
}

PairLanes TileTracer::drawn_pairs(const SobolLanes& points, std::uint32_t bounce) const {
  PairLanes pairs;
  if (options_.sampler == Sampler::OwenSobol) {
    draw_pairs(points, bounce, pairs);
  } else {
    draw_independent(points, bounce * DimensionsPerVertex + PairX, pairs.x);
    draw_independent(points, bounce * DimensionsPerVertex + PairY, pairs.y);
  }
  return pairs;
}

void TileTracer::launch_towards(Path& path, Vec2f within_cell, const LaunchCell& cell) {
  path.aim = {(cell.i + static_cast<double>(within_cell.x)) * area_.cell_m,
              (cell.j + static_cast<double>(within_cell.y)) * area_.cell_m, area_.plane_height_m};
  const Vec3d to_radar = viewpoint_.direction_from(path.aim);
  const double back = (area_.top_height_m - area_.plane_height_m) / to_radar.z;
  path.ray = {(path.aim + to_radar * back - geometry_.origin()).to<float>(), (-to_radar).to<float>()};
  path.imbalance = -1.0;
  if (frequencies_ > 1) {
    path.hero = static_cast<std::size_t>(path.point.independent(hero_choice) * static_cast<float>(frequencies_));
  }
  const PolarizationBasis transmit(path.ray.direction);
  std::ranges::fill(waves_of(path), Wave{{{transmit.v, {}}, {transmit.h, {}}}, 1.0F, 1.0F});
}

void TileTracer::find_vertices(int bounce) {
  counts_.rays += living_.size();
  if (geometry_.has_crowns()) {
    find_vertices_among_crowns(bounce);
    return;
  }
  rays_.clear();
  for (const std::uint32_t path : living_) rays_.push_back(paths_[path].ray);
  hits_.resize(rays_.size());
  answers_.resize(rays_.size());
  geometry_.intersect(rays_, hits_, answers_);
  for (std::size_t i = 0; i < living_.size(); ++i) {
    Path& path = paths_[living_[i]];
    path.hit = hits_[i];
    path.is_alive = answers_[i] != 0;
  }
  keep_living();
}

void TileTracer::find_vertices_among_crowns(int bounce) {
  for (const std::uint32_t path : living_) paths_[path].is_alive = find_vertex_among_crowns(paths_[path], bounce);
  keep_living();
}

bool TileTracer::find_vertex_among_crowns(Path& path, int bounce) {
  const auto& [origin, direction] = path.ray;
  crowns_.begin(surfaces_.front());
  const bool meets_surface = geometry_.intersect(origin, direction, path.hit, crowns_);
  float distance_m = meets_surface ? length(path.hit.position - origin) : std::numeric_limits<float>::infinity();
  const std::uint32_t dimension = first_crown + 2 * static_cast<std::uint32_t>(bounce);
  const float depth = -std::log1p(-path.point.independent(dimension));
  const auto intercepted = crowns_.interception(depth, distance_m, path.point.independent(dimension + 1));
  if (intercepted) {
    distance_m = intercepted->distance_m;
    path.hit = {.position = origin + direction * distance_m,
                .normal = -direction,
                .inverse_facet_area_per_m2 = 0.0F,
                .material = intercepted->medium,
                .extinction_per_m = intercepted->extinction_per_m};
  }
  if (bounce == 1) {
    path.first_density = std::exp(-crowns_.optical_depth(distance_m));
    path.direct_return = std::exp(-crowns_.return_depth(distance_m));
  }
  return meets_surface || intercepted.has_value();
}

void TileTracer::keep_living() {
  std::erase_if(living_, [&](std::uint32_t i) {
    const Path& path = paths_[i];
    if (!path.is_alive) books_.escapes(paths_[i], waves_of(path));
    return !path.is_alive;
  });
}

void TileTracer::leave_out_strangers() {
  std::erase_if(living_, [&](std::uint32_t i) {
    paths_[i].counts = area_.counts_from(position_of(paths_[i]));
    return !paths_[i].counts;
  });
}

void TileTracer::arrive(Path& path, int bounce) {
  if (bounce == 1) {
    path.first_position = position_of(path);
    path.first_range_m = viewpoint_.range_of(path.first_position);
    path.first_density *= density_at(path.hit, -path.ray.direction);
    return;
  }
  path.travelled_m += static_cast<double>(length(path.hit.position - path.ray.origin));
  for (Wave& wave : waves_of(path)) wave.reverse /= std::abs(density_at(path.hit, path.ray.direction));
}

void TileTracer::group_by_surface() {
  for (auto& group : groups_) group.clear();
  const std::size_t materials = surfaces_.front().size();
  for (const std::uint32_t i : living_) groups_[paths_[i].hero * materials + paths_[i].hit.material].push_back(i);
}

void TileTracer::gather_fields(const Company& company, std::size_t frequency) {
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const std::size_t path = company.paths[std::min(lane, company.paths.size() - 1)];
    fields_.set(lane, waves_[path * frequencies_ + frequency].fields);
  }
}

PairLanes TileTracer::phase_draws(const Company& company, std::uint32_t first_dimension) const {
  PairLanes draws;
  if (!surfaces_.front()[company.material].draws_phases()) return draws;
  draw_independent(company.points, first_dimension, draws.x);
  draw_independent(company.points, first_dimension + 1, draws.y);
  return draws;
}

scatter::Amplitude TileTracer::roughness_phasor(const Path& path, std::size_t frequency, int bounce) const {
  if (!surfaces_[frequency][path.hit.material].phase_is_random()) return {1.0F, 0.0F};
  const float u = path.point.independent(first_roughness_phase + static_cast<std::uint32_t>(bounce));
  return scatter::unit_phasor(static_cast<float>(2.0 * pi) * u);
}

void TileTracer::append(const Path& path, std::size_t frequency, const radar::Echo& echo) {
  echoes_[frequency].add(path.start, echo);
  ++counts_.echoes;
}

}  // namespace sigmascape::trace
