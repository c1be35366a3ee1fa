#pragma once

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

#include "sigmascape/scatter/ulaby_dobson_table.h"

namespace sigmascape::physics_test {

using Class = scatter::TerrainClass;
using Band = scatter::UlabyDobsonBand;
using Channel = scatter::UlabyDobsonChannel;

inline constexpr std::array incidences_deg{10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0};

struct Curve {
  Class terrain;
  Band band;
  Channel channel;
  std::array<double, 7> sigma0_db;  // over incidences_deg
};

// Evaluated from the coefficients by an independent program and rounded to 0.001 dB.
inline constexpr Curve curves[] = {
    {Class::Soil, Band::L, Channel::HH, {-2.501, -7.622, -11.769, -15.501, -19.642, -25.402, -34.553}},
    {Class::Soil, Band::L, Channel::HV, {-22.425, -26.220, -28.258, -29.353, -29.941, -30.257, -30.427}},
    {Class::Soil, Band::L, Channel::VV, {-3.671, -10.601, -14.750, -17.018, -19.412, -23.623, -29.836}},
    {Class::Soil, Band::S, Channel::HH, {-3.818, -8.710, -12.441, -15.680, -19.105, -23.238, -28.314}},
    {Class::Soil, Band::S, Channel::HV, {-20.391, -23.355, -24.584, -24.962, -25.117, -25.482, -26.341}},
    {Class::Soil, Band::S, Channel::VV, {-3.881, -8.976, -12.403, -14.684, -17.026, -20.460, -25.113}},
    {Class::Soil, Band::C, Channel::HH, {-3.077, -6.988, -10.190, -12.811, -14.958, -16.715, -18.154}},
    {Class::Soil, Band::C, Channel::HV, {-16.233, -19.212, -21.382, -22.962, -24.113, -24.951, -25.562}},
    {Class::Soil, Band::C, Channel::VV, {-2.674, -6.661, -9.985, -12.755, -15.065, -16.990, -18.595}},
    {Class::Grass, Band::L, Channel::HH, {-6.256, -15.281, -19.659, -21.171, -22.004, -23.737, -26.581}},
    {Class::Grass, Band::L, Channel::HV, {-22.488, -28.423, -32.079, -34.072, -35.070, -35.706, -36.451}},
    {Class::Grass, Band::L, Channel::VV, {-5.721, -14.382, -18.981, -21.161, -22.534, -24.157, -26.181}},
    {Class::Grass, Band::S, Channel::HH, {-5.634, -12.380, -15.817, -17.142, -17.581, -18.112, -19.124}},
    {Class::Grass, Band::S, Channel::HV, {-19.431, -22.911, -24.334, -25.062, -26.015, -27.456, -29.033}},
    {Class::Grass, Band::S, Channel::VV, {-5.121, -11.829, -15.651, -17.588, -18.535, -19.205, -19.969}},
    {Class::Grass, Band::C, Channel::HH, {-2.846, -7.955, -11.675, -13.819, -14.455, -14.106, -13.584}},
    {Class::Grass, Band::C, Channel::HV, {-12.127, -15.078, -17.471, -19.123, -20.003, -20.315, -20.426}},
    {Class::Grass, Band::C, Channel::VV, {-2.291, -7.259, -10.694, -12.609, -13.375, -13.635, -14.130}},
    {Class::ShortVegetation, Band::L, Channel::HH, {-6.069, -12.207, -16.047, -18.668, -20.825, -22.886, -24.855}},
    {Class::ShortVegetation, Band::L, Channel::HV, {-22.557, -24.855, -26.893, -28.700, -30.301, -31.722, -32.981}},
    {Class::ShortVegetation, Band::L, Channel::VV, {-6.627, -13.233, -17.125, -19.063, -20.048, -20.983, -22.280}},
    {Class::ShortVegetation, Band::S, Channel::HH, {-6.160, -11.109, -14.346, -16.462, -17.846, -18.751, -19.343}},
    {Class::ShortVegetation, Band::S, Channel::HV, {-19.226, -21.071, -22.468, -23.566, -24.546, -25.591, -26.870}},
    {Class::ShortVegetation, Band::S, Channel::VV, {-6.104, -11.267, -14.235, -15.610, -16.279, -17.049, -18.252}},
    {Class::ShortVegetation, Band::C, Channel::HH, {-3.860, -7.612, -10.313, -12.176, -13.464, -14.472, -15.495}},
    {Class::ShortVegetation, Band::C, Channel::HV, {-13.661, -15.587, -16.949, -17.905, -18.650, -19.394, -20.339}},
    {Class::ShortVegetation, Band::C, Channel::VV, {-4.084, -7.644, -10.052, -11.614, -12.703, -13.713, -15.024}},
    {Class::Shrubs, Band::L, Channel::HH, {-5.883, -11.163, -14.806, -17.542, -19.860, -21.955, -23.767}},
    {Class::Shrubs, Band::L, Channel::HV, {-22.773, -24.226, -25.657, -27.067, -28.456, -29.824, -31.172}},
    {Class::Shrubs, Band::L, Channel::VV, {-6.974, -12.749, -16.285, -18.129, -18.932, -19.380, -20.131}},
    {Class::Shrubs, Band::C, Channel::HH, {-4.099, -7.323, -9.738, -11.545, -12.993, -14.350, -15.873}},
    {Class::Shrubs, Band::C, Channel::HV, {-14.092, -15.623, -16.668, -17.419, -18.105, -18.955, -20.162}},
    {Class::Shrubs, Band::C, Channel::VV, {-4.648, -7.793, -9.896, -11.286, -12.359, -13.523, -15.146}},
    {Class::DrySnow, Band::L, Channel::HH, {-8.737, -17.010, -20.895, -22.571, -23.832, -26.037, -30.075}},
    {Class::DrySnow, Band::L, Channel::HV, {-23.331, -29.511, -32.502, -33.752, -34.546, -35.949, -38.750}},
    {Class::DrySnow, Band::L, Channel::VV, {-7.802, -15.822, -20.210, -22.566, -24.236, -26.288, -29.487}},
    {Class::DrySnow, Band::S, Channel::HH, {-8.698, -13.741, -15.599, -17.125, -19.321, -22.483, -26.616}},
    {Class::DrySnow, Band::S, Channel::HV, {-22.201, -24.811, -26.293, -27.932, -29.933, -32.305, -35.017}},
    {Class::DrySnow, Band::S, Channel::VV, {-8.542, -12.946, -15.329, -17.594, -20.095, -22.874, -25.907}},
    {Class::DrySnow, Band::C, Channel::HH, {-9.242, -12.445, -13.705, -15.048, -16.809, -19.017, -21.646}},
    {Class::DrySnow, Band::C, Channel::HV, {-20.059, -22.078, -22.971, -24.235, -25.812, -27.299, -28.278}},
    {Class::DrySnow, Band::C, Channel::VV, {-9.446, -13.028, -14.692, -16.300, -18.084, -19.976, -21.851}},
    {Class::WetSnow, Band::L, Channel::HH, {-7.579, -15.459, -19.474, -21.476, -22.981, -25.150, -28.769}},
    {Class::WetSnow, Band::L, Channel::HV, {-21.873, -27.204, -29.635, -30.588, -31.339, -32.936, -36.143}},
    {Class::WetSnow, Band::L, Channel::VV, {-6.967, -14.864, -18.985, -21.079, -22.612, -24.731, -28.238}},
    {Class::WetSnow, Band::S, Channel::HH, {-7.075, -12.635, -15.264, -17.346, -19.697, -22.563, -25.977}},
    {Class::WetSnow, Band::S, Channel::HV, {-21.067, -23.425, -25.275, -27.182, -29.178, -31.254, -33.398}},
    {Class::WetSnow, Band::S, Channel::VV, {-6.961, -11.901, -14.597, -16.984, -19.516, -22.277, -25.258}},
    {Class::WetSnow, Band::C, Channel::HH, {-9.059, -12.674, -14.679, -16.562, -18.500, -20.506, -22.574}},
    {Class::WetSnow, Band::C, Channel::HV, {-20.421, -22.294, -23.619, -25.052, -26.403, -27.438, -27.973}},
    {Class::WetSnow, Band::C, Channel::VV, {-9.388, -12.814, -15.109, -17.163, -19.026, -20.684, -22.126}},
};

// The same of the rows that were not checked against the book.
inline constexpr Curve unverified_curves[] = {
    {Class::Soil, Band::X, Channel::HH, {0.763, -3.170, -6.773, -9.963, -12.663, -14.811, -16.353}},
    {Class::Soil, Band::X, Channel::HV, {-13.408, -16.354, -18.237, -19.561, -20.891, -22.749, -25.518}},
    {Class::Soil, Band::X, Channel::VV, {-4.542, -7.513, -9.102, -10.158, -11.523, -13.822, -17.313}},
    {Class::Soil, Band::Ku, Channel::HH, {-3.992, -7.588, -10.541, -12.583, -13.764, -14.436, -15.121}},
    {Class::Soil, Band::Ku, Channel::VV, {-1.015, -3.816, -6.471, -8.590, -10.131, -11.435, -12.976}},
    {Class::Trees, Band::X, Channel::HH, {-8.850, -9.575, -10.404, -11.303, -12.234, -13.158, -14.038}},
    {Class::Trees, Band::X, Channel::VV, {-8.556, -9.329, -10.403, -11.645, -12.900, -14.013, -14.843}},
    {Class::Grass, Band::X, Channel::HH, {-2.231, -5.861, -9.153, -11.485, -12.750, -13.443, -14.330}},
    {Class::Grass, Band::X, Channel::HV, {-10.013, -16.870, -18.141, -18.463, -18.647, -18.833, -19.047}},
    {Class::Grass, Band::X, Channel::VV, {-3.045, -7.581, -11.269, -13.511, -14.305, -14.291, -14.406}},
    {Class::Grass, Band::Ku, Channel::HH, {-3.664, -6.801, -9.256, -11.114, -12.482, -13.486, -14.264}},
    {Class::Grass, Band::Ku, Channel::VV, {-3.396, -7.259, -10.682, -13.135, -14.248, -14.223, -13.796}},
    {Class::Grass, Band::Ka, Channel::HH, {-6.630, -6.681, -7.553, -9.053, -10.537, -11.370, -11.379}},
    {Class::Grass, Band::Ka, Channel::VV, {-7.332, -7.308, -8.029, -9.409, -10.887, -11.829, -11.983}},
    {Class::Shrubs, Band::S, Channel::HH, {-6.331, -10.900, -14.107, -16.292, -17.732, -18.682, -19.358}},
    {Class::Shrubs, Band::S, Channel::HV, {-19.397, -20.474, -21.577, -22.712, -23.884, -25.099, -26.360}},
    {Class::Shrubs, Band::S, Channel::VV, {-6.431, -11.059, -13.715, -14.839, -15.339, -16.116, -17.535}},
    {Class::Shrubs, Band::X, Channel::HH, {-3.390, -5.603, -7.557, -9.096, -10.336, -11.586, -13.124}},
    {Class::Shrubs, Band::X, Channel::VV, {-3.505, -5.833, -7.597, -8.849, -9.979, -11.440, -13.424}},
    {Class::Shrubs, Band::Ku, Channel::HH, {-2.566, -4.680, -6.316, -7.457, -8.418, -9.625, -11.310}},
    {Class::Shrubs, Band::Ku, Channel::VV, {-2.152, -4.264, -5.975, -7.276, -8.429, -9.780, -11.514}},
    {Class::ShortVegetation, Band::X, Channel::HH, {-3.071, -5.656, -8.009, -9.767, -10.967, -12.018, -13.412}},
    {Class::ShortVegetation, Band::X, Channel::HV, {-15.717, -16.387, -15.851, -15.680, -16.206, -17.088, -17.703}},
    {Class::ShortVegetation, Band::X, Channel::VV, {-3.303, -6.241, -8.676, -10.239, -11.159, -12.095, -13.668}},
    {Class::ShortVegetation, Band::Ku, Channel::HH, {-2.725, -5.206, -7.264, -8.654, -9.585, -10.572, -12.069}},
    {Class::ShortVegetation, Band::Ku, Channel::HV, {-15.106, -14.715, -13.492, -12.714, -13.007, -14.174, -15.384}},
    {Class::ShortVegetation, Band::Ku, Channel::VV, {-2.334, -4.907, -7.324, -9.080, -10.122, -10.886, -11.984}},
    {Class::ShortVegetation, Band::Ka, Channel::HH, {-6.173, -6.588, -7.181, -8.001, -9.090, -10.486, -12.217}},
    {Class::ShortVegetation, Band::Ka, Channel::VV, {-6.991, -7.110, -7.455, -8.102, -9.115, -10.548, -12.440}},
    {Class::DrySnow, Band::X, Channel::HH, {-6.226, -8.210, -8.952, -10.360, -12.442, -14.728, -16.647}},
    {Class::DrySnow, Band::X, Channel::HV, {-0.438, -12.023, -13.332, -14.627, -17.210, -20.229, -22.359}},
    {Class::DrySnow, Band::X, Channel::VV, {-3.793, -6.139, -7.800, -10.138, -12.795, -15.049, -16.254}},
    {Class::DrySnow, Band::Ku, Channel::HH, {-3.566, -5.782, -6.640, -7.639, -9.028, -10.831, -13.027}},
    {Class::DrySnow, Band::Ku, Channel::HV, {-6.418, -9.605, -11.024, -12.660, -15.039, -17.421, -18.648}},
    {Class::DrySnow, Band::Ku, Channel::VV, {-1.617, -4.261, -5.613, -6.978, -8.502, -10.124, -11.739}},
    {Class::WetSnow, Band::X, Channel::HH, {-7.480, -11.274, -14.128, -16.442, -18.202, -19.373, -19.931}},
    {Class::WetSnow, Band::X, Channel::HV, {-12.125, -15.859, -18.593, -20.887, -22.749, -24.149, -25.064}},
    {Class::WetSnow, Band::X, Channel::VV, {-6.631, -10.142, -12.860, -15.110, -16.880, -18.138, -18.862}},
};

inline constexpr const char* ulaby_dobson_source =
    "Ulaby and Dobson 1989, rows transcribed in DartsTST.jl, evaluated independently";
inline constexpr const char* unverified_source =
    "attributed to Ulaby and Dobson 1989, not checked against the book, evaluated independently";

inline double frequency_in(Band band) {
  switch (band) {
    case Band::L:
      return 1.3e9;
    case Band::S:
      return 3.0e9;
    case Band::C:
      return 5.405e9;
    case Band::Ku:
      return 15e9;
    case Band::Ka:
      return 35e9;
    default:
      return 10e9;
  }
}

inline std::string name_of(const Curve& curve) {
  constexpr const char* terrains[] = {"soil", "grass", "shrubs", "short vegetation", "dry snow", "wet snow", "trees"};
  constexpr const char* bands[] = {"L", "S", "C", "X", "Ku", "Ka"};
  constexpr const char* channels[] = {"HH", "HV", "VV"};
  return fmt::format("{} {} {}", terrains[static_cast<int>(curve.terrain)], bands[static_cast<int>(curve.band)],
                     channels[static_cast<int>(curve.channel)]);
}

inline const scatter::UlabyDobsonRow& row_of(const Curve& curve) {
  const auto& rows = scatter::ulaby_dobson_table();
  return *std::ranges::find_if(rows, [&](const scatter::UlabyDobsonRow& row) {
    return row.terrain == curve.terrain && row.band == curve.band && row.channel == curve.channel;
  });
}

}  // namespace sigmascape::physics_test
