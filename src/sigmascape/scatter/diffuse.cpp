#include "sigmascape/scatter/diffuse.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::scatter {

DiffusePolarization::DiffusePolarization(const Depolarization& depolarization)
    : cross_amplitude_(static_cast<float>(std::sqrt(depolarization.cross_ratio))),
      correlation_(std::clamp(static_cast<float>(depolarization.vv_hh_correlation), -1.0F, 1.0F)),
      quadrature_(std::sqrt(1.0F - correlation_ * correlation_)) {}

}  // namespace sigmascape::scatter
