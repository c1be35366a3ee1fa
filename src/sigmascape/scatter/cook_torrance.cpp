#include "sigmascape/scatter/cook_torrance.h"

#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {

CookTorrance::CookTorrance(const CookTorranceParameters& parameters, double frequency_hz,
                           const CookTorranceOptions& options)
    : mirrors_(Microfacets(parameters.distribution, static_cast<float>(parameters.alpha), options.masking),
               std::complex<float>(parameters.permittivity.relative_at(frequency_hz)),
               static_cast<float>(wavelength_m(frequency_hz) * wavelength_m(frequency_hz) / (4.0 * pi))),
      scattered_part_(static_cast<float>(parameters.scattering_coefficient * parameters.scattering_coefficient)),
      scattered_polarization_(parameters.depolarization),
      scattered_(
          scattered_polarization_.amplitudes(scattered_part_ * mean_reflectivity(mirrors_.permittivity()) /
                                             static_cast<float>(pi * (1.0 + parameters.depolarization.cross_ratio)))) {
  if (options.multiple_scatter) multiple_scatter_.emplace(mirrors_.facets(), mirrors_.permittivity());
}

const Mirrors* CookTorrance::beckmann_mirrors() const {
  const bool are_all = scattered_part_ == 0.0F && !multiple_scatter_;
  return are_all && mirrors_.facets().are(MicrofacetDistribution::Beckmann, Masking::Correlated) ? &mirrors_ : nullptr;
}

float CookTorrance::diffuse_share(float cos_source) const {
  const float multiple = multiple_scatter_ ? multiple_scatter_->sampling_share(cos_source) : 0.0F;
  return scattered_part_ + (1.0F - scattered_part_) * multiple;
}

radar::Channels CookTorrance::backscatter(Vec3f to_radar, const Facet& face) const {
  radar::Channels channels = mirrors_.backscatter(to_radar, face);
  if (multiple_scatter_) channels += multiple_scatter_->backscatter(dot(to_radar, face.normal));
  if (scattered_part_ == 0.0F) return channels;
  return channels * (1.0F - scattered_part_) + scattered_polarization_.backscatter(scattered_);
}

DirectionSample CookTorrance::sample(Vec3f to_source, const Facet& face, Vec2f u) const {
  const float diffuse = diffuse_share(dot(to_source, face.normal));
  const Vec3f direction = u.x < diffuse ? cosine_direction(face.normal, {u.x / diffuse, u.y}).direction
                                        : mirrors_.sample(to_source, face, {(u.x - diffuse) / (1.0F - diffuse), u.y});
  return {direction, pdf(to_source, direction, face)};
}

float CookTorrance::pdf(Vec3f to_source, Vec3f to_sink, const Facet& face) const {
  return with_diffuse_part(mirrors_.pdf(to_source, to_sink, face), to_source, to_sink, face.normal);
}

/// Density of the mixture that `sample` draws from, by that of the mirrors alone.
float CookTorrance::with_diffuse_part(float mirrored, Vec3f to_source, Vec3f to_sink, Vec3f normal) const {
  const float cos_source = dot(to_source, normal);
  if (cos_source <= 0.0F || dot(to_sink, normal) <= 0.0F) return 0.0F;
  const float diffuse = diffuse_share(cos_source);
  return diffuse == 0.0F ? mirrored : (1.0F - diffuse) * mirrored + diffuse * cosine_pdf(to_sink, normal);
}

Passage CookTorrance::pass_on(const FieldPair& in, Vec3f to_source, Vec3f to_sink, const Facet& face,
                              PhaseDraw draw) const {
  if (dot(to_source, face.normal) <= 0.0F || dot(to_sink, face.normal) <= 0.0F) return {};
  Passage passage = mirrors_.pass_on(in, to_source, to_sink, face);
  passage.pdf = with_diffuse_part(passage.pdf, to_source, to_sink, face.normal);
  passage.reverse_pdf = with_diffuse_part(passage.reverse_pdf, to_sink, to_source, face.normal);
  FieldPair& out = passage.fields;
  if (multiple_scatter_) out = out + multiple_scatter_->scatter(in, to_source, to_sink, face.normal, draw);
  if (scattered_part_ == 0.0F) return passage;
  // The diffuse part must not interfere on average with the lobe, nor with what facets pass on to one another, so it
  // gets a phase of its own: what of `a` is left over by the choice between the two halves of the draw, three times
  // round where the elements of MultipleScatter go once and twice.
  const float common_phase_rad = static_cast<float>(12.0 * pi) * (draw.a < 0.5F ? draw.a : draw.a - 0.5F);
  const FieldPair scattered = scattered_polarization_.scatter(in, scattered_, to_source, to_sink, draw);
  out = out * std::sqrt(1.0F - scattered_part_) + scattered.turned(unit_phasor(common_phase_rad));
  return passage;
}

}  // namespace sigmascape::scatter
