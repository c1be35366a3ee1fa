#pragma once

#include <optional>
#include <vector>

#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::receiver {

/// Where in a radar's bins echoes come in, and how strongly.
class EchoPlaces {
 public:
  EchoPlaces(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid);

  /// Where in range the receiver hears an echo, in units of bins, and with which gain in elevation.
  struct Heard {
    double row = 0.0;
    radar::Channels rcs_m2;
  };
  /// Nothing of an echo from beyond the gate.
  [[nodiscard]] std::optional<Heard> heard(const radar::Echo& echo) const;
  /// Of other bins from here on. What the antenna's elevation makes of depressions is kept.
  void move_to(const radar::RangeAzimuthGrid& grid) { move_to(grid, grid.first_range_m); }
  /// With a gate that opens there where the radar does not say when.
  void move_to(const radar::RangeAzimuthGrid& grid, double gate_start_m);
  /// Of an azimuth, in units of bins.
  [[nodiscard]] double column_of(double azimuth_rad) const;
  /// Makes bins NaN in azimuths that the beam's axis never comes to and in ranges outside the gate.
  void blank_unheard(radar::RangeAzimuthImage& image) const;
  /// Whether the gate is open between the middles of this row and one beside it, of which a map reads both.
  [[nodiscard]] bool is_within_gate(std::size_t row) const;
  /// Whether the antenna has a gain in elevation of its own for every depression.
  [[nodiscard]] bool tell_elevations_apart() const { return !gain_over_depression_.empty(); }

 private:
  radar::Radar radar_;
  radar::RangeAzimuthGrid grid_;
  std::vector<float> gain_over_depression_;
  double gate_start_m_ = 0.0, gate_end_m_, unambiguous_m_;
};

/// Whether the beam's axis comes between the middles of this column and one beside it, of which a map reads both. The
/// other modes make their own azimuths.
[[nodiscard]] bool looked_at(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid, std::size_t column);

}  // namespace sigmascape::receiver
