#pragma once

#include <string>
#include <vector>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// What whoever works on with a scene should know, a line each that begins with its name: of its remarks those that are
/// likely mistakes, such as a file of which nothing was used, and that the north of its frame is another than its own.
[[nodiscard]] std::vector<std::string> warnings_of(const Scene& scene);

}  // namespace sigmascape::scene
