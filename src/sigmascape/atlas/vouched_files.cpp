#include "sigmascape/atlas/vouched_files.h"

#include "sigmascape/atlas/texture_file.h"

namespace sigmascape::atlas {

std::optional<TextureRecord> VouchedFiles::record_of(const std::filesystem::path& file) const {
  {
    const std::lock_guard lock(guard_);
    if (const auto known = known_.find(file); known != known_.end()) return known->second;
    if (damaged_.holds(file)) return std::nullopt;
  }
  // One that cannot be read now may be another time.
  const std::optional<std::string> item = text_of(store_.folder() / item_path(file)).text;
  std::optional<TextureRecord> record;
  if (item) record = item_from(*item, store_.description(), file).record;
  if (record && !is_as_recorded(store_.folder(), file, *record, scrutiny_)) record.reset();
  const std::lock_guard lock(guard_);
  if (!item) {
    missing_.insert(file);
    return std::nullopt;
  }
  missing_.erase(file);
  // Another thread may have found it sound meanwhile.
  if (const auto known = known_.find(file); known != known_.end()) return known->second;
  if (!record) {
    damaged_.add(file);
    return std::nullopt;
  }
  damaged_.erase(file);
  return known_.emplace(file, std::move(*record)).first->second;
}

void VouchedFiles::tell(const std::filesystem::path& file, std::size_t level, bool decodes) const {
  const std::lock_guard lock(guard_);
  if (decodes) {
    undecoded_.erase({file, level});
  } else {
    undecoded_.emplace(file, level);
    known_.erase(file);
  }
}

std::size_t VouchedFiles::damaged() const {
  const std::lock_guard lock(guard_);
  std::set<std::filesystem::path> undecoded;
  for (const auto& [file, level] : undecoded_) undecoded.insert(file);
  return damaged_.size() + undecoded.size();
}

std::size_t VouchedFiles::missing() const {
  const std::lock_guard lock(guard_);
  return missing_.size();
}

}  // namespace sigmascape::atlas
