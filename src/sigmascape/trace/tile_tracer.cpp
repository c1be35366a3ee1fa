#include "sigmascape/trace/tile_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
/// Far from the blocks of all vertices.
constexpr std::uint32_t first_roughness_phase = 0x10000;
constexpr std::uint32_t first_crown = 0x18000;

/// Connections to the radar that return less than this, |S|² a steradian, are made only now and then and count for
/// more: most directions off a glossy surface return next to nothing, and it is not worth a ray to learn whether the
/// radar is in sight. A ground of γ = −25 dB returns 0.00025.
constexpr float faint_connection = 2.5e-4F;

/// A path goes on with the chance of the part of the power sent that it still carries, but with no less than this. On
/// the paper's scene four times the part and no less than a tenth took up to half more time for hardly less noise in
/// the median texel, and about the same in L1 at equal time.
constexpr float least_survival = 0.05F;

/// Surfaces are left by this much along the normal, so that a ray does not meet again what it starts from.
constexpr float surface_offset_m = 2e-3F;

/// A scattering matrix that is its own transpose, in the bases of the antenna.
struct ScatteringMatrix {
  Amplitude vv, hh, hv;

  [[nodiscard]] Channels powers() const { return {power_of(vv), power_of(hh), power_of(hv), correlation_of(vv, hh)}; }
  [[nodiscard]] radar::ComplexChannels amplitudes() const { return {{vv.re, vv.im}, {hh.re, hh.im}, {hv.re, hv.im}}; }
};

/// S + Sᵀ of the path and its reversal.
ScatteringMatrix paired(const FieldPair& out, const PolarizationBasis& receive) {
  return {out.from_v.along(receive.v) * 2.0F, out.from_h.along(receive.h) * 2.0F,
          out.from_v.along(receive.h) + out.from_h.along(receive.v)};
}

/// The cosine between a direction and the normal; in a crown, which has none, one.
float cosine_at(const SurfaceHit& hit, Vec3f direction) {
  return hit.is_in_crown() ? 1.0F : dot(direction, hit.normal);
}

/// How densely vertices lie along rays of that direction: cosine or extinction. docs/physics/vegetation.md, Eq. (6).
float density_at(const SurfaceHit& hit, Vec3f direction) {
  return hit.is_in_crown() ? hit.extinction_per_m : dot(direction, hit.normal);
}

