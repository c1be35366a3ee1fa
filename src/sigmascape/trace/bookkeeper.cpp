#include "sigmascape/trace/bookkeeper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::trace {
namespace {

/// Numbers of a sample that no vertex of a path uses.
constexpr std::uint32_t first_pair = 0x8000, first_choice = 0x20000;

/// How closely directions lie about the mirror direction: density (n + 1) / 2π cosⁿ. Half a sphere evenly, wide and
/// narrow lobes, so that surfaces of all kinds are found.
constexpr std::array exponents{0.0F, 30.0F, 300.0F, 3000.0F};

struct Probe {
  Vec3f direction;
  float pdf = 0.0F;
};

Vec3f axis_of(std::size_t lobe, Vec3f normal, Vec3f mirrored) {
  return exponents[lobe] == 0.0F ? normal : mirrored;
}

/// A direction from the mixture of the lobes, in a density that owes nothing to the scattering models.
Probe probe(Vec3f to_source, Vec3f normal, float choice, Vec2f u) {
  const Vec3f mirrored = normalized(normal * (2.0F * dot(to_source, normal)) - to_source);
  const auto lobe = static_cast<std::size_t>(choice * static_cast<float>(exponents.size()));
  const float z = std::pow(u.x, 1.0F / (exponents[lobe] + 1.0F));
  const float radius = std::sqrt(1.0F - z * z), phi = static_cast<float>(2.0 * pi) * u.y;
  const Vec3f direction =
      Basis(axis_of(lobe, normal, mirrored)).world_from_local({radius * std::cos(phi), radius * std::sin(phi), z});
  float density = 0.0F;
  for (std::size_t other = 0; other < exponents.size(); ++other) {
    const float cosine = dot(direction, axis_of(other, normal, mirrored));
    if (cosine > 0.0F)
      density += (exponents[other] + 1.0F) / static_cast<float>(2.0 * pi) * std::pow(cosine, exponents[other]);
  }
  return {direction, density / static_cast<float>(exponents.size())};
}

Probe evenly(Vec2f u) {
  const float z = 1.0F - 2.0F * u.x, radius = std::sqrt(std::max(0.0F, 1.0F - z * z));
  const float phi = static_cast<float>(2.0 * pi) * u.y;
  return {{radius * std::cos(phi), radius * std::sin(phi), z}, static_cast<float>(0.25 / pi)};
}

}  // namespace

double Bookkeeper::carried(std::span<const Wave> waves) {
  double power = 0.0, density = 0.0;
  for (const Wave& wave : waves) {
    power += static_cast<double>(wave.fields.mean_power());
    density += static_cast<double>(wave.forward);
  }
  return power / density;
}

void Bookkeeper::is_scattered(Path& path, const Arrival& at, std::span<const Wave> waves) {
  if (!keeps_books_) return;
  const auto& [direction, hit, point, vertex] = at;
  const Vec3f to_source = -direction;
  // A medium scatters all around, not into a half space alone.
  const Vec2f u = point.pair(first_pair + vertex);
  const Probe to =
      hit.is_in_crown() ? evenly(u) : probe(to_source, hit.normal, point.independent(first_choice + 3 * vertex), u);
  const float cosine = hit.is_in_crown() ? 1.0F : dot(to.direction, hit.normal);
  double scattered = 0.0;
  if (cosine > 0.0F) {
    const scatter::PhaseDraw draw{point.independent(first_choice + 3 * vertex + 1),
                                  point.independent(first_choice + 3 * vertex + 2)};
    std::vector<Wave> onwards(waves.begin(), waves.end());
    for (std::size_t f = 0; f < surfaces_.size(); ++f) {
      onwards[f].fields = surfaces_[f][hit.material].scatter(waves[f].fields, to_source, to.direction,
                                                             {hit.normal, hit.inverse_facet_area_per_m2}, draw);
    }
    scattered = carried(onwards) * static_cast<double>(cosine / to.pdf);
  }
  add(books_.absorbed, path, carried(waves) - scattered);
}

}  // namespace sigmascape::trace
