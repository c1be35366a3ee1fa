#include "sigmascape/scatter/lambert.h"

#include <numbers>

namespace sigmascape::scatter {

Lambert::Lambert(const LambertParameters& parameters)
    : polarization_(parameters.depolarization),
      amplitudes_(polarization_.amplitudes(
          static_cast<float>(parameters.albedo / (std::numbers::pi * (1.0 + parameters.depolarization.cross_ratio))))) {
}

}  // namespace sigmascape::scatter
