#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/trace/scattering_matrix.h"
#include "sigmascape/trace/tile_tracer.h"
#include "sigmascape/trace/vertex.h"

namespace sigmascape::trace {
namespace {

/// Connections to the radar that return less than this, |S|² a steradian, are made only now and then and count for
/// more: most directions off a glossy surface return next to nothing, and it is not worth a ray to learn whether the
/// radar is in sight. A ground of γ = −25 dB returns 0.00025.
constexpr float faint_connection = 2.5e-4F;

/// Shares of a path and its reversal are two at most.
constexpr float greatest_share = 2.0F;

}  // namespace

void TileTracer::consider_connections(const Company& company, int bounce) {
  VectorLanes to_radar;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Vec3f position = hits_[company.leg(lane)].position;
    to_radar.set(lane, viewpoint_.direction_from(in_world(position)).to<float>());
  }
  const auto first_dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
  PairLanes draws;
  draw_phases(company, first_dimension + ConnectPhaseA, draws);
  power_ = {};
  for (std::size_t f = 0; f < frequencies_; ++f) {
    surfaces_[f][company.material].pass_on(lanes_[f].fields, company.at, to_radar, draws, passages_[f]);
    raise_to_power_of(passages_[f].fields, power_);
  }
  weigh_directions(company.at, company.extinction_per_m, to_radar, cosine_, density_);
  FloatLanes lots;
  draw_independent(company.points, first_dimension + ConnectRoulette, lots);
  for (std::size_t lane = 0; lane < company.count(); ++lane)
    consider_connection(company.legs[lane], lane, to_radar[lane], lots[lane]);
}

void TileTracer::consider_connection(std::uint32_t leg, std::size_t lane, Vec3f to_radar, float lot) {
  const float cosine = cosine_[lane], power = power_[lane];
  if (cosine <= 0.0F || power <= 0.0F) return;
  Connection connection{.leg = leg, .to_radar = to_radar, .density = mean_forward(lane)};
  const auto chance_of = [&](float share) {
    return options_.roulette ? power * cosine * share / faint_connection / connection.density : 1.0F;
  };
  // Most connections are so faint that it does not matter how much their share is.
  if (chance_of(greatest_share) <= lot) return;
  const Path& path = path_of(leg);
  connection.reverse_odds = reverse_odds(path, lane) * reverse_share(leg) / path.launch_share;
  // Crowns on the way to the radar have a part in the share, which then has to wait for the ray.
  connection.chance = chance_of(geometry_.has_crowns() ? 1.0F : reciprocal_share(connection, cosine));
  if (connection.chance <= lot) return;
  connections_.push_back(connection);
  for (std::size_t f = 0; f < frequencies_; ++f) connected_fields_.push_back(passages_[f].fields[lane]);
}

float TileTracer::reverse_odds(const Path& path, std::size_t lane) const {
  float back = 0.0F, forth = 0.0F;
  for (std::size_t f = 0; f < frequencies_; ++f) {
    back += lanes_[f].reverse[lane] * passages_[f].reverse_pdf[lane];
    forth += lanes_[f].forward[lane];
  }
  return back / path.first_density / forth;
}

/// Which part of the rays that the target gets are launched to where the reversed path begins.
float TileTracer::reverse_share(std::size_t leg) const {
  const Vec3d position = in_world(hits_[leg].position);
  if (!area_.counts_from(position)) return 0.0F;
  return area_.share_at(viewpoint_.shadow_on_plane(position, area_.plane_height_m));
}

void TileTracer::add_connected_echoes(int bounce) {
  find_transmittances();
  for (std::size_t i = 0; i < connections_.size(); ++i) {
    if (transmittances_[i] > 0.0F) add_connected_echo(connections_[i], i, bounce);
  }
}

/// 2/(1 + q): the part of the path and its reversal together that falls to this one of the two.
float TileTracer::reciprocal_share(const Connection& connection, float last_density) const {
  if (options_.estimator == Estimator::OneWay) return 1.0F;
  return 2.0F / (1.0F + connection.reverse_odds * last_density);
}

void TileTracer::find_transmittances() {
  counts_.rays += connections_.size();
  transmittances_.clear();
  connecting_rays_.clear();
  for (const Connection& connection : connections_)
    connecting_rays_.push_back({start_from(hits_[connection.leg]), connection.to_radar});
  if (geometry_.has_crowns()) {
    for (const auto& [origin, direction] : connecting_rays_) {
      crowns_.begin(surfaces_.front());
      const bool is_occluded = geometry_.occluded(origin, direction, crowns_);
      transmittances_.push_back(is_occluded ? 0.0F : std::exp(-crowns_.optical_depth()));
    }
    return;
  }
  answers_.resize(connections_.size());
  geometry_.occluded(connecting_rays_, answers_);
  for (const std::uint8_t is_occluded : answers_) transmittances_.push_back(is_occluded != 0 ? 0.0F : 1.0F);
}

void TileTracer::add_connected_echo(const Connection& connection, std::size_t number, int bounce) {
  const Path& path = path_of(connection.leg);
  const SurfaceHit& hit = hits_[connection.leg];
  const Vec3f to_radar = connection.to_radar;
  const float passed = transmittances_[number];
  const float share = passed * reciprocal_share(connection, passed * density_at(hit, to_radar));
  const float strength = cosine_at(hit, to_radar) * share / std::min(connection.chance, 1.0F) / connection.density;

  const Vec3d first = in_world(path.first_vertex), last = in_world(hit.position);
  const double last_range_m = viewpoint_.range_of(last);
  const double range_m = 0.5 * (path.first_range_m + last_range_m + travelled_after(connection.leg));
  const double weight =
      4.0 * pi * viewpoint_.ray_weight_m2(path.beam, range_m, last_range_m) * static_cast<double>(strength);
  const double cross = viewpoint_.middle_cross(viewpoint_.cross_of(first), viewpoint_.cross_of(last));
  const auto sin_depression = static_cast<float>(viewpoint_.sin_depression_of(first, last));
  const scatter::PolarizationBasis receive(-to_radar);
  for (std::size_t f = 0; f < frequencies_; ++f) {
    const ScatteringMatrix matrix = paired(connected_fields_[number * frequencies_ + f], receive);
    append(path, f,
           {.range_m = range_m,
            .cross = cross,
            .rcs_m2 = matrix.powers() * 0.5F * static_cast<float>(weight),
            .bounces = static_cast<std::uint8_t>(bounce),
            .sin_depression = sin_depression});
    if (!options_.coherent) continue;
    const scatter::Amplitude phasor = roughness_phasor(connection.leg, f, bounce);
    const ScatteringMatrix turned{matrix.vv * phasor, matrix.hh * phasor, matrix.hv * phasor};
    echoes_[f].add_amplitude(turned.amplitudes() * static_cast<float>(std::sqrt(0.5 * weight)));
  }
}

}  // namespace sigmascape::trace
