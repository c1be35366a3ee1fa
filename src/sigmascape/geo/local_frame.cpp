#include "sigmascape/geo/local_frame.h"

#include <cmath>
#include <fmt/format.h>

namespace sigmascape::geo {

std::string LocalFrame::proj() const {
  return fmt::format("+proj=tmerc +lat_0={:.10f} +lon_0={:.10f} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs",
                     latitude_deg_, longitude_deg_);
}

std::string LocalFrame::title() const {
  return fmt::format("Sigmascape local transverse Mercator at {:.10g} {}, {:.10g} {}", std::abs(latitude_deg_),
                     latitude_deg_ < 0.0 ? 'S' : 'N', std::abs(longitude_deg_), longitude_deg_ < 0.0 ? 'W' : 'E');
}

}  // namespace sigmascape::geo
