#pragma once

#include <cstddef>

namespace sigmascape::bench {

/// Peak memory in MiB of a process of its own that makes up the paper's landscape and bakes it in so many patches a
/// side, of 256 texels each. Ends the program with a message when that fails.
[[nodiscard]] double memory_of_bake_mib(std::size_t patches_along_a_side);

}  // namespace sigmascape::bench
