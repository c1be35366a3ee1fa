#include "results/paper_bake.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/atlas/half.h"
#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/base/processor_stopwatch.h"
#include "sigmascape/base/units.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/simd_setting.h"

namespace sigmascape::cli {
namespace {

constexpr const char* bake_settings_key = "bake_settings";
constexpr const char* bake_seconds_key = "bake_seconds";

/// One square patch over all of the scene, a power of two of texels a side so that its mips end in one texel.
radar::GroundGrid patch_over(const radar::Rectangle& extent, double texel_m) {
  const double side_m = std::max(extent.width_m(), extent.height_m());
  const std::size_t side = std::bit_ceil(static_cast<std::size_t>(std::ceil(side_m / texel_m - 1e-9)));
  return {extent.west_m, extent.north_m, texel_m, side, side};
}

void round_to_halves(Array2D<radar::Channels>& texels) {
  const auto rounded = [](float value) { return atlas::float_from_half(atlas::half_from_float(value)); };
  for (radar::Channels& texel : texels.values())
    texel = {rounded(texel.vv), rounded(texel.hh), rounded(texel.hv), rounded(texel.re_vvhh)};
}

}  // namespace

PaperBake::PaperBake(const ResultsPlan& plan, const scene::Scene& scene, std::filesystem::path folder,
                     std::uint64_t seed)
    : plan_(plan),
      scene_(scene),
      folder_(std::move(folder)),
      seed_(seed),
      scene_hash_(scene::scene_hash(scene)),
      texels_(patch_over(scene.extent, plan.bake_settings(Method::Paper).patches.texel_m)) {}

radar::GroundMap PaperBake::baked_or_kept(const radar::Aspect& aspect, std::uint32_t samples) {
  const double azimuth_deg = deg_from_radians(aspect.azimuth_rad),
               elevation_deg = deg_from_radians(aspect.elevation_rad);
  const auto path = folder_ / fmt::format("az{:06.2f}_el{:05.2f}_{}rays.tif", azimuth_deg, elevation_deg, samples);
  const std::string settings =
      fmt::format("scene {}, azimuth {} deg, elevation {} deg, {} bounces, seed {}, {}, physics {}", scene_hash_,
                  azimuth_deg, elevation_deg, plan_.bounces, seed_, trace::simd_setting(), bake::physics_revision);
  if (std::filesystem::exists(path)) {
    radar::GroundMap kept = product::read_ground_map(path);
    if (kept.metadata[bake_settings_key] == settings) return kept;
  }
  if (!baker_ || baker_samples_ != samples) {
    bake::BakeSettings bake = plan_.bake_settings(Method::Paper);
    bake.sampling.samples_per_texel = samples;
    bake.seed = seed_;
    baker_.emplace(scene_, bake);
    baker_samples_ = samples;
  }
  const ProcessorStopwatch watch;
  radar::GroundMap map{.grid = texels_,
                       .sigma0 = baker_->bake(texels_, aspect),
                       .crs = scene_.frame.proj(),
                       .metadata = {{bake_settings_key, settings}}};
  map.metadata[bake_seconds_key] = fmt::format("{:.3f}", watch.seconds());
  std::filesystem::create_directories(folder_);
  product::write_map(path, map);
  return map;
}

PaperAtlas PaperBake::atlas_of(const atlas::AspectGrid& aspects, std::uint32_t samples, ProgressListener& progress,
                               bool in_halves) {
  std::vector<Array2D<radar::Channels>> looks;
  double seconds = 0.0;
  for (atlas::LookIndex look = 0; look < aspects.look_count(); ++look) {
    radar::GroundMap map = baked_or_kept(aspects.look(look).aspect, samples);
    seconds += std::stod(map.metadata.at(bake_seconds_key));
    if (in_halves) round_to_halves(map.sigma0);
    looks.push_back(std::move(map.sigma0));
    progress.advanced("bake in the paper's way", look + 1.0, static_cast<double>(aspects.look_count()), "looks");
  }
  render::PaperTextures textures(texels_, aspects, looks);
  // What lies beyond the scene, where the patch is rounded up, is not counted.
  const double covered =
      scene_.extent.width_m() * scene_.extent.height_m() / (texels_.extent().width_m() * texels_.extent().height_m());
  const double share = (in_halves ? 0.5 : 1.0) * covered;
  const AtlasCost cost{aspects.look_count(),
                       static_cast<std::uintmax_t>(share * static_cast<double>(textures.texture_bytes())),
                       static_cast<std::size_t>(share * static_cast<double>(textures.memory_bytes())), seconds};
  return {std::move(textures), cost};
}

}  // namespace sigmascape::cli
