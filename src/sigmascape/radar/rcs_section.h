#pragma once

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::radar {

/// The cross-section, m², that a point states in a file: `rcs_dbsm`, one number for VV and HH or a table of `vv`, `hh`
/// and `hv`, and `bounces`, whose parity is the sign of Re VV·HH*. Throws Error, naming the key, for what is missing,
/// unknown or out of range.
[[nodiscard]] Channels rcs_of_section(const TomlSection& section);

}  // namespace sigmascape::radar
