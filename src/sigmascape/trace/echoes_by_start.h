#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/echo.h"

namespace sigmascape::trace {

/// The echoes of many paths that were followed together: they come in as they are found and go out path by path, those
/// of a path in the order of its vertices.
class EchoesByStart {
 public:
  /// Forgets all echoes; paths that bring some will be numbered below `starts`.
  void begin(std::size_t starts);
  void add(std::uint32_t start, const radar::Echo& echo) { found_.push_back({start, echo}); }
  /// Belongs to the echo added last; to all echoes or to none.
  void add_amplitude(const radar::ComplexChannels& amplitude_m) { found_amplitudes_m_.push_back(amplitude_m); }
  /// No more to come.
  void sort();

  [[nodiscard]] std::span<const radar::Echo> echoes(std::size_t start) const { return part_of(echoes_, start); }
  [[nodiscard]] std::span<const radar::ComplexChannels> amplitudes_m(std::size_t start) const {
    return amplitudes_m_.empty() ? std::span<const radar::ComplexChannels>() : part_of(amplitudes_m_, start);
  }

 private:
  struct Found {
    std::uint32_t start;
    radar::Echo echo;
  };

  template <typename Record>
  [[nodiscard]] std::span<const Record> part_of(const std::vector<Record>& records, std::size_t start) const {
    return std::span(records).subspan(first_[start], first_[start + 1] - first_[start]);
  }

  std::vector<Found> found_;
  std::vector<radar::ComplexChannels> found_amplitudes_m_;
  std::vector<std::size_t> first_;  // of each start; one more for the end
  std::vector<std::size_t> next_;
  std::vector<radar::Echo> echoes_;
  std::vector<radar::ComplexChannels> amplitudes_m_;
};

}  // namespace sigmascape::trace
