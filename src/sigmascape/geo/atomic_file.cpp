#include "sigmascape/geo/atomic_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <regex>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"

namespace sigmascape::geo {
namespace {

bool is_full(int error) {
  return error == ENOSPC || error == EDQUOT || error == EFBIG;
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw Error(path.string(), fmt::format("cannot be written ({})", std::strerror(error)),
              error == EISDIR  ? "remove the folder that stands under this name"
              : error == EFBIG ? "let files grow larger (ulimit -f) or choose another disk"
              : is_full(error) ? "free some space or choose another disk"
                               : "choose a folder that exists and may be written to");
}

/// Closes a file descriptor when leaving, whatever happens.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  /// Network file systems tell only then of quotas and full disks.
  [[nodiscard]] bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }
  [[nodiscard]] bool flush_to_disk() const { return ::fsync(descriptor_) == 0; }
  /// Zero or the number of the error.
  [[nodiscard]] int take_room(std::uintmax_t bytes) const {
    return ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  }
  [[nodiscard]] bool write_all(std::string_view content) const {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

 private:
  int descriptor_;
};

constexpr std::string_view temporary_ending = ".tmp";

/// Names where processes are numbered as this one is: the host since it was started last, and of it the space that a
/// container has for processes of its own. Empty where the system does not tell.
std::string name_of_numbering() {
  std::string start;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> start;
  std::error_code error;
  const std::filesystem::path space = std::filesystem::read_symlink("/proc/self/ns/pid", error);
  std::array<char, 256> host{};
  if (start.empty() || error || ::gethostname(host.data(), host.size() - 1) != 0) return "";
  return sha256_of(fmt::format("{} {} {}", host.data(), start, space.string())).substr(0, 16);
}

const std::string& numbering() {
  static const std::string name = name_of_numbering();
  return name;
}

/// One that this process has not given before, in the same folder; it tells who has given it.
std::filesystem::path temporary_name_for(const std::filesystem::path& final_path) {
  static std::atomic<unsigned> serial{0};
  return final_path.parent_path() / fmt::format(".{}.{}-{}-{}{}", final_path.filename().string(), numbering(),
                                                ::getpid(), serial.fetch_add(1), temporary_ending);
}

/// Whether a name is one of those, whoever gave it, be it a former program that did not name the numbering.
bool is_temporary_name(const std::string& name) {
  static const std::regex form(R"(\..+\.([0-9a-f]{16}-|-)?[0-9]+-[0-9]+\.tmp)");
  return std::regex_match(name, form);
}

/// Whether a temporary file has a name that was given by a process which has ended, as far as can be seen from here.
bool is_of_ended_process(std::string_view name) {
  name.remove_suffix(temporary_ending.size());
  name.remove_prefix(name.rfind('.') + 1);
  const std::string here = numbering() + "-";
  if (numbering().empty() || !name.starts_with(here)) return false;
  name.remove_prefix(here.size());
  pid_t process = 0;
  if (std::from_chars(name.data(), name.data() + name.size(), process).ec != std::errc() || process <= 0) return false;
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

/// Whether nobody can be at work on a file any more. Clocks of hosts that share it differ by less than a day.
bool is_long_untouched(const std::filesystem::path& path) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(path, error);
  return !error && std::filesystem::file_time_type::clock::now() - written > std::chrono::hours(24);
}

/// An empty file of a name that nobody else has, removed again unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& final_path) {
    do {
      path_ = temporary_name_for(final_path);
      const int descriptor = ::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      const int error = errno;
      if (descriptor >= 0) {
        ::close(descriptor);
        return;
      }
      if (error != EEXIST) fail(final_path, error);
    } while (true);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  void rename_to(const std::filesystem::path& final_path) {
    if (::rename(path_.c_str(), final_path.c_str()) != 0) fail(final_path, errno);
    path_.clear();
  }

