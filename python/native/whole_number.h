#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <pybind11/pybind11.h>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"

namespace sigmascape::python {

/// The name of an argument, as part of a type.
template <std::size_t length>
struct ArgumentName {
  char letters[length]{};
  constexpr ArgumentName(const char (&name)[length]) { std::copy_n(name, length, letters); }
};

/// Python does not write out numbers of thousands of digits.
inline std::string is_in_words(const pybind11::object& whole) {
  try {
    return "is " + pybind11::str(whole).cast<std::string>();
  } catch (const pybind11::error_already_set&) {
    return "has thousands of digits";
  }
}

/// An argument of that name that is a whole number within these bounds. Others raise Error, however long they are;
/// what is no whole number is a TypeError, as for any argument.
template <ArgumentName name, typename Number, Number lowest = 0, Number highest = std::numeric_limits<Number>::max()>
class Whole {
 public:
  constexpr Whole() = default;
  constexpr operator Number() const { return number_; }

  /// What a Python object holds; nothing, and false, where that is no whole number.
  bool take(pybind11::handle given) {
    const auto whole = pybind11::reinterpret_steal<pybind11::object>(PyNumber_Index(given.ptr()));
    if (!whole) {
      PyErr_Clear();
      return false;
    }
    pybind11::detail::make_caster<Number> usual;
    if (usual.load(whole, false)) {
      number_ = pybind11::detail::cast_op<Number>(usual);
      if (number_ >= lowest && number_ <= highest) return true;
    }
    throw Error(name.letters, is_in_words(whole), fmt::format("give a whole number from {} to {}", lowest, highest));
  }

 private:
  Number number_ = lowest;
};

/// Of any size and sign, where what takes it says itself what it may be.
template <ArgumentName name>
using AnyWhole = Whole<name, int, std::numeric_limits<int>::min()>;

// What many functions take.
using LevelOfDetail = AnyWhole<"lod">;
using Threads = Whole<"threads", unsigned, 0, most_threads>;
using Seed = Whole<"seed", std::uint64_t>;
using Dwell = Whole<"dwell", std::uint64_t>;
using RaysACell = Whole<"samples", std::uint32_t, 1, 1U << 24U>;
using Bounces = Whole<"bounces", int, 1, 255>;

}  // namespace sigmascape::python

template <sigmascape::python::ArgumentName argument, typename Number, Number lowest, Number highest>
struct pybind11::detail::type_caster<sigmascape::python::Whole<argument, Number, lowest, highest>> {
  using Taken = sigmascape::python::Whole<argument, Number, lowest, highest>;
  PYBIND11_TYPE_CASTER(Taken, const_name("int"));
  bool load(handle given, bool) { return value.take(given); }
};
