#include "sigmascape/base/toml_reader.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <numeric>
#include <set>
#include <sstream>
#include <system_error>
#include <toml++/toml.h>

#include "sigmascape/base/virtual_path.h"

namespace sigmascape {
namespace {

/// Levenshtein's distance: insertions, deletions and replacements that lead from one word to the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (const char letter : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (letter == b[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// Of what was written, in an error.
constexpr std::size_t longest_quote = 200;

std::string as_written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  std::string words = text.str();
  if (words.size() <= longest_quote) return words;
  std::size_t end = longest_quote;
  while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xC0U) == 0x80U) --end;  // not within a letter
  return words.substr(0, end) + "…";
}

/// A number, whole ones beyond 2^53 to the nearest double: toml++ gives none of these as a double.
double number_in(const toml::node& number) {
  if (const auto whole = number.as_integer()) return static_cast<double>(whole->get());
  return *number.value<double>();
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.is_open() && !stream.bad()) return text;
  throw Error(file.string(), fmt::format("cannot be read ({})", std::strerror(errno)),
              "allow it to be read, or give the path of another file");
}

std::filesystem::file_type type_of(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::status(path, ignored).type();
}

/// What is amiss with a path that names no regular file.
std::string what_it_is(const std::filesystem::path& path) {
  std::error_code fault;
  switch (std::filesystem::status(path, fault).type()) {
    case std::filesystem::file_type::directory:
      return "is a folder";
    case std::filesystem::file_type::not_found:
      return "does not exist";
    case std::filesystem::file_type::none:
    case std::filesystem::file_type::unknown:
      return fmt::format("cannot be looked at ({})", fault.message());
    default:
      return "is no regular file, but a pipe or a device";
  }
}

/// The parser goes down by its own calls for each part of a key, and so does whatever looks at the tables then.
constexpr std::size_t most_key_parts = 256;

/// Throws Error when somewhere so many words with nothing but dots between them follow one another.
void refuse_endless_keys(const std::string& text, const std::filesystem::path& file) {
  std::size_t line = 1, parts = 1;
  for (const char letter : text) {
    if (letter == '\n') ++line;
    if (letter == '.') ++parts;
    const bool is_of_key = std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                           std::string_view("_-. \t\"'").find(letter) != std::string_view::npos;
    if (!is_of_key) parts = 1;
    if (parts > most_key_parts) {
      throw Error(fmt::format("{}:{}", file.string(), line),
                  fmt::format("holds a key of more than {} parts", most_key_parts), "correct that line");
    }
  }
}

std::string range_text(Interval allowed) {
  const std::string unit = allowed.unit.empty() ? "" : fmt::format(" {}", allowed.unit);
  return fmt::format("give a number from {:g} to {:g}{}", allowed.lowest, allowed.highest, unit);
}

}  // namespace

struct TomlSection::Table {
  std::shared_ptr<const toml::table> root;  ///< keeps the whole file alive
  const toml::table* table = nullptr;
  std::filesystem::path file;
  std::string place;  ///< "terrain", "buildings[2]", empty for the root
  std::set<std::string, std::less<>> known;
};

namespace {

const toml::node* find(const toml::table& table, std::string_view key) {
  return table.get(key);
}

}  // namespace

TomlSection TomlSection::read_file(const std::filesystem::path& file) {
  if (const auto type = type_of(file); type != std::filesystem::file_type::regular) {
    throw Error(file.empty() ? "name of a TOML file" : file.string(),
                file.empty()                                    ? "is empty"
                : type == std::filesystem::file_type::not_found ? "the file does not exist"
                                                                : what_it_is(file),
                "give the path of a TOML file");
  }
  // Read here: the parser tells of a file that it may not open as of one with a fault in line 0.
  return read_text(content_of(file), file);
}

