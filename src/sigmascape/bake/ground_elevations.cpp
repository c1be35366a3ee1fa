#include "sigmascape/bake/ground_elevations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/surface_sigma0.h"

namespace sigmascape::bake {
namespace {

/// Elevations are chosen for all frequencies at once.
constexpr double any_hz = 1e9;

/// An elevation to choose, and how far off what is read there may be without it.
struct Candidate {
  double elevation_rad = 0.0;
  double tolerance_db = ground_tolerance_db;
};

/// Close enough that no σ0 bends by much between two of them: elevations to choose from, ascending. Tenths of degrees,
/// which names of files tell, or in place of them what looks were baked at.
std::vector<Candidate> candidates_beside(const std::vector<double>& baked_rad) {
  std::map<std::string, Candidate> by_name;  // of which the higher elevation's is the later
  const auto add = [&](double elevation_rad, double tolerance_db) {
    by_name.try_emplace(atlas::look_name({{0.0, elevation_rad}, any_hz}), Candidate{elevation_rad, tolerance_db});
  };
  constexpr int lowest_tenths = 2, highest_tenths = 890;
  for (const double elevation_rad : baked_rad) {
    const double degrees = deg_from_radians(elevation_rad);
    if (degrees > lowest_tenths / 10.0 && degrees < highest_tenths / 10.0) add(elevation_rad, at_looks_tolerance_db);
  }
  for (int tenths = lowest_tenths; tenths <= highest_tenths; tenths += tenths < 30 ? 1 : 2)
    add(radians_from_deg(tenths / 10.0), ground_tolerance_db);
  std::vector<Candidate> candidates;
  for (const auto& [name, candidate] : by_name) candidates.push_back(candidate);
  return candidates;
}

/// σ0 of one material at one frequency, at every candidate.
using Curve = std::vector<radar::Channels>;

std::vector<Curve> curves_of_ground(const scene::Scene& scene, const std::vector<double>& frequencies_hz,
                                    const std::vector<Candidate>& candidates) {
  std::vector<Curve> curves;
  for (const scene::MaterialIndex material : scene.ground.materials_laid()) {
    for (const double frequency_hz : frequencies_hz) {
      const scatter::SurfaceModel surface(scene.materials[material], frequency_hz);
      Curve& curve = curves.emplace_back();
      for (const Candidate& candidate : candidates) curve.push_back(surface_sigma0(surface, candidate.elevation_rad));
    }
  }
  return curves;
}

/// How far apart two σ0 are, above the floor.
double distance_db(float one, float other) {
  const double floor = linear_from_db(ground_floor_db);
  return std::abs(db_from_linear((static_cast<double>(one) + floor) / (static_cast<double>(other) + floor)));
}

double distance_db(const radar::Channels& one, const radar::Channels& other) {
  return std::max({distance_db(one.vv, other.vv), distance_db(one.hh, other.hh), distance_db(one.hv, other.hv)});
}

/// Chooses among the candidates as lines are simplified: from each chosen one as far as what is read on the way is
/// close enough to what is true.
class Choice {
 public:
  Choice(const std::vector<Candidate>& candidates, const std::vector<Curve>& curves)
      : candidates_(candidates), curves_(curves) {}

  [[nodiscard]] std::vector<double> chosen() const {
    std::vector<double> chosen{candidates_.front().elevation_rad};
    for (std::size_t last = 0; last + 1 < candidates_.size();) {
      last = farthest_from(last);
      chosen.push_back(candidates_[last].elevation_rad);
    }
    return chosen;
  }

 private:
  [[nodiscard]] std::size_t farthest_from(std::size_t first) const {
    // The farther, the more what is read sags: by bisection.
    std::size_t close = first + 1, too_far = candidates_.size();
    while (close + 1 < too_far) {
      const std::size_t middle = (close + too_far) / 2;
      (is_close_between(first, middle) ? close : too_far) = middle;
    }
    return close;
  }

  [[nodiscard]] bool is_close_between(std::size_t first, std::size_t last) const {
    for (std::size_t between = last - 1; between > first; --between) {
      if (distance_at(first, between, last) > candidates_[between].tolerance_db) return false;
    }
    return true;
  }

  [[nodiscard]] double distance_at(std::size_t first, std::size_t between, std::size_t last) const {
    const std::array ends{first, last};
    const atlas::AspectGrid grid{{0.0}, {candidates_[first].elevation_rad, candidates_[last].elevation_rad}, {any_hz}};
    const auto weights = atlas::weights_for(grid, {0.0, candidates_[between].elevation_rad}, any_hz);
    double furthest_db = 0.0;
    for (const Curve& curve : curves_) {
      radar::Channels read;
      for (std::size_t i = 0; i < weights.count; ++i) read += curve[ends[weights.look[i]]] * weights.weight[i];
      furthest_db = std::max(furthest_db, distance_db(read, curve[between]));
    }
    return furthest_db;
  }

  const std::vector<Candidate>& candidates_;
  const std::vector<Curve>& curves_;
};

}  // namespace

std::vector<double> ground_elevations_rad(const scene::Scene& scene, const atlas::AspectGrid& looks) {
  const std::vector<Candidate> candidates = candidates_beside(looks.elevations_rad);
  const std::vector<Curve> curves = curves_of_ground(scene, looks.frequencies_hz, candidates);
  return Choice(candidates, curves).chosen();
}

}  // namespace sigmascape::bake