  /// False when something stands there already. A second name is given by one process alone wherever the folder is; an
  /// answer that a network lost shows in the number of names.
  [[nodiscard]] bool take_free_name(const std::filesystem::path& final_path) {
    if (::link(path_.c_str(), final_path.c_str()) == 0) return true;
    const int error = errno;
    if (names() == 2) return true;
    if (error == EEXIST) return false;
    if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, final_path.c_str(), RENAME_NOREPLACE) == 0) {
      path_.clear();
      return true;
    }
    if (errno == EEXIST || std::filesystem::exists(final_path)) return false;
    rename_to(final_path);
    return true;
  }

 private:
  [[nodiscard]] std::size_t names() const {
    struct stat status {};
    return ::stat(path_.c_str(), &status) == 0 ? static_cast<std::size_t>(status.st_nlink) : 0;
  }

  std::filesystem::path path_;
};

/// Keeps what stands under a name within reach when another file takes its place. Where the file system knows no
/// second names it keeps nothing.
class FormerFile {
 public:
  explicit FormerFile(const std::filesystem::path& path) : path_(path), kept_(temporary_name_for(path)) {
    if (::link(path_.c_str(), kept_.c_str()) != 0) kept_.clear();
  }
  ~FormerFile() {
    std::error_code ignored;
    if (!kept_.empty()) std::filesystem::remove(kept_, ignored);
  }
  FormerFile(const FormerFile&) = delete;
  FormerFile& operator=(const FormerFile&) = delete;

  /// In the place of what took its own; where there was nothing there is nothing again.
  void put_back() const {
    std::error_code ignored;
    if (kept_.empty()) {
      std::filesystem::remove(path_, ignored);
    } else {
      std::filesystem::rename(kept_, path_, ignored);
    }
  }

 private:
  std::filesystem::path path_, kept_;
};

void flush_file(const std::filesystem::path& temporary, const std::filesystem::path& final_path) {
  OpenFile file(::open(temporary.c_str(), O_RDWR | O_CLOEXEC));
  if (!file.is_open() || !file.flush_to_disk() || !file.close()) fail(final_path, errno);
}

/// File systems that cannot keep room free are believed to have it.
void take_room(const std::filesystem::path& temporary, const std::filesystem::path& final_path, std::uintmax_t bytes) {
  const OpenFile file(::open(temporary.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.is_open()) fail(final_path, errno);
  if (const int error = file.take_room(bytes); is_full(error)) fail(final_path, error);
}

/// A rename lives in the folder, so the folder must reach the disk too. Some network file systems cannot flush a
/// folder; the file is whole all the same.
void flush_folder(const std::filesystem::path& folder) {
  const OpenFile opened(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.is_open()) static_cast<void>(opened.flush_to_disk());
}

/// Writes all of a file and flushes it.
void fill(const std::filesystem::path& temporary, const std::filesystem::path& final_path, std::string_view content) {
  OpenFile file(::open(temporary.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.is_open() || !file.write_all(content) || !file.flush_to_disk() || !file.close()) fail(final_path, errno);
}

void make_folder(const std::filesystem::path& path) {
  if (path.parent_path().empty()) return;
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) fail(path, error.value());
}

/// Lays a file down under a name of its own, all of it on the disk, and then under its final one.
template <typename Lay>
void put_in_place(const std::filesystem::path& named, const Lay& lay) {
  const std::filesystem::path path = end_of_links(named);
  make_folder(path);
  TemporaryFile temporary(path);
  lay(temporary.path());
  temporary.rename_to(path);
  flush_folder(path.parent_path());
}

}  // namespace

std::filesystem::path end_of_links(const std::filesystem::path& path) {
  constexpr int most_links = 40;  // as many in a row as Linux follows
  std::filesystem::path end = path;
  for (int followed = 0; followed <= most_links; ++followed) {
    std::error_code is_no_link;
    const std::filesystem::path target = std::filesystem::read_symlink(end, is_no_link);
    if (is_no_link) return end;
    end = end.parent_path() / target;
  }
  throw Error(path.string(), "is a symbolic link that leads nowhere but to links", "remove it or name another file");
}

std::filesystem::path companion_of(const std::filesystem::path& path, const std::string& ending) {
  const std::filesystem::path end = end_of_links(path);
  std::filesystem::path companion = end;
  companion.replace_extension(ending);
  if (companion == end) {
    throw Error(path.string(), fmt::format("leads to {}, where what belongs beside it would lie", end.string()),
                fmt::format("let it lead to a name that ends in {}", path.extension().string()));
  }
  return companion;
}

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& writer) {
  put_in_place(path, [&](const std::filesystem::path& temporary) {
    writer(temporary);
    flush_file(temporary, path);
  });
}

