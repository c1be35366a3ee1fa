#pragma once

#include <pybind11/pybind11.h>
#include <string_view>

namespace sigmascape::python {

/// A sentence as Python has it. Names of files are bytes, which need not be UTF-8: those that are not become what
/// os.fsdecode makes of them.
inline pybind11::str text_with_file_names(std::string_view sentence) {
  auto* const text = PyUnicode_DecodeUTF8(sentence.data(), static_cast<Py_ssize_t>(sentence.size()), "surrogateescape");
  if (text == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::str>(text);
}

}  // namespace sigmascape::python
