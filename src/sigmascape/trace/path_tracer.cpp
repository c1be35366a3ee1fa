#include "sigmascape/trace/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/sobol.h"
#include "sigmascape/base/units.h"

namespace sigmascape::trace {
namespace {

using radar::Channels;
using radar::Echo;
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
  DimensionsPerVertex
};

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

/// One path on its way through the scene.
struct Path {
  Vec3f origin;
  Vec3f direction;
  FieldPair fields;
  Vec3d first_position;  // of the first vertex, in the world
  double first_range_m = 0.0;
  double travelled_m = 0.0;  // between vertices
  float first_cosine = 1.0F;
  // Density of the reversed path over that of the path, without the terms of the connection to the radar.
  float reverse_ratio = 1.0F;
};

/// Traces the paths of one tile on one thread.
class TileTracer {
 public:
  TileTracer(const SceneGeometry& geometry, const std::vector<scatter::SurfaceModel>& surfaces,
             const Viewpoint& viewpoint, const PathOptions& options, const LaunchArea& area, std::vector<Echo>& echoes,
             TraceCounts& counts)
      : geometry_(geometry),
        surfaces_(surfaces),
        viewpoint_(viewpoint),
        options_(options),
        area_(area),
        echoes_(echoes),
        counts_(counts) {}

  void trace_path(Vec2d aim, double area_m2, const SobolPoint& point) {
    Path path = launched_towards(aim);
    const Vec3d aim_point{aim.x, aim.y, area_.plane_height_m};
    ++counts_.paths;
    for (int bounce = 1; bounce <= options_.max_bounces; ++bounce) {
      SurfaceHit hit;
      ++counts_.rays;
      if (!geometry_.intersect(path.origin, path.direction, hit)) return;
      const Vec3d position = hit.position.to<double>() + geometry_.origin();
      if (bounce == 1) {
        begin_at(path, position, hit.normal);
        add_direct_echo(path, hit, position, aim_point, area_m2);
      } else {
        path.travelled_m += length(hit.position - path.origin);
        path.reverse_ratio /= std::abs(dot(path.direction, hit.normal));
        add_connected_echo(path, hit, position, aim_point, area_m2, bounce, point);
      }
      if (bounce == options_.max_bounces || !carry_on(path, hit, bounce, point)) return;
    }
  }

 private:
  [[nodiscard]] Path launched_towards(Vec2d aim) const {
    const Vec3d aim_point{aim.x, aim.y, area_.plane_height_m};
    const Vec3d to_radar = viewpoint_.direction_from(aim_point);
    const double back = (area_.top_height_m - area_.plane_height_m) / to_radar.z;
    Path path;
    path.origin = (aim_point + to_radar * back - geometry_.origin()).to<float>();
    path.direction = (-to_radar).to<float>();
    const PolarizationBasis transmit(path.direction);
    path.fields = {{transmit.v, {}}, {transmit.h, {}}};
    return path;
  }

  void begin_at(Path& path, Vec3d position, Vec3f normal) const {
    path.first_position = position;
    path.first_range_m = viewpoint_.range_of(position);
    path.first_cosine = -dot(path.direction, normal);
  }

  void add_direct_echo(const Path& path, const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2) {
    const Vec3f to_radar = -path.direction;
    const Channels brdf = surfaces_[hit.material].backscatter(to_radar, face_of(hit));
    if (brdf == Channels{}) return;
    const double weight =
        4.0 * pi * viewpoint_.ray_weight_m2(aim_point, area_m2, path.first_range_m, path.first_range_m);
    append({.range_m = path.first_range_m,
            .cross = viewpoint_.cross_of(position),
            .rcs_m2 = brdf * static_cast<float>(weight * path.first_cosine),
            .bounces = 1,
            .from_ground = hit.is_ground});
  }

  void add_connected_echo(const Path& path, const SurfaceHit& hit, Vec3d position, Vec3d aim_point, double area_m2,
                          int bounce, const SobolPoint& point) {
    const Vec3f to_radar = viewpoint_.direction_from(position).to<float>();
    const float last_cosine = dot(to_radar, hit.normal);
    if (last_cosine <= 0.0F) return;
    const auto& surface = surfaces_[hit.material];
    const auto dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
    const FieldPair out =
        surface.scatter(path.fields, -path.direction, to_radar, face_of(hit),
                        {point.independent(dimension + ConnectPhaseA), point.independent(dimension + ConnectPhaseB)});
    const float share = reciprocal_share(path, hit, position, to_radar, last_cosine);
    const float chance = options_.roulette ? out.mean_power() * last_cosine * share / faint_connection : 1.0F;
    if (out.mean_power() <= 0.0F || chance <= point.independent(dimension + ConnectRoulette)) return;
    ++counts_.rays;
    if (geometry_.occluded(hit.position + hit.normal * surface_offset_m, to_radar)) return;

    const double last_range_m = viewpoint_.range_of(position);
    const double range_m = 0.5 * (path.first_range_m + last_range_m + path.travelled_m);
    const double weight = 4.0 * pi * viewpoint_.ray_weight_m2(aim_point, area_m2, range_m, last_range_m);
    const float strength = last_cosine * share / std::min(chance, 1.0F);
    append({.range_m = range_m,
            .cross = viewpoint_.middle_cross(viewpoint_.cross_of(path.first_position), viewpoint_.cross_of(position)),
            .rcs_m2 = paired_powers(out, PolarizationBasis(-to_radar)) * static_cast<float>(weight * strength),
            .bounces = static_cast<std::uint8_t>(bounce)});
  }

