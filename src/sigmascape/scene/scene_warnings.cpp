#include "sigmascape/scene/scene_warnings.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

/// By what angle the frame's north lies east of true north at a place: tan γ = tanh(x/R) tan(φ0 + y/R), the convergence
/// of meridians in a transverse Mercator projection of a sphere.
double convergence_rad(const geo::LocalFrame& frame, Vec2d place) {
  constexpr double radius_m = 6'371'008.8;
  return std::atan(std::tanh(place.x / radius_m) *
                   std::tan(radians_from_deg(frame.latitude_deg()) + place.y / radius_m));
}

std::optional<std::string> turned_north(const Scene& scene) {
  constexpr double tolerated_deg = 0.5;
  const Vec2d middle = scene.extent.centre();
  const double turned_deg = deg_from_radians(convergence_rad(scene.frame, middle));
  if (!(std::abs(turned_deg) > tolerated_deg)) return std::nullopt;
  return fmt::format(
      "{}: {:.0f} km from the scene's origin, in its middle, the north of its frame, from which azimuths count, lies "
      "{:.1f}° {} of true north; state an origin_lat_deg and origin_lon_deg nearer to it",
      scene.name, length(middle) / 1e3, std::abs(turned_deg), turned_deg > 0.0 ? "east" : "west");
}

}  // namespace

std::vector<std::string> warnings_of(const Scene& scene) {
  std::vector<std::string> warnings;
  for (const auto& [what, count, first, is_likely_a_mistake] : scene.remarks) {
    if (is_likely_a_mistake) warnings.push_back(fmt::format("{}: {}: {}, first {}", scene.name, what, count, first));
  }
  if (auto warning = turned_north(scene)) warnings.push_back(std::move(*warning));
  return warnings;
}

}  // namespace sigmascape::scene
