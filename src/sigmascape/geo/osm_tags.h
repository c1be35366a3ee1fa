#pragma once

#include <map>
#include <string>
#include <string_view>

namespace sigmascape::geo {

/// The pairs inside OGR's `other_tags` field, which holds them as "key"=>"value","key"=>"value" with backslashes before
/// quotes and backslashes. What does not read so ends the reading; the pairs before it are kept.
[[nodiscard]] std::map<std::string, std::string> unpacked_tags(std::string_view other_tags);

}  // namespace sigmascape::geo
