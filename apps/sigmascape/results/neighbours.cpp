#include "results/neighbours.h"

#include <algorithm>
#include <iterator>

#include "results/measured.h"

namespace sigmascape::cli {

std::vector<Neighbour> neighbours_of(const std::filesystem::path& page, const ResultsPlan& plan) {
  if (page.empty() || !plan.is_the_papers_scene()) return {};
  const std::filesystem::path root = std::filesystem::path(results_pages[0].page).parent_path();
  std::vector<Neighbour> neighbours;
  for (const ResultsPage& other : results_pages) {
    if (&other == std::begin(results_pages)) continue;
    const std::filesystem::path folder = std::filesystem::path(other.page).parent_path().lexically_relative(root);
    neighbours.push_back({other, rows_of(results_kept_in(page.parent_path() / folder / "measured.json"))});
  }
  const bool has_any = std::ranges::any_of(neighbours, [](const Neighbour& each) { return !each.rows.empty(); });
  return has_any ? neighbours : std::vector<Neighbour>{};
}

}  // namespace sigmascape::cli
