#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/base/sobol_lanes.h"
#include "sigmascape/scatter/lanes.h"
#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/trace/bookkeeper.h"
#include "sigmascape/trace/echoes_by_start.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/launch_lanes.h"
#include "sigmascape/trace/path.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/scene_geometry.h"
#include "sigmascape/trace/wave_lanes.h"

namespace sigmascape::trace {

/// Paths go together in waves of about so many: enough that even the few that live long fill packets, and not too many
/// for the caches.
inline constexpr std::size_t paths_at_once = 8192;

/// How many waves so many paths go in, all alike, lest a few that are left over go alone.
[[nodiscard]] constexpr std::size_t waves_of(std::size_t paths) {
  return std::max(std::size_t{1}, (paths + paths_at_once / 2) / paths_at_once);
}

/// Follows the paths of one tile after another on one thread, many at a time: all go from vertex to vertex together, so
/// that rays are traced in packets and surfaces answer sixteen waves at once. What a path brings back does not depend
/// on its company. docs/decisions/0060-paths-in-waves.md.
class TileTracer final : public TilePaths {
 public:
  /// Everything is held by reference and has to outlive the tracer.
  TileTracer(const SceneGeometry& geometry, const SpectralSurfaces& surfaces, const Viewpoint& viewpoint,
             const PathOptions& options, const LaunchArea& area, std::uint64_t seed);

  /// Turns to another tile.
  void begin(std::span<const LaunchCell> cells) {
    cells_ = cells;
    counts_always_ = area_.counts_always(cells);
  }
  [[nodiscard]] std::span<const LaunchCell> cells() const override { return cells_; }
  void follow(std::span<const PathStart> starts) override;
  [[nodiscard]] std::span<const radar::Echo> echoes(std::size_t frequency, std::size_t start) const override {
    return echoes_[frequency].echoes(start);
  }
  [[nodiscard]] std::span<const radar::ComplexChannels> amplitudes_m(std::size_t frequency,
                                                                     std::size_t start) const override {
    return echoes_[frequency].amplitudes_m(start);
  }
  [[nodiscard]] const TraceCounts& counts() const { return counts_; }

 private:
  /// Up to sixteen paths that have come to faces of one material and whose directions the same frequency draws.
  struct Company {
    std::span<const std::uint32_t> legs;  // that led there
    std::size_t hero = 0;
    scene::MaterialIndex material = 0;
    scatter::ArrivalLanes at;
    FloatLanes extinction_per_m;  // of the crowns that they are in
    SobolLanes points;

    [[nodiscard]] std::size_t count() const { return legs.size(); }
    /// Lanes that are left over repeat the last.
    [[nodiscard]] std::size_t leg(std::size_t lane) const { return legs[std::min(lane, legs.size() - 1)]; }
  };
  /// A last vertex that may return an echo, as far as that can be told without asking whether it sees the radar.
  struct Connection {
    std::uint32_t leg = 0;  // that leads there
    Vec3f to_radar;
    float density = 1.0F;  // of the path, whichever frequency were its hero
    float chance = 1.0F;   // with which it is made, but for the reciprocal share
    // Density of the reversed path over that of the path, but for that of the last vertex; 0 if it is not launched.
    float reverse_odds = 0.0F;
  };

  /// As many of each as there are legs; waves by leg and frequency. Of first legs there are waves only when the books
  /// ask for them.
  struct Legs {
    std::vector<Leg> legs;
    std::vector<Ray> rays;
    std::vector<Wave> waves;

    [[nodiscard]] std::size_t size() const { return legs.size(); }
    void clear() {
      legs.clear();
      rays.clear();
      waves.clear();
    }
  };

  // tile_tracer.cpp: the way of the paths
  void follow_together(std::span<const PathStart> starts, std::size_t first);
  void launch(std::span<const PathStart> starts, std::size_t first);
  /// From the given number on as many rays as there are cells.
  void launch_towards(const AimLanes& aims, std::size_t count, std::size_t number);
  /// Two numbers in [0, 1) a lane that belong together: where in the cell, or the direction after a bounce. Filled
  /// where they are wanted, as all lanes: GCC 12 was seen to keep lanes that a function returns, before they are
  /// copied, at a place of the stack that is less aligned than they are.
  void draw_pairs_for(const SobolLanes& points, std::uint32_t bounce, PairLanes& pairs) const;
  /// Finds where each leg ends, on a surface or at a place in a crown before it.
  void find_vertices(int bounce);
  [[nodiscard]] bool find_vertex_among_crowns(std::size_t leg, int bounce);
  /// Groups legs by what they have come to; ends paths that have come to nothing, or that began where nobody asked.
  void arrive(int bounce);
  [[nodiscard]] bool begins(std::size_t leg);
  /// All that happens at a vertex but for rays.
  void scatter(const Company& company, int bounce, bool goes_on);
  template <typename Body>
  void for_each_company(const Body& body);

  // direct_echoes.cpp
  void add_direct_echoes(const Company& company);
  void add_direct_echoes(const Company& company, std::size_t frequency);
  void add_coherent_direct_echoes(const Company& company, std::size_t frequency);
  /// What a direct echo's BRDF counts for, 4π w cos θ.
  [[nodiscard]] double direct_weight_m2(std::size_t leg) const;
  /// False when there is nothing to add.
  bool add_direct_echo(std::size_t leg, std::size_t frequency, const radar::Channels& rcs_m2);

