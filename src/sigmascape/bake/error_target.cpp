#include "sigmascape/bake/error_target.h"

#include <cstddef>

namespace sigmascape::bake {

std::optional<atlas::TexelsAboveTarget> texels_above_target(const BakedLook& look, const Sampling& sampling) {
  if (!sampling.is_adaptive()) return std::nullopt;
  const double target = sampling.relative_target();
  atlas::TexelsAboveTarget counts;
  for (std::size_t i = 0; i < look.sigma0.size(); ++i) {
    if (look.sigma0.values()[i].power(radar::Polarization::Sum) <= 0.0F) continue;
    ++counts.lit;
    counts.above += static_cast<double>(look.relative_errors.values()[i]) > target ? 1U : 0U;
  }
  return counts;
}

}  // namespace sigmascape::bake
