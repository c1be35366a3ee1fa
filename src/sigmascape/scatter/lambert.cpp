#include "sigmascape/scatter/lambert.h"

#include <numbers>

namespace sigmascape::scatter {

Lambert::Lambert(const LambertParameters& parameters)
    : polarization_(parameters.depolarization),
      amplitudes_(polarization_.amplitudes(
          static_cast<float>(parameters.albedo / (std::numbers::pi * (1.0 + parameters.depolarization.cross_ratio))))) {
}

radar::Channels Lambert::backscatter(Vec3f, Vec3f) const {
  return polarization_.backscatter(amplitudes_);
}

DirectionSample Lambert::sample(Vec3f, Vec3f normal, Vec2f u) const {
  return cosine_direction(normal, u);
}

float Lambert::pdf(Vec3f, Vec3f to_sink, Vec3f normal) const {
  return cosine_pdf(to_sink, normal);
}

FieldPair Lambert::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f, PhaseDraw draw) const {
  return polarization_.scatter(in, amplitudes_, to_source, to_sink, draw);
}

}  // namespace sigmascape::scatter
