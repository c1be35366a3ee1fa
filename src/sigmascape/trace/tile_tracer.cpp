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

bool is_of_the_sequence_of(const PathStart& a, const PathStart& b) {
  return a.cell.i == b.cell.i && a.cell.j == b.cell.j && a.sequence == b.sequence;
}

}  // namespace

TileTracer::TileTracer(const SceneGeometry& geometry, const SpectralSurfaces& surfaces, const Viewpoint& viewpoint,
                       const PathOptions& options, const LaunchArea& area, std::uint64_t seed)
    : geometry_(geometry),
      surfaces_(surfaces),
      frequencies_(surfaces.size()),
      viewpoint_(viewpoint),
      options_(options),
      area_(area),
      seed_(seed),
      books_(surfaces, options.power_books, counts_.power),
      echoes_(surfaces.size()),
      groups_(surfaces.size() * surfaces.front().size()),
      lanes_(surfaces.size()),
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
    arrive(bounce);
    const bool is_last = bounce == options_.max_bounces, goes_on = !is_last || books_.keeps_books();
    connections_.clear();
    connected_fields_.clear();
    for_each_company([&](const Company& company) { scatter(company, bounce, goes_on); });
    add_connected_echoes(bounce);
    if (!goes_on) break;
    std::erase_if(living_, [&](std::uint32_t path) { return !paths_[path].is_alive; });
    if (!is_last) continue;
    for (const std::uint32_t path : living_) books_.is_cut(paths_[path], waves_of(paths_[path]));
  }
  if (!books_.keeps_books()) return;
  for (const Path& path : paths_) {
    if (path.counts) books_.path_ends(path);
  }
}

void TileTracer::scatter(const Company& company, int bounce, bool goes_on) {
  gather_waves(company, bounce);
  if (bounce == 1)
    add_direct_echoes(company);
  else
    consider_connections(company, bounce);
  if (books_.keeps_books()) {
    for (const std::uint32_t path : company.paths) books_.is_scattered(paths_[path], waves_of(paths_[path]), bounce);
  }
  if (goes_on) carry_on(company, bounce);
}

void TileTracer::launch(std::span<const PathStart> starts, std::size_t first) {
  counts_.paths += starts.size();
  paths_.resize(starts.size());
  waves_.resize(starts.size() * frequencies_);
  living_.resize(starts.size());
  std::iota(living_.begin(), living_.end(), 0U);
  std::uint64_t key = 0;
  for (std::size_t begin = 0; begin < starts.size(); begin += lane_count) {
    const std::size_t count = std::min(lane_count, starts.size() - begin);
    SobolLanes points;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::size_t number = begin + lane;
      const auto& [cell, sequence, sample] = starts[number];
      if (number == 0 || !is_of_the_sequence_of(starts[number - 1], starts[number]))
        key = hashed(seed_, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j), sequence);
      Path& path = paths_[number] = {};
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
  path.launch_share = cell.share;
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
    for (const std::uint32_t path : living_) paths_[path].is_alive = find_vertex_among_crowns(paths_[path], bounce);
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

void TileTracer::arrive(int bounce) {
  for (auto& group : groups_) group.clear();
  const std::size_t materials = surfaces_.front().size();
  std::erase_if(living_, [&](std::uint32_t i) {
    Path& path = paths_[i];
    if (!arrives(path, bounce)) return true;
    groups_[path.hero * materials + path.hit.material].push_back(i);
    return false;
  });
}

bool TileTracer::arrives(Path& path, int bounce) {
  if (!path.is_alive) {
    books_.escapes(path, waves_of(path));
    return false;
  }
  if (bounce > 1) {
    path.travelled_m += static_cast<double>(length(path.hit.position - path.ray.origin));
    return true;
  }
  path.first_position = position_of(path);
  path.counts = area_.counts_from(path.first_position);
  path.first_range_m = viewpoint_.range_of(path.first_position);
  path.first_density *= density_at(path.hit, -path.ray.direction);
  return path.counts;
}

void TileTracer::gather_waves(const Company& company, int bounce) {
  for (std::size_t f = 0; f < frequencies_; ++f) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::size_t path = company.paths[std::min(lane, company.paths.size() - 1)];
      lanes_[f].set(lane, waves_[path * frequencies_ + f]);
    }
  }
  if (bounce == 1) return;
  weigh_directions(company.at, company.extinction_per_m, company.at.to_source, cosine_, density_);
  for (WaveLanes& waves : lanes_) trace::arrive(density_, waves);
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
