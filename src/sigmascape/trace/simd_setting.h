#pragma once

#include <string>

namespace sigmascape::trace {

/// The widest instruction set that Embree uses here. Traversal rounds differently under different ones, so that results
/// repeat to the byte only under the same; bakes record it.
[[nodiscard]] std::string simd_setting();

}  // namespace sigmascape::trace
