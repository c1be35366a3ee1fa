#pragma once

#include <cstddef>

#include "sigmascape/product/picture.h"

namespace sigmascape::cli {

/// A texture as it lies on the triangles of a level heightmap, seen obliquely from the south: the paper's Figures 1c
/// and 1d. The colour scale stays that of the
/// texture; its grid says nothing of these pixels.
[[nodiscard]] product::Picture draped_view(const product::Picture& texture, std::size_t pixels_wide);

}  // namespace sigmascape::cli
