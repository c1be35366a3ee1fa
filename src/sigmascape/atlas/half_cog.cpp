#include "sigmascape/atlas/half_cog.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <tiffio.h>

#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/base/error.h"

namespace sigmascape::atlas {
namespace {

constexpr std::size_t tile_halves = tile_side * tile_side * texel_halves;

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, CloseTiff>;

/// libtiff does not know the tags of GeoTIFF and would say so; what goes wrong is told by Error instead.
int say_nothing(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

Tiff opened(const std::filesystem::path& path) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), say_nothing, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  return Tiff(TIFFOpenExt(path.c_str(), "r", options.get()));
}

template <typename T>
T tag(TIFF& tiff, ttag_t name) {
  T value{};
  return TIFFGetFieldDefaulted(&tiff, name, &value) == 1 ? value : T{};
}

bool is_level_of_side(TIFF& tiff, std::size_t side) {
  return tag<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH) == side &&
         tag<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH) == side &&
         tag<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH) == tile_side &&
         tag<std::uint32_t>(tiff, TIFFTAG_TILELENGTH) == tile_side &&
         tag<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL) == texel_halves &&
         tag<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE) == 16 &&
         tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_IEEEFP &&
         tag<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG;
}

/// False when a tile cannot be read.
bool read_tiles(TIFF& tiff, std::size_t side, std::vector<Half>& halves) {
  constexpr std::size_t tile_row = tile_side * texel_halves;
  halves.resize(side * side * texel_halves);
  std::vector<Half> tile(tile_halves);
  const std::size_t tiles = side / tile_side;
  for (std::size_t index = 0; index < tiles * tiles; ++index) {
    const auto bytes = static_cast<tmsize_t>(tile_halves * sizeof(Half));
    if (TIFFReadEncodedTile(&tiff, static_cast<std::uint32_t>(index), tile.data(), bytes) != bytes) return false;
    Half* corner = &halves[(index / tiles * side + index % tiles) * tile_side * texel_halves];
    for (std::size_t row = 0; row < tile_side; ++row) {
      std::copy_n(&tile[row * tile_row], tile_row, corner + row * side * texel_halves);
    }
  }
  return true;
}

}  // namespace

std::vector<std::vector<Half>> read_half_cog(const std::filesystem::path& path, std::size_t side, std::size_t levels) {
  const Tiff tiff = opened(path);
  if (!tiff) throw Error(path.string(), "cannot be opened as TIFF", "bake this texture again");
  std::vector<std::vector<Half>> halves;
  for (std::size_t level = 0; level < levels; ++level) {
    const bool found = TIFFSetDirectory(tiff.get(), static_cast<tdir_t>(level)) == 1;
    if (!found || !is_level_of_side(*tiff, side >> level)) {
      throw Error(fmt::format("{}, level {}", path.string(), level),
                  fmt::format("is not {0} x {0} half floats of four channels in tiles", side >> level),
                  "bake this texture again");
    }
    if (!read_tiles(*tiff, side >> level, halves.emplace_back())) {
      throw Error(fmt::format("{}, level {}", path.string(), level), "cannot be read whole", "bake this texture again");
    }
  }
  return halves;
}

bool read_half_tile(const std::filesystem::path& path, std::size_t level, std::size_t tile, std::span<Half> halves) {
  const Tiff tiff = opened(path);
  if (!tiff || halves.size() != tile_halves) return false;
  if (TIFFSetDirectory(tiff.get(), static_cast<tdir_t>(level)) != 1) return false;
  if (!is_level_of_side(*tiff, tag<std::uint32_t>(*tiff, TIFFTAG_IMAGEWIDTH))) return false;
  if (tile >= TIFFNumberOfTiles(tiff.get())) return false;
  const auto bytes = static_cast<tmsize_t>(halves.size_bytes());
  return TIFFReadEncodedTile(tiff.get(), static_cast<std::uint32_t>(tile), halves.data(), bytes) == bytes;
}

}  // namespace sigmascape::atlas
