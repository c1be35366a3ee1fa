#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::bake {

/// What is baked in one go, since one set of paths serves it: one patch from one aspect at every frequency.
struct Job {
  atlas::PatchIndex patch;
  radar::Aspect aspect;
  std::vector<atlas::LookIndex> looks;  ///< in the order of the frequencies
};

/// All jobs of an atlas, numbered patch by patch, within a patch elevation by elevation. They are made when asked for,
/// so that an atlas of many patches needs no list of them.
class JobList {
 public:
  explicit JobList(const atlas::AtlasDescription& atlas);

  [[nodiscard]] std::size_t size() const { return patches_.size() * aspects(); }
  [[nodiscard]] const atlas::PatchBlock& patches() const { return patches_; }
  [[nodiscard]] std::size_t looks_per_job() const { return axes_.frequencies_hz.size(); }
  /// Jobs of one patch: jobs with equal remainders on division by it are of one aspect.
  [[nodiscard]] std::size_t aspects() const { return axes_.azimuths_rad.size() * axes_.elevations_rad.size(); }
  [[nodiscard]] Job operator[](std::size_t number) const;

 private:
  atlas::AspectGrid axes_;
  atlas::PatchBlock patches_;
};

}  // namespace sigmascape::bake
