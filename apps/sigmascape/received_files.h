#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "command_parser.h"
#include "map_files.h"

#include "sigmascape/geo/local_frame.h"
#include "sigmascape/radar/power_map.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::cli {

/// What of a receiver's output is to be written; empty names ask for nothing.
struct ReceivedFiles {
  std::string snr, video;
};

void add_received_options(Command command, ReceivedFiles& files);

/// Throws Error for names that do not tell their kind of file.
void check(const ReceivedFiles& files);
/// Throws Error when something is asked for of a polarization that no receiver has.
void check(const ReceivedFiles& files, radar::Polarization polarization);

/// Passes an image through the receive chain and writes what was asked for.
void write_received(const ReceivedFiles& files, const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                    radar::Polarization polarization, std::uint64_t seed, unsigned threads,
                    const Provenance& provenance);

/// What a pulse receives from each place on the ground, described: the image through the radar equation.
[[nodiscard]] radar::PowerMap received_map(const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                                           const terrain::HeightField& terrain, const radar::GroundGrid& grid,
                                           const geo::LocalFrame& frame, const Provenance& provenance,
                                           unsigned threads);

/// Says on standard error what whoever maps with this radar should know (simulate::map_warnings).
void warn_of(const radar::Radar& radar, std::span<const std::string> warnings);

}  // namespace sigmascape::cli
