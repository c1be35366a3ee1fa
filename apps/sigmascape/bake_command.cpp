#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <system_error>

#include "bake_options.h"
#include "command.h"
#include "files_to_write.h"
#include "number_or_null.h"
#include "power_error_text.h"
#include "progress_log.h"
#include "scene_warnings.h"
#include "shard_option.h"
#include "stopwatch.h"
#include "terminal_progress.h"
#include "words.h"

#include "sigmascape/bake/bake.h"
#include "sigmascape/bake/plan.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/base/toml_reader.h"
#include "sigmascape/scene/scene_file.h"

namespace sigmascape::cli {
namespace {

/// What a bake came to, as its summary tells it.
struct Baked {
  std::string folder;
  bake::Shard shard;
  bake::BakeReport report;
  double seconds = 0.0;
};

std::string text_of(const Baked& baked) {
  const bake::BakeReport& report = baked.report;
  std::string text;
  for (const atlas::StoreFault& fault : report.mended)
    text += fmt::format("{} {}; made anew\n", fault.file.string(), fault.what);
  text +=
      fmt::format("{} in {} ({} already there", counted(report.looks, "look", "looks"), baked.folder, report.already);
  if (report.elsewhere > 0) text += fmt::format(", {} baked by another process", report.elsewhere);
  text += fmt::format("), {:.1f} s", baked.seconds);
  if (report.looks > report.already + report.elsewhere) {
    text += fmt::format(", {:.1f} million rays; error of what was baked now: {}",
                        static_cast<double>(report.counts.rays) / 1e6, error_text(report.errors));
    const std::string above_target = above_target_text(report.errors);
    if (!above_target.empty()) text += ", " + above_target;
  }
  if (report.pyramid > 0)
    text += fmt::format("; {} of looks above the patches", counted(report.pyramid, "file", "files"));
  return text;
}

nlohmann::ordered_json json_of(const Baked& baked) {
  const bake::BakeReport& report = baked.report;
  nlohmann::ordered_json mended = nlohmann::ordered_json::array();
  for (const atlas::StoreFault& fault : report.mended)
    mended.push_back({{"file", fault.file.string()}, {"fault", fault.what}});
  return {{"atlas", baked.folder},
          {"shard", {baked.shard.index, baked.shard.count}},
          {"looks", report.looks},
          {"already", report.already},
          {"mended", mended},
          {"elsewhere", report.elsewhere},
          {"pyramid", report.pyramid},
          {"seconds", baked.seconds},
          {"paths", report.counts.paths},
          {"rays", report.counts.rays},
          {"echoes", report.counts.echoes},
          {"relative_standard_error", number_or_null(report.errors.relative())},
          {"above_target", number_or_null(report.errors.part_above_target())},
          {"part_of_all", number_or_null(report.errors.part_of_all())}};
}

/// What an atlas holds besides the textures that a plan weighs.
const char* on_top_text(bake::Shadows shadows) {
  return shadows == bake::Shadows::RunTime ? "ground, obstacles and terrain come on top" : "the terrain comes on top";
}

std::string text_of(const bake::BakePlan& plan, bake::Shadows shadows) {
  const bool is_whole = plan.jobs_of_share == plan.jobs;
  std::string text = fmt::format("{}, {} of a patch and an aspect each", counted(plan.patches, "patch", "patches"),
                                 counted(plan.jobs, "job", "jobs"));
  if (!is_whole) {
    text += fmt::format(", {} of them in this share, {} of {}", plan.jobs_of_share,
                        plan.has_whole_patches ? "all" : "some", counted(plan.patches_of_share, "patch", "patches"));
  }
  text += fmt::format(
      "\n{} to bake, {} already there\n"
      "{:.1f} million cells to send rays to, gutters around the patches included\n"
      "about {} on this machine\n"
      "about {} for the textures of the whole atlas and their standard errors",
      counted(plan.looks - plan.already, "look", "looks"), plan.already, plan.cells / 1e6, duration_text(plan.seconds),
      size_text(plan.bytes));
  if (!is_whole) text += fmt::format(", {} of it from this share", size_text(plan.bytes_of_share));
  return text + fmt::format(
                    "; {}\n"
                    "(from {} at a piece of 256 x 256 texels in the middle, baked in {})",
                    on_top_text(shadows), counted(plan.probe_looks, "look", "looks"),
                    duration_text(plan.probe_seconds));
}

nlohmann::ordered_json json_of(const bake::BakePlan& plan) {
  return {{"patches", plan.patches},
          {"jobs", plan.jobs},
          {"jobs_of_share", plan.jobs_of_share},
          {"patches_of_share", plan.patches_of_share},
          {"has_whole_patches", plan.has_whole_patches},
          {"looks", plan.looks},
          {"already", plan.already},
          {"cells", plan.cells},
          {"jobs_counted", plan.jobs_counted},
          {"seconds", plan.seconds},
          {"bytes", plan.bytes},
          {"bytes_of_share", plan.bytes_of_share},
          {"probe_looks", plan.probe_looks},
          {"probe_seconds", plan.probe_seconds}};
}

/// That the log is none of the files that the bake reads, nor of those that it writes, all of them JSON or TIFF, which
/// may not be there yet.
void check_log(const std::string& log, const std::string& scene, const std::filesystem::path& folder) {
  std::error_code is_not_there;
  if (log.empty() || std::filesystem::is_other(log, is_not_there) || is_own_stream(log)) return;
  const std::string ending = file_ending(log);
  if ((ending == ".json" || ending == ".tif") && lies_in(log, folder)) {
    throw Error("--json-log", fmt::format("names {}, in the folder of --out and by a name as an atlas may have", log),
                "end it in .jsonl");
  }
  const std::array<NamedFile, 1> file{{{"--json-log", log}}};
  check_files_apart(file, TomlSection::read_file(scene).named_files());
}

}  // namespace

void add_bake_command(Command app, Output& output) {
  const auto command = app.add_subcommand("bake", "Path-trace a scene into an atlas of reflectivity textures");
  struct Options {
    std::string scene, folder, log, shard = "0/1";
    bool verify = false, plan = false;
    BakeOptions bake;
  };
  auto options = std::make_shared<Options>();
  command.add_option("SCENE", options->scene, "scene file (TOML)").required();
  command.add_option("--out", options->folder, "folder of the atlas; a bake that was broken off goes on there")
      .required();
  options->bake.add_to(command);
  add_shard_option(command, options->shard, "bake");
  const auto verify_option =
      command.add_flag("--verify", options->verify,
                       "compare the SHA-256 of looks that are there already; name altered ones and bake them again");
  const auto log_option = command.add_option(
      "--json-log", options->log, "add progress to this file, a new one or such a log, a JSON object a line");
  command
      .add_flag("--plan", options->plan,
                "write nothing; tell what the whole would take, from a look of a piece of 256 x 256 texels at every "
                "elevation, which is baked with all its rays: of a scene no larger it takes as long as one azimuth")
      .excludes(verify_option)
      .excludes(log_option);
  command.add_flag("--json", output.json, "print the summary as JSON");
  command.footer(
      "Examples:\n"
      "  sigmascape bake examples/bilbao/bilbao.toml --out out/bilbao_atlas --samples 16\n"
      "  sigmascape bake town.toml --out atlas --azimuths 16 --elevations-deg 3,5,8,13,21,34\n"
      "  sigmascape bake town.toml --out /shared/atlas --shard 2/8     (see docs/clusters.md)");
  command.callback([options, &output] {
    const bake::BakeShare share{bake::shard_from(options->shard),
                                options->verify ? atlas::Scrutiny::Content : atlas::Scrutiny::Size};
    const scene::Scene scene = scene::read_scene(options->scene);
    const bake::BakeSettings settings = options->bake.settings();
    bake::check(settings);
    check_log(options->log, options->scene, options->folder);
    warn_of_scene(scene);
    TerminalProgress terminal;
    if (options->plan) {
      const bake::BakePlan plan = bake::plan(scene, settings, options->folder, terminal, share.shard);
      return output.finish(text_of(plan, settings.shadows), json_of(plan));
    }
    Baked baked;
    baked.folder = options->folder;
    baked.shard = share.shard;
    const Stopwatch watch;
    bool is_logged = true;
    baked.report = [&] {
      if (options->log.empty()) return bake::bake(scene, settings, options->folder, terminal, share);
      ProgressLog log(options->log);
      ProgressToTwo both(terminal, log);
      const bake::BakeReport report = bake::bake(scene, settings, options->folder, both, share);
      is_logged = log.is_whole();
      return report;
    }();
    baked.seconds = watch.seconds();
    output.finish(text_of(baked), json_of(baked));
    if (!is_logged) {
      throw Error(options->log, "could not be written to its end; all that was to be baked is there",
                  "give --json-log a file on a disk that has room");
    }
  });
}

}  // namespace sigmascape::cli
