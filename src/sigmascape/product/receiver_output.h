#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "sigmascape/radar/receiver.h"

namespace sigmascape::product {

/// What a receiver did to volts before they were recorded, for whoever wants it undone: `stc_full_gain_range_m` and
/// `stc_exponent` of a time control, `adc_bits`, `adc_full_scale_v` and `saturated_samples` of a converter.
[[nodiscard]] std::map<std::string, double> output_numbers(const std::optional<radar::SensitivityTimeControl>& control,
                                                           const std::optional<radar::AnalogToDigital>& converter,
                                                           std::size_t saturated);

}  // namespace sigmascape::product
