#pragma once

#include <filesystem>

#include "sigmascape/radar/layer_stack.h"

namespace sigmascape::product {

/// Throws Error for a name that does not end in .tif.
void check_layer_name(const std::filesystem::path& path);

/// Writes layers as one float32 GeoTIFF, atomically: a band for each layer that is named after it, angles in degrees,
/// NaN where nothing is known; the bands have their units, as tags UNIT_<layer> tell them too. Throws Error when layers
/// do not fit the grid or the file cannot be written.
void write_layers(const std::filesystem::path& path, const radar::LayerStack& stack);

}  // namespace sigmascape::product
