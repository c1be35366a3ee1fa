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

/// Whether Python ends the threads that want the GIL. Needs no GIL.
[[nodiscard]] bool python_has_ended();

/// Whether this is Python's main thread, the only one that hears signals. Needs no GIL.
[[nodiscard]] bool is_main_thread();

/// Lets the work of daemon threads come to its end, or to where it heeds an Interruption, before the process takes down
/// what they work with, and notes which is the main thread. To be called once, with the GIL.
void look_after_threads();

}  // namespace sigmascape::python
