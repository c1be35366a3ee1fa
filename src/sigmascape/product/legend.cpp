#include "sigmascape/product/legend.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <system_error>

#include "sigmascape/base/units.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/bitmap_font.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/product/legend_look.h"
#include "sigmascape/product/rectangle_fill.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::product {
namespace {

// Everything is laid out in dots of the font; a dot is one or more pixels.
constexpr std::size_t margin = 6;
constexpr std::size_t bar_length = 110;
constexpr std::size_t bar_height = 8;
constexpr std::size_t gap = 3;
constexpr std::size_t between_parts = 24;
constexpr std::size_t arrow_width = 9;
constexpr std::size_t look_arrow_length = 13;
constexpr const char* look_word = "look";
constexpr std::size_t strip_height = 2 * margin + bar_height + gap + glyph_height;

/// The strip below the picture and how far it is filled.
struct Strip {
  Array2D<Rgba>& pixels;
  std::size_t top;  ///< its first row
  std::size_t dot;  ///< pixels along a dot's side
  std::size_t column;

  [[nodiscard]] bool has_room_for(std::size_t width) const { return column + width + margin * dot <= pixels.columns(); }
  [[nodiscard]] std::size_t bar_row() const { return top + margin * dot; }
  [[nodiscard]] std::size_t text_row() const { return top + (margin + bar_height + gap) * dot; }
};

std::string db_text(double db) {
  const double tenths = std::round(db * 10.0) / 10.0;
  return tenths == std::round(tenths) ? fmt::format("{:.0f}", tenths + 0.0) : fmt::format("{:.1f}", tenths);
}

void draw_colour_bar(Strip& strip, const Picture& picture) {
  const std::size_t length = bar_length * strip.dot;
  for (std::size_t i = 0; i < length; ++i) {
    const double position = static_cast<double>(i) / static_cast<double>(length - 1);
    fill_rectangle(strip.pixels, {strip.column + i, strip.bar_row(), 1, bar_height * strip.dot},
                   colour_at(picture.scale, position));
  }
  const std::string top = db_text(picture.top_db) + " dB";
  draw_text(strip.pixels, strip.column, strip.text_row(), db_text(picture.bottom_db), strip.dot, legend_ink);
  draw_text(strip.pixels, strip.column + length - text_width(top, strip.dot), strip.text_row(), top, strip.dot,
            legend_ink);
  // Differences are read from where there is none.
  if (picture.scale == ColourScale::Diverging) {
    const std::string middle = db_text((picture.bottom_db + picture.top_db) / 2.0);
    draw_text(strip.pixels, strip.column + (length - text_width(middle, strip.dot)) / 2, strip.text_row(), middle,
              strip.dot, legend_ink);
  }
  strip.column += length + between_parts * strip.dot;
}

/// As wide as a pixel is on the ground in the middle of the picture, whatever its coordinate system counts in.
double ground_pixel_m(const Picture& picture) {
  const auto crs = picture.metadata.find("crs");
  const double metres_per_unit =
      crs == picture.metadata.end() ? 1.0 : geo::ground_metres_per_unit(crs->second, picture.grid.extent().centre());
  return picture.grid.cell_m * metres_per_unit;
}

void draw_scale_bar(Strip& strip, const Picture& picture) {
  const double pixel_m = ground_pixel_m(picture);
  const double length_m = round_length_m(0.25 * pixel_m * static_cast<double>(picture.grid.columns));
  const auto length = static_cast<std::size_t>(std::lround(length_m / pixel_m));
  const std::string label =
      length_m >= 1000.0 ? fmt::format("{} km", length_m / 1000.0) : fmt::format("{} m", length_m);
  const std::size_t label_width = text_width(label, strip.dot);
  const std::size_t width = std::max(length, label_width);
  if (!strip.has_room_for(width)) return;

  const std::size_t left = strip.column + (width - length) / 2;
  const std::size_t dot = strip.dot;
  fill_rectangle(strip.pixels, {left, strip.bar_row() + (bar_height - 2) * dot, length, 2 * dot}, legend_ink);
  fill_rectangle(strip.pixels, {left, strip.bar_row() + 2 * dot, dot, (bar_height - 2) * dot}, legend_ink);
  fill_rectangle(strip.pixels,
                 {left + length - std::min(dot, length), strip.bar_row() + 2 * dot, dot, (bar_height - 2) * dot},
                 legend_ink);
  draw_text(strip.pixels, strip.column + (width - label_width) / 2, strip.text_row(), label, dot, legend_ink);
  strip.column += width + between_parts * dot;
}

/// Where an azimuth points in the picture, whichever way its coordinate system is turned in the middle of it.
Vec2d way_in(const Picture& picture, double azimuth_rad) {
  const auto crs = picture.metadata.find("crs");
  return crs == picture.metadata.end() ? radar::horizontal_direction(azimuth_rad)
                                       : geo::way_at_azimuth(crs->second, picture.grid.extent().centre(), azimuth_rad);
}

void draw_north_arrow(Strip& strip, Vec2d north) {
  const std::size_t width = arrow_width * strip.dot;
  if (!strip.has_room_for(width)) return;
  const std::size_t left = strip.pixels.columns() - margin * strip.dot - width;
  // So much longer than it is wide that its tip is known from its corners when it is turned.
  const auto height = static_cast<double>(bar_height * strip.dot), half_width = 0.35 * height;
  const double middle = 0.5 * static_cast<double>(width) - 0.5, middle_row = 0.5 * height - 0.5;
  for (std::size_t y = 0; y < bar_height * strip.dot; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const Vec2d place{static_cast<double>(x) - middle, middle_row - static_cast<double>(y)};
      const double from_tip = 0.5 * height - dot(place, north), aside = std::abs(place.x * north.y - place.y * north.x);
      if (from_tip >= 0.0 && from_tip <= height && aside <= half_width * from_tip / height)
        strip.pixels(left + x, strip.bar_row() + y) = legend_ink;
    }
  }
  draw_text(strip.pixels, left + (width - text_width("N", strip.dot)) / 2, strip.text_row(), "N", strip.dot,
            legend_ink);
}

