#include "gil.h"

#include <atomic>
#include <chrono>
#include <pthread.h>
#include <thread>
#include <unistd.h>

#include "sigmascape/base/interruption.h"

namespace sigmascape::python {
namespace {

std::atomic<int> works{0};  // without the GIL, on all threads

bool python_has_ended() {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

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

void end_after_work_without_gil() {
  // In a forked child there are no threads but one, which holds the GIL.
  ::pthread_atfork(nullptr, nullptr, [] { works = 0; });
  // Last of all that Python does, and before the libraries go.
  Py_AtExit([] {
    while (works > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
}

}  // namespace sigmascape::python
