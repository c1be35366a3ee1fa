#pragma once

#include <span>

#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/receiver/power_bins.h"

namespace sigmascape::receiver {

/// The bins that cover the given points of ground, finer than the radar resolves so that its responses can be laid over
/// them: `oversampling` bins a resolution cell in range and in azimuth.
[[nodiscard]] radar::RangeAzimuthGrid grid_covering(const radar::Radar& radar, std::span<const Vec3d> points,
                                                    double oversampling = 2.0);

/// The weighted histogram: echoes into slant range and azimuth, then the pulse and beam response over the bins.
///
/// In this power mode all weights sum to one, so that total power is kept; see docs/physics/receiver.md, Eq. (1).
class RangeAzimuthReceiver {
 public:
  RangeAzimuthReceiver(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid);

  /// May be called from several threads at once.
  void add(std::span<const radar::Echo> echoes);

  [[nodiscard]] const PowerBins& bins() const { return bins_; }
  /// The bins after the responses of pulse (Gaussian of half-power width the range resolution) and beam (two-way
  /// Gaussian).
  [[nodiscard]] radar::RangeAzimuthImage image() const;

 private:
  radar::Radar radar_;
  radar::RangeAzimuthGrid grid_;
  PowerBins bins_;
};

}  // namespace sigmascape::receiver
