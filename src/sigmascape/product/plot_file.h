#pragma once

#include <filesystem>

#include "sigmascape/product/plot.h"

namespace sigmascape::product {

/// Writes a plot as what its name ends in, .svg or .png (two pixels a unit), atomically. Throws Error for another
/// ending and when the file cannot be written.
void write_plot(const std::filesystem::path& path, const Plot& plot);

/// Throws Error when `write_plot` would not know what to write under this name: for asking before the work.
void check_plot_name(const std::filesystem::path& path);

}  // namespace sigmascape::product
