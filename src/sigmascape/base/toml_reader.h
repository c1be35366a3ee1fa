#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/base/error.h"

namespace sigmascape {

/// Numbers from `lowest` to `highest`, both allowed, in some unit.
struct Interval {
  double lowest = 0.0, highest = 0.0;
  std::string_view unit;
};

/// A table of a TOML file, read with its faults told.
///
/// Each question names a key and says what would be a right answer; a missing key, a wrong type or a value out of range
/// throws an Error that names file and key. Questions also make keys known: `refuse_unknown_keys`, called when all have
/// been asked, throws for any other, with the known key that it may have been meant to be.
class TomlSection {
 public:
  /// The root table of a file. Throws Error when the file is missing or cannot be read, or is not TOML, with the line.
  [[nodiscard]] static TomlSection read_file(const std::filesystem::path& file);
  /// The same of the text of a file, by whose name errors go and in whose folder the files that it names lie.
  [[nodiscard]] static TomlSection read_text(const std::string& text, const std::filesystem::path& file);

  /// File and full key, as errors name them: "bilbao.toml: terrain.spacing_m".
  [[nodiscard]] std::string where(std::string_view key) const;
  /// File and this table's own place in it.
  [[nodiscard]] std::string where() const;

  /// The TOML file and those that exist of what words of the table, whatever their keys, name as a file.
  [[nodiscard]] std::vector<std::filesystem::path> named_files() const;

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool is_table(std::string_view key) const;
  [[nodiscard]] bool is_list(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> keys() const;

  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> optional_text(std::string_view key) const;
  [[nodiscard]] std::string text_or(std::string_view key, std::string fallback) const;
  /// One of a few words.
  [[nodiscard]] std::string choice_or(std::string_view key, const std::vector<std::string>& choices,
                                      std::string fallback) const;

  [[nodiscard]] double number(std::string_view key, Interval allowed) const;
  [[nodiscard]] std::optional<double> optional_number(std::string_view key, Interval allowed) const;
  [[nodiscard]] double number_or(std::string_view key, Interval allowed, double fallback) const;
  [[nodiscard]] std::int64_t whole_number_or(std::string_view key, Interval allowed, std::int64_t fallback) const;
  [[nodiscard]] bool flag_or(std::string_view key, bool fallback) const;

  /// Empty when the key is absent.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key, Interval allowed) const;
  /// A list of pairs of finite numbers, empty when the key is absent.
  [[nodiscard]] std::vector<std::array<double, 2>> pairs(std::string_view key) const;

  /// An existing file, or one of a virtual path (base/virtual_path.h); see `expanded_path`.
  [[nodiscard]] std::filesystem::path file(std::string_view key) const;
  [[nodiscard]] std::optional<std::filesystem::path> optional_file(std::string_view key) const;

  [[nodiscard]] std::optional<TomlSection> section(std::string_view key) const;
  [[nodiscard]] TomlSection required_section(std::string_view key) const;
  /// The tables of an array of tables ([[buildings]]), in order; empty when the key is absent.
  [[nodiscard]] std::vector<TomlSection> sections(std::string_view key) const;

  void refuse_unknown_keys() const;

  /// An Error at one of this table's keys.
  [[nodiscard]] Error fault(std::string_view key, const std::string& what, const std::string& remedy) const;
  /// Of one that must be there and is not: names a key that has not been read and is spelt nearly so, if there is one.
  [[nodiscard]] Error missing(std::string_view key, const std::string& remedy) const;

 private:
  struct Table;
  explicit TomlSection(std::shared_ptr<Table> table) : table_(std::move(table)) {}
  std::shared_ptr<Table> table_;
};

/// The path with environment variables filled in, `${NAME}` or `${NAME:-what to use when it is not set}`, and relative
/// to `folder`. Throws Error at `where` when a variable is not set.
[[nodiscard]] std::filesystem::path expanded_path(std::string_view text, const std::filesystem::path& folder,
                                                  const std::string& where);

/// The word among `known` that `word` most likely was meant to be: at most a third of its letters differ.
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace sigmascape
