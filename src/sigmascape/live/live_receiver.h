#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/base/worker_team.h"
#include "sigmascape/live/frame.h"
#include "sigmascape/live/ground_hearing.h"
#include "sigmascape/live/kept_ground.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/receiver/bin_response.h"
#include "sigmascape/receiver/echo_places.h"
#include "sigmascape/receiver/placed_response_table.h"
#include "sigmascape/receiver/receive_chain.h"

namespace sigmascape::live {

/// What a radar hears of a live frame in one polarization, valid until its receiver hears the next.
struct HeardPower {
  radar::RangeAzimuthGrid grid;
  /// [beam][range], W, as the bins of the frame: mean power at the antenna's terminals of a compressed pulse with the
  /// beam's axis in the bin's middle and the receiver sampling there. NaN where nothing is heard: in ranges outside the
  /// gate and in azimuths that the scan never comes to.
  std::span<const float> signal_w;
  double noise_w = 0.0;  ///< mean noise beside it, k T₀ B F, the same in every bin
  /// Beams that the last call made anew, `changed` of them from `first_changed` on; behind the last beam comes the
  /// first one.
  std::size_t first_changed = 0, changed = 0;
};

/// The same for the receiver's detector and for pictures, of which it is a copy.
[[nodiscard]] receiver::ReceivedPower received_power(const HeardPower& heard);

/// What a radar hears of live frames, in watts: of whole frames, or step by step of a scan.
///
///     LiveReceiver receiver(radar, radar::Polarization::VV, ground);
///     const HeardPower& heard = receiver.hear(renderer.scan(pose, first_beam, count));
///
/// Watts are those of receiver::received_power of live::image_of with that radar, which says what they mean
/// (frame_image.h; docs/physics/receiver.md, Eqs. (1), (3)). Only beams that were drawn since the last time are heard
/// anew, and those about them that the response of the antenna brings them into. Steps of a turn come to the bytes of
/// the frame as a whole, and so do frames of which some steps were not heard: each beam's ground is weighed from where
/// the radar was when the beam was drawn (Frame::beams). While a scan goes on first azimuth and first range of its
/// poses stay, as for LiveRenderer::scan.
///
/// Responses and memory are kept while bins stay as wide and as many as they are, gains in elevation while the radar
/// stands still, and heights of the ground within some kilometres (KeptGround). The result does not depend on the
/// number of threads, nor on what was kept. Nothing is allocated once the most targets have been heard, but for another
/// window of the ground. For one caller at a time.
class LiveReceiver {
 public:
  /// `ground`: that the bins lie on, from which gains in elevation follow; none is asked for by an antenna that is even
  /// in elevation. Of a traced frame it is what its scene's terrain says (GroundHeight). `threads`: 0: one a hardware
  /// thread. Throws Error for the sum of polarizations, and for an antenna that tells elevations apart without ground.
  LiveReceiver(radar::Radar radar, radar::Polarization polarization, KeptGround ground = {}, unsigned threads = 0);

  /// All that has changed since the last time: all beams the first time, of a frame whose bins lie otherwise or that
  /// somebody else has drawn, and when tiles of the ground have come that were lacking. Throws Error as `check_holds`
  /// does and for a radar whose frequency is more than a hundredth from the frame's.
  const HeardPower& hear(const Frame& frame);

  [[nodiscard]] const radar::Radar& radar() const { return radar_; }
  [[nodiscard]] double noise_w() const { return heard_.noise_w; }
  /// What holds HeardPower::signal_w, for whoever looks at it for longer than the receiver lives or hears frames of as
  /// many bins: those of another number are heard into other memory. Empty before the first frame.
  [[nodiscard]] std::shared_ptr<const std::vector<float>> signal() const { return signal_w_; }

 private:
  struct Beams {
    std::size_t first = 0, count = 0;
  };
  /// How the radar answers in bins of one width.
  struct Responses {
    Responses(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid);

    double range_step_m, azimuth_step_rad, compression_gain;
    receiver::BinResponse along, across;
    receiver::PlacedResponseTable point_along, point_across;
    GroundHearing ground;
    receiver::EchoPlaces targets;

    /// Beams to either side that a beam's ground reaches.
    [[nodiscard]] std::size_t ground_reach() const { return across.weights.size() / 2; }
    /// And its targets, which stand up to two beams beside those that hold them.
    [[nodiscard]] std::size_t target_reach() const { return point_across.taps() / 2 + 2; }
    void move_to(const radar::RangeAzimuthGrid& grid);
  };
  /// From where the gains in elevation of a beam were found, and over which heights.
  struct WeighedFrom {
    Vec3d position;
    double curvature_per_m = 0.0;
    std::uint64_t window = 0;  // KeptGround::windows

