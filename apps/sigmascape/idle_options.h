#pragma once

#include <fmt/format.h>
#include <functional>
#include <string>
#include <vector>

#include "command_parser.h"

#include "sigmascape/base/error.h"

namespace sigmascape::cli {

/// An option that says how something is made, and does nothing where that is not made.
struct MannerOption {
  Option option;
  std::string name;
  std::string of;  ///< what it is of, as the command line calls it
  std::function<bool()> is_made;
};

/// Throws Error at the first that is given for nothing.
inline void refuse_idle(const std::vector<MannerOption>& options) {
  for (const auto& [option, name, of, is_made] : options) {
    if (!option.is_given() || is_made()) continue;
    throw Error(name, fmt::format("is of {}, which is not asked for", of), "name it or leave this out");
  }
}

}  // namespace sigmascape::cli
