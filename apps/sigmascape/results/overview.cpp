#include "results/overview.h"

#include <algorithm>
#include <fmt/format.h>

#include "results/columns.h"
#include "results/contrast.h"

namespace sigmascape::cli {
namespace {

/// A method from a grid as it is, at held-out views, with whatever rays; nullptr for none.
const ResultsRow* plain_row(const std::vector<ResultsRow>& rows, Method method, const LookGrid& grid) {
  const auto found = std::ranges::find_if(rows, [&](const ResultsRow& row) {
    return row.of.method == method && row.of.grid == grid.name() && row.of.kind == ViewKind::HeldOut &&
           row.of.change.empty() && row.of.level_of_detail == 1 && summary_cell(&row) != nullptr;
  });
  return found == rows.end() ? nullptr : &*found;
}

std::string rms_text(const ResultsRow* row) {
  return row != nullptr ? number_text(summary_cell(row)->median.rms_db, 2) : "–";
}

/// "6.30 | 5.09 | 23 of 24 | 3.45": the paper's method, ours, at how many views ours comes closer, and ours with
/// buildings apart.
std::string all_methods_from(const std::vector<ResultsRow>& rows, const LookGrid& grid) {
  const ResultsRow* paper = plain_row(rows, Method::Paper, grid);
  const ResultsRow* ours = plain_row(rows, Method::OwnGround, grid);
  std::string closer = "–";
  if (paper != nullptr && ours != nullptr) {
    const PairedFall fall = fall_between(*paper, *ours, &product::CellComparison::rms_db);
    closer = fmt::format("{} of {}", fall.better, fall.views);
  }
  return fmt::format("{} | {} | {} | {}", rms_text(paper), rms_text(ours), closer,
                     rms_text(plain_row(rows, Method::Apart, grid)));
}

std::string line_of(const std::string& scene, const std::vector<ResultsRow>& rows, const ResultsPlan& plan) {
  const ResultsRow* paper = plain_row(rows, Method::Paper, plan.paper_grid());
  const std::string truth = paper != nullptr ? number_text(summary_cell(paper)->floor_median.rms_db, 2) : "–";
  return fmt::format("| {} | {} | {} | {} |\n", scene, all_methods_from(rows, plan.paper_grid()),
                     all_methods_from(rows, plan.next_grid()), truth);
}

}  // namespace

std::string overview_section(const ResultsReport& report) {
  if (report.neighbours.empty()) return {};
  const ResultsPlan& plan = report.plan;
  const std::string grid = plan.paper_grid().name(), next = plan.next_grid().name();
  std::string text = fmt::format(
      "## All scenes\n\nRMS of dB at {:.0f} m cells, medians over the held-out views of each scene; *ours* is on its "
      "own ground, and *closer* says at how many of the views it comes closer than the paper's method from the same "
      "looks; with buildings *apart* what they return directly is made anew for each map. "
      "*Truth* is one traced map against another: no less than half of it can be shown.\n\n"
      "| scene | {} looks: paper | ours | closer | apart | {} looks: paper | ours | closer | apart | truth |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
      summary_cell_m, grid, next);
  text += line_of(results_pages[0].words, report.rows, plan);
  bool are_all_there = true;
  for (const Neighbour& neighbour : report.neighbours) {
    text += line_of(report.links.to(neighbour.page.words, neighbour.page.page), neighbour.rows, plan);
    are_all_there = are_all_there && !neighbour.rows.empty();
  }
  return text + (are_all_there ? "\n" : "\n–: measured by an earlier program, whose page stands as it was.\n\n");
}

}  // namespace sigmascape::cli