  /// 2/(1 + q): the part of the path and its reversal together that falls to this one of the two.
  [[nodiscard]] float reciprocal_share(const Path& path, const SurfaceHit& hit, Vec3d position, Vec3f to_radar,
                                       float last_cosine) const {
    if (options_.estimator == Estimator::OneWay) return 1.0F;
    if (!area_.covers(viewpoint_.shadow_on_plane(position, area_.plane_height_m))) return 2.0F;
    const float back = surfaces_[hit.material].pdf(to_radar, -path.direction, face_of(hit));
    const float q = path.reverse_ratio * back * last_cosine / path.first_cosine;
    return 2.0F / (1.0F + q);
  }

  /// Draws the next direction; false when the path ends here.
  [[nodiscard]] bool carry_on(Path& path, const SurfaceHit& hit, int bounce, const SobolPoint& point) const {
    const auto& surface = surfaces_[hit.material];
    const Vec3f to_source = -path.direction;
    const auto next = surface.sample(to_source, face_of(hit), point.pair(static_cast<std::uint32_t>(bounce)));
    const float cosine = dot(next.direction, hit.normal);
    if (next.pdf <= 0.0F || cosine <= 1e-6F) return false;

    const auto dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
    path.fields = surface.scatter(path.fields, to_source, next.direction, face_of(hit),
                                  {point.independent(dimension + PhaseA), point.independent(dimension + PhaseB)}) *
                  std::sqrt(cosine / next.pdf);
    // The vertex's part of the reversed density: at the first vertex there is none yet, only the forward one to divide
    // by.
    if (bounce > 1) path.reverse_ratio *= surface.pdf(next.direction, to_source, face_of(hit));
    path.reverse_ratio *= cosine / next.pdf;

    if (!survives_roulette(path, point.independent(dimension + RouletteChoice))) return false;
    path.direction = next.direction;
    path.origin = hit.position + hit.normal * surface_offset_m;
    return true;
  }

  [[nodiscard]] bool survives_roulette(Path& path, float u) const {
    const float power = path.fields.mean_power();
    if (power <= 0.0F) return false;
    if (!options_.roulette) return true;
    const float survival = std::clamp(power * 4.0F, 0.1F, 1.0F);
    if (u >= survival) return false;
    path.fields = path.fields * (1.0F / std::sqrt(survival));
    return true;
  }

  void append(const Echo& echo) {
    echoes_.push_back(echo);
    ++counts_.echoes;
  }

  const SceneGeometry& geometry_;
  const std::vector<scatter::SurfaceModel>& surfaces_;
  const Viewpoint& viewpoint_;
  const PathOptions& options_;
  const LaunchArea& area_;
  std::vector<Echo>& echoes_;
  TraceCounts& counts_;
};

}  // namespace

std::vector<scatter::SurfaceModel> surface_models(const scene::Scene& scene, double frequency_hz) {
  std::vector<scatter::SurfaceModel> models;
  models.reserve(scene.materials.size());
  for (const auto& material : scene.materials) models.emplace_back(material, frequency_hz);
  return models;
}

PathTracer::PathTracer(const SceneGeometry& geometry, std::vector<scatter::SurfaceModel> surfaces,
                       const Viewpoint& viewpoint, const PathOptions& options, std::uint64_t seed)
    : geometry_(&geometry), surfaces_(std::move(surfaces)), viewpoint_(viewpoint), options_(options), seed_(seed) {}

TraceCounts PathTracer::trace(const LaunchArea& area, SampleRange samples, unsigned threads,
                              const EchoSink& sink) const {
  const unsigned workers = thread_count(threads);
  std::vector<std::vector<Echo>> echoes(workers);
  std::vector<TraceCounts> counts(workers);
  const double sample_area_m2 = area.cell_m * area.cell_m / samples.of;

  parallel_for(area.tiles(), workers, [&](std::size_t tile, unsigned worker) {
    const FlushDenormals flush;
    echoes[worker].clear();
    TileTracer tracer(*geometry_, surfaces_, viewpoint_, options_, area, echoes[worker], counts[worker]);
    const std::size_t end = std::min(area.cells.size(), (tile + 1) * cells_per_tile);
    for (std::size_t index = tile * cells_per_tile; index < end; ++index) {
      const LaunchCell cell = area.cells[index];
      const std::uint64_t key = hashed(seed_, static_cast<std::uint32_t>(cell.i), static_cast<std::uint32_t>(cell.j));
      for (std::uint32_t sample = samples.first; sample < samples.first + samples.count; ++sample) {
        const SobolPoint point(key, sample);
        const Vec2f within = point.pair(0);
        tracer.trace_path({(cell.i + static_cast<double>(within.x)) * area.cell_m,
                           (cell.j + static_cast<double>(within.y)) * area.cell_m},
                          sample_area_m2, point);
      }
    }
    sink(echoes[worker], worker);
  });

  TraceCounts total;
  for (const TraceCounts& part : counts) total += part;
  return total;
}

}  // namespace sigmascape::trace
