#pragma once

#include <string>
#include <string_view>

#include "sigmascape/base/toml_reader.h"

namespace sigmascape::scene {

/// Refuses a key that says nothing without a partner, as the file would write that, where the partner is not there.
inline void refuse_without(const TomlSection& section, std::string_view key, const std::string& partner,
                           bool is_partner_there) {
  if (is_partner_there || !section.has(key)) return;
  throw section.fault(key, "stands without " + partner, "add " + partner + " or remove it");
}

}  // namespace sigmascape::scene