void write_atomically(const std::filesystem::path& path, std::uintmax_t room_bytes,
                      const std::function<void(const std::filesystem::path& temporary)>& writer) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    take_room(temporary, path, room_bytes);
    writer(temporary);
  });
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  put_in_place(path, [&](const std::filesystem::path& temporary) { fill(temporary, path, content); });
}

bool write_if_absent(const std::filesystem::path& named, std::string_view content) {
  const std::filesystem::path path = end_of_links(named);
  make_folder(path);
  TemporaryFile temporary(path);
  fill(temporary.path(), path, content);
  if (!temporary.take_free_name(path)) return false;
  flush_folder(path.parent_path());
  return true;
}

struct GrowingFile::Parts {
  explicit Parts(const std::filesystem::path& final_path)
      : path(final_path), temporary(path), file(::open(temporary.path().c_str(), O_WRONLY | O_CLOEXEC)) {
    if (!file.is_open()) fail(path, errno);
  }

  std::filesystem::path path;
  TemporaryFile temporary;
  OpenFile file;
};

GrowingFile::GrowingFile(const std::filesystem::path& named) {
  const std::filesystem::path path = end_of_links(named);
  make_folder(path);
  parts_ = std::make_unique<Parts>(path);
}

GrowingFile::~GrowingFile() = default;

void GrowingFile::append(std::string_view piece) {
  if (!parts_->file.write_all(piece)) fail(parts_->path, errno);
}

void GrowingFile::put_in_place() {
  if (!parts_->file.flush_to_disk() || !parts_->file.close()) fail(parts_->path, errno);
  parts_->temporary.rename_to(parts_->path);
  flush_folder(parts_->path.parent_path());
}

void write_together(const std::vector<FileContent>& named) {
  std::vector<FileContent> files;
  for (const auto& [path, content] : named) files.push_back({end_of_links(path), content});
  std::deque<TemporaryFile> temporaries;
  for (const auto& [path, content] : files) {
    make_folder(path);
    const TemporaryFile& temporary = temporaries.emplace_back(path);
    fill(temporary.path(), path, content);
  }
  std::deque<FormerFile> former;
  for (const FileContent& file : files) former.emplace_back(file.path);
  std::size_t renamed = 0;
  try {
    for (; renamed < files.size(); ++renamed) temporaries[renamed].rename_to(files[renamed].path);
  } catch (const Error&) {
    while (renamed > 0) former[--renamed].put_back();
    throw;
  }
  for (const FileContent& file : files) flush_folder(file.path.parent_path());
}

void check_place_for(const std::filesystem::path& named) {
  const std::filesystem::path path = end_of_links(named);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error(path.string(), "is a folder", "name a file");
  std::filesystem::path above = std::filesystem::absolute(path).parent_path();
  while (!std::filesystem::exists(above, ignored) && above != above.parent_path()) above = above.parent_path();
  if (!std::filesystem::is_directory(above, ignored)) fail(path, ENOTDIR);
  if (::access(above.c_str(), W_OK | X_OK) != 0) fail(path, errno);
  const auto longest = ::pathconf(above.c_str(), _PC_NAME_MAX);
  const std::size_t beside = temporary_name_for(path).filename().string().size();
  if (longest > 0 && beside > static_cast<std::size_t>(longest)) {
    const std::size_t own = path.filename().string().size(), spare = static_cast<std::size_t>(longest) - (beside - own);
    throw Error(path.string(), fmt::format("has a name of {} bytes, and there can be {} at most", own, spare),
                "give it a shorter name");
  }
}

void remove_leftovers(const std::filesystem::path& folder, std::string_view beginning) {
  const std::string prefix = fmt::format(".{}", beginning);
  std::error_code ignored;
  std::vector<std::filesystem::path> leftovers;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !is_temporary_name(name)) continue;
    if (is_of_ended_process(name) || is_long_untouched(entry.path())) leftovers.push_back(entry.path());
  }
  for (const std::filesystem::path& leftover : leftovers) std::filesystem::remove(leftover, ignored);
}

}  // namespace sigmascape::geo