    friend bool operator==(const WeighedFrom&, const WeighedFrom&) = default;
  };
  /// An echo of a target that a beam holds a part of, ready to be laid over the bins. Nothing of it where it is 0 m².
  struct PlacedEcho {
    receiver::PlacedResponseTable::Place across, along;
    float rcs_m2 = 0.0F;
  };
  /// What one thread needs besides.
  struct Scratch {
    std::vector<float> held, heard, targets;
  };

  /// Makes ready for bins of that grid.
  void take_bins(const radar::RangeAzimuthGrid& grid);
  /// Some beams and so many to both sides, as far as there are beams.
  [[nodiscard]] Beams with_beside(Beams beams, std::size_t reach) const;
  /// Calls `body(beam)` for each; behind the last beam comes the first one.
  template <typename Body>
  void for_each(Beams beams, Body&& body) const;
  [[nodiscard]] std::span<const float> weights_of(std::size_t beam) const;
  /// As few beams side by side as hold all that were drawn since they were heard, or whose ground is known better now.
  [[nodiscard]] Beams drawn_since(const Frame& frame) const;
  /// The first of some beams, as many as look at ground of one window, which is there then: all of them where heights
  /// do not count.
  [[nodiscard]] Beams over_one_window(const Frame& frame, Beams beams);
  [[nodiscard]] WeighedFrom weighed_from_now(const Frame& frame, std::size_t beam) const {
    return {frame.beams[beam].radar, frame.earth.curvature_per_m(), ground_.windows()};
  }
  /// Whether the gains in elevation of a beam are those of elsewhere.
  [[nodiscard]] bool is_to_be_weighed(const Frame& frame, std::size_t beam) const;
  void weigh(const Frame& frame, std::size_t beam);
  void hear_ground(const Frame& frame, Beams beams);
  /// The ground of a beam with the response of the pulse.
  void hear_ground(const Frame& frame, std::size_t beam, Scratch& scratch);
  /// The echoes that beams hold.
  void place_targets(const Frame& frame, Beams beams);
  void place(const receiver::EchoInBeam& echo, PlacedEcho& placed) const;
  /// A beam of what comes out, from the ground and the targets of all beams that reach it.
  void lay_over(const Frame& frame, std::size_t beam, Scratch& scratch);
  void add_targets(const Frame& frame, std::size_t beam, std::span<float> sums) const;
  void add_target(const PlacedEcho& echo, std::size_t beam, std::span<float> sums) const;
  [[nodiscard]] std::span<float> line_of(std::size_t beam) {
    return std::span(lines_).subspan(beam * grid_.ranges, grid_.ranges);
  }
  [[nodiscard]] std::span<const float> line_of(std::size_t beam) const {
    return std::span(lines_).subspan(beam * grid_.ranges, grid_.ranges);
  }
  /// Calls `body(index, scratch)` for all below `count`, on threads where the work is worth waking them.
  template <typename Body>
  void run(std::size_t count, std::size_t operations_each, Body&& body);

  radar::Radar radar_;
  radar::Polarization polarization_;
  KeptGround ground_;
  WorkerTeam team_;
  radar::RangeAzimuthGrid grid_;
  bool has_bins_ = false;
  std::optional<Responses> responses_;
  std::vector<double> factors_;                           // [range], W/m²
  std::vector<float> watts_per_m2_;                       // [range]; NaN where nothing is heard
  std::vector<std::uint8_t> looked_at_;                   // [beam]
  std::vector<std::uint64_t> heard_drawings_;             // [beam]
  std::vector<float> weights_;                            // [beam][range], of an even antenna [range]
  std::vector<std::optional<WeighedFrom>> weighed_from_;  // [beam]
  std::vector<float> lines_;                              // [beam][range], m²: ground with the response of the pulse
  std::vector<std::uint8_t> dark_;                        // [beam]: a line of nothing
  std::vector<PlacedEcho> echoes_;                        // as the frame has them
  std::vector<Scratch> scratch_;                          // one a worker
  std::shared_ptr<std::vector<float>> signal_w_;          // [beam][range]
  HeardPower heard_;
};

}  // namespace sigmascape::live
