#pragma once

#include <string_view>

namespace sigmascape {

/// Hears how far a long piece of work has come. The library only tells; who listens (a terminal, a log, a notebook)
/// decides how to show it. Called from the thread that runs the work, at moments of the work's own choosing.
class ProgressListener {
 public:
  virtual ~ProgressListener() = default;
  /// `done` of `total` units called `unit` ("looks", "rays") of the work called `task` are finished; parts of a unit
  /// count.
  virtual void advanced(std::string_view task, double done, double total, std::string_view unit) = 0;
  /// How the work called `task` goes beside that: `quantity` is now `value`. A bake tells of "rays" traced so far and
  /// of the "relative_standard_error" of what it has baked, weighted by power.
  virtual void measured(std::string_view /*task*/, std::string_view /*quantity*/, double /*value*/) {}
  /// The work called `task` cannot go on before `what` ("another process that is at patch_+000_+000"): told many times
  /// a second until it does.
  virtual void waiting(std::string_view /*task*/, std::string_view /*what*/) {}
};

/// Listens to nothing.
class SilentProgress final : public ProgressListener {
 public:
  void advanced(std::string_view, double, double, std::string_view) override {}
};

}  // namespace sigmascape
