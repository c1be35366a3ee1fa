#include "sigmascape/render/paper_method.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"

namespace sigmascape::render {
namespace {

constexpr double pixels_per_range_bin = 2.0;
/// By what part the sine of the grazing angle may change before the looks are weighted anew.
constexpr double aspect_step = 5e-4;

/// Two neighbours on an axis and the part of the second.
struct Between {
  std::size_t first = 0, second = 0;
  double fraction = 0.0;
};

Between between_azimuths(const std::vector<double>& axis, double azimuth_rad, bool in_the_middle) {
  const double turned = wrapped_azimuth(azimuth_rad);
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(axis, turned) - axis.begin());
  const std::size_t first = (above + axis.size() - 1) % axis.size(), second = above % axis.size();
  if (first == second) return {};
  const double gap = wrapped_azimuth(axis[second] - axis[first]);
  const double fraction = wrapped_azimuth(turned - axis[first]) / gap;
  return {first, second, in_the_middle ? atlas::part_of_second_azimuth(fraction, gap) : fraction};
}

Between between_elevations(const std::vector<double>& axis, double elevation_rad, bool by_cotangent) {
  const double held = std::clamp(elevation_rad, axis.front(), axis.back());
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(axis, held) - axis.begin());
  if (above == axis.size()) return {above - 1, above - 1, 0.0};
  const auto scale = [&](double angle) { return by_cotangent ? 1.0 / std::tan(angle) : angle; };
  return {above - 1, above, (scale(held) - scale(axis[above - 1])) / (scale(axis[above]) - scale(axis[above - 1]))};
}

/// The pixels of one azimuth, nearest first.
class PixelColumn {
 public:
  PixelColumn(const PaperTextures& textures, const terrain::HeightField& terrain, const radar::Radar& radar,
              const radar::Rectangle& area, const PaperLookUp& look_up, double pixel_m)
      : textures_(textures), terrain_(terrain), radar_(radar), area_(area), look_up_(look_up), pixel_m_(pixel_m) {
    const double lowest = terrain.lowest_m(), highest = terrain.highest_m();
    plane_m_ = (lowest + highest) / 2.0;
    // Where lines of sight to the lowest and to the highest terrain meet the plane, over their distance.
    nearest_part_ = (radar.position.z - plane_m_) / (radar.position.z - lowest);
    farthest_part_ = (radar.position.z - plane_m_) / (radar.position.z - highest);
  }

  void cast(double azimuth_rad, double azimuth_step_rad, double near_m, double far_m,
            std::vector<radar::Echo>& echoes) const {
    const Vec2d direction = radar::horizontal_direction(azimuth_rad);
    const Vec2d origin{radar_.position.x, radar_.position.y};
    const double first_m = near_m * nearest_part_;
    const auto pixels = static_cast<std::size_t>((far_m * farthest_part_ - first_m) / pixel_m_);
    const auto on_plane_m = [&](std::size_t k) { return first_m + (static_cast<double>(k) + 0.5) * pixel_m_; };
    const auto slope_of = [&](std::size_t k) { return (plane_m_ - radar_.position.z) / on_plane_m(k); };

    Aspect aspect{wrapped_azimuth(azimuth_rad + pi)};
    std::size_t pixel = 0;
    double last_slope = 0.0;
    bool on_terrain = false;
    const auto steps = static_cast<std::size_t>((far_m - near_m) / pixel_m_);
    for (std::size_t k = 0; k <= steps && pixel < pixels; ++k) {
      const double distance_m = near_m + static_cast<double>(k) * pixel_m_;
      const Vec2d point = origin + direction * distance_m;
      if (!terrain_.extent().contains(point)) continue;
      const double slope = (terrain_.height_at(point) - radar_.position.z) / distance_m;
      while (pixel < pixels && slope >= slope_of(pixel)) {
        // Rays that the terrain's very edge stops meet its side, which is not there.
        if (on_terrain) {
          const double part = (slope_of(pixel) - last_slope) / (slope - last_slope);
          const double hit_m = distance_m - (1.0 - part) * pixel_m_;
          const double plane_range_m = std::hypot(on_plane_m(pixel), plane_m_ - radar_.position.z);
          const double sine = (radar_.position.z - plane_m_) / plane_range_m;
          // What of the plane the pixel covers, seen from the radar.
          const double across_m = on_plane_m(pixel) * azimuth_step_rad, upright_m = pixel_m_ * sine;
          shade(origin + direction * hit_m, azimuth_rad, {across_m / plane_range_m, upright_m / plane_range_m}, aspect,
                echoes);
        }
        ++pixel;
      }
      last_slope = slope;
      on_terrain = true;
    }
  }

