#include <algorithm>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <new>

#include "command.h"

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/product/software.h"

namespace sigmascape::cli {

void Output::finish(const std::string& text, const nlohmann::ordered_json& summary) const {
  fmt::print("{}\n", json ? summary.dump(2) : text);
}

namespace {

/// CLI11 would only say that a command is required.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || *argv[1] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, argv[1]) != names.end()) return;
  const auto nearest = nearest_word(argv[1], names);
  const std::string remedy =
      nearest ? fmt::format("did you mean {}?", *nearest) : fmt::format("choose among {}", fmt::join(names, ", "));
  throw CLI::ParseError(fmt::format("{}: is no command; {}", argv[1], remedy), CLI::ExitCodes::ExtrasError);
}

/// Does what the command line asks; 2 when it is not understood.
int run(int argc, char** argv) {
  CLI::App app{
      "Sigmascape: what a radar sees of a landscape.\n"
      "Path-traces a scene at radio frequencies, bakes it into reflectivity textures, and renders ground maps from "
      "either."};
  app.require_subcommand(1);
  app.set_version_flag("--version", product::software_version());
  Output output;
  add_scene_command(app, output);
  add_bake_command(app, output);
  add_atlas_command(app, output);
  add_render_command(app, output);
  add_dataset_command(app, output);
  add_compare_command(app, output);
  add_plot_command(app, output);
  add_demo_command(app, output);
  add_results_command(app, output);
  try {
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& ended) {
    return ended.get_exit_code();
  } catch (const CLI::ParseError& wrong_use) {
    return app.exit(wrong_use) == 0 ? 0 : 2;
  }
  return 0;
}

}  // namespace
}  // namespace sigmascape::cli

int main(int argc, char** argv) {
  try {
    return sigmascape::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs(
        "sigmascape: memory: there is not enough of it; ask for a smaller area, coarser cells, a shorter interval or "
        "fewer threads\n",
        stderr);
    return 1;
  } catch (const std::exception& failure) {
    std::fputs("sigmascape: ", stderr);
    std::fputs(failure.what(), stderr);
    std::fputs("\n", stderr);
    return 1;
  }
}
