#pragma once

#include "sigmascape/radar/window.h"

namespace sigmascape {

/// Weights all of a band alike.
inline constexpr radar::Window even_window{.shape = radar::WindowShape::Rectangular};

}  // namespace sigmascape
