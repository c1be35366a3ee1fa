#pragma once

#include <functional>
#include <string_view>
#include <utility>

namespace sigmascape::product {

/// A tar file (POSIX ustar) that is written entry by entry and keeps none of them. Nothing of the machine gets into it:
/// owner 0, time 0, mode 644, so that equal files give equal bytes.
class TarArchive {
 public:
  /// Takes the bytes of the file, piece after piece.
  using Sink = std::function<void(std::string_view piece)>;

  explicit TarArchive(Sink write) : write_(std::move(write)) {}

  /// Throws Error when the name is longer than 100 characters or the content than 8 GiB.
  void add(std::string_view name, std::string_view content);
  /// Writes the blocks of zeros that end the file; nothing may be added afterwards.
  void end();

 private:
  Sink write_;
};

}  // namespace sigmascape::product
