#include "sigmascape/atlas/worthwhile_bits.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::atlas {
namespace {

double power_of(const radar::Channels& texel) {
  return static_cast<double>(texel.power(radar::Polarization::Sum));
}

Array2D<double> variances_of(const Array2D<radar::Channels>& texels, const Array2D<float>& relative_errors) {
  Array2D<double> variances(texels.columns(), texels.rows());
  for (std::size_t i = 0; i < variances.size(); ++i) {
    const double error = power_of(texels.values()[i]) * static_cast<double>(relative_errors.values()[i]);
    variances.values()[i] = error * error;
  }
  return variances;
}

/// Of the means of four.
Array2D<double> variances_of_means(const Array2D<double>& finer) {
  Array2D<double> coarser(finer.columns() / 2, finer.rows() / 2);
  for (std::size_t row = 0; row < coarser.rows(); ++row) {
    for (std::size_t column = 0; column < coarser.columns(); ++column) {
      const std::size_t c = 2 * column, r = 2 * row;
      coarser(column, row) = (finer(c, r) + finer(c + 1, r) + finer(c, r + 1) + finer(c + 1, r + 1)) / 16.0;
    }
  }
  return coarser;
}

}  // namespace

int worthwhile_bits(double relative_error, int most) {
  if (!(relative_error > 0.0)) return most;
  return static_cast<int>(std::clamp(std::ceil(std::log2(4.0 / relative_error)), 1.0, static_cast<double>(most)));
}

BitsOfTexels worthwhile_bits(const MipChain& chain, const Array2D<float>& relative_errors, int most) {
  BitsOfTexels bits;
  Array2D<double> variances = variances_of(chain.front(), relative_errors);
  for (const Array2D<radar::Channels>& texels : chain) {
    if (!bits.empty()) variances = variances_of_means(variances);
    Array2D<std::uint8_t>& of_level = bits.emplace_back(texels.columns(), texels.rows());
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const double power = power_of(texels.values()[i]);
      const double error = power > 0.0 ? std::sqrt(variances.values()[i]) / power : 0.0;
      of_level.values()[i] = static_cast<std::uint8_t>(worthwhile_bits(error, most));
    }
  }
  return bits;
}

}  // namespace sigmascape::atlas
