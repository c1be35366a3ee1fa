#pragma once

namespace sigmascape {

/// Bytes of memory that this machine has, in use or not.
[[nodiscard]] double machine_memory_bytes();

}  // namespace sigmascape
