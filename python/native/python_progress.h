#pragma once

#include <chrono>
#include <pybind11/pybind11.h>

#include "sigmascape/base/progress.h"

namespace sigmascape::python {

/// Passes progress on to a Python callable (task, done, total, unit), a few times a second, and lets Ctrl-C end the
/// work: what the signal raises in Python goes through the work as an exception. Make and destroy it holding the GIL;
/// the work goes without.
class PythonProgress final : public ProgressListener {
 public:
  /// `progress` as the caller of the Python function gave it: a callable, False for silence, None for a bar by tqdm
  /// where that is installed.
  explicit PythonProgress(const pybind11::object& progress);
  ~PythonProgress() override;
  PythonProgress(const PythonProgress&) = delete;
  PythonProgress& operator=(const PythonProgress&) = delete;

  void advanced(std::string_view task, double done, double total, std::string_view unit) override;

 private:
  using Clock = std::chrono::steady_clock;

  pybind11::object listener_;
  Clock::time_point told_ = {};
};

}  // namespace sigmascape::python
