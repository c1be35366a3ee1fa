#include "sigmascape/geo/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cpl_string.h>
#include <filesystem>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <limits>
#include <ogr_spatialref.h>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/small_letters.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/geo/heeding_progress.h"
#include "sigmascape/geo/is_absent.h"
#include "sigmascape/geo/length_unit.h"
#include "sigmascape/geo/pixel_net.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/raster_content.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {
namespace {

constexpr float nan_height = std::numeric_limits<float>::quiet_NaN();

GDALDatasetUniquePtr open_raster(const std::filesystem::path& file) {
  if (is_absent(file)) throw Error(file.string(), "the file does not exist", "correct the path of the raster");
  const QuietGdal quiet;
  register_gdal_drivers();
  GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (!dataset) {
    throw Error(file.string(), "is not a raster that GDAL can read" + QuietGdal::complaint_beside(),
                "give a GeoTIFF, DTED, HGT or another GDAL raster");
  }
  return dataset;
}

/// What a raster covers, in pixels.
struct Coverage {
  int columns = 0, rows = 0;
  int round = 0;  ///< columns to a turn of the globe, where it goes all the way round; some repeat their first column

  [[nodiscard]] bool holds(Vec2d pixel) const {
    constexpr double slack = 1e-3;
    return (round > 0 || (pixel.x >= -slack && pixel.x <= columns + slack)) && pixel.y >= -slack &&
           pixel.y <= rows + slack;
  }
};

}  // namespace

struct Raster::Source {
  std::string name;
  GDALDatasetUniquePtr dataset;
  GDALRasterBand* band = nullptr;
  std::string crs;
  std::string stated_unit;
  std::array<double, 6> crs_from_pixel{};
  std::array<double, 6> pixel_from_crs{};
  double full_turn = 0.0;
  std::optional<LocalFrame> latest_frame;
  std::optional<CoordinateTransform> latest_transform;

  /// The way to a frame and back, which takes far longer to find than to go: it is kept until another is asked for.
  [[nodiscard]] const CoordinateTransform& transform_to(const LocalFrame& frame) {
    if (!latest_transform || *latest_frame != frame) {
      latest_transform.emplace(crs, frame, name);
      latest_frame = frame;
    }
    return *latest_transform;
  }
  [[nodiscard]] int columns() const { return dataset->GetRasterXSize(); }
  [[nodiscard]] int rows() const { return dataset->GetRasterYSize(); }
  [[nodiscard]] Vec2d crs_position(double column, double row) const {
    const auto& g = crs_from_pixel;
    return {g[0] + column * g[1] + row * g[2], g[3] + column * g[4] + row * g[5]};
  }
  [[nodiscard]] Vec2d middle() const { return crs_position(columns() / 2.0, rows() / 2.0); }
  [[nodiscard]] Coverage coverage() const {
    const double turn = full_turn / std::abs(crs_from_pixel[1]);
    const bool goes_round = full_turn > 0.0 && columns() > turn - 0.5;
    return {columns(), rows(), goes_round ? static_cast<int>(std::lround(turn)) : 0};
  }
  /// Replaces positions in the CRS by positions in pixels. Longitudes come as −180° to 180°, whatever turn the raster
  /// counts them in: one of them is taken on the turn of the raster, the others on that of this one, for they are
  /// neighbours.
  void to_pixels(std::span<Vec2d> positions) const {
    const auto found = std::ranges::find_if(positions, [](Vec2d p) { return std::isfinite(p.x); });
    const double one = found != positions.end() ? on_turn_of(found->x, middle().x, full_turn) : 0.0;
    const auto& g = pixel_from_crs;
    for (Vec2d& p : positions) {
      const double x = on_turn_of(p.x, one, full_turn);
      p = {g[0] + x * g[1] + p.y * g[2], g[3] + x * g[4] + p.y * g[5]};
    }
  }
  [[nodiscard]] Vec2d pixel_at(const LocalFrame& frame, Vec2d place) {
    transform_to(frame).to_crs({&place, 1});
    to_pixels({&place, 1});
    return place;
  }
};

namespace {

/// A part of a band, in its cells.
struct Part {
  int first_column = 0, first_row = 0, columns = 0, rows = 0;

