#pragma once

#include <cpl_error.h>
#include <string>

class GDALDriver;

namespace sigmascape::geo {

/// Keeps GDAL from printing on this thread while it lives; what GDAL had to say since is asked for instead. Such
/// objects may lie within one another, and what the inner one heard is not held against the outer.
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal();
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  [[nodiscard]] static bool failed();
  /// What GDAL said last, in one line.
  [[nodiscard]] static std::string complaint();
  /// The same in brackets, to follow a sentence of our own; nothing where it would say no more than that.
  [[nodiscard]] static std::string complaint_beside();

 private:
  CPLErrorStateBackuper outer_;
};

/// Makes the formats known that GDAL can open. Done once, however often it is called.
void register_gdal_drivers();

/// The driver of a format, such as "GTiff" or "MEM". Throws Error when this GDAL has none.
[[nodiscard]] GDALDriver& gdal_driver(const char* name);

}  // namespace sigmascape::geo