/// Where rays that leave a vertex start.
Vec3f start_from(const SurfaceHit& hit) {
  return hit.is_in_crown() ? hit.position : hit.position + hit.normal * surface_offset_m;
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
      frequencies_(surfaces.size()),
      viewpoint_(viewpoint),
      options_(options),
      area_(area),
      cells_(cells),
      seed_(seed),
      echoes_(surfaces.size()),
      books_(surfaces, options.power_books, counts_.power),
      out_(surfaces.size()) {}

void TileTracer::follow(const LaunchCell& cell, std::uint32_t sequence, std::uint32_t sample) {
  for (EchoList& list : echoes_) list.clear();
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
  books_.path_begins();
  go_on_from_launch(aim_point, area_m2, point);
  books_.path_ends();
}

void TileTracer::go_on_from_launch(Vec3d aim_point, double area_m2, const SobolPoint& point) {
  for (int bounce = 1; bounce <= options_.max_bounces; ++bounce) {
    SurfaceHit hit;
    if (!find_vertex(hit, bounce, point)) {
      books_.escapes(path_);
      return;
    }
    const Vec3d position = hit.position.to<double>() + geometry_.origin();
    if (bounce == 1) {
      begin_at(position, hit);
      add_direct_echoes(hit, position, aim_point, area_m2, point);
    } else {
      path_.travelled_m += length(hit.position - path_.origin);
      for (Wave& wave : path_.waves) wave.reverse /= std::abs(density_at(hit, path_.direction));
      add_connected_echoes(hit, position, aim_point, area_m2, bounce, point);
    }
    books_.is_scattered(path_, hit, bounce, point);
    const bool is_last = bounce == options_.max_bounces;
    if ((is_last && !books_.keeps_books()) || !carry_on(hit, bounce, point)) return;
    if (is_last) books_.is_cut(path_);
  }
}

void TileTracer::launch_towards(Vec3d aim_point, const SobolPoint& point) {
  const Vec3d to_radar = viewpoint_.direction_from(aim_point);
  const double back = (area_.top_height_m - area_.plane_height_m) / to_radar.z;
  path_.origin = (aim_point + to_radar * back - geometry_.origin()).to<float>();
  path_.direction = (-to_radar).to<float>();
  path_.travelled_m = 0.0;
  path_.first_density = 1.0F;
  path_.direct_return = 1.0F;
  path_.hero = frequencies_ == 1
                   ? 0
                   : static_cast<std::size_t>(point.independent(hero_choice) * static_cast<float>(frequencies_));
  const PolarizationBasis transmit(path_.direction);
  path_.waves.assign(frequencies_, {{{transmit.v, {}}, {transmit.h, {}}}, 1.0F, 1.0F});
}

bool TileTracer::find_vertex(SurfaceHit& hit, int bounce, const SobolPoint& point) {
  ++counts_.rays;
  if (!geometry_.has_crowns()) return geometry_.intersect(path_.origin, path_.direction, hit);

  crowns_.begin(surfaces_.front());
  const bool meets_surface = geometry_.intersect(path_.origin, path_.direction, hit, crowns_);
  float distance_m = meets_surface ? length(hit.position - path_.origin) : std::numeric_limits<float>::infinity();
  const std::uint32_t dimension = first_crown + 2 * static_cast<std::uint32_t>(bounce);
  const float depth = -std::log1p(-point.independent(dimension));
  const auto intercepted = crowns_.interception(depth, distance_m, point.independent(dimension + 1));
  if (intercepted) {
    distance_m = intercepted->distance_m;
    hit = {.position = path_.origin + path_.direction * distance_m,
           .normal = -path_.direction,
           .inverse_facet_area_per_m2 = 0.0F,
           .material = intercepted->medium,
           .extinction_per_m = intercepted->extinction_per_m};
  }
  if (bounce == 1) {
    path_.first_density = std::exp(-crowns_.optical_depth(distance_m));
    path_.direct_return = std::exp(-crowns_.return_depth(distance_m));
  }
  return meets_surface || intercepted.has_value();
}

float TileTracer::transmittance(const SurfaceHit& hit, Vec3f to_radar) {
  ++counts_.rays;
  if (!geometry_.has_crowns()) return geometry_.occluded(start_from(hit), to_radar) ? 0.0F : 1.0F;
  crowns_.begin(surfaces_.front());
  if (geometry_.occluded(start_from(hit), to_radar, crowns_)) return 0.0F;
  return std::exp(-crowns_.optical_depth());
}

void TileTracer::begin_at(Vec3d position, const SurfaceHit& hit) {
  path_.first_position = position;
  path_.first_range_m = viewpoint_.range_of(position);
  path_.first_density *= density_at(hit, -path_.direction);
}

void TileTracer::add_direct_echoes(const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2,
                                   const SobolPoint& point) {
  const double weight =
      4.0 * pi * viewpoint_.ray_weight_m2(aim_point, area_m2, path_.first_range_m, path_.first_range_m);
  const double cross = viewpoint_.cross_of(position);
  const auto sin_depression = static_cast<float>(viewpoint_.sin_depression_of(position, position));
  const float returned = cosine_at(hit, -path_.direction) * path_.direct_return;
  for (std::size_t f = 0; f < frequencies_; ++f) {
    const Channels rcs_m2 = direct_powers(f, hit, weight * returned, point);
    if (rcs_m2 == Channels{}) continue;
    append(f, {.range_m = path_.first_range_m,
               .cross = cross,
               .rcs_m2 = rcs_m2,
               .bounces = 1,
               .sin_depression = sin_depression,
               .from_ground = hit.is_ground});
  }
}

Channels TileTracer::direct_powers(std::size_t frequency, const SurfaceHit& hit, double weight,
                                   const SobolPoint& point) {
  const Vec3f to_radar = -path_.direction;
  const auto& surface = surfaces_[frequency][hit.material];
  if (!options_.coherent) return surface.backscatter(to_radar, face_of(hit)) * static_cast<float>(weight);

  const std::uint32_t dimension = DimensionsPerVertex;
  const FieldPair out =
      surface
          .scatter(path_.waves[frequency].fields, to_radar, to_radar, face_of(hit),
                   {point.independent(dimension + ConnectPhaseA), point.independent(dimension + ConnectPhaseB)})
          .turned(roughness_phasor(surface, 1, point));
  // A direct path is its own reversal: its matrix is symmetric, and the mean of both is itself.
  const ScatteringMatrix matrix =
      paired(out * (0.5F * static_cast<float>(std::sqrt(weight))), PolarizationBasis(path_.direction));
  const Channels powers = matrix.powers();
  if (!(powers == Channels{})) echoes_[frequency].amplitudes_m.push_back(matrix.amplitudes());
  return powers;
}

Amplitude TileTracer::roughness_phasor(const scatter::SurfaceModel& surface, int bounce,
                                       const SobolPoint& point) const {
  if (!surface.phase_is_random()) return {1.0F, 0.0F};
  const float u = point.independent(first_roughness_phase + static_cast<std::uint32_t>(bounce));
  return scatter::unit_phasor(static_cast<float>(2.0 * pi) * u);
}

void TileTracer::add_connected_echoes(const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2,
                                      int bounce, const SobolPoint& point) {
  const Vec3f to_radar = viewpoint_.direction_from(position).to<float>();
  const float last_cosine = cosine_at(hit, to_radar);
  if (last_cosine <= 0.0F) return;
  const auto dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
  const scatter::PhaseDraw draw{point.independent(dimension + ConnectPhaseA),
                                point.independent(dimension + ConnectPhaseB)};
  float power = 0.0F;
  for (std::size_t f = 0; f < frequencies_; ++f) {
    out_[f] = surfaces_[f][hit.material].scatter(path_.waves[f].fields, -path_.direction, to_radar, face_of(hit), draw);
    power = std::max(power, out_[f].mean_power());
  }
  if (power <= 0.0F) return;
  const float density = path_.mean_forward(), lot = point.independent(dimension + ConnectRoulette);
  const auto chance_of = [&](float share) {
    return options_.roulette ? power * last_cosine * share / faint_connection / density : 1.0F;
  };
  // Shares are two at most, and most connections are so faint that it does not matter how much theirs is.
  if (chance_of(2.0F) <= lot) return;
  // Crowns on the way to the radar have a part in the share, which then has to wait for the ray.
  const bool has_crowns = geometry_.has_crowns();
  float share = has_crowns ? 1.0F : reciprocal_share(hit, position, to_radar, last_cosine);
  const float chance = chance_of(share);
  if (chance <= lot) return;
  const float passed = transmittance(hit, to_radar);
  if (passed <= 0.0F) return;
  if (has_crowns) share = passed * reciprocal_share(hit, position, to_radar, passed * density_at(hit, to_radar));

  const double last_range_m = viewpoint_.range_of(position);
  const double range_m = 0.5 * (path_.first_range_m + last_range_m + path_.travelled_m);
  const double weight = 4.0 * pi * viewpoint_.ray_weight_m2(aim_point, area_m2, range_m, last_range_m);
  const float strength = last_cosine * share / std::min(chance, 1.0F) / density;
  const double cross =
      viewpoint_.middle_cross(viewpoint_.cross_of(path_.first_position), viewpoint_.cross_of(position));
  const auto sin_depression = static_cast<float>(viewpoint_.sin_depression_of(path_.first_position, position));
  const PolarizationBasis receive(-to_radar);
  for (std::size_t f = 0; f < frequencies_; ++f) {
    const ScatteringMatrix matrix = paired(out_[f], receive);
    append(f, {.range_m = range_m,
               .cross = cross,
               .rcs_m2 = matrix.powers() * 0.5F * static_cast<float>(weight * strength),
               .bounces = static_cast<std::uint8_t>(bounce),
               .sin_depression = sin_depression});
    if (!options_.coherent) continue;
    const Amplitude phasor = roughness_phasor(surfaces_[f][hit.material], bounce, point);
    const ScatteringMatrix turned{matrix.vv * phasor, matrix.hh * phasor, matrix.hv * phasor};
    echoes_[f].amplitudes_m.push_back(turned.amplitudes() * static_cast<float>(std::sqrt(0.5 * weight * strength)));
  }
}

/// 2/(1 + q): the part of the path and its reversal together that falls to this one of the two.
float TileTracer::reciprocal_share(const SurfaceHit& hit, Vec3d position, Vec3f to_radar, float last_density) const {
  if (options_.estimator == Estimator::OneWay) return 1.0F;
  if (!area_.covers(viewpoint_.shadow_on_plane(position, area_.plane_height_m))) return 2.0F;
  float back = 0.0F, forth = 0.0F;
  for (std::size_t f = 0; f < frequencies_; ++f) {
    back += path_.waves[f].reverse * surfaces_[f][hit.material].pdf(to_radar, -path_.direction, face_of(hit));
    forth += path_.waves[f].forward;
  }
  const float q = back * last_density / path_.first_density / forth;
  return 2.0F / (1.0F + q);
}

/// Draws the next direction; false when the path ends here.
bool TileTracer::carry_on(const SurfaceHit& hit, int bounce, const SobolPoint& point) {
  const Vec3f to_source = -path_.direction;
  const auto next = surfaces_[path_.hero][hit.material].sample(to_source, face_of(hit),
                                                               drawn_pair(point, static_cast<std::uint32_t>(bounce)));
  const float cosine = cosine_at(hit, next.direction);
  if (next.pdf <= 0.0F || cosine <= 1e-6F) return false;

  const auto dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
  const scatter::PhaseDraw draw{point.independent(dimension + PhaseA), point.independent(dimension + PhaseB)};
  for (std::size_t f = 0; f < frequencies_; ++f) {
    const auto& surface = surfaces_[f][hit.material];
    Wave& wave = path_.waves[f];
    wave.fields =
        surface.scatter(wave.fields, to_source, next.direction, face_of(hit), draw) * std::sqrt(cosine / next.pdf);
    if (options_.coherent) wave.fields = wave.fields.turned(roughness_phasor(surface, bounce, point));
    if (f != path_.hero) wave.forward *= surface.pdf(to_source, next.direction, face_of(hit)) / next.pdf;
  }
  if (!survives_roulette(point.independent(dimension + RouletteChoice))) return false;
  for (std::size_t f = 0; f < frequencies_; ++f) {
    // The vertex's part of the reversed density: at the first vertex there is none yet, only the forward one to divide
    // by.
    Wave& wave = path_.waves[f];
    if (bounce > 1) wave.reverse *= surfaces_[f][hit.material].pdf(next.direction, to_source, face_of(hit));
    wave.reverse *= density_at(hit, next.direction) / next.pdf;
  }
  path_.direction = next.direction;
  path_.origin = start_from(hit);
  return true;
}

bool TileTracer::survives_roulette(float u) {
  const float power = path_.greatest_power();
  if (power <= 0.0F) return false;
  if (!options_.roulette) return true;
  const float survival = std::clamp(power, least_survival, 1.0F);
  const double before = books_.keeps_books() ? Bookkeeper::carried(path_) : 0.0;
  const bool survives = u < survival;
  if (survives) {
    for (Wave& wave : path_.waves) wave.fields = wave.fields * (1.0F / std::sqrt(survival));
  }
  if (books_.keeps_books()) books_.meets_roulette(before, survives ? Bookkeeper::carried(path_) : 0.0);
  return survives;
}

void TileTracer::append(std::size_t frequency, const radar::Echo& echo) {
  echoes_[frequency].echoes.push_back(echo);
  ++counts_.echoes;
}

}  // namespace sigmascape::trace
