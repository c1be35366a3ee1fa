#pragma once

#include "figures.h"

#include "sigmascape/scene/scene.h"

namespace sigmascape::bench {

/// The paper's scene from the paper's view (20 km away, azimuth 130°, elevation 8.6°): what a live frame of all its
/// 1024² texels takes against tracing it, and how much of the scene it looks at.
void measure_paper_frame(const scene::Scene& scene, bool quick, Figures& figures);

/// How long level of detail 0 takes for 512 m × 512 m of town and forest to 1.5 dB.
void measure_traced_map(const scene::Scene& scene, Figures& figures);

}  // namespace sigmascape::bench
