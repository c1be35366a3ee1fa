#include "sigmascape/scene/scene_warnings.h"

#include <fmt/format.h>

namespace sigmascape::scene {

std::vector<std::string> warnings_of(const Scene& scene) {
  std::vector<std::string> warnings;
  for (const auto& [what, count, first, is_likely_a_mistake] : scene.remarks) {
    if (is_likely_a_mistake) warnings.push_back(fmt::format("{}: {}: {}, first {}", scene.name, what, count, first));
  }
  return warnings;
}

}  // namespace sigmascape::scene
