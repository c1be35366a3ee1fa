#pragma once

#include <stdexcept>
#include <string>

namespace sigmascape {

/// The one exception type. Thrown at the doors (files, arguments, devices), never inside kernels.
///
/// Its message is one sentence with three parts, so that whoever reads it can act: where the fault lies (a file and,
/// within it, a key, feature or band), what is wrong there, and what would be right.
class Error : public std::runtime_error {
 public:
  Error(const std::string& where, const std::string& what, const std::string& remedy)
      : std::runtime_error(where + ": " + what + "; " + remedy) {}
};

}  // namespace sigmascape
