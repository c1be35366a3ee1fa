#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "sigmascape/base/progress.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/phase_history.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/slant_image.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/render/ground_scatterers.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/windblown.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// What a coherent mode looks at: ground by its shape and σ0, and targets. All must outlive the call.
struct CoherentScene {
  const terrain::HeightField* terrain = nullptr;
  render::Reflectivity sigma0;  ///< `render::reflectivity_of` an atlas, or any field
  std::span<const radar::Target> targets = {};
  Windblown windblown = {};  ///< where leaves move when the radar's file knows of wind; nowhere without
};

struct CoherentSettings {
  /// Time over which pulses are added up, about time zero, when the radar is at its position.
  double interval_s = 0.1;
  /// Half-power width along the flight that stripmap processes to, with all looks together.
  double along_resolution_m = 1.0;
  /// Side of the cells that hold a scatterer each; 0 for half of what is told apart at the finest, in range or across
  /// it: `scatterer_spacing_m`, and for pulses `pulse_scatterer_spacing_m`.
  double scatterer_spacing_m = 0.0;
  std::uint64_t seed = 1;   ///< of speckle, targets and noise
  std::uint64_t dwell = 0;  ///< by which fluctuating targets and noise are drawn anew, and speckle is not
  /// When time zero is, on the clock by which leaves move and scans turn: both go on from one recording to the next.
  double moment_s = 0.0;
  /// Of a range–Doppler image, the part of the area that is to be right, about whose middle the Doppler axis lies and
  /// the beam points: of the ground around it nothing is there that would fold onto it (DopplerRim). Without it that is
  /// all of the area, which folds as it may.
  std::optional<radar::Rectangle> mapped = {};
  /// Volts at the receiver's output, with antenna, radar equation, thermal noise and, where the radar has them,
  /// sensitivity time control and converter, instead of metres without.
  bool calibrated = false;
  unsigned threads = 0;
  ProgressListener* progress = nullptr;  ///< hears of pulses as they are recorded; images tell nothing
};

/// Throws Error when the radar stands within the ground or lower than all of it, with Mode::Stripmap when it does not
/// move, and when the interval holds less than two pulses or more than memory, or the gate over the area is longer than
/// the unambiguous range, or the area has too many scatterers: before much else is made. Returns how many samples of
/// every polarization there will be.
std::size_t check_recording(const radar::Radar& radar, const radar::Rectangle& area,
                            const terrain::HeightField& terrain, const CoherentSettings& settings);

/// The pulses of one interval, before any processing: I and Q, at the radar's pulse repetition frequency, over the gate
/// that `area` or the radar file asks for. They hold the echoes of the ground of the area and of all targets; what lies
/// beside the area, in the beam or in the gate, is not in them. The axis of the beam is that of `recorded_beam`. Ground
/// and targets are seen where terrain and what the atlas knows to stand there let them, as at time zero, or with
/// Mode::Stripmap as for `stripmap_image`. Cost goes with pulses × scatterers.
///
/// Throws Error as `check_recording` does.
[[nodiscard]] radar::PhaseHistory phase_history(const CoherentScene& scene, const radar::Radar& radar,
                                                const radar::Rectangle& area, const CoherentSettings& settings);

/// Doppler beam sharpening or spotlight SAR of the area as a focused image in slant range and Doppler, in metres.
/// `radar.processing` says whether with the antenna's pattern and with noise. The beam of a spotlight points
/// to the middle of the area, and so does that of a scan of one direction which does not say where; a scanning one is
/// taken to pass over every place. Throws Error when the radar does not move, or stands within the ground or lower than
/// all of it, and when the interval holds less than two pulses.
[[nodiscard]] radar::RangeDopplerImage range_doppler_image(const CoherentScene& scene, const radar::Radar& radar,
                                                           const radar::Rectangle& area,
                                                           const CoherentSettings& settings);

/// Stripmap SAR of the area, in metres, with the beam under the azimuth of a fixed scan, else under that in which the
/// radar sees the middle of the area at time zero (radar/strip_beam.h). All ground and every target are looked at from
/// where the platform is as its beam passes over them: aspect, grazing angle and shadows are those of that moment.
/// Ground beyond the area takes part where its azimuth ambiguities fall into it. Throws Error when the radar does not
/// move, or stands within the ground or lower than all of it.
[[nodiscard]] radar::StripmapImage stripmap_image(const CoherentScene& scene, const radar::Radar& radar,
                                                  const radar::Rectangle& area, const CoherentSettings& settings);

/// The same as so many looks, one after the other: images from equal parts of the pulses, each coarser across range by
/// as much, whose mean power has less speckle.
void range_doppler_looks(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                         const CoherentSettings& settings, std::size_t looks,
                         const std::function<void(const radar::RangeDopplerImage&)>& visit);
void stripmap_looks(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                    const CoherentSettings& settings, std::size_t looks,
                    const std::function<void(const radar::StripmapImage&)>& visit);

/// Where the axis of the beam points whose pattern the image of the radar's mode keeps: in the middle of the interval,
/// of a strip all along it, clockwise from the frame's north. Nothing where the image keeps no pattern, and where a
/// scanning beam passes over every place.
[[nodiscard]] std::optional<double> beam_azimuth_rad(const radar::Radar& radar, const radar::Rectangle& area);

/// To which side of its course the radar looks at an area (radar::look_side).
[[nodiscard]] const char* look_side(const radar::Radar& radar, const radar::Rectangle& area);

/// Adds the targets that the radar sees past these obstructions to an image of the power mode, of whatever level of
/// detail.
void add_targets(radar::RangeAzimuthImage& image, const radar::Radar& radar, const Obstructions& obstructions,
                 std::span<const radar::Target> targets, const radar::Moment& moment);

}  // namespace sigmascape::simulate
