#pragma once

#include <optional>
#include <pybind11/pybind11.h>

#include "gil.h"

#include "sigmascape/base/interruption.h"

namespace sigmascape::python {

/// Does a long piece of work without the GIL. Ctrl-C and other signals are looked for some twenty times a second in
/// every parallel loop; what they raise in Python ends the work and is raised by the call. Only Python's main thread
/// hears signals, which is Python's own rule; on the others Python's end alone breaks the work off.
template <typename Work>
auto long_call(const Work& work) {
  std::optional<pybind11::error_already_set> raised;
  try {
    const WithoutGil released;
    const Interruption interruption([&raised] {
      if (python_has_ended()) throw Interrupted();
      // Another would look in vain, and Python may end it while it waits for the GIL, with locks that others wait for.
      if (!is_main_thread()) return false;
      const WithGil gil;
      if (PyErr_CheckSignals() == 0) return false;
      raised.emplace();
      return true;
    });
    return work();
  } catch (const Interrupted&) {
    if (!raised) throw;
    throw pybind11::error_already_set(*raised);
  }
}

}  // namespace sigmascape::python
