#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/trace/multibounce_reach.h"
#include "sigmascape/trace/viewpoint.h"

namespace sigmascape::trace {

/// By how far echoes of several bounces that land in `target` may land behind their beginnings where the tallest thing
/// is so tall (trace::multibounce_reach says why): no less than between slopes of bare ground, no more than a
/// kilometre, and the most of the corners and the place nearest to the radar. On ground at height zero, which is all
/// the same to a radar at infinity.
[[nodiscard]] double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target);
/// The same on terrain: a radar at a place sees high ground more flatly than the sea.
[[nodiscard]] double late_by_m(double tallest_m, const Viewpoint& viewpoint, const radar::Rectangle& target,
                               const terrain::HeightField& terrain);

/// How far from a target, and nowhere but on what a scene occupies, paths may begin that are late by so much.
[[nodiscard]] MultibounceReach reach_of_late(double late_m, const radar::Rectangle& occupied);

}  // namespace sigmascape::trace
