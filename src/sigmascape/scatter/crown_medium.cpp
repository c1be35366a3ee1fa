#include "sigmascape/scatter/crown_medium.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::scatter {
namespace {

constexpr float isotropic = std::numbers::inv_pi_v<float> / 4.0F;
/// Below this, waves that go straight on have no mirror between them; what grazing mirrors pass on is left to them.
constexpr float least_bend = 1e-5F;

std::optional<std::complex<float>> mirrors_of(const CrownParameters& parameters, double frequency_hz) {
  if (!parameters.leaf) return std::nullopt;
  return std::complex<float>(parameters.leaf->relative_at(frequency_hz));
}

}  // namespace

CrownMedium::CrownMedium(const CrownParameters& parameters, double frequency_hz)
    : extinction_per_m_(static_cast<float>(parameters.extinction_per_m)),
      shares_gaps_(parameters.shares_gaps),
      albedo_(static_cast<float>(parameters.albedo)),
      mirrors_(mirrors_of(parameters, frequency_hz)),
      polarization_(parameters.depolarization),
      amplitudes_(polarization_.amplitudes(albedo_ * isotropic /
                                           static_cast<float>(1.0 + parameters.depolarization.cross_ratio))) {
  if (mirrors_) albedo_ = mean_reflectivity(*mirrors_);
}

radar::Channels CrownMedium::backscatter(Vec3f, Vec3f) const {
  if (!mirrors_) return polarization_.backscatter(amplitudes_);
  const float power = power_of(fresnel(*mirrors_, 1.0F).s) * isotropic;
  return {power, power, 0.0F, power};
}

DirectionSample CrownMedium::sample(Vec3f, Vec3f, Vec2f u) const {
  const float z = 1.0F - 2.0F * u.x;
  const float radius = std::sqrt(std::max(0.0F, 1.0F - z * z));
  const float phi = 2.0F * std::numbers::pi_v<float> * u.y;
  return {{radius * std::cos(phi), radius * std::sin(phi), z}, isotropic};
}

float CrownMedium::pdf(Vec3f, Vec3f, Vec3f) const {
  return isotropic;
}

FieldPair CrownMedium::scatter(const FieldPair& in, Vec3f to_source, Vec3f to_sink, Vec3f, PhaseDraw draw) const {
  if (!mirrors_) return polarization_.scatter(in, amplitudes_, to_source, to_sink, draw);
  const Vec3f between = to_source + to_sink;
  const float bend = length(between);
  if (bend < least_bend) return in * std::sqrt(isotropic);
  return reflected(in, *mirrors_, -to_source, to_sink, between * (1.0F / bend)) * std::sqrt(isotropic);
}

}  // namespace sigmascape::scatter
