#pragma once

#include <ctime>

namespace sigmascape {

/// Seconds that the processors have spent on this program since it was made, all threads together: unlike the time on
/// the wall they hardly change when the machine has other work.
class ProcessorStopwatch {
 public:
  [[nodiscard]] double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace sigmascape
