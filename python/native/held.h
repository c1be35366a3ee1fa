#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "turns.h"

namespace sigmascape::python {

/// A live class of the library as Python holds it: calls of several threads queue up, and a forked child is told that
/// it has to make its own.
template <typename Live>
class Held {
 public:
  /// `name`: of the class in Python.
  Held(std::string name, std::shared_ptr<Live> live) : state_(new State{Turns(std::move(name)), std::move(live)}) {}
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() {
    // In a forked child the end would be waited for of threads that are not there: what it lets go of is left as it is.
    if (!state_->turns.are_of_this_process()) (void)state_.release();
  }

  [[nodiscard]] Turns& turns() const { return state_->turns; }
  /// For what any number of threads may do with it at once. Throws Error in another process.
  [[nodiscard]] const std::shared_ptr<Live>& here() const {
    turns().check_process();
    return state_->live;
  }
  /// Does a piece of work with it, given as a reference, when the callers before have done theirs. Call it without the
  /// GIL. Throws Error in another process.
  template <typename Work>
  auto in_turn(const Work& work) const {
    const std::scoped_lock turn(turns());
    return work(*state_->live);
  }

 private:
  struct State {
    Turns turns;
    std::shared_ptr<Live> live;
  };

  std::unique_ptr<State> state_;
};

}  // namespace sigmascape::python
