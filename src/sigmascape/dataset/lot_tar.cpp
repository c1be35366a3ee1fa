#include "sigmascape/dataset/lot_tar.h"

#include <utility>

#include "sigmascape/dataset/dataset_summary.h"

namespace sigmascape::dataset {

LotTar::LotTar(const std::filesystem::path& path, std::size_t first_sample)
    : file_(path), archive_([this](std::string_view piece) { write(piece); }), next_(first_sample) {}

void LotTar::add(std::size_t sample, std::vector<SampleFile> files) {
  const std::lock_guard lock(guard_);
  waiting_.emplace(sample, std::move(files));
  for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_; first = waiting_.begin()) {
    for (const SampleFile& file : first->second) archive_.add(sample_name(next_) + "." + file.name, file.bytes);
    waiting_.erase(first);
    ++next_;
  }
}

LotTar::Written LotTar::put_in_place() {
  archive_.end();
  file_.put_in_place();
  return {bytes_, digest_.hex_digest()};
}

void LotTar::write(std::string_view piece) {
  file_.append(piece);
  digest_.add(piece);
  bytes_ += piece.size();
}

}  // namespace sigmascape::dataset
