#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "sigmascape/radar/radar.h"

namespace sigmascape::receiver {

/// How the power of one bin spreads over its neighbours along one axis.
struct BinResponse {
  /// Odd in number, the middle one for the bin itself; they sum to one.
  std::vector<float> weights;
  /// The response's energy in bins of its peak, wherever that lies. A point of cross-section σ has σ over `peak_bins`
  /// in a bin that the response's peak falls on.
  double peak_bins = 1.0;
};

/// The compressed pulse's |h|² at steps of the bins, followed until no more than 3e-4 of its power is left out, at most
/// 64 resolution cells to either side.
[[nodiscard]] BinResponse range_response(const radar::Radar& radar, double range_step_m);
/// The beam's two-way power pattern at steps of the bins, followed until no more than 1e-5 of its power is left out, at
/// most half a turn to either side.
[[nodiscard]] BinResponse azimuth_response(const radar::Radar& radar, double azimuth_step_rad);

/// What `peak_bins` is of responses that are sampled more and more finely: the energy of the whole response in bins of
/// its peak. It is less where bins are so coarse that most of a response falls between their middles: by so much of a
/// bin of even ground a pulse answers as though all of that lay at its peak.
[[nodiscard]] double range_energy_bins(const radar::Radar& radar, double range_step_m);
[[nodiscard]] double azimuth_energy_bins(const radar::Radar& radar, double azimuth_step_rad);

/// How the power of a point spreads along one axis, wherever within a bin it lies; from the middle of a bin as that of
/// the bin does.
class PlacedResponse {
 public:
  /// `power` over the offset from a bin's middle to the point in bins, followed over `reach` bins to either side.
  PlacedResponse(std::function<double(double offset_bins)> power, std::size_t reach)
      : power_(std::move(power)), reach_(static_cast<double>(reach)) {}

  /// One for each bin from the first on; they sum to one.
  struct Weights {
    std::ptrdiff_t first_bin = 0;
    std::vector<float> of_bins;
  };
  /// `place` in units of bins, 0.5 being the middle of bin 0.
  [[nodiscard]] Weights at(double place) const;

 private:
  std::function<double(double)> power_;
  double reach_;
};

/// As far as `range_response` and `azimuth_response` follow theirs.
[[nodiscard]] PlacedResponse placed_range_response(const radar::Radar& radar, double range_step_m);
[[nodiscard]] PlacedResponse placed_azimuth_response(const radar::Radar& radar, double azimuth_step_rad);

}  // namespace sigmascape::receiver
