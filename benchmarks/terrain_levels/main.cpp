// How much does a live frame lose of shadows and ranges on coarse terrain, when its nodes stand two texels apart, one,
// or half of one, against terrain as fine as it is known?

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "figures.h"

#include "sigmascape/base/units.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/render/level_of_detail.h"
#include "sigmascape/terrain/pyramid_levels.h"
#include "sigmascape/terrain/terrain_reader.h"
#include "sigmascape/terrain/terrain_window.h"

namespace {

using sigmascape::Vec2d;
using sigmascape::Vec3d;
using namespace sigmascape::terrain;

struct Place {
  std::string name, file;
  sigmascape::geo::LocalFrame frame;
  double spacing_m, smooth_within_m, half_m;
};

/// A line over the ground, seen from a radar that stands above its prolongation.
struct Profile {
  Vec2d begin, direction;
  double length_m;
  double radar_m, to_begin_m;  ///< height of the radar, and its distance along the ground from where the line begins

  [[nodiscard]] Vec2d at(double metres) const { return begin + direction * metres; }
};

/// What a walk over one surface finds in steps of a length: whether the middle of each is seen, and how high it lies.
struct Steps {
  std::vector<double> seen, height_m;
};

Steps walked(const TerrainView& ground, const Profile& profile, double step_m) {
  Steps steps;
  double steepest = -1e30;
  for (double d = 0.5 * step_m; d < profile.length_m; d += step_m) {
    const double height_m = height_at(ground, profile.at(d));
    const double slope = (height_m - profile.radar_m) / (profile.to_begin_m + d);
    steps.seen.push_back(slope >= steepest ? 1.0 : 0.0);
    steps.height_m.push_back(height_m);
    steepest = std::max(steepest, slope);
  }
  return steps;
}

/// Means of so many steps each.
std::vector<double> means(const std::vector<double>& values, std::size_t together) {
  std::vector<double> result(values.size() / together, 0.0);
  for (std::size_t i = 0; i < result.size() * together; ++i)
    result[i / together] += values[i] / static_cast<double>(together);
  return result;
}

/// What is wrong with one level, over all profiles.
struct Errors {
  double seen = 0.0, truly_seen = 0.0, differ = 0.0;  ///< in cells
  std::size_t cells = 0;
  double worst_quarters = 0.0;  ///< of a range cell, that a texel's mean height shifts its range by

  void add(const Steps& level, const Steps& truth, std::size_t finer, double sine, double quarter_m) {
    // Two texels are a cell.
    const std::vector<double> here = means(level.seen, 2), there = means(truth.seen, 2 * finer);
    for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i, ++cells) {
      seen += here[i];
      truly_seen += there[i];
      differ += std::abs(here[i] - there[i]);
    }
    const std::vector<double> height = means(truth.height_m, finer);
    for (std::size_t i = 0; i < std::min(height.size(), level.height_m.size()); ++i)
      worst_quarters = std::max(worst_quarters, std::abs(level.height_m[i] - height[i]) * sine / quarter_m);
  }
};

std::vector<Profile> profiles_over(const HeightField& field, double elevation_deg) {
  std::vector<Profile> profiles;
  const sigmascape::radar::Rectangle r = field.extent();
  const Vec2d middle = r.centre();
  const double half_m = 0.45 * std::min(r.width_m(), r.height_m()), range_m = 40e3;
  const double elevation = sigmascape::radians_from_deg(elevation_deg);
  for (int azimuth_deg = 10; azimuth_deg < 360; azimuth_deg += 45) {
    const Vec2d direction = sigmascape::radar::horizontal_direction(sigmascape::radians_from_deg(azimuth_deg));
    const Vec2d aside{direction.y, -direction.x};
    for (double side = -1.0; side <= 1.0; side += 0.04) {
      const double length_m = 2.0 * half_m * std::sqrt(1.0 - side * side);
      if (length_m < 500.0) continue;
      profiles.push_back({middle + aside * (side * half_m) - direction * (0.5 * length_m), direction, length_m,
                          field.height_at(middle) + range_m * std::sin(elevation),
                          range_m * std::cos(elevation) - 0.5 * length_m});
    }
  }
  return profiles;
}

/// One landscape at all levels.
class Ground {
 public:
  Ground(const Place& place, const std::filesystem::path& data)
      : place_(place), field_(read(place, data)), pyramid_(pyramid_in_memory(field_)) {
    for (int level = 0; level < pyramid_.levels(); ++level) {
      levels_.emplace_back(4096, WindowSlopes::None);
      levels_.back().fill(pyramid_, field_.extent(), level);
    }
  }

