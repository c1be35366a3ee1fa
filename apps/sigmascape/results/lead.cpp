#include "results/lead.h"

#include <fmt/format.h>

#include "results/columns.h"
#include "results/combinations.h"
#include "results/results_pages.h"
#include "words.h"

#include "sigmascape/product/software.h"

namespace sigmascape::cli {
namespace {

std::string other_pages(const PageLinks& links) {
  std::string text;
  for (const ResultsPage& other : results_pages) {
    if (links.is_own(other.page)) continue;
    text += (text.empty() ? "Other pages: " : ", ") + links.to(other.words, other.page);
  }
  return text + ".\n\n";
}

std::string scene_title(const ResultsReport& report) {
  if (!report.plan.scene_file.empty()) return report.scene;
  return report.plan.is_the_papers_scene() ? results_pages[0].words : "the paper's scene of real materials";
}

std::string scene_in_words(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  if (plan.scene_file.empty()) {
    std::string size = fmt::format("{:.0f} m a side", plan.side_m());
    if (plan.scale < 1.0) {
      size += fmt::format(" instead of the paper's 2 km ({})",
                          report.links.to("why", "docs/decisions/0134-pages-of-four-hundred-metres.md"));
    }
    return fmt::format("a scene made up after the paper's, {}, with {} materials", size,
                       plan.is_the_papers_scene() ? "the paper's" : "real buildings' (ITU-R P.2040)");
  }
  if (plan.around_m == Vec2d{})
    return fmt::format("a square of {:.0f} m in the middle of {}", plan.side_m(), report.scene);
  return fmt::format("a square of {:.0f} m in {}, {:g} m east and {:g} m north of the middle of its scene file",
                     plan.side_m(), report.scene, plan.around_m.x, plan.around_m.y);
}

/// Where maps are made from, and from what textures.
std::string words_of_views(const ResultsPlan& plan) {
  const LookGrid& looks = plan.paper_grid();
  return fmt::format(
      "- A **look** is a direction towards the radar, azimuth and elevation, for which a texture was baked; {} are {} "
      "azimuths at {} elevations each. A **texel** is a cell of a texture, {:.2f} m wide on the ground. **LOD** is the "
      "level of detail: 1 reads the finest texels, each next one texels twice as wide.\n"
      "- A **view** is a direction from which a map is made. Views **on grid** are exactly at a look that was baked, "
      "those **held out** are drawn at random, and the **Figure 8 view** is that of the paper's picture. A view's "
      "**own look** is a texture baked for that very view, so that no angle is missing.\n",
      looks.name(), looks.azimuths, looks.elevations_deg.size(), ResultsPlan::texel_m);
}

/// What is shown, and how a map's distance from the truth is told.
std::string words_of_numbers() {
  const product::CompareOptions compare;
  return fmt::format(
      "- **σ0** is the radar cross-section of a square metre of ground, without unit; all numbers are of the sum of "
      "polarizations, VV + HH + 2·HV. **ψ** is the angle of the line of sight above the horizontal, **γ** = σ0 / sin "
      "ψ.\n"
      "- The **truth** of a view is the mean of two path-traced maps of the full scene. Rows *truth* hold these two "
      "against one another: at least half of their difference is left in the mean, and below that half nothing can be "
      "told.\n"
      "- **Correlation** and **RMS** are of σ0 in dB, cell by cell, none taken below {:g} dB. **Bias** is the map's "
      "total power over the truth's in dB, positive where the map is too bright. **Relative L1** is the sum of all |σ0 "
      "− true σ0| over the sum of true σ0: 0 is "
      "perfect, and bright cells decide. **Shadow IoU** is how many cells are in shadow, below {:g} dB, in both maps "
      "over how many are in either: 1 is perfect. It is of the views whose traced maps have {} such cells or more; a "
      "dash says that none has.\n",
      compare.floor_db, compare.shadow_db, product::least_shadow_cells);
}

std::string words_of_methods(const PageLinks& links) {
  return fmt::format(
      "- **paper** is the method of the paper {}; its store is counted as the paper counts, four floats a texel and "
      "look.\n"
      "- **ours, shadows baked**: echoes go straight into texels, {}; half floats, compressed.\n"
      "- **ours, on level ground**: the same, but {}, and shadows are made when a map is; its bytes include the "
      "ground.\n"
      "- **ours, on its own ground**: the same, and {}. So `sigmascape bake` does by default, but with rays that {}; "
      "here every texel gets as many.\n"
      "- **ours, buildings apart**: the same, and {} (`bake --buildings apart`); its bytes include these.\n\n",
      links.to("to the letter", "docs/decisions/0050-the-paper-literally.md"),
      links.to("γ is blended over cot ψ", "docs/decisions/0005-blend-gamma.md"),
      links.to("the ground is kept apart from what stands on it", "docs/decisions/0006-ground-apart.md"),
      links.to("objects are baked on the terrain that they stand on", "docs/decisions/0051-baked-on-its-own-ground.md"),
      links.to("go where the noise is", "docs/decisions/0097-rays-where-the-noise-is.md"),
      links.to("what buildings return directly is made from their walls and roofs when a map is",
               "docs/decisions/0171-buildings-apart.md"));
}

/// How well two traced maps agree, and what that leaves a baked map to reach.
std::string noise_floor_text(const ResultsReport& report) {
  std::string text = fmt::format(
      "The two traced maps of a view differ in their random numbers alone. Baked maps are held against their mean, "
      "which has half the variance of either's noise. So a baked map without any fault or noise would still show half "
      "of the RMS and of the relative L1 in the row *truth*, more where rare bright paths are most of the noise, and a "
      "correlation of √(2ρ/(1 + ρ)), where ρ is the one in that row. Nothing better can be shown. At {:.0f} m cells "
      "this is:\n\n",
      summary_cell_m);
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    const product::CellComparison* floor = noise_floor(report.plan, report.rows, report.plan.scene_name(), kind);
    if (floor == nullptr) continue;
    const ResultsRow& row = *baseline_row(report.plan, report.rows, report.plan.scene_name(), kind);
    text += fmt::format(
        "- {}: RMS {} dB, relative L1 {}, correlation {}; the two traced maps agree to {:g} or more, as was aimed at, "
        "at {} of {}\n",
        text_of(kind), number_text(least_error(floor->rms_db), 2), number_text(least_error(floor->l1), 3),
        number_text(most_correlation(floor->correlation_db), 3), least_agreement, row.agreeing_views,
        counted(row.views, "view", "views"));
  }
  return text + "\n";
}

}  // namespace

