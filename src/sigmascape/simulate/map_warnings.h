#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// Where an area lies, for radar_warnings.
[[nodiscard]] radar::MappedGround mapped_ground(const radar::Radar& radar, const radar::Rectangle& area,
                                                const terrain::HeightField& terrain,
                                                const radar::CurvedEarth& earth = radar::CurvedEarth::flat());

/// What whoever asks for this map should know before it is made, one sentence each: what radar::radar_warnings objects
/// to, an area of which map_grid() leaves a cell or more out since `extent`, which the scene covers, ends before it,
/// and a beam that points so far above, below or beside what is mapped that all of it lies 20 dB or more under its
/// peak, both ways. Throws Error as map_grid() does.
[[nodiscard]] std::vector<std::string> map_warnings(const radar::Radar& radar, const radar::MapRequest& request,
                                                    const terrain::HeightField& terrain,
                                                    const radar::Rectangle& extent);

/// The same but for what is said of the map's cells: for pulses of what it maps, which have none.
[[nodiscard]] std::vector<std::string> area_warnings(const radar::Radar& radar, const radar::MapRequest& request,
                                                     const terrain::HeightField& terrain,
                                                     const radar::Rectangle& extent);

/// Of a beam whose pattern leaves all that lies in an area 20 dB or more under its peak, both ways, since it points
/// above or below it.
[[nodiscard]] std::optional<std::string> beam_above_or_below(const radar::Radar& radar, const radar::Rectangle& area,
                                                             const terrain::HeightField& terrain);

/// What whoever records pulses of this area should know: that what lies beside it is not in them (`phase_history`),
/// where the half-power beam of a `calibrated` recording is wider, or a range gate that the radar states; which targets
/// answer from outside the gate; and that Doppler folds at one range, of the area or, where the beam is narrower in a
/// `calibrated` recording, of what is within that.
[[nodiscard]] std::vector<std::string> recording_warnings(const radar::Radar& radar, const radar::Rectangle& area,
                                                          const terrain::HeightField& terrain, bool calibrated,
                                                          std::span<const radar::Target> targets = {});

/// All that whoever records pulses as the settings say should know: what interval_warnings() says of the interval that
/// was asked for, if one was, recording_warnings() and scan_beside().
[[nodiscard]] std::vector<std::string> pulse_warnings(const radar::Radar& radar, const radar::Rectangle& area,
                                                      const terrain::HeightField& terrain,
                                                      std::span<const radar::Target> targets,
                                                      std::optional<double> asked_s, const CoherentSettings& settings);

/// Of a real beam that scans while pulses in volts are recorded for so long about `moment_s`, and does not come so near
/// to the area meanwhile that any of it is less than 20 dB under its peak, both ways.
[[nodiscard]] std::optional<std::string> scan_beside(const radar::Radar& radar, const radar::Rectangle& area,
                                                     double interval_s, double moment_s);

}  // namespace sigmascape::simulate