TomlSection TomlSection::read_text(const std::string& text, const std::filesystem::path& file) {
  refuse_endless_keys(text, file);
  try {
    auto table = std::make_shared<Table>();
    table->root = std::make_shared<const toml::table>(toml::parse(text, file.string()));
    table->table = table->root.get();
    table->file = file;
    return TomlSection(table);
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("{}:{}", file.string(), error.source().begin.line),
                fmt::format("is not TOML ({})", error.description()), "correct that line");
  }
}

namespace {

void add_files_named_in(const toml::node& node, const std::filesystem::path& folder,
                        std::vector<std::filesystem::path>& files) {
  if (const auto* const table = node.as_table()) {
    for (const auto& [key, value] : *table) add_files_named_in(value, folder, files);
  } else if (const auto* const array = node.as_array()) {
    for (const toml::node& value : *array) add_files_named_in(value, folder, files);
  } else if (const auto word = node.value<std::string>()) {
    try {
      const std::filesystem::path path = expanded_path(*word, folder, "");
      std::error_code ignored;
      if (std::filesystem::is_regular_file(path, ignored)) files.push_back(path);
    } catch (const Error&) {  // names no file
    }
  }
}

}  // namespace

std::vector<std::filesystem::path> TomlSection::named_files() const {
  std::vector<std::filesystem::path> files{table_->file};
  add_files_named_in(*table_->table, table_->file.parent_path(), files);
  return files;
}

std::string TomlSection::where() const {
  return table_->place.empty() ? table_->file.string() : fmt::format("{}: {}", table_->file.string(), table_->place);
}

std::string TomlSection::where(std::string_view key) const {
  return fmt::format("{}: {}{}{}", table_->file.string(), table_->place, table_->place.empty() ? "" : ".", key);
}

Error TomlSection::fault(std::string_view key, const std::string& what, const std::string& remedy) const {
  return Error(where(key), what, remedy);
}

Error TomlSection::missing(std::string_view key, const std::string& remedy) const {
  for (const std::string& other : keys()) {
    if (!table_->known.contains(other) && nearest_word(other, {std::string(key)}))
      return fault(other, "is not a known key", fmt::format("did you mean {}?", key));
  }
  return fault(key, "is missing", remedy);
}

bool TomlSection::has(std::string_view key) const {
  table_->known.emplace(key);
  return find(*table_->table, key) != nullptr;
}

bool TomlSection::is_table(std::string_view key) const {
  return has(key) && find(*table_->table, key)->is_table();
}

bool TomlSection::is_list(std::string_view key) const {
  return has(key) && find(*table_->table, key)->is_array();
}

std::vector<std::string> TomlSection::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, value] : *table_->table) names.emplace_back(key.str());
  return names;
}

std::optional<std::string> TomlSection::optional_text(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const toml::node& node = *find(*table_->table, key);
  if (!node.is_string()) throw fault(key, fmt::format("is {}", as_written(node)), "give text in quotes");
  return node.value<std::string>();
}

std::string TomlSection::text(std::string_view key) const {
  if (auto value = optional_text(key)) return *value;
  throw missing(key, "add it");
}

std::string TomlSection::text_or(std::string_view key, std::string fallback) const {
  return optional_text(key).value_or(std::move(fallback));
}

std::string TomlSection::choice_or(std::string_view key, const std::vector<std::string>& choices,
                                   std::string fallback) const {
  std::string word = text_or(key, std::move(fallback));
  if (std::ranges::find(choices, word) == choices.end()) {
    throw fault(key, fmt::format("is \"{}\"", word), fmt::format("choose among {}", fmt::join(choices, ", ")));
  }
  return word;
}

std::optional<double> TomlSection::optional_number(std::string_view key, Interval allowed) const {
  if (!has(key)) return std::nullopt;
  const toml::node& node = *find(*table_->table, key);
  if (!node.is_number()) throw fault(key, fmt::format("is {}", as_written(node)), range_text(allowed));
  const double value = number_in(node);
  if (!(value >= allowed.lowest && value <= allowed.highest))
    throw fault(key, fmt::format("is {:g}", value), range_text(allowed));
  return value;
}