std::string results_lead(const ResultsReport& report) {
  std::string text = fmt::format(
      "# How close the baked map is: {}\n\n{}"
      "A path tracer makes a ground map from the full scene. Baking traces once and keeps what every "
      "patch of ground returns in each of some directions as textures, from which maps are rendered with nothing but "
      "the bare terrain. This page holds the second kind of map against the first, on {}. *The paper* is R. Visina, J. "
      "Bergin, D. Kirk and P. Skangos, *LOD and Texture Mapping for Real-Time Radar Ground Map Simulation*; its method "
      "is measured beside ours, and its Figures {}5 to 8 are made again. {}",
      scene_title(report), verdict(report.plan, report.rows), scene_in_words(report),
      report.plan.scene_file.empty() ? "1 and " : "", other_pages(report.links));
  if (!report.attribution.empty()) text += "Data: " + report.attribution + "\n\n";
  return text;
}

std::string words_section(const ResultsReport& report) {
  return "## The words of this page\n\n" + words_of_views(report.plan) + words_of_numbers() +
         words_of_methods(report.links);
}

std::string how_it_was_measured(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  std::string text = fmt::format(
      "## How it was measured\n\nBy {}:\n\n```\n{}\n```\n\n"
      "Numbers are medians over the views; in brackets stands the worst of all views, of each number by itself, so "
      "that those of one row may be of several views. `product/map_metrics.h` defines the five numbers.\n\n"
      "The radar stands 20 km from the middle of the scene and resolves 2 m in range and across. A rim of {:.0f} m "
      "along the edges is not compared, because what lies beyond echoes into it: {}.\n\n",
      product::software_name(), report.command_line, plan.rim_m(),
      plan.scene_file.empty() ? "there, bare ground goes on level for 300 m"
                              : "there, the place goes on with all that stands on it as far as the scene file "
                                "reaches, and beyond that bare ground level for 300 m");
  if (plan.has_level_ground()) {
    text +=
        "*hills* is the scene as it is. *level* is the same with all its ground at height zero, from views that were "
        "baked, seen from 200 km, where waves are as good as plane, as a bake takes them to be. What was baked on "
        "level "
        "ground is rendered on both.\n\n";
  }
  text += noise_floor_text(report);
  return text +
         fmt::format(
             "All times are processor time, summed over all threads, on {}; what else the machine does is not "
             "in them, and the wall clock shows less where several threads share the work. The time of a bake is "
             "that of its textures: the ground kept apart and the heights of what stands on it, made once for all "
             "looks, are not in it. The time of a map is that of one rendered by itself, from the atlas in memory to "
             "powers in range and azimuth; the paper's method goes over what terrain there is behind the square as "
             "well, ours ends with the square. Live frames, pose "
             "after pose from an atlas that stays open, have a renderer and times of their own: {}.\n\n",
             report.machine, report.links.to("live frames", "docs/live.md"));
}

}  // namespace sigmascape::cli
