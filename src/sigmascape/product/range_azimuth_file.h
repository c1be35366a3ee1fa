#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::product {

/// What a range-azimuth file holds besides its numbers.
struct RangeAzimuthLabel {
  std::string quantity;       ///< "signal-to-noise ratio of one pulse, linear power"
  Vec3d radar_position = {};  ///< east, north and up in the scene's frame, m
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> words;
};

/// Throws Error for a name that does not end in .npy.
void check_range_azimuth_name(const std::filesystem::path& path);

/// Writes bins as a NumPy file (.npy, format 1.0: float32, little-endian, [range, azimuth]) and beside it, with the
/// extension .json, where the bins lie and what they hold. Both or neither. Throws Error when the disk is full or the
/// file is not called .npy.
void write_range_azimuth(const std::filesystem::path& path, const radar::RangeAzimuthGrid& grid,
                         const Array2D<float>& bins, const RangeAzimuthLabel& label);

}  // namespace sigmascape::product
