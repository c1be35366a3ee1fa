#pragma once

#include <cstdint>

#include "paper_look.h"

namespace sigmascape::bench {

/// The power of a piece of the paper's scene in our maps over that in long plain ones. No ray of it is left out.
struct Bias {
  double ratio = 0.0;
  double standard_error = 0.0;  ///< of the ratio, as a pair of maps of each kind tells it
  radar::Rectangle piece;
};

/// The piece is 64 × 64 texels (125 m a side) where town and forest meet: of all such squares the one with the most of
/// both. What is around it is traced as well, so that few plain paths begin outside that would end within.
[[nodiscard]] Bias bias_in_town_and_forest(const scene::Scene& scene, const radar::Aspect& aspect,
                                           const bake::Sampling& sampling, std::uint32_t plain_samples);

}  // namespace sigmascape::bench
