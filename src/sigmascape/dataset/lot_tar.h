#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/base/sha256.h"
#include "sigmascape/dataset/sample_files.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/tar_archive.h"

namespace sigmascape::dataset {

/// The tar file of a lot of samples, one after another in their numbers, whichever is made first. It grows on the disk
/// as they come: in memory are those alone that wait for one before them. Threads may add samples at once. Throws Error
/// when the file cannot be written; destroyed before `put_in_place` it leaves nothing.
class LotTar {
 public:
  LotTar(const std::filesystem::path& path, std::size_t first_sample);

  void add(std::size_t sample, std::vector<SampleFile> files);

  struct Written {
    std::size_t bytes = 0;
    std::string sha256;
  };
  /// When all samples have been added.
  Written put_in_place();

 private:
  void write(std::string_view piece);

  geo::GrowingFile file_;
  product::TarArchive archive_;
  Sha256 digest_;
  std::size_t bytes_ = 0;
  std::mutex guard_;
  std::size_t next_;  // sample to be written
  std::map<std::size_t, std::vector<SampleFile>> waiting_;
};

}  // namespace sigmascape::dataset
