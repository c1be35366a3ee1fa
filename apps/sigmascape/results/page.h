#pragma once

#include <string>
#include <utility>
#include <vector>

#include "results/links.h"
#include "results/neighbours.h"
#include "results/plan.h"
#include "results/table.h"
#include "results/vertices.h"

#include "sigmascape/product/comparison_page.h"
#include "sigmascape/product/plot.h"

namespace sigmascape::cli {

using product::Plot;
using product::PlotSeries;

/// Everything that a page is made of.
struct ResultsReport {
  ResultsPlan plan;
  std::string scene;         ///< the scene's own name
  std::string attribution;   ///< of its data
  std::string machine;       ///< that the times are of
  std::string command_line;  ///< that makes the page again
  PageLinks links;
  VertexCounts vertices;                 ///< of which maps from textures keep those of the terrain alone
  std::size_t tracing_memory_bytes = 0;  ///< of the full scene's acceleration structures
  std::size_t patches = 1;               ///< of the atlas that the square lies on
  std::vector<ViewResult> views;
  std::vector<ResultsRow> rows;
  std::vector<product::PageSection> figures;
  std::vector<Neighbour> neighbours = {};
};

/// The page as Markdown. Figures are shown by the names of their files, which are to lie beside it, like the plots.
[[nodiscard]] std::string results_markdown(const ResultsReport& report);

/// The plots of the page by the names of their files.
[[nodiscard]] std::vector<std::pair<std::string, Plot>> plots_of(const ResultsReport& report);

/// The numbers at 8 m cells as sections of a page with pictures.
[[nodiscard]] std::vector<product::PageSection> results_sections(const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
