#pragma once

#include <functional>

#include "sigmascape/base/vec.h"

namespace sigmascape::live {

/// Height of the ground at a place of the local frame, above mean sea level.
using GroundHeight = std::function<double(Vec2d)>;

}  // namespace sigmascape::live
