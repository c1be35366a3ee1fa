#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "command_parser.h"
#include "number_within.h"

namespace sigmascape::cli {

/// Adds --seed. CLI11 alone would take -1, and what is too long, for the greatest number that there is.
inline Option add_seed_option(Command command, std::uint64_t& seed, const std::string& description) {
  return command.add_option("--seed", seed, description)
      .capture_default_str()
      .check(count_within<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max()));
}

}  // namespace sigmascape::cli
