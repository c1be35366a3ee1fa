#include "sigmascape/product/range_azimuth_file.h"

#include <bit>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::product {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Magic, version, length and a Python dictionary, padded so that the numbers begin at a multiple of 64 bytes.
std::string npy_header(std::size_t rows, std::size_t columns) {
  std::string words = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", rows, columns);
  constexpr std::size_t before = 10, alignment = 64;
  words.append(alignment - 1 - (before + words.size()) % alignment, ' ');
  words += '\n';
  std::string header = "\x93NUMPY";
  header += {'\x01', '\x00', static_cast<char>(words.size() & 0xffU), static_cast<char>(words.size() >> 8U)};
  return header + words;
}

std::string description(const radar::RangeAzimuthGrid& grid, const RangeAzimuthLabel& label) {
  nlohmann::ordered_json json{{"quantity", label.quantity},
                              {"axes", {"range", "azimuth"}},
                              {"first_range_m", grid.first_range_m},
                              {"range_step_m", grid.range_step_m},
                              {"ranges", grid.ranges},
                              {"first_azimuth_deg", deg_from_radians(grid.first_azimuth_rad)},
                              {"azimuth_step_deg", deg_from_radians(grid.azimuth_step_rad)},
                              {"azimuths", grid.azimuths}};
  for (const auto& [key, number] : label.numbers) json[key] = number;
  for (const auto& [key, word] : label.words) json[key] = word;
  return json.dump(2) + "\n";
}

}  // namespace

void write_range_azimuth(const std::filesystem::path& path, const radar::RangeAzimuthGrid& grid,
                         const Array2D<float>& bins, const RangeAzimuthLabel& label) {
  if (path.extension() != ".npy")
    throw Error(path.string(), "would not be known for a NumPy file", "give a name that ends in .npy");
  std::string bytes = npy_header(bins.rows(), bins.columns());
  bytes.append(reinterpret_cast<const char*>(bins.values().data()), bins.size() * sizeof(float));
  geo::write_atomically(std::filesystem::path(path).replace_extension(".json"), description(grid, label));
  geo::write_atomically(path, bytes);
}

}  // namespace sigmascape::product
