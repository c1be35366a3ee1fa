#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sigmascape::cli {

/// What every subcommand offers besides its own options.
struct Output {
  bool json = false;  ///< print the summary as JSON on standard output instead of text

  /// Prints `text`, or `summary` when JSON was asked for.
  void finish(const std::string& text, const nlohmann::ordered_json& summary) const;
};

/// Throws Error when what was printed did not get to where it was to go.
void flush_standard_output();

}  // namespace sigmascape::cli
