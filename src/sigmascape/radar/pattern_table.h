#pragma once

#include <filesystem>

#include "sigmascape/radar/antenna_pattern.h"

namespace sigmascape::radar {

/// A measured cut of an antenna, with its own half-power width.
struct PatternTable {
  TabulatedBeam beam;
  double half_power_width_rad = 0.0;
};

/// Reads a CSV file of two columns, `offset_deg,gain_db`: angle from the axis, increasing, and one-way gain in dB; only
/// differences of gain matter. Throws Error, naming file and line, for anything else, and when the gain does not fall
/// by 3 dB on both sides of its peak.
[[nodiscard]] PatternTable read_pattern_table(const std::filesystem::path& file);

}  // namespace sigmascape::radar
