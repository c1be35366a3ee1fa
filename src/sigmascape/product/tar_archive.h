#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sigmascape::product {

/// A tar file (POSIX ustar) that grows in memory. Nothing of the machine gets into it: owner 0, time 0, mode 644, so
/// that equal files give equal bytes.
class TarArchive {
 public:
  /// Throws Error when the name is longer than 100 characters or the content than 8 GiB.
  void add(std::string_view name, std::string_view content);
  /// For so many entries of so much content together: whoever knows them beforehand has them in memory but once.
  void make_room(std::size_t entries, std::size_t content_bytes);
  /// The whole file, with the blocks of zeros that end it. Leaves nothing behind.
  [[nodiscard]] std::string bytes() &&;

 private:
  std::string blocks_;
};

}  // namespace sigmascape::product
