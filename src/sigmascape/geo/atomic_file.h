#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sigmascape::geo {

/// The file that a name stands for: the name itself, or what it leads to where it is a symbolic link, whether something
/// is there or not. Throws Error where links go round.
[[nodiscard]] std::filesystem::path end_of_links(const std::filesystem::path& path);

/// What lies beside a file under its name but for the ending, of which `ending` has the dot: beside what a symbolic
/// link leads to, where its content goes. Throws Error where that has this ending itself.
[[nodiscard]] std::filesystem::path companion_of(const std::filesystem::path& path, const std::string& ending);

/// Puts a file under its final name only when it is whole. Where the name is a symbolic link, that is the name at the
/// end of it, and the link stays.
///
/// Creates the parent folders, reserves an empty file under a name of its own in the same folder, lets `writer` fill
/// it, flushes it to the disk, renames it over `path` and flushes the folder. When anything fails, a full disk
/// included, the temporary file is removed, whatever stood under `path` before is untouched, and the failure is thrown:
/// the writer's own exception, or Error. Any number of threads and processes may write the same path at once; the last
/// rename wins.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& writer);

/// The same for a writer that does not get over a full disk: the disk is first asked for room for so many bytes, and
/// the writer is not called where there is none.
void write_atomically(const std::filesystem::path& path, std::uintmax_t room_bytes,
                      const std::function<void(const std::filesystem::path& temporary)>& writer);

/// The same for content that is at hand: text, or the bytes of a file made in memory.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for what only one may write: false, and nothing is changed, when something stands under `path` already. Of
/// any number of threads and processes that write the same path at once one is told true, on network file systems too.
/// Only where a file system has neither second names nor renaming without replacing may two come through.
[[nodiscard]] bool write_if_absent(const std::filesystem::path& path, std::string_view content);

/// The same for content that comes piece by piece, of which no more than a piece is in memory. A file that is destroyed
/// before `put_in_place` leaves nothing.
class GrowingFile {
 public:
  explicit GrowingFile(const std::filesystem::path& path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view piece);
  /// Once, when nothing is to come any more.
  void put_in_place();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

struct FileContent {
  std::filesystem::path path;
  std::string_view content;
};

/// The same for files that say nothing without one another: they come under their final names, in this order, when all
/// of them are whole and on the disk. When one cannot be, none is there, and what stood under their names before stands
/// there again. Whoever looks while the names change may still see a new file beside an old one.
void write_together(const std::vector<FileContent>& files);

/// Throws Error when such a file cannot be written there as things stand, for callers with long work before it: where
/// `path` is a folder or its name too long, or the first of its parents that exists is none or may not be written to.
/// Writes nothing.
void check_place_for(const std::filesystem::path& path);

/// Removes from `folder` the temporary files that killed writers left of files whose names begin with `beginning`, as
/// far as they surely belong to nobody: their writer was a process of this host, or container, that has ended, or they
/// were last written more than a day ago. Those of other hosts and containers stay until then, since they may be being
/// written; so anybody may call it at any time.
void remove_leftovers(const std::filesystem::path& folder, std::string_view beginning);

}  // namespace sigmascape::geo
