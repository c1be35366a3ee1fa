#include "memory_of_bake.h"

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "figures.h"

#include "sigmascape/bake/bake.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/paper_scene.h"

namespace sigmascape::bench {
namespace {

void bake_in_patches(std::size_t along_a_side, const std::filesystem::path& folder) {
  const scene::Scene scene = scene::paper_scene();
  bake::BakeSettings settings;
  settings.patches.texels_per_side = 256;
  settings.patches.texel_m =
      scene.extent.width_m() / static_cast<double>(along_a_side * settings.patches.texels_per_side);
  settings.aspects = {{radians_from_deg(45.0)}, {radians_from_deg(5.0), radians_from_deg(37.0)}, {10e9}};
  settings.sampling.samples_per_texel = 2;
  settings.threads = 2;
  SilentProgress silent;
  bake::bake(scene, settings, folder, silent);
}

}  // namespace

double memory_of_bake_mib(std::size_t patches_along_a_side) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("sigmascape_bench_memory_{}", getpid());
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      bake_in_patches(patches_along_a_side, folder);
    } catch (const std::exception&) {
      std::_Exit(EXIT_FAILURE);
    }
    std::_Exit(EXIT_SUCCESS);
  }
  int status = 0;
  rusage usage{};
  prove(child > 0 && ::wait4(child, &status, 0, &usage) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0,
        "a process of its own bakes the landscape");
  const atlas::Store store = atlas::Store::open(folder);
  const std::size_t patches = store.description().patches.block_over(store.description().extent).size();
  prove(patches == patches_along_a_side * patches_along_a_side, "it has the patches that it was to have");
  std::filesystem::remove_all(folder);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace sigmascape::bench
