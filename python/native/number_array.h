#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string_view>
#include <utility>

namespace sigmascape::python {

/// An argument that holds numbers, in any shape, as doubles one after the other: arrays, lists of lists, single ones.
/// Text, times, complex numbers and objects are a TypeError, where NumPy would make of them what it can.
class NumberArray : public pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast> {
 public:
  using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
  NumberArray() = default;
  explicit NumberArray(Doubles doubles) : Doubles(std::move(doubles)) {}
};

}  // namespace sigmascape::python

template <>
struct pybind11::detail::type_caster<sigmascape::python::NumberArray> {
  PYBIND11_TYPE_CASTER(sigmascape::python::NumberArray, const_name("numpy.ndarray[numpy.float64]"));
  bool load(handle given, bool) {
    constexpr std::string_view kinds_of_numbers = "biuf";
    const auto held = array::ensure(given);
    if (!held || kinds_of_numbers.find(held.dtype().kind()) == std::string_view::npos) return false;
    value = sigmascape::python::NumberArray(sigmascape::python::NumberArray::Doubles::ensure(held));
    return true;
  }
};