  [[nodiscard]] double cells() const { return static_cast<double>(columns) * static_cast<double>(rows); }
};

/// The part that holds a box and the neighbours of what lies in it.
Part part_around(const PixelBox& box, const Coverage& coverage) {
  if (box.empty()) return {};
  const double west = std::floor(box.least.x - 2.0), east = std::ceil(box.greatest.x + 2.0);
  const double north = std::floor(box.least.y - 2.0), south = std::ceil(box.greatest.y + 2.0);
  const auto within = [](double position, int count) {
    return static_cast<int>(std::clamp(position, 0.0, static_cast<double>(count)));
  };
  const int first_row = within(north, coverage.rows), rows = within(south, coverage.rows) - first_row;
  // Columns of a raster that goes round are counted on beyond its ends.
  if (coverage.round > 0) return {static_cast<int>(west), first_row, within(east - west, coverage.round), rows};
  const int first_column = within(west, coverage.columns);
  return {first_column, first_row, within(east, coverage.columns) - first_column, rows};
}

/// A part of a band, in memory.
template <typename T>
struct Window {
  int first_column = 0, first_row = 0;
  Array2D<T> value;
  Array2D<std::uint8_t> valid;

  /// The cell holding a pixel position, drawn to the window's edge.
  [[nodiscard]] std::size_t column_of(double x) const { return drawn_in(x - first_column, value.columns()); }
  [[nodiscard]] std::size_t row_of(double y) const { return drawn_in(y - first_row, value.rows()); }

 private:
  [[nodiscard]] static std::size_t drawn_in(double position, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, static_cast<double>(count - 1)));
  }
};

template <typename T>
Window<T> read_window(GDALRasterBand& band, const Coverage& coverage, const Part& part, GDALDataType type,
                      const std::string& name) {
  Window<T> window;
  window.first_column = part.first_column;
  window.first_row = part.first_row;
  window.value = Array2D<T>(static_cast<std::size_t>(part.columns), static_cast<std::size_t>(part.rows));
  window.valid = Array2D<std::uint8_t>(static_cast<std::size_t>(part.columns), static_cast<std::size_t>(part.rows));
  HeedingProgress heeding;
  GDALRasterIOExtraArg extra;
  INIT_RASTERIO_EXTRA_ARG(extra);
  extra.pfnProgress = HeedingProgress::advanced;
  extra.pProgressData = &heeding;
  const QuietGdal quiet;
  bool is_read = true;
  const auto read = [&](GDALRasterBand& from, int column, int piece, auto* to, GDALDataType as) {
    const auto bytes = static_cast<GSpacing>(sizeof(*to));
    return from.RasterIO(GF_Read, column, part.first_row, piece, part.rows, to, piece, part.rows, as, bytes,
                         bytes * part.columns, &extra) == CE_None;
  };
  const int turn = coverage.round > 0 ? coverage.round : coverage.columns;
  for (int done = 0, piece = 0; done < part.columns && is_read; done += piece) {
    const int column = ((part.first_column + done) % turn + turn) % turn;
    piece = std::min(part.columns - done, turn - column);
    is_read =
        read(band, column, piece, &window.value.values()[static_cast<std::size_t>(done)], type) &&
        read(*band.GetMaskBand(), column, piece, &window.valid.values()[static_cast<std::size_t>(done)], GDT_Byte);
  }
  heeding.settle();
  if (!is_read) {
    throw Error(name, fmt::format("its cells cannot be read ({})", QuietGdal::complaint()), "replace the damaged file");
  }
  return window;
}

/// Calls `fill(block, part)` for blocks that make up a lattice, with the part of the band that each touches. Blocks are
/// halved until their parts hold so few cells that a lattice takes no more memory from a fine raster than from a coarse
/// one, and where the net is torn until they are points.
template <typename Fill>
void for_each_block(const LatticeBlock& block, const PixelNet& net, const Coverage& coverage, const Fill& fill) {
  constexpr double most_cells = 1 << 22;
  const auto part_of = [&](const LatticeBlock& piece) { return part_around(net.box_of(piece), coverage); };
  const bool is_point = block.columns * block.rows == 1, is_torn = !is_point && net.is_torn(block);
  const Part part = part_of(block);
  if (!is_torn && (part.columns <= 0 || part.rows <= 0)) return;
  if (is_point || (!is_torn && part.cells() <= most_cells)) {
    fill(block, part);
    return;
  }
  const auto [column, row, columns, rows] = block;
  const std::array north_and_south{LatticeBlock{column, row, columns, rows / 2},
                                   LatticeBlock{column, row + rows / 2, columns, rows - rows / 2}};
  const std::array west_and_east{LatticeBlock{column, row, columns / 2, rows},
                                 LatticeBlock{column + columns / 2, row, columns - columns / 2, rows}};
  const auto cells_of = [&](const auto& halves) { return part_of(halves[0]).cells() + part_of(halves[1]).cells(); };
  // Rasters are stored in rows more often than not, unless parts that lie slantwise make the other halves much smaller.
  constexpr double much = 1.2;
  const bool by_rows = columns == 1 || (rows > 1 && cells_of(north_and_south) <= much * cells_of(west_and_east));
  for (const LatticeBlock& half : by_rows ? north_and_south : west_and_east) for_each_block(half, net, coverage, fill);
}

