#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/product/map_metrics.h"

namespace sigmascape::product {

/// A picture on the page.
struct PageFigure {
  std::filesystem::path png = {};  ///< a file that exists; it is copied into the page
  std::string caption = {};
};

/// A line of the page's facts: "Rays", "41.9 million".
struct PageFact {
  std::string name;
  std::string value;
};

/// A part of the page under its own heading; what it lacks is left out.
struct PageSection {
  std::string heading = {};
  std::vector<std::string> paragraphs = {};
  std::vector<PageFigure> figures = {};  ///< side by side where the window is wide enough
  std::optional<MapComparison> comparison = {};
  /// The truth against itself from another seed, shown beside the comparison.
  std::optional<MapComparison> noise_floor = {};
  std::vector<PageFact> facts = {};
};

/// What a comparison of two maps looks like to a person.
struct ComparisonPage {
  std::string title = {};
  std::string lead = {};  ///< one sentence below the title
  std::vector<PageSection> sections = {};
  std::string attribution = {};  ///< of the data shown, at the foot; empty for none
};

/// Writes the page as one HTML file that stands alone: pictures inside, no scripts, nothing fetched. Atomically. All
/// texts are plain text. Throws Error when a picture cannot be read or the page not be written.
void write_comparison_page(const std::filesystem::path& path, const ComparisonPage& page);

/// The page as HTML text. Throws Error when a picture cannot be read.
[[nodiscard]] std::string comparison_page_html(const ComparisonPage& page);

}  // namespace sigmascape::product
