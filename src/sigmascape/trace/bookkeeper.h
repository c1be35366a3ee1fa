#pragma once

#include "sigmascape/base/sobol.h"
#include "sigmascape/trace/path.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/power_books.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// Keeps the books of power, path by path; does nothing when none are asked for.
class Bookkeeper {
 public:
  Bookkeeper(const SpectralSurfaces& surfaces, bool keeps_books, PowerBooks& books)
      : surfaces_(surfaces), keeps_books_(keeps_books), books_(books) {}

  [[nodiscard]] bool keeps_books() const { return keeps_books_; }

  void path_begins() { balance_ = -1.0; }
  void path_ends() {
    if (!keeps_books_) return;
    ++books_.paths;
    books_.squared_imbalance += balance_ * balance_;
  }
  void escapes(const Path& path) { enter(books_.escaped, path); }
  void is_cut(const Path& path) { enter(books_.cut, path); }
  void meets_roulette(double power_before, double power_after) {
    if (keeps_books_) books_.roulette += power_before - power_after;
  }
  /// What the surface takes of the power that arrives: the rest of what it sends into all directions.
  void is_scattered(const Path& path, const SurfaceHit& hit, int bounce, const SobolPoint& point);

  /// The mean over transmit polarizations and frequencies of the power that a path carries.
  [[nodiscard]] static double carried(const Path& path);

 private:
  void enter(double& account, const Path& path) {
    if (keeps_books_) add(account, carried(path));
  }
  void add(double& account, double power) {
    account += power;
    balance_ += power;
  }

  const SpectralSurfaces& surfaces_;
  bool keeps_books_;
  PowerBooks& books_;
  double balance_ = 0.0;  // of the path at hand
};

}  // namespace sigmascape::trace
