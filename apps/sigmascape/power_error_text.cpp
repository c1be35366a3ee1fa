#include "power_error_text.h"

#include <fmt/format.h>

namespace sigmascape::cli {
namespace {

/// Whether bare ground, which is kept apart, outshines what was baked: as where nothing stands on it. What was baked
/// then came over stray paths and is as unsure as it is little.
bool is_next_to_nothing(const atlas::PowerErrors& errors) {
  return errors.part_of_all().value_or(0.0) < 0.01;
}

std::string percent_of_all(double part) {
  const double percent = 100.0 * part;
  if (percent < 0.01) return "less than 0.01";
  if (percent < 10.0) return fmt::format("{:.2g}", percent);
  return percent < 99.5 ? fmt::format("{:.0f}", percent) : "more than 99";
}

}  // namespace

std::string error_text(const atlas::PowerErrors& errors) {
  const auto relative = errors.relative();
  if (!relative) return "none, for no texel returns anything";
  const double part_of_all = *errors.part_of_all();
  std::string text =
      fmt::format("{:.1f} % of {}", 100.0 * *relative, is_next_to_nothing(errors) ? "next to nothing" : "the power");
  if (part_of_all < 1.0)
    text += fmt::format(", {} % of what returns with the bare ground, which has no noise", percent_of_all(part_of_all));
  return text;
}

std::string above_target_text(const atlas::PowerErrors& errors) {
  const auto part = errors.part_above_target();
  if (!part || is_next_to_nothing(errors)) return "";
  return fmt::format("{:.0f} % of the power in texels above the target", 100.0 * *part);
}

}  // namespace sigmascape::cli
