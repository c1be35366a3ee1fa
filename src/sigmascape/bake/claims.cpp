#include "sigmascape/bake/claims.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "sigmascape/bake/job.h"
#include "sigmascape/base/interruption.h"

namespace sigmascape::bake {
namespace {

/// Locks of the open file rather than of the process (F_OFD_…), so that two bakes within one process exclude each other
/// as well.
bool set_lock(int descriptor, std::size_t byte, short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(byte);
  lock.l_len = 1;
  int result = 0;
  do {
    result = ::fcntl(descriptor, F_OFD_SETLK, &lock);
  } while (result != 0 && errno == EINTR);
  return result == 0;
}

int open_claims(const std::filesystem::path& file) {
  return ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
}

}  // namespace

Claims::Claims(const std::filesystem::path& folder) : file_(folder / ".claims"), descriptor_(open_claims(file_)) {}

Claims::~Claims() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Claims::Claim::~Claim() {
  if (claims_ != nullptr) set_lock(claims_->descriptor_, job_, F_UNLCK);
}

std::optional<Claims::Claim> Claims::take_if_free(std::size_t job) const {
  if (set_lock(descriptor_, job, F_WRLCK)) return Claim(this, job);
  const bool held_by_another = errno == EAGAIN || errno == EACCES;
  return held_by_another ? std::nullopt : std::optional(Claim(nullptr, job));
}

void Claims::renew_if_deleted() const {
  struct stat held {
  }, there{};
  if (::fstat(descriptor_, &held) != 0) return;
  if (::stat(file_.c_str(), &there) == 0 && there.st_ino == held.st_ino && there.st_dev == held.st_dev) return;
  const int renewed = open_claims(file_);
  if (renewed < 0) return;
  ::dup3(renewed, descriptor_, O_CLOEXEC);
  ::close(renewed);
}

Claims::Claim Claims::take(std::size_t job, const std::function<void()>& while_waiting) const {
  constexpr std::size_t turns_a_second = 50;
  // Asked for again and again rather than slept on, so that who waits can be told to stop.
  for (std::size_t turn = 1;; ++turn) {
    if (auto claim = take_if_free(job)) return *std::move(claim);
    if (while_waiting) while_waiting();
    if (turn % turns_a_second == 0) renew_if_deleted();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    Interruption::heed();
  }
}

std::size_t terrain_claim(const atlas::AtlasDescription& description) {
  return JobList(description).size() + description.patches.block_over(description.extent).size();
}

}  // namespace sigmascape::bake
