#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/lattice.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/geo/raster_outline.h"

namespace sigmascape::geo {

/// Which band of which file, and what of it the file does not say or says wrongly.
struct RasterBand {
  std::filesystem::path file;
  int band = 1;
  std::string crs;     ///< overrides the file's own when not empty
  std::string unit{};  ///< of heights, "m", "cm", "ft" or "us-ft": overrides the file's own when not empty
};

/// What heights of a raster are counted in.
struct HeightUnit {
  double metres = 1.0;
  bool is_guess = false;  ///< nothing states it, and the map's own axes are in feet: taken to be metres all the same
};

/// Heights outside this range count as no data: voids that a file does not declare, spikes.
struct PlausibleHeights {
  double lowest_m = -500.0;
  double highest_m = 9000.0;
};

/// What a class raster reads where it has no class.
inline constexpr std::int32_t no_class = std::numeric_limits<std::int32_t>::min();

/// One band of a georeferenced raster of any format that GDAL reads, open for sampling in a local frame. One thread at
/// a time may ask it, as GDAL has it.
class Raster {
 public:
  /// Throws Error when the file is missing, no raster, lacks the band, or carries neither CRS nor georeference.
  explicit Raster(const RasterBand& source);
  ~Raster();
  Raster(Raster&&) noexcept;
  Raster& operator=(Raster&&) noexcept;

  /// SHA-256 of each file that it is read from; see digests_of_content. Rasters of equal digests are equal.
  [[nodiscard]] std::vector<std::string> digests() const;
  [[nodiscard]] GeographicPosition centre() const;
  /// The shorter side of the cell at a place of a frame, in metres there; of the nearest one, where the raster does not
  /// reach.
  [[nodiscard]] double cell_m(const LocalFrame& frame, Vec2d place) const;
  /// Whether a place of a frame lies in it, be there data or none.
  [[nodiscard]] bool covers(const LocalFrame& frame, Vec2d place) const;
  /// Its edges in a frame; empty for one that goes round the globe, which has none.
  [[nodiscard]] RasterOutline outline_in(const LocalFrame& frame) const;

  /// What is stated of it, else what the band says, else what the vertical axis of its coordinate reference system
  /// says, else metres. Throws Error for a unit that is not known.
  [[nodiscard]] HeightUnit height_unit() const;
  /// Bilinear heights in metres, [column, row] of the lattice; NaN outside the raster and where it holds no data. Where
  /// the lattice is coarser than the raster is there, the mean over the lattice cell. Values in feet, or in
  /// whatever else their unit is, become metres; the vertical datum stays whatever it is. Throws Error for a unit that
  /// is not known.
  [[nodiscard]] Array2D<float> heights_on(const Lattice& lattice, const LocalFrame& frame,
                                          PlausibleHeights plausible = {}) const;
  /// Class of the nearest cell, [column, row] of the lattice; `no_class` outside the raster and where it holds no data.
  /// Throws Error for a band that is the red, green or blue of a picture.
  [[nodiscard]] Array2D<std::int32_t> classes_on(const Lattice& lattice, const LocalFrame& frame) const;

 private:
  struct Source;
  std::unique_ptr<Source> source_;
};

}  // namespace sigmascape::geo
