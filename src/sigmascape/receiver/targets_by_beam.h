#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/echo.h"

namespace sigmascape::receiver {

/// What a beam of a live frame holds of a target: the echo from the target's own place, with the part of its
/// cross-section that is in this beam's bins.
struct EchoInBeam {
  std::uint32_t beam = 0;
  radar::Echo echo;
};

/// What a bin of a live frame held before targets were added to it.
struct BinBefore {
  std::uint32_t bin = 0;  ///< beam · ranges + range
  radar::Channels rcs_m2;
};

/// The targets of a live frame, told apart from what else its bins hold. Both beam by beam, the first beam first.
struct TargetsApart {
  std::span<const EchoInBeam> echoes;
  std::span<const BinBefore> bins;  ///< of one that is here several times the first holds no targets at all
};

/// Keeps them while some beams of a frame are drawn anew and others stay.
class TargetsByBeam {
 public:
  explicit TargetsByBeam(std::size_t ranges) : ranges_(ranges) {}

  /// Takes memory for so many at once.
  void reserve(std::size_t echoes, std::size_t bins);

  struct Room {
    std::span<EchoInBeam> echoes;
    std::span<BinBefore> bins;
  };
  /// Forgets what beams first … first + count − 1 hold and makes room for what they are to hold instead; to be filled
  /// in the order of beams.
  Room renewed(std::size_t first_beam, std::size_t count, std::size_t echoes, std::size_t bins);

  /// Valid until beams are renewed.
  [[nodiscard]] TargetsApart all() const { return {echoes_, bins_}; }

 private:
  std::size_t ranges_;
  std::vector<EchoInBeam> echoes_;
  std::vector<BinBefore> bins_;
};

/// Those of beams first … first + count − 1 of a frame with so many ranges.
[[nodiscard]] TargetsApart of_beams(const TargetsApart& targets, std::size_t first_beam, std::size_t count,
                                    std::size_t ranges);

}  // namespace sigmascape::receiver
