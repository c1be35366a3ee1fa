#pragma once

#include <exception>

#include "sigmascape/base/interruption.h"

namespace sigmascape::geo {

/// Lets GDAL's long readings be told to stop: `advanced` is the function that GDAL asks now and then, with this object
/// as its data. Nothing may be thrown through GDAL, so what there is to throw waits for `settle`.
class HeedingProgress {
 public:
  static int advanced(double, const char*, void* self) noexcept {
    // GDALDataset::GetNextFeature tells its end without the data.
    if (self == nullptr) return 1;
    auto& progress = *static_cast<HeedingProgress*>(self);
    try {
      Interruption::heed();
    } catch (...) {
      progress.stopped_by_ = std::current_exception();
      return 0;
    }
    return 1;
  }

  /// Throws what made it stop.
  void settle() const {
    if (stopped_by_) std::rethrow_exception(stopped_by_);
  }

 private:
  std::exception_ptr stopped_by_;
};

}  // namespace sigmascape::geo
