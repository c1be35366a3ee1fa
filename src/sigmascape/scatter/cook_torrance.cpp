#include "sigmascape/scatter/cook_torrance.h"

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {

CookTorrance::CookTorrance(const CookTorranceParameters& parameters, double frequency_hz,
                           const CookTorranceOptions& options)
    : permittivity_(parameters.permittivity.relative_at(frequency_hz)),
      normal_reflectivity_(power_of(fresnel(permittivity_, 1.0F).s)),
      facets_(parameters.distribution, static_cast<float>(parameters.alpha), options.masking),
      diffraction_m2_(static_cast<float>(wavelength_m(frequency_hz) * wavelength_m(frequency_hz) / (4.0 * pi))),
      scattered_part_(static_cast<float>(parameters.scattering_coefficient * parameters.scattering_coefficient)),
      scattered_polarization_(parameters.depolarization),
      scattered_(
          scattered_polarization_.amplitudes(scattered_part_ * mean_reflectivity(permittivity_) /
                                             static_cast<float>(pi * (1.0 + parameters.depolarization.cross_ratio)))) {
  if (options.multiple_scatter) multiple_scatter_.emplace(facets_, permittivity_);
}

Microfacets CookTorrance::facets_on(const Facet& face) const {
  if (face.inverse_area_per_m2 == 0.0F) return facets_;
  return facets_.widened(std::sqrt(facets_.alpha() * facets_.alpha() + diffraction_m2_ * face.inverse_area_per_m2));
}

float CookTorrance::diffuse_share(float cos_source) const {
  const float multiple = multiple_scatter_ ? multiple_scatter_->sampling_share(cos_source) : 0.0F;
  return scattered_part_ + (1.0F - scattered_part_) * multiple;
}

radar::Channels CookTorrance::backscatter(Vec3f to_radar, const Facet& face) const {
  const Microfacets facets = facets_on(face);
  const Vec3f w = Basis(face.normal).local_from_world(to_radar);
  const float brdf = normal_reflectivity_ * facets.density(w) * facets.visible_part(w, w) / (4.0F * w.z * w.z);
  // The facets that answer are seen head-on: both polarizations alike and no cross-polarization, whatever the tilt.
  radar::Channels channels{brdf, brdf, 0.0F, brdf};
  if (multiple_scatter_) channels += multiple_scatter_->backscatter(w.z);
  if (scattered_part_ == 0.0F) return channels;
  return channels * (1.0F - scattered_part_) + scattered_polarization_.backscatter(scattered_);
}

DirectionSample CookTorrance::sample(Vec3f to_source, const Facet& face, Vec2f u) const {
  const float diffuse = diffuse_share(dot(to_source, face.normal));
  if (u.x < diffuse) {
    const Vec3f direction = cosine_direction(face.normal, {u.x / diffuse, u.y}).direction;
    return {direction, pdf(to_source, direction, face)};
  }
  const Basis basis(face.normal);
  const Vec2f remaining{(u.x - diffuse) / (1.0F - diffuse), u.y};
  const Vec3f facet =
      basis.world_from_local(facets_on(face).visible_normal(basis.local_from_world(to_source), remaining));
  const Vec3f direction = normalized(facet * (2.0F * dot(to_source, facet)) - to_source);
  return {direction, pdf(to_source, direction, face)};
}

float CookTorrance::pdf(Vec3f to_source, Vec3f to_sink, const Facet& face) const {
  const float cos_source = dot(to_source, face.normal);
  if (cos_source <= 0.0F || dot(to_sink, face.normal) <= 0.0F) return 0.0F;
  const Microfacets facets = facets_on(face);
  const Vec3f half = Basis(face.normal).local_from_world(normalized(to_source + to_sink));
  const float mirrored = facets.visible_part(cos_source) * facets.density(half) / (4.0F * cos_source);
  const float diffuse = diffuse_share(cos_source);
  return diffuse == 0.0F ? mirrored : (1.0F - diffuse) * mirrored + diffuse * cosine_pdf(to_sink, face.normal);
}

FieldPair CookTorrance::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                                PhaseDraw draw) const {
  const Basis basis(face.normal);
  const Vec3f source = basis.local_from_world(to_source);
  const Vec3f sink = basis.local_from_world(to_sink);
  if (source.z <= 0.0F || sink.z <= 0.0F) return {};
  const Microfacets facets = facets_on(face);
  const Vec3f half = normalized(to_source + to_sink);
  const float density = facets.density(basis.local_from_world(half));
  FieldPair out;
  if (density > 0.0F) {
    const float amplitude = std::sqrt(density * facets.visible_part(source, sink) / (4.0F * source.z * sink.z));
    out = reflected(in, permittivity_, -to_source, to_sink, half) * amplitude;
  }
  if (multiple_scatter_) out = out + multiple_scatter_->scatter(in, to_source, to_sink, face.normal, draw);
  if (scattered_part_ == 0.0F) return out;
  // The diffuse part must not interfere with the lobe on average, so it gets a phase of its own; what of `a` chooses
  // between the two halves of the draw is left over for it.
  const float common_phase_rad = static_cast<float>(4.0 * pi) * (draw.a < 0.5F ? draw.a : draw.a - 0.5F);
  const FieldPair scattered = scattered_polarization_.scatter(in, scattered_, to_source, to_sink, draw);
  return out * std::sqrt(1.0F - scattered_part_) + scattered.turned(unit_phasor(common_phase_rad));
}

}  // namespace sigmascape::scatter
