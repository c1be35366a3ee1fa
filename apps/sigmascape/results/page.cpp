#include "results/page.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "results/causes.h"
#include "results/changes.h"
#include "results/claims.h"
#include "results/columns.h"
#include "results/combinations.h"
#include "results/costs.h"
#include "results/error_tables.h"
#include "results/lead.h"
#include "results/noise_tables.h"
#include "results/overview.h"
#include "results/tracing.h"

namespace sigmascape::cli {
namespace {

std::string view_table(const ResultsPlan& plan) {
  std::string text =
      fmt::format("| view | azimuth [°] | elevation [°] | from the nearest look of {} [°] |\n|---|---:|---:|---:|\n",
                  plan.paper_grid().name());
  for (const PlannedView& view : plan.views) {
    text += fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} |\n", text_of(view.kind), view.azimuth_deg, view.elevation_deg,
                        ResultsPlan::distance_deg(view, plan.paper_grid()));
  }
  return text;
}

/// Grids that differ above all views alone cannot be told apart.
std::string elevation_remark(const ResultsPlan& plan) {
  double highest_deg = 0.0;
  for (const PlannedView& view : plan.views) highest_deg = std::max(highest_deg, view.elevation_deg);
  const double first_grid_deg = plan.grids.front().elevations_deg.back();
  if (highest_deg > first_grid_deg) return {};
  return fmt::format(" No view lies above {:.1f}°: what a grid holds beyond {:g}° is not put to the test.", highest_deg,
                     first_grid_deg);
}

std::string grid_list(const ResultsPlan& plan) {
  std::string text;
  std::vector<LookGrid> grids = plan.grids;
  grids.push_back(plan.even_in_cotangent());
  for (const LookGrid& grid : grids)
    text += fmt::format("- {}: azimuths every {:g}°, elevations {}°\n", grid.name(), 360.0 / grid.azimuths,
                        fmt::join(grid.elevations_deg, "°, "));
  if (!plan.has_finest_grid())
    text += fmt::format("- {}, which a page may have besides: left out, for its bake takes longest\n",
                        ResultsPlan::finest_grid().name());
  return text;
}

/// How many of so many figures stand beside one another in the next row: two until whole rows of three are left.
std::size_t in_next_row(std::size_t left) {
  return std::min<std::size_t>(left, left % 3 == 0 ? 3 : 2);
}

/// The figures of each section.
std::string figures_text(const std::vector<product::PageSection>& sections, const std::string& attribution) {
  std::string text;
  for (const product::PageSection& section : sections) {
    text += "## " + section.heading + "\n\n";
    for (const std::string& paragraph : section.paragraphs) text += paragraph + "\n\n";
    for (std::size_t first = 0, next = 0; first < section.figures.size(); first = next) {
      next = first + in_next_row(section.figures.size() - first);
      std::string captions = "|", rules = "|", pictures = "|";
      for (std::size_t i = first; i < next; ++i) {
        const product::PageFigure& figure = section.figures[i];
        captions += fmt::format(" {} |", figure.caption);
        rules += "---|";
        pictures += fmt::format(" ![{}]({}) |", figure.caption, figure.png.filename().string());
      }
      text += fmt::format("{}\n{}\n{}\n\n", captions, rules, pictures);
    }
    if (!attribution.empty()) text += "Data: " + attribution + "\n\n";
  }
  return text;
}

std::string settings_text(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  constexpr std::uint32_t papers_samples = 100;
  const auto rays_of = [&](ViewKind kind) { return traced_rays(plan, report.rows, plan.scene_name(), kind).text(); };
  return fmt::format(
             "## Settings\n\n"
             "- {} rays a texel of {:.2f} m{}, {} where stated. Each method is baked once, from its finest grid; "
             "coarser "
             "grids are looks of the same bake; the one in cot ψ, those whose texels share noise and those with rays "
             "where the noise is have their own\n"
             "- {} rays a 2 m cell in each of the two traced maps of a view, {} where it was baked\n"
             "- {} bounces, seed {}, 10 GHz\n",
             plan.baked_samples, ResultsPlan::texel_m,
             plan.baked_samples == papers_samples ? "" : fmt::format(" (the paper has {})", papers_samples),
             plan.finer_samples, rays_of(ViewKind::HeldOut), rays_of(ViewKind::OnGrid), plan.bounces, plan.seed) +
         grid_list(plan) +
         "\nHeld-out views are drawn from the seed, azimuth evenly over the circle and elevation evenly over 3° to "
         "40°; the view of the paper's picture stands by itself." +
         elevation_remark(plan) + "\n\n<details>\n<summary>All views</summary>\n\n" + view_table(plan) +
         "\n</details>\n\n"
         "[measured.json](measured.json) holds the numbers of every view; `sigmascape results --measured` goes on from "
         "them, where the physics that it was measured with is still the program's.\n";
}

}  // namespace

std::string results_markdown(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = results_lead(report) + combinations_table(plan, report.rows) + overview_section(report);
  text += tracing_section(plan, report.rows) + limits_section(plan, report.rows) + claims_section(report);
  text += words_section(report) + figures_text(report.figures, report.attribution);
  text += how_it_was_measured(report) + summary_section(report) + aims_section(report);
  text += without_noise_section(report) + level_section(report) + causes_section(plan, report.rows);
  text += changes_section(plan, report.rows);
  text += "## Error by angle, bytes and cell size\n\n";
  for (const auto& [name, plot] : plots_of(report)) text += fmt::format("![{}]({})\n\n", plot.title, name);
  return text + cell_section(report) + detail_section(report) + costs_section(report) + settings_text(report);
}

std::vector<product::PageSection> results_sections(const std::vector<ResultsRow>& rows) {
  std::vector<product::PageSection> sections;
  for (const ResultsRow& row : rows) {
    const ResultsCell* cell = row.at_cell(summary_cell_m);
    if (cell == nullptr) continue;
    const std::string heading =
        fmt::format("{}, {} at {:.0f} m cells: median (worst)", row.of.scene, text_of(row.of.kind), summary_cell_m);
    if (sections.empty() || sections.back().heading != heading) {
      sections.push_back({.heading = heading,
                          .paragraphs = {"Correlation of dB, RMS dB, bias in dB, relative L1, shadow IoU; store and "
                                         "processor time of the bake."}});
      sections.back().facts.push_back({"truth against truth", floor_text(row, *cell)});
    }
    sections.back().facts.push_back(
        {fmt::format("{}{}{}, rays: {}, LOD {}", way_text(row.of), row.of.grid.empty() ? "" : ", ", row.of.grid,
                     rays_text(row.of.baked_samples), row.of.level_of_detail),
         fmt::format("{}; {} MB, {:.0f} s", metrics_text(row, *cell), megabytes(row.atlas.store_bytes),
                     row.atlas.bake_seconds)});
  }
  return sections;
}

}  // namespace sigmascape::cli