  // connected_echoes.cpp
  void consider_connections(const Company& company, int bounce);
  void consider_connection(std::uint32_t leg, std::size_t lane, Vec3f to_radar, float lot);
  [[nodiscard]] float reverse_odds(const Path& path, std::size_t lane) const;
  [[nodiscard]] float reverse_share(std::size_t leg) const;
  /// Makes those that were found worth it, if they see the radar.
  void add_connected_echoes(int bounce);
  [[nodiscard]] float reciprocal_share(const Connection& connection, float last_density) const;
  /// What crowns let pass from the vertices to the radar, 0 where a surface stands in the way.
  void find_transmittances();
  void add_connected_echo(const Connection& connection, std::size_t number, int bounce);

  // next_directions.cpp
  /// Draws the next directions and ends paths that have become dark.
  void carry_on(const Company& company, int bounce);
  /// Where the path leaves the vertex that a leg has led to.
  void begin_leg(std::size_t leg, std::size_t lane, Vec3f direction, int bounce);
  /// Density of the paths, whichever frequency were their hero, over the hero's own.
  [[nodiscard]] float mean_forward(std::size_t lane) const;
  void leave(const Company& company, int bounce);
  [[nodiscard]] bool survives_roulette(std::size_t lane, float chance, float lot);

  [[nodiscard]] Path& path_of(std::size_t leg) { return paths_[now_.legs[leg].path]; }
  [[nodiscard]] const Path& path_of(std::size_t leg) const { return paths_[now_.legs[leg].path]; }
  [[nodiscard]] std::span<const Wave> waves_along(std::size_t leg) const {
    return std::span(now_.waves).subspan(leg * frequencies_, frequencies_);
  }
  [[nodiscard]] Vec3d in_world(Vec3f position) const { return position.to<double>() + geometry_.origin(); }
  /// The way between the vertices of a leg's path up to the one that it has led to.
  [[nodiscard]] double travelled_after(std::size_t leg) const {
    return now_.legs[leg].travelled_m + static_cast<double>(length(hits_[leg].position - now_.rays[leg].origin));
  }
  /// Vertex number `bounce`, to which the leg has led.
  [[nodiscard]] Arrival arrival_of(std::size_t leg, int bounce) const {
    return {now_.rays[leg].direction, hits_[leg], now_.legs[leg].point, static_cast<std::uint32_t>(bounce)};
  }
  /// What the company's paths carry, by frequency and lane.
  void gather_waves(const Company& company, int bounce);
  /// Numbers for the phases of unresolved roughness, by lane, where the surface makes use of them; else none are drawn.
  void draw_phases(const Company& company, std::uint32_t first_dimension, PairLanes& draws) const;
  /// The phase that the unresolved roughness of vertex number `bounce` gives to all fields alike.
  [[nodiscard]] scatter::Amplitude roughness_phasor(std::size_t leg, std::size_t frequency, int bounce) const;
  void append(const Path& path, std::size_t frequency, const radar::Echo& echo);

  const SceneGeometry& geometry_;
  const SpectralSurfaces& surfaces_;
  const std::size_t frequencies_;
  const Viewpoint& viewpoint_;
  const PathOptions& options_;
  const LaunchArea& area_;
  std::span<const LaunchCell> cells_;
  bool counts_always_ = false;  // wherever its paths begin
  std::uint64_t seed_;
  TraceCounts counts_;
  Bookkeeper books_;
  std::vector<EchoesByStart> echoes_;  // [frequency]
  CrownCrossings crowns_;

  std::vector<Path> paths_;          // that go together
  Legs now_, next_;                  // those of all living paths, and of those that go on from where they end
  std::vector<SurfaceHit> hits_;     // [leg]
  std::vector<std::uint8_t> meets_;  // [leg]: whether there is one
  std::vector<std::vector<std::uint32_t>> groups_;  // [hero, material]: legs
  // Scratch space.
  std::vector<Connection> connections_;
  std::vector<Ray> connecting_rays_;
  std::vector<std::uint8_t> answers_;
  std::vector<scatter::FieldPair> connected_fields_;  // [connection, frequency]
  std::vector<float> transmittances_;                 // [connection]
  // Of one company.
  std::vector<WaveLanes> lanes_;                 // [frequency]
  std::vector<scatter::PassageLanes> passages_;  // [frequency]
  FloatLanes cosine_, density_, power_;
};

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

template <typename Body>
void TileTracer::for_each_company(const Body& body) {
  const std::size_t materials = surfaces_.front().size();
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    const std::span<const std::uint32_t> legs(groups_[group]);
    for (std::size_t first = 0; first < legs.size(); first += lane_count) {
      Company company{.legs = legs.subspan(first, std::min(lane_count, legs.size() - first)),
                      .hero = group / materials,
                      .material = static_cast<scene::MaterialIndex>(group % materials),
                      .at = {},
                      .extinction_per_m = {},
                      .points = {}};
      company.at.count = company.count();
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const std::size_t leg = company.leg(lane);
        const SurfaceHit& hit = hits_[leg];
        company.points.set(lane, now_.legs[leg].point);
        company.at.to_source.set(lane, -now_.rays[leg].direction);
        company.at.normal.set(lane, hit.normal);
        company.at.inverse_area_per_m2[lane] = hit.inverse_facet_area_per_m2;
        company.extinction_per_m[lane] = hit.extinction_per_m;
      }
      body(company);
    }
  }
}

}  // namespace sigmascape::trace
