#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::radar {

/// Throws Error, naming the `earth_refraction` of this file, for a radar that makes real-beam maps over an Earth that
/// curves: those are made over a flat one.
void check_earth(const Radar& radar, const std::string& file);

/// Where what is mapped lies, as distances over the ground from right below the radar.
struct MappedGround {
  double nearest_m = 0.0, farthest_m = 0.0;
  double below_m = 0.0;  ///< the radar
};

/// What a radar engineer would object to before this radar maps these bins onto cells of `cell_m`, one sentence each:
/// a swath longer than the unambiguous range, one outside the range gate, be it that pulses fold it in, one in which
/// the transmitter deafens the receiver, pulses, and beams of real-beam maps, that on the ground are
/// `narrower_than_cells`.
[[nodiscard]] std::vector<std::string> radar_warnings(const Radar& radar, const RangeAzimuthGrid& bins,
                                                      const MappedGround& ground, double cell_m);

/// A sentence where `what`, of this half-power width, is so narrow beside a map's cells that more than 1 % of a point's
/// power is lost between them; nothing where it is not.
[[nodiscard]] std::optional<std::string> narrower_than_cells(std::string_view what, double width_m, double cell_m);

}  // namespace sigmascape::radar
