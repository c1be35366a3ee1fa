#pragma once

#include <span>

#include "sigmascape/trace/path.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/power_books.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// Where a path has come to.
struct Arrival {
  Vec3f direction;  ///< in which it came
  const SurfaceHit& hit;
  const SobolPoint& point;  ///< the numbers that the path is drawn from
  std::uint32_t vertex;     ///< its number along the path
};

/// Keeps the books of power, path by path; does nothing when none are asked for.
class Bookkeeper {
 public:
  Bookkeeper(const SpectralSurfaces& surfaces, bool keeps_books, PowerBooks& books)
      : surfaces_(surfaces), keeps_books_(keeps_books), books_(books) {}

  [[nodiscard]] bool keeps_books() const { return keeps_books_; }

  void path_ends(const Path& path) {
    if (!keeps_books_) return;
    ++books_.paths;
    books_.squared_imbalance += path.imbalance * path.imbalance;
  }
  void escapes(Path& path, std::span<const Wave> waves) { enter(books_.escaped, path, waves); }
  void is_cut(Path& path, std::span<const Wave> waves) { enter(books_.cut, path, waves); }
  void meets_roulette(double power_before, double power_after) {
    if (keeps_books_) books_.roulette += power_before - power_after;
  }
  /// What the surface takes of the power that arrives: the rest of what it sends into all directions.
  void is_scattered(Path& path, const Arrival& at, std::span<const Wave> waves);

  /// The mean over transmit polarizations and frequencies of the power that a path carries.
  [[nodiscard]] static double carried(std::span<const Wave> waves);

 private:
  void enter(double& account, Path& path, std::span<const Wave> waves) {
    if (keeps_books_) add(account, path, carried(waves));
  }
  static void add(double& account, Path& path, double power) {
    account += power;
    path.imbalance += power;
  }

  const SpectralSurfaces& surfaces_;
  bool keeps_books_;
  PowerBooks& books_;
};

}  // namespace sigmascape::trace
