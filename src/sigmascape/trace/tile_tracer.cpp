#include "sigmascape/trace/tile_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sigmascape/base/units.h"
#include "sigmascape/trace/vertex.h"

namespace sigmascape::trace {
namespace {

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
  const std::size_t waves = waves_of(starts.size());
  for (std::size_t wave = 0; wave < waves; ++wave) {
    const std::size_t first = wave * starts.size() / waves, end = (wave + 1) * starts.size() / waves;
    follow_together(starts.subspan(first, end - first), first);
  }
  for (EchoesByStart& list : echoes_) list.sort();
}

void TileTracer::follow_together(std::span<const PathStart> starts, std::size_t first) {
  launch(starts, first);
  for (int bounce = 1; bounce <= options_.max_bounces && now_.size() > 0; ++bounce) {
    find_vertices(bounce);
    arrive(bounce);
    const bool is_last = bounce == options_.max_bounces, goes_on = !is_last || books_.keeps_books();
    connections_.clear();
    connected_fields_.clear();
    next_.clear();
    for_each_company([&](const Company& company) { scatter(company, bounce, goes_on); });
    add_connected_echoes(bounce);
    if (!goes_on) break;
    std::swap(now_, next_);
    if (!is_last) continue;
    for (std::size_t leg = 0; leg < now_.size(); ++leg) books_.is_cut(path_of(leg), waves_along(leg));
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
    for (const std::uint32_t leg : company.legs)
      books_.is_scattered(path_of(leg), arrival_of(leg, bounce), waves_along(leg));
  }
  if (goes_on) carry_on(company, bounce);
}

void TileTracer::launch(std::span<const PathStart> starts, std::size_t first) {
  counts_.paths += starts.size();
  paths_.resize(starts.size());
  now_.legs.resize(starts.size());
  now_.rays.resize(starts.size());
  std::uint64_t key = 0;
  for (std::size_t begin = 0; begin < starts.size(); begin += lane_count) {
    const std::size_t count = std::min(lane_count, starts.size() - begin);
    SobolLanes points;
    AimLanes aims;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::size_t number = begin + lane;
      const auto& [cell, sequence, sample] = starts[number];
      if (number == 0 || !is_of_the_sequence_of(starts[number - 1], starts[number]))
        key = hashed(seed_, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j), sequence);
      paths_[number] = {.start = static_cast<std::uint32_t>(first + number),
                        .launch_share = cell.share,
                        .first_vertex = {},
                        .imbalance = -1.0};
      Leg& leg = now_.legs[number] = {.path = static_cast<std::uint32_t>(number), .point = SobolPoint(key, sample)};
      if (frequencies_ > 1) {
        leg.hero = static_cast<std::uint32_t>(leg.point.independent(hero_choice) * static_cast<float>(frequencies_));
      }
      points.set(lane, leg.point);
      aims.i[lane] = cell.i;
      aims.j[lane] = cell.j;
    }
    draw_pairs_for(points, 0, aims.within_cell);
    launch_towards(aims, count, begin);
  }
  now_.waves.clear();
  if (!books_.keeps_books()) return;
  for (const Ray& ray : now_.rays) now_.waves.insert(now_.waves.end(), frequencies_, transmitted(ray.direction));
}

void TileTracer::draw_pairs_for(const SobolLanes& points, std::uint32_t bounce, PairLanes& pairs) const {
  if (options_.sampler == Sampler::OwenSobol) {
    draw_pairs(points, bounce, pairs);
  } else {
    draw_independent(points, bounce * DimensionsPerVertex + PairX, pairs.x);
    draw_independent(points, bounce * DimensionsPerVertex + PairY, pairs.y);
  }
}

void TileTracer::launch_towards(const AimLanes& aims, std::size_t count, std::size_t number) {
  LaunchedLanes launched;
  aim_rays(viewpoint_,
           {.cell_m = area_.cell_m,
            .plane_height_m = area_.plane_height_m,
            .top_height_m = area_.top_height_m,
            .origin = geometry_.origin()},
           aims, launched);
  for (std::size_t lane = 0; lane < count; ++lane) {
    paths_[number + lane].beam = launched.beam[lane];
    now_.rays[number + lane] = {launched.start[lane], launched.direction[lane]};
  }
}

