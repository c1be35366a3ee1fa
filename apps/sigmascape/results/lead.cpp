#include "results/lead.h"

#include <fmt/format.h>

#include "results/columns.h"
#include "results/combinations.h"

#include "sigmascape/product/software.h"

namespace sigmascape::cli {
namespace {

struct Sibling {
  const char* words;
  const char* page;
};

/// The pages that `make results` writes.
constexpr Sibling siblings[] = {{"the paper's scene", "docs/results/README.md"},
                                {"the same of real materials", "docs/results/itu/README.md"},
                                {"Bilbao", "docs/results/bilbao/README.md"},
                                {"San Francisco", "docs/results/san_francisco/README.md"}};

std::string other_pages(const PageLinks& links) {
  std::string text;
  for (const Sibling& sibling : siblings) {
    if (links.is_own(sibling.page)) continue;
    text += (text.empty() ? "Other pages: " : ", ") + links.to(sibling.words, sibling.page);
  }
  return text + ".\n\n";
}

bool has_the_papers_materials(const ResultsPlan& plan) {
  return plan.materials == scene::PaperMaterials::Paper;
}

std::string scene_title(const ResultsReport& report) {
  if (!report.plan.scene_file.empty()) return report.scene;
  return has_the_papers_materials(report.plan) ? "the paper's scene" : "the paper's scene of real materials";
}

std::string scene_in_words(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  if (plan.scene_file.empty()) {
    return fmt::format("the paper's scene, made up, at scale {:g} ({:.0f} m a side), with {} materials", plan.scale,
                       plan.side_m(),
                       has_the_papers_materials(plan) ? "the paper's" : "real buildings' (ITU-R P.2040)");
  }
  if (plan.around_m == Vec2d{}) return fmt::format("the middle {:.0f} m of {}", plan.side_m(), report.scene);
  return fmt::format("{:.0f} m of {}, whose middle lies {:g} m east and {:g} m north of its own", plan.side_m(),
                     report.scene, plan.around_m.x, plan.around_m.y);
}

std::string words(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const PageLinks& links = report.links;
  std::string text = "The words of this page:\n\n";
  text += fmt::format(
      "- a **look** is a direction, azimuth and elevation, that a texture is baked for, {0} are 8 azimuths at 5 "
      "elevations each; a **texel** a cell of a texture on the ground, {1:.2f} m wide; **LOD** the level of detail: 1 "
      "reads the finest texels, each next one texels twice as wide\n",
      plan.paper_grid().name(), plan.texel_m);
  text +=
      "- **σ0** is the radar cross-section of a square metre of the map, **ψ** the angle of the line of sight above "
      "the "
      "horizontal, **γ** = σ0 / sin ψ\n"
      "- views are **on grid**, exactly at a look that was baked, **held out**, drawn at random, or the **Figure 8 "
      "view**, that of the paper's picture; the **own look** of a view is one baked for it, so that no angle is "
      "missing\n";
  text += fmt::format(
      "- **correlation** and **RMS** are of the dB of σ0, cell by cell; **bias** is that of total power; **relative "
      "L1** the sum of absolute differences of σ0 over the sum of the truth's; **shadow IoU** the cells that are in "
      "shadow in both maps over those in either, of the views whose traced maps have {} or more of them; a dash where "
      "none has\n",
      product::least_shadow_cells);
  text += fmt::format(
      "- **paper** is the method of the paper {}; its store is counted as the paper counts, four floats a texel and "
      "look\n",
      links.to("to the letter", "docs/decisions/0050-the-paper-literally.md"));
  text += fmt::format("- **ours, shadows baked**: echoes straight into texels, {}, half floats, compressed\n",
                      links.to("γ blended over cot ψ", "docs/decisions/0005-blend-gamma.md"));
  text += fmt::format("- **ours, on level ground**: {}, its shadows made at run time; its bytes include the ground\n",
                      links.to("the ground apart from what stands on it", "docs/decisions/0006-ground-apart.md"));
  text += fmt::format(
      "- **ours, on its own ground**: the same, and {}. Shadows and footing are what `sigmascape bake` takes by "
      "default; its rays are not: they {}, here they are as many for every texel\n\n",
      links.to("objects baked on the terrain that they stand on", "docs/decisions/0051-baked-on-its-own-ground.md"),
      links.to("go where the noise is", "docs/decisions/0097-rays-where-the-noise-is.md"));
  return text;
}

/// How well two traced maps agree, and what that leaves a baked map to reach.
std::string noise_floor_text(const ResultsReport& report) {
  std::string text = fmt::format(
      "The rows *truth* hold one traced map against another that differs in its seed alone: the noise floor. Baked "
      "maps are held against the mean of the two, whose noise has half the variance of either's. Where two differ by "
      "σ√2, their mean is off by σ/√2, so that a map without fault or noise of its own still shows half of the RMS "
      "and of the relative L1 in the row *truth*, and cannot be shown to show less, and a correlation of √(2ρ/(1 + "
      "ρ)) for the ρ there. ");
  for (const ViewKind kind : {ViewKind::OnGrid, ViewKind::HeldOut}) {
    const product::CellComparison* floor = noise_floor(report.plan, report.rows, report.plan.scene_name(), kind);
    if (floor == nullptr) continue;
    const ResultsRow& row = *baseline_row(report.plan, report.rows, report.plan.scene_name(), kind);
    text += fmt::format(
        "At {:.0f} m cells of {} views these are {} dB, {} and {}; at {} of {} views ρ is {:g} or more. ",
        summary_cell_m, kind == ViewKind::OnGrid ? "on-grid" : "held-out", number_text(least_error(floor->rms_db), 2),
        number_text(least_error(floor->l1), 3), number_text(most_correlation(floor->correlation_db), 3),
        row.agreeing_views, row.views, least_agreement);
  }
  return text + "\n\n";
}

}  // namespace

std::string results_lead(const ResultsReport& report) {
  std::string text = fmt::format(
      "# How close the baked map is: {}\n\n"
      "Ground maps of {}, rendered from terrain and baked reflectivity and held against path-traced maps of the full "
      "scene. *The paper* is R. Visina, J. Bergin, D. Kirk and P. Skangos, *LOD and Texture Mapping for Real-Time "
      "Radar Ground Map Simulation*: its method is measured beside ours. {}",
      scene_title(report), scene_in_words(report), other_pages(report.links));
  if (!report.attribution.empty()) text += "Data: " + report.attribution + "\n\n";
  return text + verdict(report.plan, report.rows) + combinations_table(report.plan, report.rows) + words(report);
}

std::string how_it_was_measured(const ResultsReport& report) {
  const ResultsPlan& plan = report.plan;
  const product::CompareOptions compare;
  std::string text = fmt::format(
      "## How it was measured\n\nBy {}:\n\n```\n{}\n```\n\n"
      "Numbers are medians over the views, in brackets the worst value of each number by itself, so that those of one "
      "row may be of several views. Sum of polarizations VV + HH + 2·HV; dB of σ0 no lower than {:g} dB; a cell is in "
      "shadow below {:g} dB. `product/map_metrics.h` defines the five numbers.\n\n"
      "The radar stands 20 km from the middle of the scene, resolution 2 m in range and across. A rim of {:.0f} m "
      "along the edges is left out, where what lies beyond has a part: {}.\n\n",
      product::software_name(), report.command_line, compare.floor_db, compare.shadow_db, plan.rim_m(),
      plan.scene_file.empty() ? "ground that goes on level for 300 m and has nothing on it"
                              : "the place goes on there with all that stands on it");
  if (plan.has_level_ground()) {
    text +=
        "*hills* is the scene as it is; *level* the same with its ground at height zero, at views that were baked and "
        "from ten times as far away, where waves are as good as plane. What is baked on level ground serves both.\n\n";
  }
  text += noise_floor_text(report);
  return text + fmt::format(
                    "All times are of the processor, all threads together, seconds of bakes and traced maps and "
                    "milliseconds of "
                    "frames, by {}: what other work takes on the machine is not in them, and on the wall several "
                    "threads share them. A frame here is one map rendered by itself, from the atlas in memory to a map "
                    "of the ground. Live frames, pose after pose from an atlas that stays open, have a renderer and "
                    "times of their own: {}.\n\n",
                    report.machine, report.links.to("live frames", "docs/live.md"));
}

}  // namespace sigmascape::cli
