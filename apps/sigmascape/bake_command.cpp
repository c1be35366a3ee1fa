#include <fmt/format.h>

#include "bake_options.h"
#include "command.h"
#include "stopwatch.h"
#include "terminal_progress.h"

#include "sigmascape/scene/scene_file.h"

namespace sigmascape::cli {

void add_bake_command(CLI::App& app, Output& output) {
  auto* command = app.add_subcommand("bake", "Path-trace a scene into an atlas of reflectivity textures");
  struct Options {
    std::string scene, folder;
    BakeOptions bake;
  };
  auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("--out", options->folder, "folder of the atlas; a bake that was broken off goes on there")
      ->required();
  options->bake.add_to(*command);
  command->add_flag("--json", output.json, "print the summary as JSON");
  command->footer(
      "Examples:\n"
      "  sigmascape bake examples/bilbao/bilbao.toml --out out/bilbao_atlas --samples 16\n"
      "  sigmascape bake town.toml --out atlas --azimuths 16 --elevations-deg 3,5,8,13,21,34");
  command->callback([options, &output] {
    const scene::Scene scene = scene::read_scene(options->scene);
    TerminalProgress progress;
    const Stopwatch watch;
    const bake::BakeReport report = bake::bake(scene, options->bake.settings(), options->folder, progress);
    const double seconds = watch.seconds();
    output.finish(
        fmt::format("{} looks in {} ({} were there already), {:.1f} s, {:.1f} million rays, texel error {:.0f} %",
                    report.looks, options->folder, report.already, seconds,
                    static_cast<double>(report.counts.rays) / 1e6, 100.0 * report.relative_standard_error),
        {{"atlas", options->folder},
         {"looks", report.looks},
         {"already", report.already},
         {"seconds", seconds},
         {"paths", report.counts.paths},
         {"rays", report.counts.rays},
         {"echoes", report.counts.echoes},
         {"relative_standard_error", report.relative_standard_error}});
  });
}

}  // namespace sigmascape::cli
