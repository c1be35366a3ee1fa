#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "sigmascape/base/worker_team.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/receiver/point_response.h"
#include "sigmascape/receiver/targets_by_beam.h"

namespace sigmascape::receiver {

/// The bins of a live frame that stay the same from frame to frame, and how a point answers in them.
struct TargetFrameBins {
  double frequency_hz = 10e9;
  std::size_t beams = 512, ranges = 512;
  double beam_step_rad = 2e-3, range_step_m = 15.0;
  PointResponse across = PointResponse::shared(), along = PointResponse::shared();
};

/// Where the radar is and where its bins begin.
struct TargetFramePose {
  Vec3d position;                  ///< local frame, height above mean sea level
  double first_azimuth_rad = 0.0;  ///< left edge of beam 0, clockwise from north
  double first_range_m = 1000.0;   ///< near edge of range bin 0
  radar::CurvedEarth earth = {};
};

/// Targets and movers in the bins of a live frame, thousands of them in a part of a millisecond.
///
/// Meant for a renderer that fills the bins of its ground by sectors, beam by beam: `look` once a frame finds every
/// target's place, cross-section and phase and puts them in order of beams; then each sector, on whatever thread, adds
/// those of its beams to its own bins, after the ground:
///
///     targets.look(list, pose, moment, sight, &team);
///     targets.tell_apart(0, beams);
///     team.run(sectors, [&](std::size_t s, unsigned) { fill_ground(s); targets.add_amplitudes(first(s), count, bins);
///     });
///
/// A bin gets its targets always in the same order, so that the bytes depend neither on the number of threads nor on
/// how beams are cut into sectors. A target is never left out for being weak or small, only for lying outside the bins
/// or behind what `sight` knows. Nothing is allocated once the most targets have been seen. No noise, no antenna gain:
/// cross-sections, as the ground of live frames is.
class TargetFrame {
 public:
  /// A target as the frame sees it, for finding out what stands before it.
  struct Seen {
    Vec3d position;           ///< height above mean sea level
    double distance_m = 0.0;  ///< over the ground
    double beam = 0.0;        ///< place in beams, 0.5 being the middle of beam 0
  };
  /// The part of a target's power that gets through, out and back: 0 behind a hill, 1 in the open. Called from several
  /// threads at once.
  using Sight = std::function<float(const Seen& seen)>;

  explicit TargetFrame(TargetFrameBins bins);

  /// Finds the targets of one frame. Without `sight` all are seen.
  void look(std::span<const radar::Target> targets, const TargetFramePose& pose, const radar::Moment& moment,
            const Sight& sight = {}, WorkerTeam* team = nullptr);

  /// From here on keeps apart what is added to beams first … first + count − 1, whose bins hold no targets yet, in
  /// place of what it has kept of them; of other beams it keeps what it has. Left out, nothing of this look is kept.
  void tell_apart(std::size_t first_beam, std::size_t count);
  /// What was kept, complete once targets have been added to those beams; valid until the next `tell_apart`.
  [[nodiscard]] TargetsApart apart() const { return by_beam_.all(); }

  /// How many stand in the frame and are seen.
  [[nodiscard]] std::size_t seen() const { return starts_.back(); }

  /// Adds what was looked at to beams first … first + count − 1. `amplitudes_m`: those of the whole frame,
  /// [beam][range] [VV, HH, HV, VH], metres, with the phase of the way out and back. May be called at once for beams
  /// that differ.
  void add_amplitudes(std::size_t first_beam, std::size_t count, std::span<std::complex<float>> amplitudes_m);
  /// The same in power: [beam][range][VV, HH, HV, Re VV·HH*], m².
  void add_powers(std::size_t first_beam, std::size_t count, std::span<float> powers_m2);

 private:
  /// A target in its place: one line of cache.
  struct alignas(64) Placed {
    static constexpr std::int32_t nowhere = std::numeric_limits<std::int32_t>::min();

    std::array<float, 6> amplitude_m;  // VV, HH, HV; real and imaginary parts
    std::array<float, 4> power_m2;
    std::int32_t first_beam = nowhere, first_range = 0;
    float beams_on = 0.0F,
          ranges_on = 0.0F;  // from the left edge of the first beam and the near one of the first range
    float sin_depression = 0.0F;
    std::uint16_t beam_row = 0, range_row = 0;  // of the tables

    [[nodiscard]] bool is_seen() const { return first_beam != nowhere; }
  };
  static_assert(sizeof(Placed) == 64);

  [[nodiscard]] Placed placed(const radar::Target& target, const TargetFramePose& pose, Vec2d middle,
                              const radar::Moment& moment, const Sight& sight) const;
  void sort();
  template <typename Content>
  void add(std::size_t first_beam, std::size_t count, float* frame);
  /// Of those that look was at, how many have a share in a beam.
  [[nodiscard]] std::uint32_t sharing(std::size_t beam) const;
  /// Keeps what tap `tap` across of a point brings to a beam, and what the bins in its row held before.
  template <typename Content>
  void keep(const Placed& point, std::size_t tap, std::size_t beam, const float* row);

  TargetFrameBins bins_;
  bool goes_round_;  // beam 0 lies next to the last one
  double ranges_per_m_, beams_per_rad_;
  std::vector<Placed> found_, sorted_;                    // as the targets were given; those seen, by first beam
  std::vector<std::uint32_t> starts_;                     // in `sorted_`, by first beam + taps − 1
  double first_azimuth_rad_ = 0.0, first_range_m_ = 0.0;  // of the last look
  TargetsByBeam by_beam_;
  TargetsByBeam::Room room_;                         // of the beams that are told apart
  std::vector<std::uint32_t> next_kept_, kept_end_;  // of the echoes in it, by beam
};

}  // namespace sigmascape::receiver
