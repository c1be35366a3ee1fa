#pragma once

#include <atomic>
#include <cstddef>

#include "sigmascape/live/live_settings.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/receiver/point_response.h"

namespace sigmascape::live {

/// Counts targets that are seen and have a share in some beams of a frame: those that the beams of a scan's step bring
/// to its picture. By any number of threads at once.
class TargetCount {
 public:
  /// Beams `first` … `first` + `count` − 1 of those of the settings.
  TargetCount(const LiveSettings& settings, std::size_t first, std::size_t count)
      : is_whole_(count == settings.beams),
        first_(static_cast<std::ptrdiff_t>(first)),
        end_(static_cast<std::ptrdiff_t>(first + count)),
        turn_(radar::goes_round(settings.beams, settings.beam_step_rad) ? static_cast<std::ptrdiff_t>(settings.beams)
                                                                        : 0) {}

  /// Gives back the part that is seen of a target, 0 to 1, which stands at `beam` (receiver::TargetFrame::Seen).
  float counted(double beam, float part_seen) {
    if (!is_whole_ && part_seen > 0.0F && has_share(beam)) seen_.fetch_add(1, std::memory_order_relaxed);
    return part_seen;
  }
  /// Of so many that all beams of the frame see.
  [[nodiscard]] std::size_t seen_of(std::size_t by_all) const {
    return is_whole_ ? by_all : seen_.load(std::memory_order_relaxed);
  }

 private:
  /// What begins before the first beam ends in the last ones where beams go round, and the other way round.
  [[nodiscard]] bool has_share(double beam) const {
    const std::ptrdiff_t tap = response().place_of(beam).first_bin;
    return meets(tap) || (turn_ > 0 && (meets(tap + turn_) || meets(tap - turn_)));
  }
  [[nodiscard]] bool meets(std::ptrdiff_t first_tap) const {
    return first_tap < end_ && first_tap + static_cast<std::ptrdiff_t>(response().taps()) > first_;
  }

  /// That of targets in live frames.
  [[nodiscard]] static const receiver::PointResponse& response() {
    static const receiver::PointResponse shared = receiver::PointResponse::shared();
    return shared;
  }

  bool is_whole_;
  std::ptrdiff_t first_, end_, turn_;
  std::atomic<std::size_t> seen_ = 0;
};

}  // namespace sigmascape::live
