#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/scatterer.h"
#include "sigmascape/radar/slant_image.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/receiver/equivalent_noise.h"
#include "sigmascape/receiver/multilook.h"
#include "sigmascape/receiver/range_gate.h"
#include "sigmascape/receiver/response_plane.h"
#include "sigmascape/receiver/strip_pattern.h"
#include "sigmascape/receiver/strip_target.h"
#include "sigmascape/receiver/voltage_gain.h"

namespace sigmascape::receiver {

/// A strip along a straight flight.
struct Strip {
  double first_along_m = 0.0;  ///< from where the platform is at time zero, along its velocity
  double last_along_m = 0.0;
  double resolution_m = 1.0;  ///< half-power width along the flight: half the antenna's length at best
  radar::Window window = {};  ///< over the processed Doppler band
  double oversampling = 1.5;  ///< bins a resolution cell, at least 1
  double squint_rad = 0.0;    ///< of the beam, ahead of broadside
  bool looks_left = false;    ///< of the flight
  double ground_m = 0.0;      ///< height of what is mapped, above mean sea level
  double relief_m = 0.0;      ///< by how much some of the ground may be higher
  std::uint64_t dwell = 0;    ///< by which fluctuating targets are drawn
};

/// An azimuth ambiguity of a strip: what the pulses fold into the processed band from this number of repetition
/// frequencies away.
struct AzimuthAmbiguity {
  int order = 0;
  double power = 0.0;          ///< of the ghost over that of the point itself
  double least_shift_m = 0.0;  ///< along the flight, from a point to its ghost, over the range gate
  double most_shift_m = 0.0;
  double least_outwards_m = 0.0;  ///< over level ground, away from the track, likewise
  double most_outwards_m = 0.0;
};

/// Stripmap SAR in the image domain: every point answers at its closest slant range and its place along the flight,
/// with the exact responses of band and processed Doppler; movers stand where a point at rest would have their range
/// and Doppler, and are smeared over what their Doppler rate differs. Slant geometry; the
/// antenna's gain is that on the axis of the beam unless `gain` says otherwise. Ghosts are added on request, one order
/// after the other. docs/physics/doppler.md, Eqs. (5), (6), (13), (14).
class StripmapImager {
 public:
  /// `platform`: at time zero. Throws Error when gate or strip make no sense, the platform stands still, or the band
  /// that the resolution takes is wider than the pulse repetition frequency.
  StripmapImager(const radar::Radar& radar, const radar::Motion& platform, const Strip& strip, const RangeGate& gate,
                 VoltageGain gain = {});

  /// The orders of which ghosts are within 60 dB of the point itself, by the antenna's pattern in azimuth and the pulse
  /// repetition frequency. docs/physics/doppler.md, Eq. (14).
  [[nodiscard]] std::vector<AzimuthAmbiguity> ambiguities() const;

  /// Points where they are or, of an order other than 0, their ghosts. A ghost of ground is put in one place of the
  /// patch over which the processor smears it, drawn for each scatterer; of targets all is shown (strip_parts), movers
  /// as weak as the beam leaves them and folded as the pulses fold them, with order 0 the brightest of their images.
  void add(std::span<const radar::Scatterer> ground, unsigned threads = 0, int order = 0);
  void add(std::span<const radar::Target> targets, int order = 0);
  /// Thermal noise, in place of what there was of it; lifted as on level ground.
  void add(const EquivalentNoise& noise);

  /// All pulses as one look, or one of several that have equal parts of them: each has speckle and noise of its own,
  /// and cells that are wider across range by as much as it has fewer pulses. Throws Error when a look would have none.
  [[nodiscard]] radar::StripmapImage image(const Subband& part = {}, unsigned threads = 0) const;

 private:
  struct Seen;
  [[nodiscard]] StripProcessing processing() const;
  struct Fold;
  [[nodiscard]] Fold unfolded() const;
  [[nodiscard]] Fold fold_of(int order, double part_of_band) const;
  [[nodiscard]] double ghost_voltage(const Fold& fold, double sine_depression) const;
  [[nodiscard]] double noise_lift(double closest_m) const;
  [[nodiscard]] Vec3d ground_beside(double range_m) const;
  [[nodiscard]] double height_over_ground_m(double along_m) const;
  [[nodiscard]] double height_over_middle_m() const;
  [[nodiscard]] double nearest_ground_m() const;
  [[nodiscard]] double sine_depression_at(double closest_m) const;
  [[nodiscard]] Seen seen(Vec3d position, double own_range_rate_mps, const Fold& fold) const;
  [[nodiscard]] PlacedAmplitude placed(const Seen& seen, Vec3d position, const radar::ComplexChannels& amplitude) const;

  Strip strip_;
  GatedAxis along_, range_;
  VoltageGain gain_;
  radar::StripmapImage frame_;  // without bins
  double speed_mps_, band_per_m_, repetition_hz_;
  Vec3d direction_;
  StripPattern pattern_;
  radar::WindowResponse response_;
  std::vector<radar::CosineTerm> window_terms_;
  ResponsePlane plane_;
  RowNoise noise_;
};

}  // namespace sigmascape::receiver
