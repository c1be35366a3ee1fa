#include "sigmascape/scatter/cook_torrance.h"

#include <cmath>

#include "sigmascape/scatter/diffuse.h"
#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {

CookTorrance::CookTorrance(const CookTorranceParameters& parameters, double frequency_hz,
                           const CookTorranceOptions& options)
    : permittivity_(parameters.permittivity.relative_at(frequency_hz)),
      normal_reflectivity_(power_of(fresnel(permittivity_, 1.0F).s)),
      facets_(parameters.distribution, static_cast<float>(parameters.alpha), options.masking) {
  if (options.multiple_scatter) multiple_scatter_.emplace(facets_, permittivity_);
}

radar::Channels CookTorrance::backscatter(Vec3f to_radar, Vec3f normal) const {
  const Vec3f w = Basis(normal).local_from_world(to_radar);
  const float brdf = normal_reflectivity_ * facets_.density(w) * facets_.visible_part(w, w) / (4.0F * w.z * w.z);
  // The facets that answer are seen head-on: both polarizations alike and no cross-polarization, whatever the tilt.
  radar::Channels channels{brdf, brdf, 0.0F, brdf};
  if (multiple_scatter_) channels += multiple_scatter_->backscatter(w.z);
  return channels;
}

DirectionSample CookTorrance::sample(Vec3f to_source, Vec3f normal, Vec2f u) const {
  const float diffuse = multiple_scatter_ ? multiple_scatter_->sampling_share(dot(to_source, normal)) : 0.0F;
  if (u.x < diffuse) {
    const Vec3f direction = cosine_direction(normal, {u.x / diffuse, u.y}).direction;
    return {direction, pdf(to_source, direction, normal)};
  }
  const Basis basis(normal);
  const Vec2f remaining{(u.x - diffuse) / (1.0F - diffuse), u.y};
  const Vec3f facet = basis.world_from_local(facets_.visible_normal(basis.local_from_world(to_source), remaining));
  const Vec3f direction = normalized(facet * (2.0F * dot(to_source, facet)) - to_source);
  return {direction, pdf(to_source, direction, normal)};
}

float CookTorrance::pdf(Vec3f to_source, Vec3f to_sink, Vec3f normal) const {
  const float cos_source = dot(to_source, normal);
  if (cos_source <= 0.0F || dot(to_sink, normal) <= 0.0F) return 0.0F;
  const Vec3f half = Basis(normal).local_from_world(normalized(to_source + to_sink));
  const float mirrored = facets_.visible_part(cos_source) * facets_.density(half) / (4.0F * cos_source);
  if (!multiple_scatter_) return mirrored;
  const float diffuse = multiple_scatter_->sampling_share(cos_source);
  return (1.0F - diffuse) * mirrored + diffuse * cosine_pdf(to_sink, normal);
}

FieldPair CookTorrance::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f normal,
                                PhaseDraw draw) const {
  const Basis basis(normal);
  const Vec3f source = basis.local_from_world(to_source);
  const Vec3f sink = basis.local_from_world(to_sink);
  if (source.z <= 0.0F || sink.z <= 0.0F) return {};
  const Vec3f half = normalized(to_source + to_sink);
  const float density = facets_.density(basis.local_from_world(half));
  FieldPair out;
  if (density > 0.0F) {
    const float amplitude = std::sqrt(density * facets_.visible_part(source, sink) / (4.0F * source.z * sink.z));
    out = reflected(in, permittivity_, -to_source, to_sink, half) * amplitude;
  }
  if (multiple_scatter_) {
    const FieldPair diffuse = multiple_scatter_->scatter(in, to_source, to_sink, normal, draw);
    out = {out.from_v + diffuse.from_v, out.from_h + diffuse.from_h};
  }
  return out;
}

}  // namespace sigmascape::scatter
