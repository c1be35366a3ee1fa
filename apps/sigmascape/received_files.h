#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "map_files.h"

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::cli {

/// What of a receiver's output is to be written; empty names ask for nothing.
struct ReceivedFiles {
  std::string snr, video;
};

void add_received_options(CLI::App& command, ReceivedFiles& files);

/// Passes an image through the receive chain and writes what was asked for. Throws Error when `polarization` is none
/// that a receiver has.
void write_received(const ReceivedFiles& files, const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                    radar::Polarization polarization, std::uint64_t seed, unsigned threads,
                    const Provenance& provenance);

/// Says on standard error what `radar_warnings` finds.
void warn_of(const radar::Radar& radar, const radar::RangeAzimuthGrid& bins, double cell_m);

}  // namespace sigmascape::cli
