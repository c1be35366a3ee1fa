#include "sigmascape/geo/quiet_gdal.h"

#include <algorithm>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <mutex>

#include "sigmascape/base/error.h"

namespace sigmascape::geo {

QuietGdal::QuietGdal() {
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLErrorReset();
}

QuietGdal::~QuietGdal() {
  CPLPopErrorHandler();
}

bool QuietGdal::failed() {
  return CPLGetLastErrorType() >= CE_Failure;
}

std::string QuietGdal::complaint() {
  std::string message = CPLGetLastErrorMsg();
  // OGR quotes a condition below its fault, with an arrow under the place.
  message.resize(std::min({message.size(), message.find(". Occurred around"), message.find('\n')}));
  return message.empty() ? "no reason was given" : message;
}

std::string QuietGdal::complaint_beside() {
  const std::string message = complaint();
  const bool says_no_more = !failed() || message.find("not recognized as") != std::string::npos;
  return says_no_more ? "" : fmt::format(" ({})", message);
}

void register_gdal_drivers() {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
}

GDALDriver& gdal_driver(const char* name) {
  register_gdal_drivers();
  GDALDriver* found = GetGDALDriverManager()->GetDriverByName(name);
  if (found == nullptr) throw Error("GDAL", fmt::format("has no {} driver", name), "install a complete GDAL");
  return *found;
}

}  // namespace sigmascape::geo
