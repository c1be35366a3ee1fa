#pragma once

#include <string>

namespace sigmascape {

/// What this machine computes with, to stand beside measured times: "2 hardware threads, AMD EPYC 7763".
[[nodiscard]] std::string machine_name();

}  // namespace sigmascape
