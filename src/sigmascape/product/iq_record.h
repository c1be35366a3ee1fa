#pragma once

#include <complex>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/phase_history.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/slant_image.h"

namespace sigmascape::product {

/// One axis of an I/Q recording and where its samples stand.
struct IqAxis {
  std::string name;  ///< "slant_range"
  std::string unit;  ///< "m"
  std::vector<double> values;
};

/// Complex numbers over two axes and the polarizations, with all that a processor must know to use them: what every
/// I/Q file is written from. The samples are looked at, not owned.
struct IqRecord {
  std::string kind;      ///< "phase history"
  std::string unit;      ///< of a sample: "V" or "m"
  std::string quantity;  ///< what a sample means, in words
  IqAxis slow, fast;
  std::vector<std::string> polarizations;         ///< transmit and receive: "VV"
  std::span<const std::complex<float>> samples;   ///< [slow][fast][polarization]
  std::vector<radar::Motion> platform;            ///< one for each place on the slow axis, or one for all
  std::vector<double> beam_azimuth_rad = {};      ///< of the axis, clockwise from north, as many as platforms, or none
  std::vector<IqAxis> cuts = {};                  ///< of a measured antenna: offsets, and gains at as many of them
  std::map<std::string, double> numbers = {};     ///< with their units in their names
  std::map<std::string, std::string> words = {};  ///< where it comes from; no key of `numbers` again
};

/// What comes out of `simulate::phase_history`, of `simulate::range_doppler_image` and `stripmap_image`, and of a live
/// renderer: `amplitudes_m` is [beam][range][VV, HH, HV, VH], `platform` one for all beams or one for each, in the
/// local frame over that Earth. `words` says where it comes from, of which what is a number becomes one
/// (told_numbers.h); the radar's own facts are added. What is passed must outlive the record.
[[nodiscard]] IqRecord iq_record(const radar::PhaseHistory& history, const radar::Radar& radar,
                                 std::map<std::string, std::string> words = {});
[[nodiscard]] IqRecord iq_record(const radar::RangeDopplerImage& image, const radar::Radar& radar,
                                 std::map<std::string, std::string> words = {});
[[nodiscard]] IqRecord iq_record(const radar::StripmapImage& image, const radar::Radar& radar,
                                 std::map<std::string, std::string> words = {});
[[nodiscard]] IqRecord iq_record(const radar::RangeAzimuthGrid& grid, std::span<const std::complex<float>> amplitudes_m,
                                 std::vector<radar::Motion> platform, double frequency_hz,
                                 const radar::CurvedEarth& earth = radar::CurvedEarth::flat(),
                                 std::map<std::string, std::string> words = {});

}  // namespace sigmascape::product
