#include "sigmascape/bake/ground_elevations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/surface_sigma0.h"

namespace sigmascape::bake {
namespace {

/// Close enough that no σ0 bends by much between two of them: elevations to choose from, ascending. Tenths of degrees,
/// which names of files tell (atlas::look_name).
std::vector<double> candidates_rad() {
  std::vector<double> candidates;
  for (int tenths = 2; tenths <= 890; tenths += tenths < 30 ? 1 : 2)
    candidates.push_back(radians_from_deg(tenths / 10.0));
  return candidates;
}

/// σ0 of one material at one frequency, at every candidate.
using Curve = std::vector<radar::Channels>;

std::vector<Curve> curves_of_ground(const scene::Scene& scene, const std::vector<double>& frequencies_hz,
                                    const std::vector<double>& candidates) {
  const auto& laid = scene.ground.material.values();
  std::vector<Curve> curves;
  for (const scene::MaterialIndex material : std::set(laid.begin(), laid.end())) {
    for (const double frequency_hz : frequencies_hz) {
      const scatter::SurfaceModel surface(scene.materials[material], frequency_hz);
      Curve& curve = curves.emplace_back();
      for (const double elevation_rad : candidates) curve.push_back(surface_sigma0(surface, elevation_rad));
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

/// Chooses among the candidates as lines are simplified: where what is read between two chosen ones is furthest from
/// what is true, the candidate there is chosen as well, until all of it is close enough.
class Choice {
 public:
  Choice(const std::vector<double>& candidates, const std::vector<Curve>& curves)
      : candidates_(candidates), curves_(curves) {}

  [[nodiscard]] std::vector<double> chosen() const {
    std::vector<double> chosen{candidates_.front()};
    refine(0, candidates_.size() - 1, chosen);
    return chosen;
  }

 private:
  /// Appends what is needed after the first of two candidates up to the last.
  void refine(std::size_t first, std::size_t last, std::vector<double>& chosen) const {
    double worst_db = 0.0;
    std::size_t worst = first;
    for (std::size_t between = first + 1; between < last; ++between) {
      if (const double away_db = distance_at(first, between, last); away_db > worst_db) {
        worst_db = away_db;
        worst = between;
      }
    }
    if (worst_db > ground_tolerance_db) {
      refine(first, worst, chosen);
      refine(worst, last, chosen);
    } else {
      chosen.push_back(candidates_[last]);
    }
  }

  [[nodiscard]] double distance_at(std::size_t first, std::size_t between, std::size_t last) const {
    constexpr double any_hz = 1e9;
    const std::array ends{first, last};
    const atlas::AspectGrid grid{{0.0}, {candidates_[first], candidates_[last]}, {any_hz}};
    const auto weights = atlas::weights_for(grid, {0.0, candidates_[between]}, any_hz);
    double furthest_db = 0.0;
    for (const Curve& curve : curves_) {
      radar::Channels read;
      for (std::size_t i = 0; i < weights.count; ++i) read += curve[ends[weights.look[i]]] * weights.weight[i];
      furthest_db = std::max(furthest_db, distance_db(read, curve[between]));
    }
    return furthest_db;
  }

  const std::vector<double>& candidates_;
  const std::vector<Curve>& curves_;
};

}  // namespace

std::vector<double> ground_elevations_rad(const scene::Scene& scene, const std::vector<double>& frequencies_hz) {
  const std::vector<double> candidates = candidates_rad();
  const std::vector<Curve> curves = curves_of_ground(scene, frequencies_hz, candidates);
  return Choice(candidates, curves).chosen();
}

}  // namespace sigmascape::bake
