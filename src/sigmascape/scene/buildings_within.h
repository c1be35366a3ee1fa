#pragma once

#include <cstdint>
#include <vector>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Numbers of the buildings that reach into a place, which of a large scene are few. Throws Interrupted when this
/// thread is told to stop (base/interruption.h).
[[nodiscard]] std::vector<std::uint32_t> buildings_within(const Buildings& buildings, const radar::Rectangle& place);

}  // namespace sigmascape::scene