/// Bilinear between cell centres. Cells without data take no part; where the nearest one has none, neither has the
/// result.
float bilinear(const Window<float>& window, Vec2d pixel) {
  if (window.valid(window.column_of(pixel.x), window.row_of(pixel.y)) == 0) return nan_height;
  const double x = pixel.x - 0.5, y = pixel.y - 0.5;
  const double u = x - std::floor(x), v = y - std::floor(y);
  double sum = 0.0, weight_sum = 0.0;
  for (const int down : {0, 1}) {
    for (const int across : {0, 1}) {
      const std::size_t column = window.column_of(std::floor(x) + across), row = window.row_of(std::floor(y) + down);
      if (window.valid(column, row) == 0) continue;
      const double weight = (across != 0 ? u : 1.0 - u) * (down != 0 ? v : 1.0 - v);
      sum += weight * static_cast<double>(window.value(column, row));
      weight_sum += weight;
    }
  }
  return weight_sum > 0.0 ? static_cast<float>(sum / weight_sum) : nan_height;
}

/// How many cells of the raster a step of the lattice crosses at a point, whose position is `pixel`, in the direction
/// in which it crosses more. It tells by the place alone: where tiles meet, their heights are means over the same
/// samples.
int cells_across(const PixelNet& net, std::size_t column, std::size_t row, Vec2d pixel) {
  constexpr double most = 16.0;
  const auto x = static_cast<double>(column), y = static_cast<double>(row);
  const double cells = 2.0 * std::max(length(net.at(x + 0.5, y) - pixel), length(net.at(x, y + 0.5) - pixel));
  return cells > 1.0 ? static_cast<int>(std::lround(std::min(cells, most))) : 1;
}

/// Mean of n × n bilinear samples spread over the lattice cell around a point.
float mean_over_cell(const Window<float>& window, const PixelNet& net, std::size_t column, std::size_t row, int n,
                     const Coverage& coverage) {
  double sum = 0.0;
  int found = 0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Vec2d pixel =
          net.at(static_cast<double>(column) + (i + 0.5) / n - 0.5, static_cast<double>(row) + (j + 0.5) / n - 0.5);
      if (!coverage.holds(pixel)) continue;
      const float height = bilinear(window, pixel);
      if (std::isnan(height)) continue;
      sum += static_cast<double>(height);
      ++found;
    }
  }
  return found > 0 ? static_cast<float>(sum / found) : nan_height;
}

/// Calls `visit(column, row, pixel)` for the points of a block that the raster covers.
template <typename Visit>
void for_each_point(const LatticeBlock& block, const PixelNet& net, const Coverage& coverage, const Visit& visit) {
  for (std::size_t row = block.row; row < block.row + block.rows; ++row) {
    Interruption::heed();
    for (std::size_t column = block.column; column < block.column + block.columns; ++column) {
      const Vec2d pixel = net.at(static_cast<double>(column), static_cast<double>(row));
      if (coverage.holds(pixel)) visit(column, row, pixel);
    }
  }
}

/// Throws Error when a band is a colour of a picture, whose numbers would be taken for classes.
void require_classes(GDALRasterBand& band, const std::string& name) {
  const GDALColorInterp colour = band.GetColorInterpretation();
  if (colour != GCI_RedBand && colour != GCI_GreenBand && colour != GCI_BlueBand) return;
  throw Error(
      fmt::format("{}, band {}", name, band.GetBand()),
      fmt::format("is the {} of a picture, not a raster of classes",
                  in_small_letters(GDALGetColorInterpretationName(colour))),
      fmt::format("give the raster of classes that the picture was made from; if the band does hold classes, say "
                  "so in the file with gdal_edit.py -colorinterp_{} gray",
                  band.GetBand()));
}

