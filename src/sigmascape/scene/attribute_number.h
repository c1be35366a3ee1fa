#pragma once

#include <optional>
#include <string_view>

namespace sigmascape::scene {

/// A length in metres from an attribute as people write them: "12", "12.5 m", "40 ft", "40'" and "40'6\"" (feet and
/// inches). Nothing when the text says no such thing.
[[nodiscard]] std::optional<double> metres_from_text(std::string_view text);

}  // namespace sigmascape::scene
