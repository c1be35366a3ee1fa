#pragma once

#include <string>

#include "results/page.h"

namespace sigmascape::cli {

/// Markdown: what is left of the error at baked views when the noise of bake and truth is taken out; empty when no view
/// was baked twice.
[[nodiscard]] std::string without_noise_section(const ResultsReport& report);

/// Markdown: the squared error in dB by level of truth.
[[nodiscard]] std::string level_section(const ResultsReport& report);

}  // namespace sigmascape::cli
