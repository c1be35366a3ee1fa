#pragma once

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::simulate {

/// The ground around what a range–Doppler image maps, which is there for the outermost cells, whose responses reach
/// into it. What of it pulses would fold onto the map is not: Doppler is known up to the pulse repetition frequency,
/// and left and right of the course not at all, so that ground may have the range and Doppler of other ground. Of each
/// such set the map's own counts, else the one nearest to its middle in Doppler, and the Doppler axis is filled once.
/// docs/decisions/0161-rims-do-not-fold.md.
class DopplerRim {
 public:
  /// `area`: what is mapped with all that lies around it.
  DopplerRim(const radar::Radar& radar, const radar::Rectangle& mapped, const radar::Rectangle& area);

  /// Whether what stands at a place of the area is in the image; what is mapped always is.
  [[nodiscard]] bool takes_part(Vec3d place) const;

 private:
  [[nodiscard]] double cosine_off_course(Vec2d away) const;

  radar::Rectangle mapped_, area_;
  Vec3d position_;
  radar::CurvedEarth earth_;
  Vec2d course_;              // a unit vector
  double fold_ = 0.0;         // what one pulse repetition frequency is in cos φ cos ψ
  double middle_ = 0.0;       // cos φ of the map's middle, φ the angle off the course
  double reach_ = 2.0;        // from the least to the most cos φ of the area
  double map_on_side_ = 0.0;  // 1 left of the course, −1 right of it, 0 on both sides
};

}  // namespace sigmascape::simulate
