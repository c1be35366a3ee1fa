#pragma once

#include <string>

#include "sigmascape/base/vec.h"

namespace sigmascape::geo {

/// The frame that everything in a scene lives in: transverse Mercator about an origin on the WGS 84 ellipsoid, with
/// scale 1 and true north there. x is east, y north, in metres; heights are orthometric and pass through unchanged.
class LocalFrame {
 public:
  /// A frame about 0° N, 0° E, for made-up landscapes that lie nowhere.
  LocalFrame() = default;
  LocalFrame(double latitude_deg, double longitude_deg) : latitude_deg_(latitude_deg), longitude_deg_(longitude_deg) {}

  friend bool operator==(const LocalFrame&, const LocalFrame&) = default;
  [[nodiscard]] double latitude_deg() const { return latitude_deg_; }
  [[nodiscard]] double longitude_deg() const { return longitude_deg_; }

  /// The frame as a PROJ string, which GDAL, PROJ and every GIS understand.
  [[nodiscard]] std::string proj() const;

  /// What a GIS calls it: "Sigmascape local transverse Mercator at 43.26 N, 2.93 W".
  [[nodiscard]] std::string title() const;

 private:
  double latitude_deg_ = 0.0;
  double longitude_deg_ = 0.0;
};

}  // namespace sigmascape::geo
