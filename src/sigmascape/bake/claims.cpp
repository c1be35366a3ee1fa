#include "sigmascape/bake/claims.h"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace sigmascape::bake {
namespace {

/// Locks of the open file rather than of the process (F_OFD_…), so that two bakes within one process exclude each other
/// as well.
bool set_lock(int descriptor, std::size_t byte, short type, Claims::Wait wait) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(byte);
  lock.l_len = 1;
  const int command = wait == Claims::Wait::UntilFree ? F_OFD_SETLKW : F_OFD_SETLK;
  int result = 0;
  do {
    result = ::fcntl(descriptor, command, &lock);
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
  if (claims_ != nullptr) set_lock(claims_->descriptor_, job_, F_UNLCK, Wait::No);
}

std::optional<Claims::Claim> Claims::take(std::size_t job, Wait wait) const {
  if (set_lock(descriptor_, job, F_WRLCK, wait)) return Claim(this, job);
  const bool held_by_another = errno == EAGAIN || errno == EACCES;
  if (held_by_another) return std::nullopt;
  return Claim(nullptr, job);
}

}  // namespace sigmascape::bake
