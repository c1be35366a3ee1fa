#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/scatter/material.h"

namespace sigmascape::scene {

/// The materials a scene file may name: its own, under [materials.<name>], and behind them the library's.
class MaterialTable {
 public:
  MaterialTable() = default;
  /// Reads [materials] of a scene file's root.
  explicit MaterialTable(const TomlSection& root);

  [[nodiscard]] bool knows(const std::string& name) const;
  /// The library material that one of the file's own starts from; nothing of others.
  [[nodiscard]] std::optional<std::string> base_of(const std::string& name) const;
  /// Those of the file that nobody has asked for yet.
  [[nodiscard]] std::vector<std::string> unasked() const;
  /// Throws Error at `where`, with the nearest known name, when neither has it.
  [[nodiscard]] const scatter::Material& material(const std::string& name, const std::string& where) const;
  /// The same for the medium of a tree's crown, which `material` refuses.
  [[nodiscard]] const scatter::Material& crown(const std::string& name, const std::string& where) const;
  /// The material named by a key, or of the fallback name where the key is absent.
  [[nodiscard]] const scatter::Material& named_by(const TomlSection& section, std::string_view key,
                                                  const std::string& fallback) const;

 private:
  [[nodiscard]] const scatter::Material& found(const std::string& name, const std::string& where) const;

  std::map<std::string, scatter::Material> own_;
  std::map<std::string, std::string> bases_;  ///< of those that have one
  mutable std::set<std::string> asked_;
};

}  // namespace sigmascape::scene
