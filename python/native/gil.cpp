#include "gil.h"

#include <atomic>
#include <chrono>
#include <pthread.h>
#include <thread>
#include <unistd.h>

#include "sigmascape/base/interruption.h"

namespace sigmascape::python {
namespace {

std::atomic<int> works{0};                  // without the GIL, on all threads
std::atomic<unsigned long> main_thread{0};  // as Python numbers them

[[noreturn]] void wait_for_the_end() {
  while (true) ::pause();
}

}  // namespace

WithoutGil::WithoutGil() : thread_(PyEval_SaveThread()) {
  ++works;
}

WithoutGil::~WithoutGil() {
  --works;
  try {
    PyEval_RestoreThread(thread_);
  } catch (...) {  // the unwinding by which Python ends threads: nothing else comes out of its C
    wait_for_the_end();
  }
}

WithGil::WithGil() {
  if (python_has_ended()) throw Interrupted();
  try {
    gil_.emplace();
  } catch (...) {  // it has ended since
    --works;
    wait_for_the_end();
  }
}

bool python_has_ended() {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

bool is_main_thread() {
  return PyThread_get_thread_ident() == main_thread;
}

void look_after_threads() {
  main_thread = pybind11::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  // In a forked child there are no threads but one, which holds the GIL and is the main one from then on.
  ::pthread_atfork(nullptr, nullptr, [] {
    works = 0;
    main_thread = PyThread_get_thread_ident();
  });
  // Last of all that Python does, and before the libraries go.
  Py_AtExit([] {
    while (works > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
}

}  // namespace sigmascape::python
