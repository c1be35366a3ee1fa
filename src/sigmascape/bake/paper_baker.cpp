#include "sigmascape/bake/paper_baker.h"

#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/receiver/polar_ground.h"
#include "sigmascape/trace/launch.h"

namespace sigmascape::bake {

PaperBaker::PaperBaker(const scene::Scene& scene, const BakeSettings& settings)
    : scene_(scene),
      settings_(settings),
      geometry_(scene, trace::Footing::LevelPlane),
      surfaces_(trace::surface_models(scene, settings.aspects.frequencies_hz.front())) {}

Array2D<radar::Channels> PaperBaker::bake(const radar::GroundGrid& texels, const radar::Aspect& aspect) const {
  const auto viewpoint = trace::Viewpoint::distant(aspect);
  const trace::PathTracer tracer(geometry_, surfaces_, viewpoint, {.max_bounces = settings_.max_bounces},
                                 settings_.seed);
  const auto area = trace::launch_area(viewpoint, scene_.extent, texels.cell_m, 0.0, geometry_.highest_m() + 1.0,
                                       trace::multibounce_reach(scene_, viewpoint, scene_.extent));
  const std::uint32_t samples = settings_.sampling.samples_per_texel;
  receiver::PolarGround ground(texels, aspect);
  tracer.trace(area, {0, samples, samples}, settings_.threads,
               [&](std::span<const radar::Echo> echoes, unsigned) { ground.add(echoes); });
  if (ground.bins().overflows() > 0) {
    throw Error(fmt::format("bake in the paper's way, azimuth {:.1f}°, elevation {:.1f}°",
                            deg_from_radians(aspect.azimuth_rad), deg_from_radians(aspect.elevation_rad)),
                "a bin is brighter than the sums can hold", "use a smaller texel or a rougher material");
  }
  return ground.sigma0();
}

}  // namespace sigmascape::bake
