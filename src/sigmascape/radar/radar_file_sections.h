#pragma once

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// The sections of a radar file that say how the radar is made; each fills in its part of the radar and refuses unknown
/// keys. docs/radar_file.md lists the keys.

/// [platform]: how the carrier moves.
void read_platform(const TomlSection& section, Radar& radar);
/// [antenna]; without one, pass nothing: the gain follows from the beam. Returns by what efficiency it does, or nothing
/// where it is stated.
[[nodiscard]] std::optional<double> read_antenna(const std::optional<TomlSection>& section, Radar& radar);
/// [waveform]; gives the radar its range resolution when it states a bandwidth.
void read_waveform(const TomlSection& section, Radar& radar);
void read_receiver(const TomlSection& section, Radar& radar);
void read_scan(const TomlSection& section, Radar& radar);
/// The kind of a [mode], a real beam where it says none.
[[nodiscard]] Mode mode_asked(const TomlSection& section);
/// [mode]; after the platform, whose motion some modes need.
void read_mode(const TomlSection& section, Radar& radar);

}  // namespace sigmascape::radar
