#include "scene_warnings.h"

#include <cstdio>
#include <fmt/format.h>

namespace sigmascape::cli {

void warn_of_scene(const scene::Scene& scene) {
  for (const scene::Remark& remark : scene.remarks) {
    if (!remark.is_likely_a_mistake) continue;
    fmt::print(stderr, "warning: {}: {}: {}, first {}\n", scene.name, remark.what, remark.count, remark.first);
  }
}

}  // namespace sigmascape::cli
