#include "sigmascape/base/interruption.h"

#include <utility>

namespace sigmascape {
namespace {

constexpr auto asking_time = std::chrono::milliseconds(50);

thread_local Interruption* of_this_thread = nullptr;

}  // namespace

Interruption::Membership::Membership(Interruption* of) : before_(std::exchange(of_this_thread, of)) {}

Interruption::Membership::~Membership() {
  of_this_thread = before_;
}

Interruption::Interruption(std::function<bool()> is_wanted) : is_wanted_(std::move(is_wanted)), membership_(this) {}

Interruption::~Interruption() = default;

Interruption* Interruption::current() {
  return of_this_thread;
}

void Interruption::poll() {
  if (stops_.load(std::memory_order_relaxed)) throw Interrupted();
  if (std::this_thread::get_id() != owner_) return;
  const auto now = Clock::now();
  if (now - asked_ < asking_time) return;
  asked_ = now;
  bool wanted = true;
  try {
    wanted = is_wanted_();
  } catch (...) {
    stops_.store(true, std::memory_order_relaxed);
    throw;
  }
  if (!wanted) return;
  stops_.store(true, std::memory_order_relaxed);
  throw Interrupted();
}

}  // namespace sigmascape
