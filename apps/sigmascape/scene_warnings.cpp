#include "scene_warnings.h"

#include <cstdio>
#include <fmt/format.h>
#include <string>

#include "sigmascape/scene/scene_warnings.h"

namespace sigmascape::cli {

void warn_of_scene(const scene::Scene& scene) {
  for (const std::string& warning : scene::warnings_of(scene)) fmt::print(stderr, "warning: {}\n", warning);
}

}  // namespace sigmascape::cli
