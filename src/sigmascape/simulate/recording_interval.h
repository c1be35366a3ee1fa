#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// How long a real beam is recorded when nobody says.
inline constexpr double usual_interval_s = 0.1;

/// Time of pulses, about time zero, from which the radar's mode maps an area: that of its plan, all looks together, and
/// of a strip that in which its beam passes over the whole area, with the time for which each place is processed.
/// Nothing for a real beam. Throws Error as coherent_plan does.
[[nodiscard]] std::optional<double> interval_of_mode_s(const radar::Radar& radar, const radar::Rectangle& area,
                                                       const terrain::HeightField& terrain);

/// Time over which pulses of an area are recorded: the one that is asked for, else that of the mode, else the usual.
/// Throws Error as coherent_plan does where none is asked for.
[[nodiscard]] double recording_interval_s(std::optional<double> asked_s, const radar::Radar& radar,
                                          const radar::Rectangle& area, const terrain::HeightField& terrain);

/// What whoever asks for so long a recording, or for none in particular, should know: that the radar's mode needs a
/// longer one, or that the pulses of a whole strip are very many.
[[nodiscard]] std::vector<std::string> interval_warnings(std::optional<double> asked_s, const radar::Radar& radar,
                                                         const radar::Rectangle& area,
                                                         const terrain::HeightField& terrain);

/// Adds what a recording says of the radar's mode: its name and, where it can map the area, its interval.
void tell_of_mode(const radar::Radar& radar, const radar::Rectangle& area, const terrain::HeightField& terrain,
                  std::map<std::string, std::string>& words);

}  // namespace sigmascape::simulate
