#pragma once

#include <optional>

#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::atlas {

/// The setting of a store whose bake aimed at a standard error, in decibels.
inline constexpr const char* target_setting = "target_db";

/// The relative standard error that a bake aimed at; nothing when it had no target.
[[nodiscard]] std::optional<double> error_target(const AtlasDescription& description);

/// How many texels return anything, and how many of these have a relative standard error above `limit`. A target is one
/// for what the rays of a cell return (docs/decisions/0015-adaptive-sampling.md), so that texels may miss it.
[[nodiscard]] TexelsAboveTarget texels_above(double limit, const Array2D<float>& relative_errors,
                                             const Array2D<radar::Channels>& texels);

}  // namespace sigmascape::atlas
