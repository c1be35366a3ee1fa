#pragma once

#include <algorithm>
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <span>
#include <vector>

#include "sigmascape/base/array2d.h"

namespace sigmascape::python {

/// Whether whoever gets the array may write into it.
enum class Access { ReadOnly, ReadWrite };

/// Strides of C order. Said by us and not by pybind11: versions of it read the width of a number where NumPy 2 keeps
/// something else, and all strides come out as 0.
inline std::vector<pybind11::ssize_t> strides_of(const std::vector<pybind11::ssize_t>& shape,
                                                 std::size_t number_bytes) {
  std::vector<pybind11::ssize_t> strides(shape.size(), static_cast<pybind11::ssize_t>(number_bytes));
  for (std::size_t axis = shape.size(); axis-- > 1;) strides[axis - 1] = strides[axis] * shape[axis];
  return strides;
}

/// A NumPy array over memory that `owner` keeps alive: no number is copied. Strides are in bytes.
inline pybind11::array array_view(const pybind11::dtype& type, const void* numbers,
                                  std::vector<pybind11::ssize_t> shape, std::vector<pybind11::ssize_t> strides,
                                  pybind11::handle owner, Access access) {
  pybind11::array array(type, std::move(shape), std::move(strides), numbers, owner);
  if (access == Access::ReadOnly) array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

template <typename T>
pybind11::array array_view(const T* numbers, std::vector<pybind11::ssize_t> shape, pybind11::handle owner,
                           Access access) {
  auto strides = strides_of(shape, sizeof(T));
  return array_view(pybind11::dtype::of<T>(), numbers, std::move(shape), std::move(strides), owner, access);
}

/// [row, column] of one number of each element of an Array2D, the number `offset` bytes into the element.
template <typename Number, typename Element>
pybind11::array layer_view(const Array2D<Element>& array, std::size_t offset, pybind11::handle owner, Access access) {
  constexpr auto step = static_cast<pybind11::ssize_t>(sizeof(Element));
  const auto rows = static_cast<pybind11::ssize_t>(array.rows());
  const auto columns = static_cast<pybind11::ssize_t>(array.columns());
  const auto* first = reinterpret_cast<const std::byte*>(array.values().data()) + offset;
  return array_view(pybind11::dtype::of<Number>(), first, {rows, columns}, {columns * step, step}, owner, access);
}

/// [row, column, number] of all numbers of each element of an Array2D.
template <typename Number, typename Element>
pybind11::array layers_view(const Array2D<Element>& array, pybind11::handle owner, Access access) {
  static_assert(sizeof(Element) % sizeof(Number) == 0);
  return array_view(reinterpret_cast<const Number*>(array.values().data()),
                    {static_cast<pybind11::ssize_t>(array.rows()), static_cast<pybind11::ssize_t>(array.columns()),
                     static_cast<pybind11::ssize_t>(sizeof(Element) / sizeof(Number))},
                    owner, access);
}

/// A small array of its own.
template <typename T>
pybind11::array_t<T> copied_array(const std::vector<T>& numbers) {
  pybind11::array_t<T> array(std::vector<pybind11::ssize_t>{static_cast<pybind11::ssize_t>(numbers.size())},
                             std::vector<pybind11::ssize_t>{sizeof(T)});
  std::copy(numbers.begin(), numbers.end(), array.mutable_data());
  return array;
}

}  // namespace sigmascape::python
