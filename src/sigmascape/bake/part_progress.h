#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "sigmascape/base/progress.h"

namespace sigmascape::bake {

/// Tells of the looks of one job as part of all looks of the work called `task`.
class PartProgress final : public ProgressListener {
 public:
  /// `looks` of `total` are the job's, and `before` of them are done.
  PartProgress(ProgressListener& whole, std::string task, std::size_t before, std::size_t looks, std::size_t total)
      : whole_(whole), task_(std::move(task)), before_(before), looks_(looks), total_(total) {}

  void advanced(std::string_view, double done, double of, std::string_view) override {
    // Whoever has the job tells of looks as done, when there is no more to do about them.
    if (done >= of) return;
    whole_.advanced(task_, static_cast<double>(before_) + done / of * static_cast<double>(looks_),
                    static_cast<double>(total_), "looks");
  }

 private:
  ProgressListener& whole_;
  std::string task_;
  std::size_t before_, looks_, total_;
};

}  // namespace sigmascape::bake