 private:
  /// Width and height of a pixel as angles.
  struct PixelAngles {
    double across_rad = 0.0, upright_rad = 0.0;
  };

  /// The looks that answer for the current stretch of the column.
  struct Aspect {
    double azimuth_rad;
    double sin_grazing = 2.0;  // none yet
    atlas::AspectWeights weights = {};
  };

  void shade(Vec2d place, double azimuth_rad, const PixelAngles& angles, Aspect& aspect,
             std::vector<radar::Echo>& echoes) const {
    if (!area_.contains(place)) return;
    const Vec3d point{place.x, place.y, terrain_.height_at(place)};
    const Vec3d away = radar_.position - point;
    const double range_m = length(away);
    const Vec3d normal = terrain_.normal_at(place);
    const double facing = dot(normal, away) / range_m;
    if (facing <= 0.0) return;
    const double sin_grazing = away.z / range_m;
    if (std::abs(sin_grazing - aspect.sin_grazing) > aspect_step * sin_grazing) {
      aspect.sin_grazing = sin_grazing;
      aspect.weights = textures_.weights_for({aspect.azimuth_rad, std::asin(sin_grazing)}, look_up_);
    }
    // The mip follows the longer side of the pixel's footprint, as derivatives on the screen do.
    const double along_m = range_m * angles.upright_rad / facing * normal.z;
    const double level = std::log2(std::max(range_m * angles.across_rad, along_m) / textures_.grid().cell_m);
    const radar::Channels sigma0 = textures_.sigma0_at(place, aspect.weights, look_up_.finest_only ? 0.0 : level);
    const double solid_angle_sr = angles.across_rad * angles.upright_rad;
    double rcs_per_sigma0_m2 = rcs_of_radiance(radiance_of(1.0, range_m, facing), range_m, solid_angle_sr);
    if (look_up_.by_map_area) rcs_per_sigma0_m2 *= normal.z;
    echoes.push_back({.range_m = range_m,
                      .cross = azimuth_rad,
                      .rcs_m2 = sigma0 * static_cast<float>(rcs_per_sigma0_m2),
                      .bounces = 1,
                      .sin_depression = static_cast<float>(sin_grazing)});
  }

  const PaperTextures& textures_;
  const terrain::HeightField& terrain_;
  const radar::Radar& radar_;
  const radar::Rectangle& area_;
  const PaperLookUp& look_up_;
  double pixel_m_;
  double plane_m_ = 0.0, nearest_part_ = 1.0, farthest_part_ = 1.0;
};

}  // namespace

PaperTextures::PaperTextures(const radar::GroundGrid& grid, const atlas::AspectGrid& aspects,
                             const std::vector<Array2D<radar::Channels>>& looks)
    : grid_(grid), aspects_(aspects) {
  for (const Array2D<radar::Channels>& look : looks) looks_.push_back(atlas::mip_chain(look, 1));
}

std::size_t PaperTextures::texture_bytes() const {
  return looks_.size() * grid_.columns * grid_.rows * sizeof(radar::Channels);
}

std::size_t PaperTextures::memory_bytes() const {
  std::size_t texels = 0;
  for (const Array2D<radar::Channels>& level : looks_.front()) texels += level.size();
  return looks_.size() * texels * sizeof(radar::Channels);
}

atlas::AspectWeights PaperTextures::weights_for(const radar::Aspect& aspect, const PaperLookUp& look_up) const {
  const Between azimuth = between_azimuths(aspects_.azimuths_rad, aspect.azimuth_rad, look_up.in_the_middle);
  const Between elevation = between_elevations(aspects_.elevations_rad, aspect.elevation_rad, look_up.by_cotangent);
  const double held = std::clamp(aspect.elevation_rad, aspects_.elevations_rad.front(), aspects_.elevations_rad.back());
  atlas::AspectWeights weights;
  for (const bool upper : {false, true}) {
    for (const bool right : {false, true}) {
      double part =
          (upper ? elevation.fraction : 1.0 - elevation.fraction) * (right ? azimuth.fraction : 1.0 - azimuth.fraction);
      if (part == 0.0) continue;
      const std::size_t node = upper ? elevation.second : elevation.first;
      if (look_up.blends_gamma) part *= std::sin(held) / std::sin(aspects_.elevations_rad[node]);
      weights.look[weights.count] = aspects_.index_of(right ? azimuth.second : azimuth.first, node, 0);
      weights.weight[weights.count++] = static_cast<float>(part);
    }
  }
  return weights;
}

