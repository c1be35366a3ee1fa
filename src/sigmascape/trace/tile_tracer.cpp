#include "sigmascape/trace/tile_tracer.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::trace {
namespace {

using radar::Channels;
using scatter::Amplitude;
using scatter::FieldPair;
using scatter::PolarizationBasis;

/// Which numbers of a path's sample serve what; one block of dimensions a vertex.
enum Dimension : std::uint32_t {
  RouletteChoice,
  PhaseA,
  PhaseB,
  ConnectPhaseA,
  ConnectPhaseB,
  ConnectRoulette,
  PairX,  // of the plain sampler
  PairY,
  DimensionsPerVertex
};
/// From the block before the first vertex, which has no other use for it.
constexpr std::uint32_t hero_choice = 0;

/// Connections to the radar that return less than this, |S|² a steradian, are made only now and then and count for
/// more: most directions off a glossy surface return next to nothing, and it is not worth a ray to learn whether the
/// radar is in sight. A ground of γ = −25 dB returns 0.00025.
constexpr float faint_connection = 2.5e-4F;

/// Surfaces are left by this much along the normal, so that a ray does not meet again what it starts from.
constexpr float surface_offset_m = 2e-3F;

/// S + Sᵀ of the path and its reversal, as powers: ½|(S + Sᵀ)_pq|².
Channels paired_powers(const FieldPair& out, const PolarizationBasis& receive) {
  const Amplitude vv = out.from_v.along(receive.v) * 2.0F;
  const Amplitude hh = out.from_h.along(receive.h) * 2.0F;
  const Amplitude hv = out.from_v.along(receive.h) + out.from_h.along(receive.v);
  return Channels{power_of(vv), power_of(hh), power_of(hv), correlation_of(vv, hh)} * 0.5F;
}

scatter::Facet face_of(const SurfaceHit& hit) {
  return {hit.normal, hit.inverse_facet_area_per_m2};
}

}  // namespace

TileTracer::TileTracer(const SceneGeometry& geometry, const SpectralSurfaces& surfaces, const Viewpoint& viewpoint,
                       const PathOptions& options, const LaunchArea& area, std::span<const LaunchCell> cells,
                       std::uint64_t seed)
    : geometry_(geometry),
      surfaces_(surfaces),
      viewpoint_(viewpoint),
      options_(options),
      area_(area),
      cells_(cells),
      seed_(seed),
      echoes_(surfaces.size()),
      out_(surfaces.size()) {}

void TileTracer::follow(const LaunchCell& cell, std::uint32_t sequence, std::uint32_t sample) {
  for (auto& of_frequency : echoes_) of_frequency.clear();
  const std::uint64_t key =
      hashed(seed_, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j), sequence);
  const SobolPoint point(key, sample);
  const Vec2f within = drawn_pair(point, 0);
  trace_path({(cell.i + static_cast<double>(within.x)) * area_.cell_m,
              (cell.j + static_cast<double>(within.y)) * area_.cell_m},
             area_.cell_m * area_.cell_m, point);
}

Vec2f TileTracer::drawn_pair(const SobolPoint& point, std::uint32_t bounce) const {
  if (options_.sampler == Sampler::OwenSobol) return point.pair(bounce);
  const std::uint32_t dimension = bounce * DimensionsPerVertex;
  return {point.independent(dimension + PairX), point.independent(dimension + PairY)};
}

void TileTracer::trace_path(Vec2d aim, double area_m2, const SobolPoint& point) {
  const Vec3d aim_point{aim.x, aim.y, area_.plane_height_m};
  launch_towards(aim_point, point);
  ++counts_.paths;
  for (int bounce = 1; bounce <= options_.max_bounces; ++bounce) {
    SurfaceHit hit;
    ++counts_.rays;
    if (!geometry_.intersect(path_.origin, path_.direction, hit)) return;
    const Vec3d position = hit.position.to<double>() + geometry_.origin();
    if (bounce == 1) {
      begin_at(position, hit.normal);
      add_direct_echoes(hit, position, aim_point, area_m2);
    } else {
      path_.travelled_m += length(hit.position - path_.origin);
      for (Wave& wave : path_.waves) wave.reverse /= std::abs(dot(path_.direction, hit.normal));
      add_connected_echoes(hit, position, aim_point, area_m2, bounce, point);
    }
    if (bounce == options_.max_bounces || !carry_on(hit, bounce, point)) return;
  }
}

void TileTracer::launch_towards(Vec3d aim_point, const SobolPoint& point) {
  const Vec3d to_radar = viewpoint_.direction_from(aim_point);
  const double back = (area_.top_height_m - area_.plane_height_m) / to_radar.z;
  path_.origin = (aim_point + to_radar * back - geometry_.origin()).to<float>();
  path_.direction = (-to_radar).to<float>();
  path_.travelled_m = 0.0;
  const std::size_t frequencies = surfaces_.size();
  path_.hero =
      frequencies == 1 ? 0 : static_cast<std::size_t>(point.independent(hero_choice) * static_cast<float>(frequencies));
  const PolarizationBasis transmit(path_.direction);
  path_.waves.assign(frequencies, {{{transmit.v, {}}, {transmit.h, {}}}, 1.0F, 1.0F});
}

void TileTracer::begin_at(Vec3d position, Vec3f normal) {
  path_.first_position = position;
  path_.first_range_m = viewpoint_.range_of(position);
  path_.first_cosine = -dot(path_.direction, normal);
}