Vec2d position_in(const std::string& crs, geo::GeographicPosition place) {
  Vec2d position;
  geo::CoordinateTransform(crs, geo::LocalFrame(place.latitude_deg, place.longitude_deg), "map").to_crs({&position, 1});
  return position;
}

/// What azimuth true north has, in the middle of the picture, in the frame that its map was made in: the picture's own
/// system where no other is told.
double north_of_frame_rad(const Picture& picture) {
  const auto crs = picture.metadata.find("crs"), told = picture.metadata.find(local_frame_key);
  if (crs == picture.metadata.end()) return 0.0;
  Vec2d middle = picture.grid.extent().centre();
  const std::string& frame = told == picture.metadata.end() ? crs->second : told->second;
  if (frame != crs->second) middle = position_in(frame, geo::place_on_globe(crs->second, middle, "map"));
  const Vec2d north = geo::way_at_azimuth(frame, middle, 0.0);
  return azimuth_of(north);
}

/// Where the picture says that its radar stands, seen from its middle: clockwise from the north of its map's frame.
std::optional<double> radar_azimuth_rad(const Picture& picture) {
  const auto told = picture.metadata.find(radar_azimuth_key);
  if (told == picture.metadata.end()) return std::nullopt;
  const std::string& text = told->second;
  double azimuth_deg = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), azimuth_deg);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(azimuth_deg)) return std::nullopt;
  return radians_from_deg(azimuth_deg);
}

/// Whether an arrow of so many pixels, its middle in the origin, covers a place `along` its way and `across` it.
bool is_on_arrow(double along, double across, double length, double thickness) {
  const double tip = length / 2.0, head = 0.45 * length;
  if (along < tip - head) return along >= -tip && std::abs(across) <= thickness / 2.0;
  return along <= tip && std::abs(across) <= 0.7 * (tip - along);
}

/// Left of the arrow to north: the direction of look, away from the radar, as its waves go and shadows fall.
void draw_look_arrow(Strip& strip, Vec2d away) {
  const std::size_t width = text_width(look_word, strip.dot);
  const std::size_t north_arrow = (arrow_width + between_parts / 2) * strip.dot;
  if (!strip.has_room_for(width + north_arrow)) return;
  const std::size_t left = strip.pixels.columns() - margin * strip.dot - north_arrow - width;
  draw_text(strip.pixels, left, strip.text_row(), look_word, strip.dot, legend_ink);
  const std::size_t side = look_arrow_length * strip.dot;
  const std::size_t first_column = left + (width - side) / 2;
  const std::size_t first_row = strip.text_row() - (gap - 1) * strip.dot - side;
  const double middle = 0.5 * static_cast<double>(side) - 0.5;
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const Vec2d place{static_cast<double>(x) - middle, middle - static_cast<double>(y)};
      if (is_on_arrow(dot(place, away), place.x * away.y - place.y * away.x, static_cast<double>(side),
                      1.3 * static_cast<double>(strip.dot)))
        strip.pixels(first_column + x, first_row + y) = legend_ink;
    }
  }
}

}  // namespace

double round_length_m(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= longest_m) return step * decade;
  }
  return decade;
}

Picture with_legend(const Picture& picture, const LegendParts& parts) {
  const std::size_t columns = picture.pixels.columns();
  const std::size_t dot = legend_dot(columns);
  if (columns < (bar_length + 2 * margin) * dot) return picture;

  Picture framed = picture;
  framed.pixels = Array2D<Rgba>(columns, picture.pixels.rows() + strip_height * dot, legend_background);
  std::copy(picture.pixels.values().begin(), picture.pixels.values().end(), framed.pixels.values().begin());
  Strip strip{framed.pixels, picture.pixels.rows(), dot, margin * dot};
  if (parts.colour_scale) draw_colour_bar(strip, picture);
  if (parts.scale_bar) draw_scale_bar(strip, picture);
  if (parts.north_arrow) draw_north_arrow(strip, way_in(picture, 0.0));
  if (const auto azimuth_rad = radar_azimuth_rad(picture); azimuth_rad && parts.north_arrow)
    draw_look_arrow(strip, way_in(picture, *azimuth_rad - north_of_frame_rad(picture) + pi));
  return framed;
}

}  // namespace sigmascape::product
