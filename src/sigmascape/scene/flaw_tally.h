#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// How many flawed features of a source are put up with.
struct FlawLimit {
  double max_share = 0.5;  ///< of all features of the source, for each kind of flaw
  bool strict = false;     ///< none at all
};

/// Counts what had to be mended or left out of one source, kind by kind, and remembers the first of each.
class FlawTally {
 public:
  /// A fault of the data: counts against the limit. `kind` is a phrase such as "trees standing in water, left out".
  void flaw(const std::string& kind, const std::string& which, std::size_t count = 1) {
    if (count > 0) add(kind, which, count, true);
  }
  /// Something left out by rights, such as what lies outside the scene, or stood in for as the scene file says.
  void note(const std::string& kind, const std::string& which, std::size_t count = 1) {
    if (count > 0) add(kind, which, count, false);
  }
  /// Something that a file is hardly meant to be like: a note of which those are warned who work with the scene.
  void mistake(const std::string& kind, const std::string& which, std::size_t count = 1) {
    if (count > 0) add(kind, which, count, false).is_likely_a_mistake = true;
  }

  /// Says of what was noted of a kind, if anything was, that it is all that the source holds: likely a mistake.
  void leaves_nothing(const std::string& kind);

  /// Turns the counts into remarks of the scene. Throws Error at `where` (a file) when a flaw is too common among
  /// `total` features.
  void settle(const std::string& where, std::size_t total, const FlawLimit& limit, std::vector<Remark>& remarks) const;

 private:
  struct Entry {
    Remark remark;
    bool is_flaw;
  };
  Remark& add(const std::string& kind, const std::string& which, std::size_t count, bool is_flaw);
  std::vector<Entry> entries_;
};

}  // namespace sigmascape::scene
