#pragma once

#include <optional>
#include <pybind11/pybind11.h>

namespace sigmascape::python {

/// Lets other Python threads run while it lives. Python ends a daemon thread that wants the GIL back after the main
/// thread has gone by unwinding it, through destructors that must not throw, which ends the whole process as a crash.
/// Such a thread waits here for the process to end instead, as all do from Python 3.14 on.
class WithoutGil {
 public:
  WithoutGil();
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* thread_;
};

/// Holds the GIL while it lives, in a piece of work that goes without. Throws Interrupted when Python has ended
/// meanwhile.
class WithGil {
 public:
  WithGil();

 private:
  std::optional<pybind11::gil_scoped_acquire> gil_;
};

/// Lets the work of daemon threads come to its end, or to where it heeds an Interruption, before the process takes down
/// what they work with. To be called once.
void end_after_work_without_gil();

}  // namespace sigmascape::python