/// Throws Error when a CRS of degrees is stated for numbers that cannot be latitudes.
void require_latitudes(const std::array<double, 6>& crs_from_pixel, int columns, int rows, const std::string& crs,
                       const std::string& where) {
  if (reference_from(crs, where).IsGeographic() == 0) return;
  // Rasters of the whole globe may reach half a cell beyond the poles, where their outermost cells have their centres.
  const double slack = 0.51 * (std::abs(crs_from_pixel[4]) + std::abs(crs_from_pixel[5]));
  const double north_west = crs_from_pixel[3], down = crs_from_pixel[5] * rows, across = crs_from_pixel[4] * columns;
  const auto [lowest, highest] =
      std::minmax({north_west, north_west + down, north_west + across, north_west + down + across});
  if (lowest >= -90.0 - slack && highest <= 90.0 + slack) return;
  throw Error(where,
              fmt::format("'{}' counts in degrees, and the raster's rows lie at {:.10g} to {:.10g}, which are none",
                          crs.substr(0, 60), lowest, highest),
              "state the coordinate reference system of its numbers, such as EPSG:25830 for metres");
}

}  // namespace

Raster::Raster(const RasterBand& wanted) : source_(std::make_unique<Source>()) {
  Source& source = *source_;
  source.name = wanted.file.string();
  source.dataset = open_raster(wanted.file);
  if (source.dataset->GetRasterCount() == 0) {
    throw Error(source.name, "has no bands of its own, as files of several rasters have none",
                "take the one that is wanted out of it with gdal_translate, and give that");
  }
  if (wanted.band < 1 || wanted.band > source.dataset->GetRasterCount()) {
    throw Error(source.name, fmt::format("has no band {}", wanted.band),
                fmt::format("choose a band from 1 to {}", source.dataset->GetRasterCount()));
  }
  source.band = source.dataset->GetRasterBand(wanted.band);
  source.crs = wanted.crs;
  source.stated_unit = wanted.unit;
  if (source.crs.empty()) source.crs = source.dataset->GetProjectionRef();
  if (source.crs.empty()) {
    throw Error(source.name, "carries no coordinate reference system",
                "state it, such as EPSG:25830, with the key crs or the option --crs, or write it into the file with "
                "gdal_edit.py -a_srs");
  }
  const std::string where = wanted.crs.empty() ? source.name : source.name + ": crs";
  require_known_reference(source.crs, where);
  if (source.dataset->GetGeoTransform(source.crs_from_pixel.data()) != CE_None ||
      GDALInvGeoTransform(source.crs_from_pixel.data(), source.pixel_from_crs.data()) == 0) {
    throw Error(source.name, "does not say where its cells lie",
                "georeference it, for example with gdal_translate -a_ullr");
  }
  require_latitudes(source.crs_from_pixel, source.columns(), source.rows(), source.crs, where);
  source.full_turn = turn_of_x(source.crs);
}

Raster::~Raster() = default;
Raster::Raster(Raster&&) noexcept = default;
Raster& Raster::operator=(Raster&&) noexcept = default;

std::vector<std::string> Raster::digests() const {
  return digests_of_content(*source_->dataset);
}

GeographicPosition Raster::centre() const {
  return place_on_globe(source_->crs, source_->middle(), source_->name);
}

double Raster::cell_m(const LocalFrame& frame, Vec2d place) const {
  const CoordinateTransform& transform = source_->transform_to(frame);
  const Vec2d pixel = source_->pixel_at(frame, place);
  const auto cell_at = [](double position, int count) {
    return std::isfinite(position) ? std::clamp(std::floor(position), 0.0, count - 1.0) : count / 2.0;
  };
  const double column = cell_at(pixel.x, source_->columns()), row = cell_at(pixel.y, source_->rows());
  std::array corners{source_->crs_position(column, row), source_->crs_position(column + 1.0, row),
                     source_->crs_position(column, row + 1.0)};
  transform.to_frame(corners);
  const double cell_m = std::min(length(corners[1] - corners[0]), length(corners[2] - corners[0]));
  if (std::isfinite(cell_m) && cell_m > 0.0) return cell_m;
  throw Error(source_->name, "lies where the scene's frame does not reach",
              "give one that overlaps the scene, and state crs if its numbers are of another system than it says");
}

