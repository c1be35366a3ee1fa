#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace sigmascape {

/// A rectangular array, row by row: element (column, row) stands at row · columns + column.
template <typename T>
class Array2D {
 public:
  Array2D() = default;
  Array2D(std::size_t columns, std::size_t rows, T fill = T{})
      : columns_(columns), rows_(rows), values_(columns * rows, fill) {}

  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }

  [[nodiscard]] T& operator()(std::size_t column, std::size_t row) {
    assert(column < columns_ && row < rows_);
    return values_[row * columns_ + column];
  }
  [[nodiscard]] const T& operator()(std::size_t column, std::size_t row) const {
    assert(column < columns_ && row < rows_);
    return values_[row * columns_ + column];
  }

  [[nodiscard]] std::span<T> row(std::size_t index) { return std::span(values_).subspan(index * columns_, columns_); }
  [[nodiscard]] std::span<const T> row(std::size_t index) const {
    return std::span(values_).subspan(index * columns_, columns_);
  }
  [[nodiscard]] std::span<T> values() { return values_; }
  [[nodiscard]] std::span<const T> values() const { return values_; }

 private:
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<T> values_;
};

}  // namespace sigmascape
