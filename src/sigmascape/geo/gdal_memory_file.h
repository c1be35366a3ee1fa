#pragma once

#include <string>
#include <string_view>

namespace sigmascape::geo {

/// A GeoTIFF that GDAL keeps in memory while this lives, under a name that nothing else uses.
class GdalMemoryFile {
 public:
  GdalMemoryFile();
  ~GdalMemoryFile();
  GdalMemoryFile(const GdalMemoryFile&) = delete;
  GdalMemoryFile& operator=(const GdalMemoryFile&) = delete;

  [[nodiscard]] const char* name() const { return name_.c_str(); }
  /// As long as GDAL does not write to it.
  [[nodiscard]] std::string_view bytes() const;

 private:
  std::string name_;
};

}  // namespace sigmascape::geo