  [[nodiscard]] int level_for(double texel_m) const {
    return sigmascape::render::terrain_level_for(texel_m, place_.spacing_m, pyramid_.levels());
  }

  /// In steps of a texel, as a sweep takes, against level 0 in steps of half its own spacing.
  [[nodiscard]] Errors errors(int level, double texel_m, double elevation_deg) const {
    const double elevation = sigmascape::radians_from_deg(elevation_deg);
    const auto finer = static_cast<std::size_t>(std::lround(2.0 * texel_m / place_.spacing_m));
    // Two texels are a cell.
    const double quarter_m = 0.25 * 2.0 * texel_m * std::cos(elevation);
    Errors errors;
    for (const Profile& profile : profiles_over(field_, elevation_deg)) {
      const Steps truth = walked(levels_[0].view(), profile, texel_m / static_cast<double>(finer));
      const Steps here = walked(levels_[static_cast<std::size_t>(level)].view(), profile, texel_m);
      errors.add(here, truth, finer, std::sin(elevation), quarter_m);
    }
    return errors;
  }

  [[nodiscard]] const Place& place() const { return place_; }

 private:
  static HeightField read(const Place& place, const std::filesystem::path& data) {
    TerrainSource source;
    source.raster = {data / place.file, 1, ""};
    source.spacing_m = place.spacing_m;
    source.smooth_within_m = place.smooth_within_m;
    const sigmascape::radar::Rectangle wanted{-place.half_m, -place.half_m, place.half_m, place.half_m};
    return read_terrain(source, place.frame, wanted).field;
  }

  Place place_;
  HeightField field_;
  TerrainPyramid pyramid_;
  std::vector<TerrainWindow> levels_;
};

void measure(const Ground& ground, bool quick, sigmascape::bench::Figures& figures) {
  const double spacing_m = ground.place().spacing_m;
  const Errors none = ground.errors(0, 0.5 * spacing_m, 6.0);
  sigmascape::bench::prove(none.differ == 0.0 && none.truly_seen > 0.0, "a level differs in nothing from itself");
  for (const double elevation_deg : quick ? std::vector{6.0} : std::vector{3.0, 6.0, 12.0, 25.0, 45.0}) {
    for (const double texel_m : {spacing_m, 2.0 * spacing_m, 4.0 * spacing_m}) {
      const int by_rule = ground.level_for(texel_m);
      for (int level = by_rule; level >= 0; --level) {
        const Errors errors = ground.errors(level, texel_m, elevation_deg);
        const std::string name = fmt::format("terrain_levels.{}.{:g}_deg.texel_{:g}_m.level_{}", ground.place().name,
                                             elevation_deg, texel_m, level);
        const std::string_view note = level == by_rule ? "that of live frames" : "";
        figures.add(name + ".shadow_error", 100.0 * errors.differ / errors.truly_seen, "% of seen ground", note);
        figures.add(name + ".bias", 10.0 * std::log10(errors.seen / errors.truly_seen), "dB of seen ground", note);
        if (level == 0)
          figures.add(name + ".hidden", 100.0 - 100.0 * errors.truly_seen / static_cast<double>(errors.cells), "%");
        figures.add(name + ".range_error", errors.worst_quarters, "quarters of a range cell, at worst", note);
      }
    }
  }
}

}  // namespace

int main(int count, char** words) {
  const auto arguments = sigmascape::bench::Arguments::parsed(count, words);
  sigmascape::bench::Figures figures(arguments.out);
  const char* const data = std::getenv("SIGMASCAPE_DATA");
  for (const Place& place :
       {Place{"bilbao", "bilbao/dem_5m_utm30n.tif", {43.312, -2.986}, 5.0, 0.5, 1600.0},
        Place{"san_francisco", "san_francisco/dem_3dep_1arcsec_4326.tif", {37.79, -122.41}, 10.0, 0.0, 4000.0}}) {
    if (data == nullptr || !std::filesystem::exists(std::filesystem::path(data) / place.file)) {
      fmt::print("{} is not measured: set SIGMASCAPE_DATA to the folder that holds {}\n", place.name, place.file);
      continue;
    }
    measure(Ground(place, data), arguments.quick, figures);
  }
}
