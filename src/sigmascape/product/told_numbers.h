#pragma once

#include <map>
#include <string>

namespace sigmascape::product {

/// What counts or measures among the words that say where a file comes from, such as `time_s` and `dwell`: taken out of
/// `words` and handed over as numbers, for files that tell the two apart. Words that are no number stay, and so do the
/// seed and a dwell beyond 2⁵³, which a double cannot hold.
[[nodiscard]] std::map<std::string, double> numbers_taken_from(std::map<std::string, std::string>& words);

}  // namespace sigmascape::product
