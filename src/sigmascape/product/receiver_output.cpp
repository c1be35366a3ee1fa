#include "sigmascape/product/receiver_output.h"

namespace sigmascape::product {

std::map<std::string, double> output_numbers(const std::optional<radar::SensitivityTimeControl>& control,
                                             const std::optional<radar::AnalogToDigital>& converter,
                                             std::size_t saturated) {
  std::map<std::string, double> numbers;
  if (control) {
    numbers["stc_full_gain_range_m"] = control->full_gain_range_m;
    numbers["stc_exponent"] = control->exponent;
  }
  if (converter) {
    numbers["adc_bits"] = converter->bits;
    numbers["adc_full_scale_v"] = converter->full_scale_v;
    numbers["saturated_samples"] = static_cast<double>(saturated);
  }
  return numbers;
}

}  // namespace sigmascape::product
