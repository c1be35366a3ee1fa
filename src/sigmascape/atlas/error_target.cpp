#include "sigmascape/atlas/error_target.h"

#include <charconv>
#include <string>
#include <system_error>

#include "sigmascape/base/units.h"

namespace sigmascape::atlas {

std::optional<double> error_target(const AtlasDescription& description) {
  const auto found = description.settings.find(target_setting);
  if (found == description.settings.end()) return std::nullopt;
  const std::string& words = found->second;
  double target_db = 0.0;
  const auto [end, fault] = std::from_chars(words.data(), words.data() + words.size(), target_db);
  if (fault != std::errc{} || end != words.data() + words.size()) return std::nullopt;
  return linear_from_db(target_db) - 1.0;
}

TexelsAboveTarget texels_above(double limit, const Array2D<float>& relative_errors,
                               const Array2D<radar::Channels>& texels) {
  TexelsAboveTarget counts;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (texels.values()[i].power(radar::Polarization::Sum) <= 0.0F) continue;
    ++counts.lit;
    counts.above += static_cast<double>(relative_errors.values()[i]) > limit ? 1U : 0U;
  }
  return counts;
}

}  // namespace sigmascape::atlas
