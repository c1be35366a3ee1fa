#include "sigmascape/trace/echoes_by_start.h"

#include <numeric>

namespace sigmascape::trace {

void EchoesByStart::begin(std::size_t starts) {
  found_.clear();
  found_amplitudes_m_.clear();
  first_.assign(starts + 1, 0);
}

void EchoesByStart::sort() {
  for (const Found& found : found_) ++first_[found.start + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  next_ = first_;
  echoes_.resize(found_.size());
  amplitudes_m_.resize(found_amplitudes_m_.size());
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const std::size_t place = next_[found_[i].start]++;
    echoes_[place] = found_[i].echo;
    if (!amplitudes_m_.empty()) amplitudes_m_[place] = found_amplitudes_m_[i];
  }
}

}  // namespace sigmascape::trace
