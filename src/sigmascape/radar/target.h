#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/rcs_table.h"
#include "sigmascape/radar/swerling.h"
#include "sigmascape/radar/track.h"

namespace sigmascape::radar {

/// A point that answers on its own, at every level of detail: a vehicle, a ship, a reflector.
struct Target {
  std::string name;
  Track track;  ///< of its phase centre, height above mean sea level
  /// The same from everywhere, or by aspect. The azimuth of a table counts from the nose, which points along the
  /// velocity, or along `heading_rad` while it stands.
  std::variant<Channels, RcsTable> rcs_m2;
  Swerling fluctuation = Swerling::Case0;
  double heading_rad = 0.0;  ///< clockwise from the frame's north
  std::uint64_t seed = 0;    ///< of its fluctuation; give every target its own
  /// Length along its heading, width and height of a box about its foot that keeps the radar from seeing the ground
  /// behind it; without, it casts no shadow. Its foot is half the height below the phase centre.
  Vec3d size_m = {};
  /// Its own vertical in the frame of its track, from which elevations count: another one where that is a straight
  /// space over an Earth that curves.
  Vec3d up = {0.0, 0.0, 1.0};
};

/// When a target is looked at: fluctuation of cases 1 and 3 goes by dwells, that of 2 and 4 by pulses within them.
struct Moment {
  double time_s = 0.0;
  std::uint64_t dwell = 0;
  std::uint64_t pulse = 0;
};

[[nodiscard]] Motion motion_of(const Target& target, double time_s);
/// Where its nose points, clockwise from the frame's north.
[[nodiscard]] double heading_of(const Target& target, double time_s);

/// The target in the straight space under a foot, place, velocity and vertical right at that time.
[[nodiscard]] Target bent(Target target, const CurvedEarth& earth, Vec2d foot, double time_s);

/// Cross-section as seen from a place, the mean of its fluctuation. `earth`: over which rays come where place and track
/// are of the local frame; in a straight space they are straight.
[[nodiscard]] Channels mean_rcs_of(const Target& target, Vec3d seen_from, double frequency_hz, double time_s,
                                   const CurvedEarth& earth = CurvedEarth::flat());
/// The same at a moment, fluctuation included.
[[nodiscard]] Channels rcs_of(const Target& target, Vec3d seen_from, double frequency_hz, const Moment& moment,
                              const CurvedEarth& earth = CurvedEarth::flat());

/// The same target with so small a part of its cross-section, however that is given.
[[nodiscard]] Target weakened(Target target, double part);

/// Whether the target stands between a place and the radar. In Doppler modes its echo is moved by its velocity, but not
/// its shadow: that is ground which does not answer.
[[nodiscard]] bool hides(const Target& target, double time_s, Vec3d radar_position, Vec3d place);

/// Amplitude in metres with |a|² that cross-section: VV real, HH as far out of phase with it as the correlation says,
/// HV real.                                                                      docs/physics/targets.md, Eq. (3)
[[nodiscard]] ComplexChannels steady_amplitude(const Channels& rcs_m2);

}  // namespace sigmascape::radar
