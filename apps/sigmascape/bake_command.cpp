#include <fmt/format.h>

#include "bake_options.h"
#include "command.h"
#include "progress_log.h"
#include "stopwatch.h"
#include "terminal_progress.h"
#include "words.h"

#include "sigmascape/bake/plan.h"
#include "sigmascape/scene/scene_file.h"

namespace sigmascape::cli {
namespace {

std::string text_of(const bake::BakeReport& report, const std::string& folder, double seconds) {
  std::string text = fmt::format("{} looks in {} ({} were there already", report.looks, folder, report.already);
  if (report.elsewhere > 0) text += fmt::format(", {} baked by another process", report.elsewhere);
  text += fmt::format("), {:.1f} s, {:.1f} million rays, texel error {:.0f} %", seconds,
                      static_cast<double>(report.counts.rays) / 1e6, 100.0 * report.relative_standard_error);
  if (report.pyramid > 0) text += fmt::format(", {} textures of the pyramid", report.pyramid);
  return text;
}

nlohmann::ordered_json summary_of(const bake::BakeReport& report, const bake::Shard& shard, const std::string& folder,
                                  double seconds) {
  return {{"atlas", folder},
          {"shard", {shard.index, shard.count}},
          {"looks", report.looks},
          {"already", report.already},
          {"elsewhere", report.elsewhere},
          {"pyramid", report.pyramid},
          {"seconds", seconds},
          {"paths", report.counts.paths},
          {"rays", report.counts.rays},
          {"echoes", report.counts.echoes},
          {"relative_standard_error", report.relative_standard_error}};
}

void show_plan(const bake::BakePlan& plan, const Output& output) {
  const std::size_t left = plan.looks - plan.already;
  output.finish(
      fmt::format("{} patches, {} jobs of a patch and an aspect each\n"
                  "{} looks to bake, {} are there already\n"
                  "{:.1f} million cells to send rays to, gutters around the patches included\n"
                  "about {} on this machine, about {} for the textures of the whole atlas and their standard errors\n"
                  "(from {} looks at a piece of 256 x 256 texels in the middle, baked in {})",
                  plan.patches, plan.jobs, left, plan.already, plan.cells / 1e6, duration_text(plan.seconds),
                  size_text(plan.bytes), plan.probe_looks, duration_text(plan.probe_seconds)),
      {{"patches", plan.patches},
       {"jobs", plan.jobs},
       {"looks", plan.looks},
       {"already", plan.already},
       {"cells", plan.cells},
       {"seconds", plan.seconds},
       {"bytes", plan.bytes},
       {"probe_looks", plan.probe_looks},
       {"probe_seconds", plan.probe_seconds}});
}

}  // namespace

void add_bake_command(CLI::App& app, Output& output) {
  auto* command = app.add_subcommand("bake", "Path-trace a scene into an atlas of reflectivity textures");
  struct Options {
    std::string scene, folder, log, shard = "0/1";
    bool verify = false, plan = false;
    BakeOptions bake;
  };
  auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("--out", options->folder, "folder of the atlas; a bake that was broken off goes on there")
      ->required();
  options->bake.add_to(*command);
  command
      ->add_option("--shard", options->shard,
                   "bake one of several equal shares, counted from 0: 2/8 is the third of eight")
      ->capture_default_str();
  command->add_flag("--verify", options->verify,
                    "compare the SHA-256 of looks that are there already, and bake altered ones again");
  command->add_flag("--plan", options->plan,
                    "write nothing; bake a small piece at each elevation and tell what the whole would take");
  command->add_option("--json-log", options->log, "add progress to this file, a JSON object a line");
  command->add_flag("--json", output.json, "print the summary as JSON");
  command->footer(
      "Examples:\n"
      "  sigmascape bake examples/bilbao/bilbao.toml --out out/bilbao_atlas --samples 16\n"
      "  sigmascape bake town.toml --out atlas --azimuths 16 --elevations-deg 3,5,8,13,21,34\n"
      "  sigmascape bake town.toml --out /shared/atlas --shard 2/8     (see docs/clusters.md)");
  command->callback([options, &output] {
    const bake::BakeShare share{bake::shard_from(options->shard),
                                options->verify ? atlas::Scrutiny::Content : atlas::Scrutiny::Size};
    const scene::Scene scene = scene::read_scene(options->scene);
    if (options->plan)
      return show_plan(bake::plan(scene, options->bake.settings(), options->folder, share.shard), output);
    TerminalProgress terminal;
    const Stopwatch watch;
    const bake::BakeReport report = [&] {
      const bake::BakeSettings settings = options->bake.settings();
      if (options->log.empty()) return bake::bake(scene, settings, options->folder, terminal, share);
      ProgressLog log(options->log);
      ProgressToTwo both(terminal, log);
      return bake::bake(scene, settings, options->folder, both, share);
    }();
    output.finish(text_of(report, options->folder, watch.seconds()),
                  summary_of(report, share.shard, options->folder, watch.seconds()));
  });
}

}  // namespace sigmascape::cli