double TomlSection::number(std::string_view key, Interval allowed) const {
  if (const auto value = optional_number(key, allowed)) return *value;
  throw missing(key, range_text(allowed));
}

double TomlSection::number_or(std::string_view key, Interval allowed, double fallback) const {
  return optional_number(key, allowed).value_or(fallback);
}

std::int64_t TomlSection::whole_number_or(std::string_view key, Interval allowed, std::int64_t fallback) const {
  if (!optional_number(key, allowed)) return fallback;
  const toml::node& node = *find(*table_->table, key);
  if (!node.is_integer()) throw fault(key, fmt::format("is {}", as_written(node)), "give a whole number");
  return *node.value<std::int64_t>();
}

bool TomlSection::flag_or(std::string_view key, bool fallback) const {
  if (!has(key)) return fallback;
  const toml::node& node = *find(*table_->table, key);
  if (!node.is_boolean()) throw fault(key, fmt::format("is {}", as_written(node)), "give true or false");
  return *node.value<bool>();
}

std::vector<std::string> TomlSection::texts(std::string_view key) const {
  if (!has(key)) return {};
  const toml::node& node = *find(*table_->table, key);
  std::vector<std::string> words;
  const toml::array* array = node.as_array();
  if (array == nullptr) throw fault(key, fmt::format("is {}", as_written(node)), "give a list of texts in quotes");
  for (const toml::node& element : *array) {
    if (!element.is_string())
      throw fault(key, fmt::format("holds {}", as_written(element)), "give a list of texts in quotes");
    words.push_back(*element.value<std::string>());
  }
  return words;
}

std::vector<double> TomlSection::numbers(std::string_view key, Interval allowed) const {
  if (!has(key)) return {};
  const toml::node& node = *find(*table_->table, key);
  std::vector<double> values;
  const toml::array* array = node.as_array();
  if (array == nullptr) throw fault(key, fmt::format("is {}", as_written(node)), "give a list of numbers");
  for (const toml::node& element : *array) {
    const double value = element.is_number() ? number_in(element) : allowed.lowest - 1.0;
    if (!(value >= allowed.lowest && value <= allowed.highest)) {
      throw fault(key, fmt::format("holds {}", as_written(element)), range_text(allowed));
    }
    values.push_back(value);
  }
  return values;
}

std::vector<std::array<double, 2>> TomlSection::pairs(std::string_view key) const {
  if (!has(key)) return {};
  const toml::node& node = *find(*table_->table, key);
  const auto is_finite = [](const toml::node& n) { return n.is_number() && std::isfinite(number_in(n)); };
  const auto is_pair = [&](const toml::node& n) {
    return n.is_array() && n.as_array()->size() == 2 && is_finite(*n.as_array()->get(0)) &&
           is_finite(*n.as_array()->get(1));
  };
  std::vector<std::array<double, 2>> values;
  const toml::array* array = node.as_array();
  const char* const remedy = "give a list of pairs of numbers such as [[10, 20], [30, 40]]";
  if (array == nullptr) throw fault(key, fmt::format("is {}", as_written(node)), remedy);
  for (const toml::node& pair : *array) {
    if (!is_pair(pair)) throw fault(key, fmt::format("holds {}", as_written(pair)), remedy);
    values.push_back({number_in(*pair.as_array()->get(0)), number_in(*pair.as_array()->get(1))});
  }
  return values;
}

std::optional<std::filesystem::path> TomlSection::optional_file(std::string_view key) const {
  const auto written = optional_text(key);
  if (!written) return std::nullopt;
  if (written->empty()) throw fault(key, "is empty", "give the path of a file, relative to the TOML file");
  auto path = expanded_path(*written, table_->file.parent_path(), where(key));
  const auto type = is_virtual(path) ? std::filesystem::file_type::regular : type_of(path);
  if (type != std::filesystem::file_type::regular && type != std::filesystem::file_type::directory) {
    throw fault(key, fmt::format("the file {} {}", path.string(), what_it_is(path)),
                "correct the path, which is relative to the TOML file");
  }
  return path;
}

