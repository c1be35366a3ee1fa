#include "sigmascape/geo/local_frame.h"

#include <fmt/format.h>

namespace sigmascape::geo {

std::string LocalFrame::proj() const {
  return fmt::format("+proj=tmerc +lat_0={:.10f} +lon_0={:.10f} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs",
                     latitude_deg_, longitude_deg_);
}

}  // namespace sigmascape::geo
