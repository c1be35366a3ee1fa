#pragma once

#include <span>

#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/receiver/echo_places.h"
#include "sigmascape/receiver/power_bins.h"

namespace sigmascape::receiver {

/// The bins that cover the given points of ground, finer than the radar resolves so that its responses can be laid over
/// them: `oversampling` bins a resolution cell in range and in two-way azimuth. They go all round, once, when one of
/// the points is straight below the radar and when beams aimed beside the points would take in a whole turn. Throws
/// Error when they are too many to hold, or when the radar's scan never comes to them.
[[nodiscard]] radar::RangeAzimuthGrid grid_covering(const radar::Radar& radar, std::span<const Vec3d> points,
                                                    double oversampling = 2.0);

/// The weighted histogram: echoes into slant range and azimuth, then the pulse and beam response over the bins.
///
/// Power mode: the weights of pulse, beam and place within a bin sum to one, so that total power is kept; see
/// docs/physics/receiver.md, Eq. (1). Before that an echo is weighted by the antenna's two-way gain in elevation
/// relative to its peak, and one from outside the unambiguous range after the gate's opening folds into it as the
/// cross-section that would return its power from there.
class RangeAzimuthReceiver {
 public:
  RangeAzimuthReceiver(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid);

  /// May be called from several threads at once.
  void add(std::span<const radar::Echo> echoes);

  /// The same for echoes that all stand at one azimuth, whatever they say themselves; several times as quick. May be
  /// called from several threads at once.
  void add_at_azimuth(double azimuth_rad, std::span<const radar::Echo> echoes);

  /// Forgets what was added.
  void clear() { bins_.clear(); }

  [[nodiscard]] const PowerBins& bins() const { return bins_; }
  /// The bins after the responses of the compressed pulse and of the two-way beam; NaN in azimuths that the beam's axis
  /// never comes to and in ranges outside the gate, which closes an unambiguous range after its opening at the latest.
  /// Throws Error when a bin became brighter than its sum can hold.
  [[nodiscard]] radar::RangeAzimuthImage image() const;

 private:
  /// Nothing for a column beyond the bins; where these go all round, columns do.
  void add_line(double column, const PowerLine& line);

  radar::Radar radar_;
  radar::RangeAzimuthGrid grid_;
  EchoPlaces places_;
  PowerBins bins_;
};

}  // namespace sigmascape::receiver
