#pragma once

#include <string>
#include <string_view>

namespace sigmascape::cli {

// What is said beside the work is of no weight for it: where standard error cannot be written, as on a full disk or
// when its terminal or whoever reads it is gone, it is lost and the work goes on.

/// Writes a text to standard error as it is, at once.
void say(std::string_view text) noexcept;

/// "warning: …" on a line of its own; what was said already is not said again.
void warn(const std::string& what);

}  // namespace sigmascape::cli
