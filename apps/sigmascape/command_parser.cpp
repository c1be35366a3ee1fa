#include "command_parser.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <type_traits>

namespace sigmascape::cli {

Validator one_of(const std::vector<std::string>& words) {
  return {[words](const std::string& word) {
            if (std::ranges::find(words, word) != words.end()) return std::string();
            return fmt::format("is {}; choose among {}", word, fmt::join(words, ", "));
          },
          fmt::format("{{{}}}", fmt::join(words, ","))};
}

Option Option::required() const {
  of_->required();
  return *this;
}

Option Option::capture_default_str() const {
  of_->capture_default_str();
  return *this;
}

Option Option::default_str(const std::string& text) const {
  of_->default_str(text);
  return *this;
}

Option Option::check(const Validator& validator) const {
  of_->check(
      CLI::Validator([fault = validator.fault](std::string& word) { return fault(word); }, validator.description));
  return *this;
}

Option Option::delimiter(char between) const {
  of_->delimiter(between);
  // A vector would take all words that follow, those that stand by themselves too.
  of_->allow_extra_args(false);
  // Its own help has blanks between.
  of_->option_text(fmt::format("{0}[{1}{0}...]", of_->get_type_name(), between));
  return *this;
}

Option Option::expected(int values) const {
  of_->expected(values);
  return *this;
}

Option Option::type_name(const std::string& name) const {
  of_->type_name(name);
  return *this;
}

Option Option::needs(const Option& other) const {
  of_->needs(other.of_);
  return *this;
}

void Option::exclude(const Option& other) const {
  of_->excludes(other.of_);
}

bool Option::is_given() const {
  return of_->count() > 0;
}

Command Command::add_subcommand(const std::string& name, const std::string& description) const {
  return Command(*of_->add_subcommand(name, description));
}

void Command::require_subcommand(int count) const {
  of_->require_subcommand(count);
}

namespace {

template <typename Variable>
constexpr bool is_whole_number = std::is_integral_v<Variable>;
template <typename Number>
constexpr bool is_whole_number<std::optional<Number>> = std::is_integral_v<Number>;

/// "010" as "10": CLI11 would take it for octal.
std::string without_leading_zeros(std::string& word) {
  const std::size_t first = word.find_first_not_of('0');
  if (first == std::string::npos) {
    word = "0";
  } else if (std::isdigit(static_cast<unsigned char>(word[first])) != 0) {
    word.erase(0, first);
  }
  return {};
}

}  // namespace

template <typename Variable>
Option Command::add_option(const std::string& name, Variable& variable, const std::string& description) const {
  CLI::Option* const option = of_->add_option(name, variable, description);
  if constexpr (is_whole_number<Variable>) option->transform(CLI::Validator(without_leading_zeros, ""));
  return Option(*option);
}

Option Command::add_option_function(const std::string& name, const std::function<void(const std::string&)>& take,
                                    const std::string& description) const {
  return Option(*of_->add_option_function<std::string>(name, take, description));
}

Option Command::add_flag(const std::string& name, bool& variable, const std::string& description) const {
  return Option(*of_->add_flag(name, variable, description));
}

void Command::callback(const std::function<void()>& work) const {
  of_->callback(work);
}

void Command::footer(const std::string& text) const {
  of_->footer(text);
}

void end_with(int code) {
  throw CLI::RuntimeError(code);
}

template Option Command::add_option(const std::string&, std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, std::filesystem::path&, const std::string&) const;
template Option Command::add_option(const std::string&, double&, const std::string&) const;
template Option Command::add_option(const std::string&, int&, const std::string&) const;
template Option Command::add_option(const std::string&, std::uint32_t&, const std::string&) const;
template Option Command::add_option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<std::uint32_t>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::array<double, 2>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<double>&, const std::string&) const;

}  // namespace sigmascape::cli
