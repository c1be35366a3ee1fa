#include <fmt/format.h>

#include "command.h"
#include "received_files.h"
#include "scene_warnings.h"
#include "shard_option.h"
#include "stopwatch.h"
#include "terminal_progress.h"
#include "threads_option.h"
#include "words.h"

#include "sigmascape/bake/shard.h"
#include "sigmascape/dataset/dataset_run.h"
#include "sigmascape/dataset/dataset_warnings.h"

namespace sigmascape::cli {

void add_dataset_command(Command app, Output& output) {
  const auto command = app.add_subcommand("dataset", "Make labelled radar images of a scene by the thousand");
  struct Options {
    std::string spec, folder, shard = "0/1";
    unsigned threads = 0;
  };
  auto options = std::make_shared<Options>();
  command.add_option("SPEC", options->spec, "dataset file (TOML)").required();
  command.add_option("--out", options->folder, "folder to fill; a run that was broken off goes on there").required();
  add_shard_option(command, options->shard, "make");
  add_threads_option(command, options->threads);
  command.add_flag("--json", output.json, "print the summary as JSON");
  command.footer(
      "Examples:\n"
      "  sigmascape dataset examples/datasets/san_francisco.toml --out out/san_francisco_samples\n"
      "  sigmascape dataset spec.toml --out /shared/samples --shard 2/8     (see docs/datasets.md)");
  command.callback([options, &output] {
    const bake::Shard shard = bake::shard_from(options->shard);
    const dataset::SampleMaker maker(dataset::read_dataset_spec(options->spec));
    const scene::Scene& scene = maker.scene();
    warn_of_scene(scene);
    warn_of(maker.spec().radar.radar, dataset::dataset_warnings(maker.spec(), scene.terrain, scene.extent));
    TerminalProgress progress;
    const Stopwatch watch;
    const auto report =
        dataset::make_dataset(maker, options->folder, {shard.index, shard.count, options->threads}, progress);
    const double seconds = watch.seconds();
    const std::size_t made = report.samples - report.already;
    const double rate = seconds > 0.0 ? static_cast<double>(made) / seconds : 0.0;
    output.finish(fmt::format("{} in {} ({} already there), {:.1f} s, {:.1f} a second{}",
                              counted(report.samples, "sample", "samples"), options->folder, report.already, seconds,
                              rate, report.is_complete ? "" : "; other shares are still lacking"),
                  {{"dataset", options->folder},
                   {"samples", report.samples},
                   {"already", report.already},
                   {"complete", report.is_complete},
                   {"seconds", seconds},
                   {"samples_per_second", rate}});
  });
}

}  // namespace sigmascape::cli
