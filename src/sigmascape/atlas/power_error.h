#pragma once

#include <map>
#include <optional>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::atlas {

/// What the texels of textures return in all, with what buildings that are kept apart do, and how sure that is: of one
/// texture the means over all its texels, dark ones too, of several (which have equally many) the sums of these. Power
/// is VV + HH + 2 HV as σ0. Weighted by power, since many texels are lit by one stray path, which is sure to no more
/// than itself and counts for next to nothing: docs/decisions/0170-errors-weighted-by-power.md.
struct PowerError {
  double power = 0.0;
  double standard_error = 0.0;              ///< of texels one by one: not that of their mean, in which noise makes up
  std::optional<double> above_target = {};  ///< the power of texels whose error is above a target, where there is one
  /// What bare ground returns besides that is kept apart, level and seen whole; it has no noise. 0 where it is among
  /// the texels.
  double ground_power = 0.0;

  /// Standard errors over power; nothing where no texel returns anything.
  [[nodiscard]] std::optional<double> relative() const;
  /// Part of the power; nothing where there is none, or no target.
  [[nodiscard]] std::optional<double> part_above_target() const;
  /// Part that the texels have in all that returns, bare ground included; nothing where nothing does.
  [[nodiscard]] std::optional<double> part_of_all() const;

  PowerError& operator+=(const PowerError& other);
  friend bool operator==(const PowerError&, const PowerError&) = default;
};

/// Of one texture. `relative_errors` are standard errors of its texels' power over that power, one a texel.
[[nodiscard]] PowerError power_error(const Array2D<radar::Channels>& texels, const Array2D<float>& relative_errors,
                                     std::optional<double> relative_target = {});

/// The same of looks, each of which is a map of its own: over the patches of a look power weighs, and looks count
/// alike. Else the one in which walls flash would speak for all.
class PowerErrors {
 public:
  void add(LookIndex look, const PowerError& of_texture) { by_look_[look] += of_texture; }

  /// Whether there is none.
  [[nodiscard]] bool empty() const { return by_look_.empty(); }
  // Each the mean over those looks of which there is such a figure; nothing where there is none.
  [[nodiscard]] std::optional<double> relative() const;
  [[nodiscard]] std::optional<double> part_above_target() const;
  [[nodiscard]] std::optional<double> part_of_all() const;

  struct Spread {
    double smallest = 0.0, largest = 0.0;
  };
  /// Of the relative errors of looks.
  [[nodiscard]] std::optional<Spread> spread() const;

 private:
  std::map<LookIndex, PowerError> by_look_;
};

}  // namespace sigmascape::atlas
