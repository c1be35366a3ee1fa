#include "results/optical_view.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <string_view>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::cli {
namespace {

/// Light, linear in power, red, green and blue.
using Light = Vec3f;

struct MaterialColour {
  std::string_view name;  ///< or the beginning of it
  Light colour;
};

constexpr Light unknown_colour{0.35F, 0.35F, 0.35F};
constexpr MaterialColour material_colours[] = {
    {"water", {0.03F, 0.09F, 0.16F}},          {"fresh_water", {0.03F, 0.09F, 0.16F}},
    {"grass", {0.17F, 0.30F, 0.08F}},          {"crops", {0.33F, 0.35F, 0.12F}},
    {"forest_floor", {0.12F, 0.11F, 0.06F}},   {"bare_soil", {0.36F, 0.24F, 0.14F}},
    {"asphalt", {0.12F, 0.12F, 0.13F}},        {"concrete", {0.42F, 0.41F, 0.39F}},
    {"paper_building", {0.60F, 0.30F, 0.22F}}, {"brick", {0.50F, 0.20F, 0.13F}},
    {"metal", {0.70F, 0.72F, 0.75F}},          {"paper_bark", {0.16F, 0.10F, 0.06F}},
    {"bark", {0.16F, 0.10F, 0.06F}},           {"paper_leaf", {0.06F, 0.17F, 0.04F}},
    {"leaf", {0.06F, 0.17F, 0.04F}},
};

/// What is shown in one colour on the map of materials.
struct GroundClass {
  std::string_view material;
  const char* legend;
  Light colour;
};

/// The colours of the paper's Figure 6: concrete black, trees green, grass red, water white, dirt blue; and two more.
constexpr GroundClass ground_classes[] = {
    {"concrete", "black concrete", {0, 0, 0}},
    {"asphalt", "grey asphalt", {0.22F, 0.22F, 0.22F}},
    {"forest_floor", "green forest floor", {0, 0.5F, 0}},
    {"grass", "red grass", {0.8F, 0, 0}},
    {"crops", "orange crops", {0.8F, 0.35F, 0}},
    {"water", "white water", {1, 1, 1}},
    {"fresh_water", "white water", {1, 1, 1}},
    {"bare_soil", "blue soil", {0, 0, 0.8F}},
};
constexpr GroundClass other_ground{"", "violet others", {0.35F, 0.1F, 0.5F}};

const GroundClass& class_of(const scatter::Material& material) {
  const auto known = std::ranges::find(ground_classes, material.name, &GroundClass::material);
  return known == std::end(ground_classes) ? other_ground : *known;
}

std::vector<Light> colours_of(const scene::Scene& scene) {
  std::vector<Light> colours;
  for (const scatter::Material& material : scene.materials) {
    const auto known = std::ranges::find(material_colours, material.name, &MaterialColour::name);
    colours.push_back(known == std::end(material_colours) ? unknown_colour : known->colour);
  }
  return colours;
}

std::uint8_t srgb_level(float power) {
  const double linear = std::clamp(static_cast<double>(power), 0.0, 1.0);
  const double coded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * coded));
}

/// Looks down on the scene, one vertical ray at a time.
class ViewFromAbove {
 public:
  ViewFromAbove(const scene::Scene& scene, const trace::SceneGeometry& geometry)
      : geometry_(geometry),
        colours_(colours_of(scene)),
        to_sun_(radar::direction_to_radar({radians_from_deg(135.0), radians_from_deg(40.0)}).to<float>()) {}

  [[nodiscard]] Light at(Vec2d point) const {
    const Vec3d start = Vec3d{point.x, point.y, geometry_.highest_m() + 10.0} - geometry_.origin();
    trace::SurfaceHit hit;
    if (!geometry_.intersect(start.to<float>(), {0.0F, 0.0F, -1.0F}, hit)) return {};
    constexpr float sky = 0.35F, sun = 1.3F, clear_of_surface_m = 0.02F;
    const Vec3f above = hit.position + hit.normal * clear_of_surface_m;
    const float facing = std::max(0.0F, dot(hit.normal, to_sun_));
    const bool sunlit = facing > 0.0F && !geometry_.occluded(above, to_sun_);
    return colours_[hit.material] * (sky + (sunlit ? sun * facing : 0.0F));
  }

 private:
  const trace::SceneGeometry& geometry_;
  std::vector<Light> colours_;
  Vec3f to_sun_;
};

}  // namespace

product::Picture optical_view(const scene::Scene& scene, const trace::SceneGeometry& geometry, std::size_t pixels_wide,
                              unsigned threads) {
  const double pixel_m = scene.extent.width_m() / static_cast<double>(pixels_wide);
  product::Picture picture;
  picture.grid = {scene.extent.west_m, scene.extent.north_m, pixel_m, pixels_wide,
                  static_cast<std::size_t>(scene.extent.height_m() / pixel_m)};
  picture.pixels = Array2D<product::Rgba>(picture.grid.columns, picture.grid.rows);
  picture.metadata = {{"scene", scene.name}, {"attribution", scene.attribution}};
  const ViewFromAbove view(scene, geometry);
  parallel_for(picture.grid.rows, threads, [&](std::size_t row, unsigned) {
    const trace::FlushDenormals flush;
    for (std::size_t column = 0; column < picture.grid.columns; ++column) {
      const Vec2d centre = picture.grid.centre_of(column, row);
      Light sum{};
      for (const double east : {-0.25, 0.25}) {
        for (const double north : {-0.25, 0.25}) sum += view.at(centre + Vec2d{east * pixel_m, north * pixel_m});
      }
      const Light light = sum * 0.25F;
      picture.pixels(column, row) = {srgb_level(light.x), srgb_level(light.y), srgb_level(light.z)};
    }
  });
  return picture;
}

MaterialView material_view(const scene::Scene& scene, std::size_t pixels_wide) {
  const double pixel_m = scene.extent.width_m() / static_cast<double>(pixels_wide);
  MaterialView view;
  product::Picture& picture = view.picture;
  picture.grid = {scene.extent.west_m, scene.extent.north_m, pixel_m, pixels_wide,
                  static_cast<std::size_t>(scene.extent.height_m() / pixel_m)};
  picture.pixels = Array2D<product::Rgba>(picture.grid.columns, picture.grid.rows);
  picture.metadata = {{"scene", scene.name}, {"attribution", scene.attribution}};
  std::set<std::string> legends;
  for (std::size_t row = 0; row < picture.grid.rows; ++row) {
    for (std::size_t column = 0; column < picture.grid.columns; ++column) {
      const GroundClass& seen = class_of(scene.materials[scene.ground.at(picture.grid.centre_of(column, row))]);
      picture.pixels(column, row) = {srgb_level(seen.colour.x), srgb_level(seen.colour.y), srgb_level(seen.colour.z)};
      legends.insert(seen.legend);
    }
  }
  view.classes = legends.size();
  view.legend = fmt::format("{}", fmt::join(legends, ", "));
  return view;
}

}  // namespace sigmascape::cli