std::filesystem::path TomlSection::file(std::string_view key) const {
  static_cast<void>(text(key));
  return *optional_file(key);
}

std::optional<TomlSection> TomlSection::section(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const toml::node& node = *find(*table_->table, key);
  if (!node.is_table())
    throw fault(key, fmt::format("is {}", as_written(node)),
                fmt::format("write it as a table, {}",
                            table_->place.empty() ? fmt::format("[{}]", key) : fmt::format("{} = {{…}}", key)));
  auto inner = std::make_shared<Table>(*table_);
  inner->table = node.as_table();
  inner->place = fmt::format("{}{}{}", table_->place, table_->place.empty() ? "" : ".", key);
  inner->known.clear();
  return TomlSection(inner);
}

TomlSection TomlSection::required_section(std::string_view key) const {
  if (auto found = section(key)) return *found;
  throw missing(key, fmt::format("add a [{}] section", key));
}

std::vector<TomlSection> TomlSection::sections(std::string_view key) const {
  if (!has(key)) return {};
  const toml::node& node = *find(*table_->table, key);
  const toml::array* array = node.as_array();
  if (array == nullptr || !std::ranges::all_of(*array, [](const toml::node& n) { return n.is_table(); })) {
    throw fault(key, "is not a list of tables", fmt::format("begin each with [[{}]]", key));
  }
  std::vector<TomlSection> tables;
  for (const toml::node& element : *array) {
    auto inner = std::make_shared<Table>(*table_);
    inner->table = element.as_table();
    inner->place = fmt::format("{}{}{}[{}]", table_->place, table_->place.empty() ? "" : ".", key, tables.size() + 1);
    inner->known.clear();
    tables.push_back(TomlSection(inner));
  }
  return tables;
}

void TomlSection::refuse_unknown_keys() const {
  const std::vector<std::string> known(table_->known.begin(), table_->known.end());
  for (const std::string& key : keys()) {
    if (table_->known.contains(key)) continue;
    const auto nearest = nearest_word(key, known);
    throw fault(
        key, "is not a known key",
        nearest ? fmt::format("did you mean {}?", *nearest) : fmt::format("use one of {}", fmt::join(known, ", ")));
  }
}

std::filesystem::path expanded_path(std::string_view text, const std::filesystem::path& folder,
                                    const std::string& where) {
  std::string expanded;
  while (!text.empty()) {
    const auto start = text.find("${");
    const auto end = start == std::string_view::npos ? start : text.find('}', start);
    expanded += text.substr(0, std::min(start, text.size()));
    if (start == std::string_view::npos) break;
    if (end == std::string_view::npos) throw Error(where, "opens ${ and does not close it", "write ${NAME}");
    const std::string_view inside = text.substr(start + 2, end - start - 2);
    const auto separator = inside.find(":-");
    const std::string name(inside.substr(0, separator));
    if (const char* value = std::getenv(name.c_str()); value != nullptr && *value != '\0') {
      expanded += value;
    } else if (separator != std::string_view::npos) {
      expanded += inside.substr(separator + 2);
    } else {
      throw Error(where, fmt::format("the environment variable {} is not set", name),
                  "set it to the folder that holds the data");
    }
    text.remove_prefix(end + 1);
  }
  const std::filesystem::path path(expanded);
  if (is_virtual(path)) return path;  // where a second slash says that what follows is absolute
  return (path.is_absolute() ? path : folder / path).lexically_normal();
}

std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known) {
  const auto distance = [word](const std::string& other) { return edit_distance(word, other); };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (nearest == known.end()) return std::nullopt;
  if (3 * distance(*nearest) > std::max(word.size(), nearest->size())) return std::nullopt;
  return *nearest;
}

}  // namespace sigmascape
