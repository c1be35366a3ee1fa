#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sigmascape::bench {

/// Writes measured figures as JSON lines {name, value, unit, machine, commit} and prints them as they come.
class Figures {
 public:
  /// Begins a new file; with none, figures are only printed.
  explicit Figures(std::optional<std::filesystem::path> file);

  void add(std::string_view name, double value, std::string_view unit, std::string_view note = {});

 private:
  std::optional<std::filesystem::path> file_;
  std::string machine_, commit_;
};

/// What every benchmark is asked on its command line: --out FILE, --quick.
struct Arguments {
  std::optional<std::filesystem::path> out;
  bool quick = false;  ///< smaller crops and fewer repetitions: minutes become seconds, figures become rough

  /// Ends the program with a message when it does not understand.
  static Arguments parsed(int count, char** words);
};

/// Ends the program with a message unless `holds`: a benchmark does not time what is wrong.
void prove(bool holds, std::string_view claim);

[[nodiscard]] double wall_seconds();
/// Of all threads of this process.
[[nodiscard]] double processor_seconds();
[[nodiscard]] double peak_memory_mib();

}  // namespace sigmascape::bench
