#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/trace/scattering_matrix.h"
#include "sigmascape/trace/tile_tracer.h"
#include "sigmascape/trace/vertex.h"

namespace sigmascape::trace {

using radar::Channels;
using scatter::PolarizationBasis;

void TileTracer::add_direct_echoes(const Company& company) {
  for (std::size_t f = 0; f < frequencies_; ++f) {
    if (options_.coherent)
      add_coherent_direct_echoes(company, f);
    else
      add_direct_echoes(company, f);
  }
}

void TileTracer::add_direct_echoes(const Company& company, std::size_t frequency) {
  scatter::ChannelLanes brdf;
  surfaces_[frequency][company.material].backscatter(company.at, brdf);
  for (std::size_t lane = 0; lane < company.count(); ++lane) {
    const std::size_t leg = company.leg(lane);
    add_direct_echo(leg, frequency, brdf[lane] * static_cast<float>(direct_weight_m2(leg)));
  }
}

/// Instead of mean powers those of a draw, with its amplitudes.
void TileTracer::add_coherent_direct_echoes(const Company& company, std::size_t frequency) {
  const auto& surface = surfaces_[frequency][company.material];
  PairLanes draws;
  draw_phases(company, DimensionsPerVertex + ConnectPhaseA, draws);
  for (std::size_t lane = 0; lane < company.count(); ++lane) {
    const std::size_t leg = company.leg(lane);
    const Vec3f to_radar = company.at.to_source[lane];
    const auto out = surface
                         .scatter(lanes_[frequency].fields[lane], to_radar, to_radar, face_of(hits_[leg]),
                                  {draws.x[lane], draws.y[lane]})
                         .turned(roughness_phasor(leg, frequency, 1));
    // A direct path is its own reversal: its matrix is symmetric, and the mean of both is itself.
    const float half_root = 0.5F * static_cast<float>(std::sqrt(direct_weight_m2(leg)));
    const ScatteringMatrix matrix = paired(out * half_root, PolarizationBasis(-to_radar));
    if (add_direct_echo(leg, frequency, matrix.powers())) echoes_[frequency].add_amplitude(matrix.amplitudes());
  }
}

double TileTracer::direct_weight_m2(std::size_t leg) const {
  const Path& path = path_of(leg);
  const float returned = cosine_at(hits_[leg], -now_.rays[leg].direction) * path.direct_return;
  return 4.0 * pi * viewpoint_.ray_weight_m2(path.beam, path.first_range_m, path.first_range_m) *
         static_cast<double>(returned);
}

bool TileTracer::add_direct_echo(std::size_t leg, std::size_t frequency, const Channels& rcs_m2) {
  if (rcs_m2 == Channels{}) return false;
  const Path& path = path_of(leg);
  const Vec3d position = in_world(path.first_vertex);
  append(path, frequency,
         {.range_m = path.first_range_m,
          .cross = viewpoint_.cross_of(position),
          .rcs_m2 = rcs_m2,
          .bounces = 1,
          .sin_depression = static_cast<float>(viewpoint_.sin_depression_of(position, position)),
          .from_ground = hits_[leg].is_ground,
          .from_building = hits_[leg].is_building});
  return true;
}

}  // namespace sigmascape::trace
