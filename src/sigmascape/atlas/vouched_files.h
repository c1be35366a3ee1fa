#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/failed_lately.h"

namespace sigmascape::atlas {

/// Files of a store that readers of single tiles come back to again and again: each is held against its item once, and
/// again after a while if something was wrong (FailedLately). Any number of threads.
class VouchedFiles {
 public:
  VouchedFiles(Store store, Scrutiny scrutiny, std::chrono::milliseconds patience = before_another_try)
      : store_(std::move(store)), scrutiny_(scrutiny), damaged_(patience) {}

  /// What the item of a file (relative to the store) records; nothing when there is none, when something is wrong with
  /// it, or when the file is not as it says. What has no item is looked for again each time: it may be baked meanwhile.
  [[nodiscard]] std::optional<TextureRecord> record_of(const std::filesystem::path& file) const;

  /// To be told whether a tile of a level of a file that is as its item says decodes: that of a former kind, say, does
  /// not. The file is held against its item again before the next tile of one that did not.
  void tell(const std::filesystem::path& file, std::size_t level, bool decodes) const;

  /// Files asked for so far that have an item and, when last looked at, were not as it says, or it was wrong, or that
  /// did not decode.
  [[nodiscard]] std::size_t damaged() const;
  /// Files without an item when they were last asked for.
  [[nodiscard]] std::size_t missing() const;

 private:
  Store store_;
  Scrutiny scrutiny_;
  mutable std::mutex guard_;
  mutable std::map<std::filesystem::path, TextureRecord> known_;
  mutable FailedLately<std::filesystem::path> damaged_;
  mutable std::set<std::filesystem::path> missing_;
  mutable std::set<std::pair<std::filesystem::path, std::size_t>> undecoded_;  ///< files and levels
};

}  // namespace sigmascape::atlas
