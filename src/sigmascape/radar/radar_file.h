#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// The radar stands where a ground point sees it under these angles.
struct SeenFrom {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double slant_range_m = 0.0;
  std::optional<Vec2d> target;  ///< ground point in the local frame; the centre of the scene when absent
};

/// The radar's own place in the local frame, height above mean sea level.
struct LocalPlace {
  Vec3d position;
};

/// The radar's own place on the Earth, height above mean sea level.
struct GeographicPlace {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
};

/// Left to whoever reads the file, or yet to be said.
struct Unplaced {};

using Place = std::variant<SeenFrom, LocalPlace, GeographicPlace, Unplaced>;

/// What the radar maps and how finely: a rectangle of the local frame (the scene's extent when absent) in square cells.
struct MapRequest {
  std::optional<Rectangle> area;
  double cell_m = 2.0;
};

/// A radar file as read: everything but the scene that it will look at.
struct RadarFile {
  Radar radar;  ///< its position is yet to be resolved from `place`
  Place place;
  MapRequest map;
  /// Of an antenna whose gain follows from the shape of its beam; none where the gain itself is stated.
  std::optional<double> antenna_efficiency = {};
  /// Whether the pulse is as short as its bandwidth lets it be, rather than of a stated length.
  bool has_shortest_pulse = false;
};

/// Makes the real beam so wide in azimuth, one-way at half power, as the file would be read with another
/// `beam_width_deg`: a gain that follows from the beam goes with it, one that is stated stays. Throws Error for a
/// measured beam, whose table has the width.
void set_beam_width(RadarFile& file, double width_rad);

/// States the antenna's gain at the peak, one way over isotropic: it follows from the beam no longer.
void set_antenna_gain(RadarFile& file, double gain);

/// Points the peak so far above the horizontal; a gain that follows from the beam goes with it. Throws Error for a beam
/// that is even in elevation, and for a cosecant-squared one whose peak would lie above the horizontal or steeper than
/// it reaches.
void set_tilt(RadarFile& file, double tilt_rad);

/// States the pulse's length. Throws Error where that has not the bandwidth, and where it leaves the receiver less than
/// half of the time between pulses.
void set_pulse_length(RadarFile& file, double length_s);

/// The widest that the compressed pulse can be at half power: what a pulse of the stated length is without being coded,
/// or of the longest that the repetition allows where the pulse is as short as can be.
[[nodiscard]] double coarsest_range_resolution_m(const RadarFile& file);

/// The half-power width that the compressed pulse must exceed: that of a band about its carrier which begins at no
/// frequency at all.
[[nodiscard]] double finest_range_resolution_m(const Radar& radar);

/// Makes the compressed pulse so wide, at half power, as the file would be read with another `range_resolution_m`: a
/// pulse that is as short as can be goes with it. Throws Error where a pulse of the stated length has not the bandwidth
/// for it, where the shortest one is too long for the repetition, and where the carrier has no room for it.
void set_range_resolution(RadarFile& file, double resolution_m);

/// Sends so many pulses a second. Throws Error where the pulse leaves the receiver less than half of the time between
/// them.
void set_pulse_repetition(RadarFile& file, double repetition_hz);

/// Puts the radar at another carrier. Throws Error where that has no room for the bandwidth of the pulse.
void set_frequency(RadarFile& file, double frequency_hz);

/// Whether a file must say where the radar stands, or may leave it to whoever reads it.
enum class PlaceOfRadar { Required, Optional };

/// Reads a radar file; docs/radar_file.md lists its keys. Throws Error, naming file and key, for what is missing,
/// unknown or out of range.
[[nodiscard]] RadarFile read_radar_file(const std::filesystem::path& path, PlaceOfRadar need = PlaceOfRadar::Required);

/// The same of the text of such a file. Errors call it by its name, in whose folder the files that it names lie.
[[nodiscard]] RadarFile read_radar_text(const std::string& text, const std::filesystem::path& name,
                                        PlaceOfRadar need = PlaceOfRadar::Required);

/// Throws Error when a radar file's mode is another than a real beam, which is all that serves: "datasets are made of
/// real-beam maps". For asking before the file is read as a whole, which has demands of its own on other modes.
void require_real_beam(const std::filesystem::path& radar_file, std::string_view what_serves);

}  // namespace sigmascape::radar
