#include "sigmascape/scene/flaw_tally.h"

#include <algorithm>
#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::scene {

Remark& FlawTally::add(const std::string& kind, const std::string& which, std::size_t count, bool is_flaw) {
  auto entry = std::ranges::find(entries_, kind, [](const Entry& e) { return e.remark.what; });
  if (entry == entries_.end()) entry = entries_.insert(entry, {Remark{kind, 0, which}, is_flaw});
  entry->remark.count += count;
  return entry->remark;
}

void FlawTally::leaves_nothing(const std::string& kind) {
  const auto entry = std::ranges::find(entries_, kind, [](const Entry& e) { return e.remark.what; });
  if (entry == entries_.end()) return;
  entry->remark.what += ", so that nothing of the file is used";
  entry->remark.is_likely_a_mistake = true;
}

void FlawTally::settle(const std::string& where, std::size_t total, const FlawLimit& limit,
                       std::vector<Remark>& remarks) const {
  for (const auto& [remark, is_flaw] : entries_) {
    const std::string first = fmt::format("{}: {}", where, remark.first);
    const bool too_many = static_cast<double>(remark.count) > limit.max_share * static_cast<double>(total);
    if (is_flaw && (limit.strict || too_many)) {
      throw Error(first, fmt::format("the first of {} {} (of {} in all)", remark.count, remark.what, total),
                  limit.strict ? "correct the data, or set strict = false to put up with them"
                               : "correct the data, or raise max_flawed_share to put up with them");
    }
    remarks.push_back({remark.what, remark.count, first, remark.is_likely_a_mistake});
  }
}

}  // namespace sigmascape::scene
