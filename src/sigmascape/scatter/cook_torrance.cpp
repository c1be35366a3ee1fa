#include "sigmascape/scatter/cook_torrance.h"

#include <cmath>

#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {

CookTorrance::CookTorrance(const CookTorranceParameters& parameters, double frequency_hz)
    : permittivity_(parameters.permittivity.relative_at(frequency_hz)),
      normal_reflectivity_(power_of(fresnel(permittivity_, 1.0F).s)),
      facets_(parameters.distribution, static_cast<float>(parameters.alpha)) {}

radar::Channels CookTorrance::backscatter(Vec3f to_radar, Vec3f normal) const {
  const float cos_angle = dot(to_radar, normal);
  const float brdf = normal_reflectivity_ * facets_.density(cos_angle) * facets_.visible_part(cos_angle) / (4.0F * cos_angle * cos_angle);
  // The facets that answer are seen head-on: both polarizations alike and no cross-polarization, whatever the tilt.
  return {brdf, brdf, 0.0F, brdf};
}

DirectionSample CookTorrance::sample(Vec3f to_source, Vec3f normal, Vec2f u) const {
  const Basis basis(normal);
  const Vec3f facet = basis.world_from_local(facets_.visible_normal(basis.local_from_world(to_source), u));
  const Vec3f direction = normalized(facet * (2.0F * dot(to_source, facet)) - to_source);
  return {direction, pdf(to_source, direction, normal)};
}

float CookTorrance::pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const {
  const float cos_source = dot(to_source, normal);
  if (cos_source <= 0.0F || dot(to_sink, normal) <= 0.0F) return 0.0F;
  const Vec3f half = normalized(to_source + to_sink);
  return facets_.visible_part(cos_source) * facets_.density(dot(half, normal)) / (4.0F * cos_source);
}

FieldPair CookTorrance::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal, PhaseDraw) const {
  const Vec3f half = normalized(to_source + to_sink);
  const float cos_source = dot(to_source, normal);
  const float cos_sink = dot(to_sink, normal);
  const float density = facets_.density(dot(half, normal));
  if (density <= 0.0F || cos_source <= 0.0F || cos_sink <= 0.0F) return {};
  const Basis basis(normal);
  const float seen = facets_.visible_part(basis.local_from_world(to_source), basis.local_from_world(to_sink));
  const float amplitude = std::sqrt(density * seen / (4.0F * cos_source * cos_sink));
  return reflected(in, permittivity_, -to_source, to_sink, half) * amplitude;
}

}  // namespace sigmascape::scatter
