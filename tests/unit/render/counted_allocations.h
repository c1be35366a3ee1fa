#pragma once

#include <cstddef>

namespace sigmascape::render {

/// How often the whole program, whose new and delete are counted, has taken memory so far. What counts is a file of its
/// own: a compiler that sees into delete but not into new takes the two for strangers.
[[nodiscard]] std::size_t allocations();

}  // namespace sigmascape::render
