#pragma once

#include <cstddef>

namespace sigmascape::live {

/// How often the whole program, whose new and delete are counted, has taken memory so far. What counts is a file of its
/// own: a compiler that sees into delete but not into new takes the two for strangers.
[[nodiscard]] std::size_t allocations();
/// And how many bytes all together, those for lines of cache among them, whether they were given back or not.
[[nodiscard]] std::size_t allocated_bytes();

}  // namespace sigmascape::live