radar::Channels PaperTextures::at_level(Vec2d point, const atlas::AspectWeights& weights, std::size_t level) const {
  const auto side = static_cast<double>(grid_.columns >> level);
  const Vec2d place = grid_.cells_from(point) * (1.0 / static_cast<double>(std::size_t{1} << level));
  // Held at the edges, as a texture is that neither repeats nor has a border.
  const double across = std::clamp(place.x - 0.5, 0.0, side - 1.0), down = std::clamp(place.y - 0.5, 0.0, side - 1.0);
  const auto left = static_cast<std::size_t>(across), top = static_cast<std::size_t>(down);
  const std::size_t right = std::min(left + 1, (grid_.columns >> level) - 1);
  const std::size_t bottom = std::min(top + 1, (grid_.rows >> level) - 1);
  const auto u = static_cast<float>(across - static_cast<double>(left));
  const auto v = static_cast<float>(down - static_cast<double>(top));
  radar::Channels sum;
  for (std::size_t i = 0; i < weights.count; ++i) {
    const Array2D<radar::Channels>& texels = looks_[weights.look[i]][level];
    sum += (texels(left, top) * ((1.0F - u) * (1.0F - v)) + texels(right, top) * (u * (1.0F - v)) +
            texels(left, bottom) * ((1.0F - u) * v) + texels(right, bottom) * (u * v)) *
           weights.weight[i];
  }
  return sum;
}

radar::Channels PaperTextures::sigma0_at(Vec2d point, const atlas::AspectWeights& weights, double level) const {
  const double held = std::clamp(level, 0.0, static_cast<double>(looks_.front().size() - 1));
  const auto finer = static_cast<std::size_t>(held);
  const auto part = static_cast<float>(held - static_cast<double>(finer));
  const radar::Channels fine = at_level(point, weights, finer);
  if (part == 0.0F) return fine;
  return fine * (1.0F - part) + at_level(point, weights, finer + 1) * part;
}

double radiance_of(double sigma0, double range_m, double cos_incidence) {
  return sigma0 / (16.0 * pi * pi * range_m * range_m * cos_incidence);
}

double rcs_of_radiance(double radiance, double range_m, double solid_angle_sr) {
  return 16.0 * pi * pi * range_m * range_m * range_m * range_m * radiance * solid_angle_sr;
}

radar::RangeAzimuthImage paper_image(const PaperTextures& textures, const terrain::HeightField& terrain,
                                     const radar::Radar& radar, const radar::Rectangle& area,
                                     const radar::RangeAzimuthGrid& grid, const PaperLookUp& look_up,
                                     unsigned threads) {
  if (!(radar.position.z > terrain.highest_m())) {
    throw Error(
        radar::title_of(radar),
        fmt::format("stands at {:.1f} m, and the highest ground at {:.1f} m", radar.position.z, terrain.highest_m()),
        "place the radar above the ground: the paper's camera looks down on all of it");
  }
  const radar::Rectangle ground = terrain.extent();
  const Vec2d place{radar.position.x, radar.position.y};
  const Vec2d nearest{std::clamp(place.x, ground.west_m, ground.east_m),
                      std::clamp(place.y, ground.south_m, ground.north_m)};
  double far_m = 0.0;
  for (const double x : {ground.west_m, ground.east_m}) {
    for (const double y : {ground.south_m, ground.north_m}) far_m = std::max(far_m, length(Vec2d{x, y} - place));
  }
  receiver::RangeAzimuthReceiver receiver(radar, grid);
  const PixelColumn column(textures, terrain, radar, area, look_up, grid.range_step_m / pixels_per_range_bin);
  const unsigned workers = thread_count(threads);
  std::vector<std::vector<radar::Echo>> echoes(workers);
  parallel_for(grid.azimuths, workers, [&](std::size_t index, unsigned worker) {
    echoes[worker].clear();
    const double azimuth = grid.first_azimuth_rad + (static_cast<double>(index) + 0.5) * grid.azimuth_step_rad;
    column.cast(azimuth, grid.azimuth_step_rad, length(nearest - place), far_m, echoes[worker]);
    receiver.add(echoes[worker]);
  });
  return receiver.image();
}

}  // namespace sigmascape::render
