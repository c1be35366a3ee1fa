#pragma once

#include <filesystem>
#include <vector>

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::radar {

/// A target's cross-section by azimuth (from its nose, clockwise), elevation and frequency, in all channels.
struct RcsTable {
  std::vector<double> azimuths_rad, elevations_rad, frequencies_hz;  ///< each ascending
  std::vector<Channels> rcs_m2;                                      ///< [frequency][elevation][azimuth]

  /// Linear in power between entries; azimuth closes on itself, elevation and frequency are held beyond their ends.
  [[nodiscard]] Channels at(const Look& look) const;
};

/// Reads a table from comma-separated values under a line of names:
///
///     azimuth_deg, elevation_deg, frequency_ghz, vv_dbsm, hh_dbsm, hv_dbsm, vv_hh_correlation
///
/// in any order; elevation, frequency, HV and the correlation (−1 … 1; 1 when absent) may be left out. Every azimuth
/// must come with every elevation and frequency, once, and azimuths must go all round: no gap among three or more is
/// wider than two and a half times the next widest. Lines that begin with # are remarks. Throws Error, naming file and
/// line.
[[nodiscard]] RcsTable read_rcs_table(const std::filesystem::path& path);

}  // namespace sigmascape::radar
