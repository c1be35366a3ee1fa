#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <new>
#include <string>
#include <string_view>

#include "command.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/toml_reader.h"
#include "sigmascape/product/software.h"

namespace sigmascape::cli {
namespace {

/// Throws Error when what was printed did not get to where it was to go.
void flush_standard_output() {
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::ferror(stdout) == 0) return;
  // When an earlier write failed, its reason is not known any more.
  const std::string reason = is_flushed ? "" : fmt::format(" ({})", std::strerror(errno));
  throw Error("standard output", "cannot be written" + reason, "send it to where there is room");
}

}  // namespace

void Output::finish(const std::string& text, const nlohmann::ordered_json& summary) const {
  // Names of files may be of any bytes, which JSON may not.
  const std::string written =
      json ? summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) : text;
  std::fputs((written + "\n").c_str(), stdout);
  flush_standard_output();
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

/// No option has a use for an empty value, and as the name of a folder it would be the one that the user stands in.
void refuse_empty_values(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const bool is_option_with_value = word.starts_with("--") && word.ends_with('=');
    if (!word.empty() && !is_option_with_value) continue;
    const std::string_view before = argv[i - 1];
    const std::string where = is_option_with_value      ? std::string(word.substr(0, word.size() - 1))
                              : before.starts_with('-') ? std::string(before)
                                                        : fmt::format("word {} of the command line", i);
    throw CLI::ParseError(fmt::format("{}: is empty; give a name or a value", where), CLI::ExitCodes::ValidationError);
  }
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
  add_scene_command(Command(app), output);
  add_bake_command(Command(app), output);
  add_atlas_command(Command(app), output);
  add_render_command(Command(app), output);
  add_dataset_command(Command(app), output);
  add_compare_command(Command(app), output);
  add_plot_command(Command(app), output);
  add_demo_command(Command(app), output);
  add_results_command(Command(app), output);
  try {
    refuse_empty_values(argc, argv);
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
  // A file that may not grow further is told of by the failed write, as a full disk is, and not by the end of this.
  static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
  try {
    const int code = sigmascape::cli::run(argc, argv);
    sigmascape::cli::flush_standard_output();  // of help, which CLI11 prints
    return code;
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
