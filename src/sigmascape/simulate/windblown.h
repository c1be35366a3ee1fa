#pragma once

#include <functional>

#include "sigmascape/scene/scene.h"

namespace sigmascape::simulate {

/// Whether what grows at a point moves in the wind. Called from several threads at once.
using Windblown = std::function<bool(Vec2d point)>;

/// By the scene, wherever in it: under crowns of trees and on ground whose material stands for plants. The scene must
/// outlive it. Crowns are looked for where and when they are first asked for, 2 km square at a time.
[[nodiscard]] Windblown windblown_of(const scene::Scene& scene);

}  // namespace sigmascape::simulate