void TileTracer::add_direct_echoes(const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2) {
  const Vec3f to_radar = -path_.direction;
  const double weight =
      4.0 * pi * viewpoint_.ray_weight_m2(aim_point, area_m2, path_.first_range_m, path_.first_range_m);
  const double cross = viewpoint_.cross_of(position);
  for (std::size_t f = 0; f < surfaces_.size(); ++f) {
    const Channels brdf = surfaces_[f][hit.material].backscatter(to_radar, face_of(hit));
    if (brdf == Channels{}) continue;
    append(f, {.range_m = path_.first_range_m,
               .cross = cross,
               .rcs_m2 = brdf * static_cast<float>(weight * path_.first_cosine),
               .bounces = 1});
  }
}

void TileTracer::add_connected_echoes(const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2,
                                      int bounce, const SobolPoint& point) {
  const Vec3f to_radar = viewpoint_.direction_from(position).to<float>();
  const float last_cosine = dot(to_radar, hit.normal);
  if (last_cosine <= 0.0F) return;
  const auto dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
  const scatter::PhaseDraw draw{point.independent(dimension + ConnectPhaseA),
                                point.independent(dimension + ConnectPhaseB)};
  float power = 0.0F;
  for (std::size_t f = 0; f < surfaces_.size(); ++f) {
    out_[f] = surfaces_[f][hit.material].scatter(path_.waves[f].fields, -path_.direction, to_radar, face_of(hit), draw);
    power = std::max(power, out_[f].mean_power());
  }
  if (power <= 0.0F) return;
  const float share = reciprocal_share(hit, position, to_radar, last_cosine);
  const float density = path_.mean_forward();
  const float chance = options_.roulette ? power * last_cosine * share / faint_connection / density : 1.0F;
  if (chance <= point.independent(dimension + ConnectRoulette)) return;
  ++counts_.rays;
  if (geometry_.occluded(hit.position + hit.normal * surface_offset_m, to_radar)) return;

  const double last_range_m = viewpoint_.range_of(position);
  const double range_m = 0.5 * (path_.first_range_m + last_range_m + path_.travelled_m);
  const double weight = 4.0 * pi * viewpoint_.ray_weight_m2(aim_point, area_m2, range_m, last_range_m);
  const float strength = last_cosine * share / std::min(chance, 1.0F) / density;
  const double cross =
      viewpoint_.middle_cross(viewpoint_.cross_of(path_.first_position), viewpoint_.cross_of(position));
  const PolarizationBasis receive(-to_radar);
  for (std::size_t f = 0; f < surfaces_.size(); ++f) {
    append(f, {.range_m = range_m,
               .cross = cross,
               .rcs_m2 = paired_powers(out_[f], receive) * static_cast<float>(weight * strength),
               .bounces = static_cast<std::uint8_t>(bounce)});
  }
}

/// 2/(1 + q): the part of the path and its reversal together that falls to this one of the two.
float TileTracer::reciprocal_share(const SurfaceHit& hit, Vec3d position, Vec3f to_radar, float last_cosine) const {
  if (options_.estimator == Estimator::OneWay) return 1.0F;
  if (!area_.covers(viewpoint_.shadow_on_plane(position, area_.plane_height_m))) return 2.0F;
  float back = 0.0F, forth = 0.0F;
  for (std::size_t f = 0; f < surfaces_.size(); ++f) {
    back += path_.waves[f].reverse * surfaces_[f][hit.material].pdf(to_radar, -path_.direction, face_of(hit));
    forth += path_.waves[f].forward;
  }
  const float q = back * last_cosine / path_.first_cosine / forth;
  return 2.0F / (1.0F + q);
}

/// Draws the next direction; false when the path ends here.
bool TileTracer::carry_on(const SurfaceHit& hit, int bounce, const SobolPoint& point) {
  const Vec3f to_source = -path_.direction;
  const auto next = surfaces_[path_.hero][hit.material].sample(to_source, face_of(hit),
                                                               drawn_pair(point, static_cast<std::uint32_t>(bounce)));
  const float cosine = dot(next.direction, hit.normal);
  if (next.pdf <= 0.0F || cosine <= 1e-6F) return false;

  const auto dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
  const scatter::PhaseDraw draw{point.independent(dimension + PhaseA), point.independent(dimension + PhaseB)};
  for (std::size_t f = 0; f < surfaces_.size(); ++f) {
    const auto& surface = surfaces_[f][hit.material];
    Wave& wave = path_.waves[f];
    wave.fields =
        surface.scatter(wave.fields, to_source, next.direction, face_of(hit), draw) * std::sqrt(cosine / next.pdf);
    if (f != path_.hero) wave.forward *= surface.pdf(to_source, next.direction, face_of(hit)) / next.pdf;
    // The vertex's part of the reversed density: at the first vertex there is none yet, only the forward one to divide
    // by.
    if (bounce > 1) wave.reverse *= surface.pdf(next.direction, to_source, face_of(hit));
    wave.reverse *= cosine / next.pdf;
  }
  if (!survives_roulette(point.independent(dimension + RouletteChoice))) return false;
  path_.direction = next.direction;
  path_.origin = hit.position + hit.normal * surface_offset_m;
  return true;
}

bool TileTracer::survives_roulette(float u) {
  const float power = path_.greatest_power();
  if (power <= 0.0F) return false;
  if (!options_.roulette) return true;
  const float survival = std::clamp(power * 4.0F, 0.1F, 1.0F);
  if (u >= survival) return false;
  for (Wave& wave : path_.waves) wave.fields = wave.fields * (1.0F / std::sqrt(survival));
  return true;
}

void TileTracer::append(std::size_t frequency, const radar::Echo& echo) {
  echoes_[frequency].push_back(echo);
  ++counts_.echoes;
}

}  // namespace sigmascape::trace
