#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sigmascape::cli {

// CLI11 behind a header that is read quickly: its own takes ten seconds in every file that includes it
// (docs/decisions/0143-cli11-is-compiled-once.md). Names are those that CLI11 gives the same things.

/// What is wrong with a word of the command line; empty when nothing is.
struct Validator {
  std::function<std::string(const std::string& word)> fault;
  std::string description;  ///< of what is right, for the help
};

/// Takes the words of a list alone.
[[nodiscard]] Validator one_of(const std::vector<std::string>& words);

/// An option of a command. A handle: copies speak of the same option.
class Option {
 public:
  explicit Option(CLI::Option& of) : of_(&of) {}

  // Each returns the option itself.
  Option required() const;
  /// Shows what the variable holds now as default, or this text.
  Option capture_default_str() const;
  Option default_str(const std::string& text) const;
  Option check(const Validator& validator) const;
  /// Between the values of a word. A list is one word.
  Option delimiter(char between) const;
  /// So many values.
  Option expected(int values) const;
  Option type_name(const std::string& name) const;
  Option needs(const Option& other) const;
  template <typename... Others>
  Option excludes(const Others&... others) const {
    (exclude(others), ...);
    return *this;
  }

  /// Whether the command line has it, once it is parsed.
  [[nodiscard]] bool is_given() const;

 private:
  void exclude(const Option& other) const;

  CLI::Option* of_;
};

/// A command, or the program itself. A handle as well.
class Command {
 public:
  explicit Command(CLI::App& of) : of_(&of) {}

  [[nodiscard]] Command add_subcommand(const std::string& name, const std::string& description) const;
  /// That many of its commands must be named.
  void require_subcommand(int count) const;
  /// An option, `--name`, or what stands by itself, `NAME`, that sets the variable. The kinds of variables it takes are
  /// at the end of command_parser.cpp: another one is added there.
  template <typename Variable>
  Option add_option(const std::string& name, Variable& variable, const std::string& description = {}) const;
  /// The same that hands over its word.
  Option add_option_function(const std::string& name, const std::function<void(const std::string& word)>& take,
                             const std::string& description) const;
  Option add_flag(const std::string& name, bool& variable, const std::string& description) const;
  /// What is done when the command line has been understood.
  void callback(const std::function<void()>& work) const;
  void footer(const std::string& text) const;

 private:
  CLI::App* of_;
};

/// Ends the program with this code, with nothing more said.
[[noreturn]] void end_with(int code);

}  // namespace sigmascape::cli
