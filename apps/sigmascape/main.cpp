#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include "command.h"
#include "standard_error.h"

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/product/software.h"

namespace sigmascape::cli {
namespace {

/// "bake", "atlas info", or the program's own name.
std::string words_of(const CLI::App& command) {
  const CLI::App* above = command.get_parent();
  if (above == nullptr) return "sigmascape";
  return above->get_parent() == nullptr ? command.get_name() : words_of(*above) + " " + command.get_name();
}

/// CLI11 tells of a list that is not of numbers "Could not convert: NAME = WORDS" and no more.
std::string as_told(const CLI::ConversionError& wrong_word) {
  const std::string_view said = wrong_word.what(), before = "Could not convert: ", between = " = ";
  const std::size_t end = said.find(between);
  if (!said.starts_with(before) || end == std::string_view::npos) return std::string(said) + "\n";
  return fmt::format("{}: is {}; give numbers, as --help shows them\n", said.substr(before.size(), end - before.size()),
                     said.substr(end + between.size()));
}

[[noreturn]] void refuse(std::string_view word, const std::string& what, const std::vector<std::string>& known,
                         const std::string& otherwise) {
  const auto nearest = nearest_word(word, known);
  throw CLI::ParseError(
      fmt::format("{}: {}; {}", word, what, nearest ? fmt::format("did you mean {}?", *nearest) : otherwise),
      CLI::ExitCodes::ExtrasError);
}

/// The command, and the command under it, that the line names: the last word of theirs is at `last`, 0 for none.
struct NamedCommand {
  const CLI::App* command;
  int last;
};

/// CLI11 would only say that a command is required.
NamedCommand named_command(const CLI::App& app, int argc, char** argv) {
  NamedCommand named{&app, 0};
  for (int i = 1; i < argc && *argv[i] != '-'; ++i) {
    const std::vector<const CLI::App*> under = named.command->get_subcommands(nullptr);
    if (under.empty()) break;
    const auto found = std::ranges::find(under, argv[i], &CLI::App::get_name);
    if (found == under.end()) {
      std::vector<std::string> names;
      for (const CLI::App* command : under) names.push_back(command->get_name());
      const bool is_root = named.command == &app;
      refuse(argv[i], is_root ? "is no command" : "is no command of " + words_of(*named.command), names,
             fmt::format("choose among {}", fmt::join(names, ", ")));
    }
    named = {*found, i};
  }
  return named;
}

/// CLI11 would list what it did not expect from its end, and before that ask for what a misspelled option was to be.
void refuse_unknown_options(const NamedCommand& named, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : named.command->get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& name : option->get_snames()) known.push_back("-" + name);
  }
  for (int i = named.last + 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--") return;  // what stands behind is no option
    // Numbers may be negative.
    const bool is_option =
        word.size() > 1 && word[0] == '-' && (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
    const std::string_view name = word.substr(0, word.find('='));
    if (!is_option || std::ranges::find(known, name) != known.end()) continue;
    refuse(name, "is no option of " + words_of(*named.command), known, "choose among those that --help tells");
  }
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

/// CLI11 passes over what stands between two delimiters with nothing between them.
void refuse_empty_items(const NamedCommand& named, int argc, char** argv) {
  for (int i = named.last + 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--") return;  // what stands behind is no option
    const std::size_t equals = word.find('=');
    const std::string name(word.substr(0, equals));
    const CLI::Option* const option = name.starts_with("--") ? named.command->get_option_no_throw(name) : nullptr;
    if (option == nullptr || option->get_delimiter() == '\0') continue;
    const bool has_own_word = equals == std::string_view::npos;
    if (has_own_word && i + 1 == argc) continue;
    const std::string_view list = has_own_word ? std::string_view(argv[i + 1]) : word.substr(equals + 1);
    const char between = option->get_delimiter();
    if (!list.starts_with(between) && !list.ends_with(between) && list.find(std::string(2, between)) == list.npos)
      continue;
    throw CLI::ParseError(fmt::format("{}: has an empty item in {}; put one comma between two", name, list),
                          CLI::ExitCodes::ValidationError);
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
    const NamedCommand named = named_command(app, argc, argv);
    refuse_unknown_options(named, argc, argv);
    refuse_empty_items(named, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& ended) {
    return ended.get_exit_code();
  } catch (const CLI::ConversionError& wrong_word) {
    say(as_told(wrong_word));
    return 2;
  } catch (const CLI::ParseError& wrong_use) {
    std::ostringstream said;
    const int code = app.exit(wrong_use, std::cout, said) == 0 ? 0 : 2;
    say(said.str());
    return code;
  }
  return 0;
}

}  // namespace
}  // namespace sigmascape::cli

namespace {

/// The first process of a container is spared signals that it does not handle: an eviction would wait for its end in
/// vain. It ends by them here as any other process does, with the code that a shell gives for that.
void end_by_signals_as_first_process() {
  if (::getpid() != 1) return;
  for (const int signal : {SIGTERM, SIGINT, SIGHUP})
    static_cast<void>(std::signal(signal, [](int by) { std::_Exit(128 + by); }));
}

/// A stream that was closed before the start leaves its number to the first file that is opened: a warning would go
/// into a map. What is written under a number that is held for reading fails, as it does on a closed stream.
void hold_numbers_of_closed_streams() {
  int held = ::open("/dev/null", O_RDONLY);
  while (held >= 0 && held <= STDERR_FILENO) held = ::open("/dev/null", O_RDONLY);
  if (held >= 0) ::close(held);
}

}  // namespace

int main(int argc, char** argv) {
  hold_numbers_of_closed_streams();
  end_by_signals_as_first_process();
  // A file that may not grow further is told of by the failed write, as a full disk is, and not by the end of this.
  static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
  try {
    const int code = sigmascape::cli::run(argc, argv);
    sigmascape::cli::flush_standard_output();  // of help, which CLI11 prints
    return code;
  } catch (const std::bad_alloc&) {
    sigmascape::cli::say(
        "sigmascape: memory: there is not enough of it; ask for a smaller area, coarser cells, a shorter interval or "
        "fewer threads\n");
    return 1;
  } catch (const std::exception& failure) {
    for (const char* part : {"sigmascape: ", failure.what(), "\n"}) sigmascape::cli::say(part);
    return 1;
  }
}
