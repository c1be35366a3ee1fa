#pragma once

#include <string>

namespace sigmascape::cli {

/// Links from a page to others of the project.
class PageLinks {
 public:
  /// `page` is named from the root of the project, "docs/results/itu/README.md"; elsewhere or empty, there is nothing
  /// to link to from it, and pages are named instead.
  explicit PageLinks(const std::string& page);

  /// The words as a link to a page that is named from the root, "docs/live.md"; or the words and that name.
  [[nodiscard]] std::string to(const std::string& words, const std::string& target) const;
  /// Whether that page is this one.
  [[nodiscard]] bool is_own(const std::string& target) const { return target == page_; }

 private:
  std::string page_;  ///< empty when it is not among the others
};

}  // namespace sigmascape::cli
