#include "sigmascape/bake/claims.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
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

}  // namespace

Claims::Claims(const std::filesystem::path& folder)
    : descriptor_(::open((folder / ".claims").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)) {}

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

Claims::Claim Claims::take(std::size_t job, const std::function<void()>& while_waiting) const {
  // Asked for again and again rather than slept on, so that who waits can be told to stop.
  for (;;) {
    if (auto claim = take_if_free(job)) return *std::move(claim);
    if (while_waiting) while_waiting();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    Interruption::heed();
  }
}

std::size_t terrain_claim(const atlas::AtlasDescription& description) {
  return JobList(description).size() + description.patches.block_over(description.extent).size();
}

}  // namespace sigmascape::bake
