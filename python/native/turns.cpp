#include "turns.h"

#include <chrono>
#include <unistd.h>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"

namespace sigmascape::python {
namespace {

constexpr auto heeding_time = std::chrono::milliseconds(50);

}  // namespace

Turns::Turns(std::string name) : name_(std::move(name)), made_in_(::getpid()) {}

bool Turns::are_of_this_process() const {
  return ::getpid() == made_in_;
}

void Turns::check_process() const {
  if (!are_of_this_process()) throw Error(name_, "was made in another process", "make it in this one");
}

void Turns::lock() {
  // Before the mutex, which a thread of the other process may have held when this one was forked off.
  check_process();
  std::unique_lock lock(guard_);
  while (!given_up_.wait_for(lock, heeding_time, [this] { return !is_taken_; })) Interruption::heed();
  is_taken_ = true;
}

void Turns::unlock() {
  {
    const std::scoped_lock lock(guard_);
    is_taken_ = false;
  }
  given_up_.notify_one();
}

}  // namespace sigmascape::python
