#include "sigmascape/atlas/vouched_files.h"

#include <algorithm>

#include "sigmascape/atlas/texture_file.h"

namespace sigmascape::atlas {

std::optional<TextureRecord> VouchedFiles::record_of(const std::filesystem::path& file) const {
  {
    const std::lock_guard lock(guard_);
    if (const auto known = known_.find(file); known != known_.end()) return known->second;
  }
  std::optional<TextureRecord> record = texture_record(folder_, file);
  const bool has_item = record.has_value();
  if (has_item && !is_as_recorded(folder_, file, *record, scrutiny_)) record.reset();
  const std::lock_guard lock(guard_);
  if (!has_item) {
    missing_.insert(file);
    return std::nullopt;
  }
  missing_.erase(file);
  return known_.emplace(file, std::move(record)).first->second;
}

void VouchedFiles::did_not_decode(const std::filesystem::path& file) const {
  const std::lock_guard lock(guard_);
  undecoded_.insert(file);
}

std::size_t VouchedFiles::damaged() const {
  const std::lock_guard lock(guard_);
  const auto altered = std::ranges::count_if(known_, [](const auto& file) { return !file.second; });
  return static_cast<std::size_t>(altered) + undecoded_.size();
}

std::size_t VouchedFiles::missing() const {
  const std::lock_guard lock(guard_);
  return missing_.size();
}

}  // namespace sigmascape::atlas
