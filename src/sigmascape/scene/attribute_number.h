#pragma once

#include <optional>
#include <string_view>

namespace sigmascape::scene {

/// A length in metres from an attribute as people write them: "12", "12.5 m", "1250 cm", "40 ft", "40'" and "40'6\""
/// (feet and inches), with a unit that geo::metres_per_unit knows. A number without one counts units of
/// `metres_per_plain_number`. A comma parts decimals, as in "3,5", where it cannot part thousands. Nothing when the
/// text says no such thing, or has a doubtful comma.
[[nodiscard]] std::optional<double> metres_from_text(std::string_view text, double metres_per_plain_number = 1.0);

/// Whether a text begins with a number whose comma may part decimals as well as thousands: after one to three digits
/// that do not begin with 0, and before three. "1,234" is 1.234 in one country and 1234 in another; "12,34", "0,125"
/// and "1234,567" are decimals in all.
[[nodiscard]] bool has_doubtful_comma(std::string_view text);

}  // namespace sigmascape::scene