void TileTracer::find_vertices(int bounce) {
  counts_.rays += now_.size();
  hits_.resize(now_.size());
  meets_.resize(now_.size());
  if (geometry_.has_crowns()) {
    for (std::size_t leg = 0; leg < now_.size(); ++leg) meets_[leg] = find_vertex_among_crowns(leg, bounce) ? 1 : 0;
    return;
  }
  // Those from the radar come cell by cell.
  geometry_.intersect(now_.rays, hits_, meets_, bounce == 1 ? RayOrder::AsGiven : RayOrder::ByPlace);
}

bool TileTracer::find_vertex_among_crowns(std::size_t leg, int bounce) {
  const auto& [origin, direction] = now_.rays[leg];
  const SobolPoint& point = now_.legs[leg].point;
  SurfaceHit& hit = hits_[leg];
  crowns_.begin(surfaces_.front());
  const bool meets_surface = geometry_.intersect(origin, direction, hit, crowns_);
  float distance_m = meets_surface ? length(hit.position - origin) : std::numeric_limits<float>::infinity();
  const std::uint32_t dimension = first_crown + 2 * static_cast<std::uint32_t>(bounce);
  const float depth = -std::log1p(-point.independent(dimension));
  const auto intercepted = crowns_.interception(depth, distance_m, point.independent(dimension + 1));
  if (intercepted) {
    distance_m = intercepted->distance_m;
    hit = {.position = origin + direction * distance_m,
           .normal = -direction,
           .inverse_facet_area_per_m2 = 0.0F,
           .material = intercepted->medium,
           .extinction_per_m = intercepted->extinction_per_m};
  }
  if (bounce == 1) {
    path_of(leg).first_density = std::exp(-crowns_.optical_depth(distance_m));
    path_of(leg).direct_return = std::exp(-crowns_.return_depth(distance_m));
  }
  return meets_surface || intercepted.has_value();
}

void TileTracer::arrive(int bounce) {
  for (auto& group : groups_) group.clear();
  const std::size_t materials = surfaces_.front().size();
  for (std::size_t leg = 0; leg < now_.size(); ++leg) {
    if (meets_[leg] == 0 || !stops(hits_[leg], now_.rays[leg].direction))
      books_.escapes(path_of(leg), now_.waves.empty() ? std::span<const Wave>() : waves_along(leg));
    else if (bounce > 1 || begins(leg))
      groups_[now_.legs[leg].hero * materials + hits_[leg].material].push_back(static_cast<std::uint32_t>(leg));
  }
}

bool TileTracer::begins(std::size_t leg) {
  Path& path = path_of(leg);
  path.first_vertex = hits_[leg].position;
  const Vec3d position = in_world(path.first_vertex);
  path.counts = counts_always_ || area_.counts_from(position);
  path.first_range_m = viewpoint_.range_of(position);
  path.first_density *= density_at(hits_[leg], -now_.rays[leg].direction);
  return path.counts;
}

void TileTracer::gather_waves(const Company& company, int bounce) {
  if (bounce == 1) {
    transmit(company.at, lanes_.front());
    for (std::size_t f = 1; f < frequencies_; ++f) lanes_[f] = lanes_.front();
    return;
  }
  for (std::size_t f = 0; f < frequencies_; ++f) {
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      lanes_[f].set(lane, now_.waves[company.leg(lane) * frequencies_ + f]);
  }
  weigh_directions(company.at, company.extinction_per_m, company.at.to_source, cosine_, density_);
  for (WaveLanes& waves : lanes_) trace::arrive(density_, waves);
}

void TileTracer::draw_phases(const Company& company, std::uint32_t first_dimension, PairLanes& draws) const {
  if (!surfaces_.front()[company.material].draws_phases()) return;
  draw_independent(company.points, first_dimension, draws.x);
  draw_independent(company.points, first_dimension + 1, draws.y);
}

scatter::Amplitude TileTracer::roughness_phasor(std::size_t leg, std::size_t frequency, int bounce) const {
  if (!surfaces_[frequency][hits_[leg].material].phase_is_random()) return {1.0F, 0.0F};
  const float u = now_.legs[leg].point.independent(first_roughness_phase + static_cast<std::uint32_t>(bounce));
  return scatter::unit_phasor(static_cast<float>(2.0 * pi) * u);
}

void TileTracer::append(const Path& path, std::size_t frequency, const radar::Echo& echo) {
  echoes_[frequency].add(path.start, echo);
  ++counts_.echoes;
}

}  // namespace sigmascape::trace
