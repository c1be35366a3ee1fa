#include "scene_warnings.h"

#include <string>

#include "standard_error.h"

#include "sigmascape/scene/scene_warnings.h"

namespace sigmascape::cli {

void warn_of_scene(const scene::Scene& scene) {
  for (const std::string& warning : scene::warnings_of(scene)) warn(warning);
}

}  // namespace sigmascape::cli