bool Raster::covers(const LocalFrame& frame, Vec2d place) const {
  return source_->coverage().holds(source_->pixel_at(frame, place));
}

RasterOutline Raster::outline_in(const LocalFrame& frame) const {
  if (source_->coverage().round > 0) return {};
  constexpr int steps = 1024;
  const double columns = source_->columns(), rows = source_->rows();
  std::vector<Vec2d> left, right, top, bottom;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    left.push_back(source_->crs_position(0.0, t * rows));
    right.push_back(source_->crs_position(columns, t * rows));
    top.push_back(source_->crs_position(t * columns, 0.0));
    bottom.push_back(source_->crs_position(t * columns, rows));
  }
  const CoordinateTransform& transform = source_->transform_to(frame);
  for (auto* edge : {&left, &right, &top, &bottom}) transform.to_frame(*edge);
  return RasterOutline::of(std::move(left), std::move(right), std::move(bottom), std::move(top));
}

HeightUnit Raster::height_unit() const {
  const std::string name = source_->stated_unit.empty() ? source_->band->GetUnitType() : source_->stated_unit;
  if (!name.empty()) {
    if (const auto metres = metres_per_unit(name)) return {*metres};
    throw Error(
        source_->name, fmt::format("counts heights in '{}', which is no known unit", name),
        "convert it to metres, or state the unit as m, cm, ft or us-ft: with unit in a scene's [terrain], with --unit "
        "of 'atlas terrain', or in the file with gdal_edit.py -units");
  }
  // A reference stated in place of the file's own may be one of places alone.
  for (const std::string& crs : {source_->crs, std::string(source_->dataset->GetProjectionRef())}) {
    if (const auto metres = metres_per_vertical_unit(crs)) return {*metres};
  }
  const std::string of_places = axis_unit(source_->crs);
  return {.is_guess = of_places == "ft" || of_places == "us_ft"};
}

Array2D<float> Raster::heights_on(const Lattice& lattice, const LocalFrame& frame, PlausibleHeights plausible) const {
  const PixelNet net(lattice, source_->transform_to(frame),
                     [this](std::span<Vec2d> knots) { source_->to_pixels(knots); });
  const Coverage coverage = source_->coverage();
  Array2D<float> heights(lattice.columns, lattice.rows, nan_height);
  const double to_metres = height_unit().metres;
  const double scale = source_->band->GetScale() * to_metres, offset = source_->band->GetOffset() * to_metres;
  for_each_block(
      {0, 0, lattice.columns, lattice.rows}, net, coverage, [&](const LatticeBlock& block, const Part& part) {
        auto window = read_window<float>(*source_->band, coverage, part, GDT_Float32, source_->name);
        for (std::size_t i = 0; i < window.value.size(); ++i) {
          float& height = window.value.values()[i];
          height = static_cast<float>(static_cast<double>(height) * scale + offset);
          const bool believed =
              height >= static_cast<float>(plausible.lowest_m) && height <= static_cast<float>(plausible.highest_m);
          if (!believed) window.valid.values()[i] = 0;
        }
        for_each_point(block, net, coverage, [&](std::size_t column, std::size_t row, Vec2d pixel) {
          const int samples = cells_across(net, column, row, pixel);
          heights(column, row) =
              samples == 1 ? bilinear(window, pixel) : mean_over_cell(window, net, column, row, samples, coverage);
        });
      });
  return heights;
}

Array2D<std::int32_t> Raster::classes_on(const Lattice& lattice, const LocalFrame& frame) const {
  require_classes(*source_->band, source_->name);
  const PixelNet net(lattice, source_->transform_to(frame),
                     [this](std::span<Vec2d> knots) { source_->to_pixels(knots); });
  const Coverage coverage = source_->coverage();
  Array2D<std::int32_t> classes(lattice.columns, lattice.rows, no_class);
  for_each_block(
      {0, 0, lattice.columns, lattice.rows}, net, coverage, [&](const LatticeBlock& block, const Part& part) {
        const auto window = read_window<std::int32_t>(*source_->band, coverage, part, GDT_Int32, source_->name);
        for_each_point(block, net, coverage, [&](std::size_t column, std::size_t row, Vec2d pixel) {
          const std::size_t i = window.column_of(pixel.x), j = window.row_of(pixel.y);
          if (window.valid(i, j) != 0) classes(column, row) = window.value(i, j);
        });
      });
  return classes;
}

}  // namespace sigmascape::geo
