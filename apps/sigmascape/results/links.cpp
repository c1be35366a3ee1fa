#include "results/links.h"

#include <filesystem>
#include <fmt/format.h>

namespace sigmascape::cli {

PageLinks::PageLinks(const std::string& page) : page_(page.starts_with("docs/") ? page : std::string()) {}

std::string PageLinks::to(const std::string& words, const std::string& target) const {
  if (page_.empty()) return fmt::format("{} ({})", words, target);
  const auto from = std::filesystem::path(page_).parent_path();
  return fmt::format("[{}]({})", words, std::filesystem::path(target).lexically_relative(from).generic_string());
}

}  // namespace sigmascape::cli
