#include "sigmascape/geo/gdal_memory_file.h"

#include <atomic>
#include <cpl_vsi.h>
#include <fmt/format.h>

namespace sigmascape::geo {

GdalMemoryFile::GdalMemoryFile() {
  static std::atomic<unsigned> serial{0};
  name_ = fmt::format("/vsimem/sigmascape/{}.tif", serial.fetch_add(1));
}

GdalMemoryFile::~GdalMemoryFile() {
  VSIUnlink(name_.c_str());
}

std::string_view GdalMemoryFile::bytes() const {
  vsi_l_offset size = 0;
  const GByte* data = VSIGetMemFileBuffer(name_.c_str(), &size, FALSE);
  return {reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)};
}

}  // namespace sigmascape::geo
