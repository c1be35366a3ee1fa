#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// Files of a store that readers of single tiles come back to again and again: each is held against its item once.
/// Any number of threads.
class VouchedFiles {
 public:
  VouchedFiles(Store store, Scrutiny scrutiny) : store_(std::move(store)), scrutiny_(scrutiny) {}

  /// What the item of a file (relative to the store) records; nothing when there is none, when something is wrong with
  /// it, or when the file is not as it says. What has no item is looked for again each time: it may be baked meanwhile.
  [[nodiscard]] std::optional<TextureRecord> record_of(const std::filesystem::path& file) const;

  /// To be told of a file that is as its item says and whose tile does not decode all the same, as that of a former
  /// kind.
  void did_not_decode(const std::filesystem::path& file) const;

  /// Files asked for so far that have an item but are not as it says, or it is wrong, or did not decode.
  [[nodiscard]] std::size_t damaged() const;
  /// Files without an item when they were last asked for.
  [[nodiscard]] std::size_t missing() const;

 private:
  Store store_;
  Scrutiny scrutiny_;
  mutable std::mutex guard_;
  mutable std::map<std::filesystem::path, std::optional<TextureRecord>> known_;  // nothing of the damaged ones
  mutable std::set<std::filesystem::path> missing_, undecoded_;
};

}  // namespace sigmascape::atlas
