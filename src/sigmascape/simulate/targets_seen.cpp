#include "sigmascape/simulate/targets_seen.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::simulate {
namespace {

/// Less is not worth a word.
constexpr double told_loss_db = 1.0;

/// "target a", or "of 5 targets 2 (a and b)": who it is that something is said of.
std::string subject_of(std::span<const radar::Target* const> told, std::size_t all) {
  if (all == 1) return "target " + names_of(told);
  return fmt::format("of {} targets {} ({})", all, told.size(), names_of(told));
}

/// Of those within an area, or without one of all.
TargetsSeen told_of(std::span<const TargetInSight> targets, const std::optional<radar::Rectangle>& area) {
  std::vector<const radar::Target*> within, hidden, weakened;
  double least_part = 1.0;
  for (const TargetInSight& sight : targets) {
    if (area && !area->contains({sight.position.x, sight.position.y})) continue;
    within.push_back(sight.target);
    if (!(sight.part_seen > 0.0)) {
      hidden.push_back(sight.target);
    } else if (-db_from_linear(sight.part_seen) >= told_loss_db) {
      weakened.push_back(sight.target);
      least_part = std::min(least_part, sight.part_seen);
    }
  }
  TargetsSeen told{.count = within.size() - hidden.size(), .warnings = {}};
  if (within.empty()) {
    const std::vector<const radar::Target*> first{targets.front().target};
    told.warnings.push_back(targets.size() == 1
                                ? subject_of(first, 1) + " stands beside what is mapped"
                                : fmt::format("all {} targets stand beside what is mapped", targets.size()));
  }
  if (!hidden.empty()) {
    told.warnings.push_back(fmt::format("{} {} hidden by ground or by what stands on it, and nothing of {} is seen",
                                        subject_of(hidden, targets.size()), hidden.size() == 1 ? "is" : "are",
                                        hidden.size() == 1 ? "it" : "them"));
  }
  if (!weakened.empty()) {
    told.warnings.push_back(fmt::format("{} {} behind crowns, which leave {:.1f} dB less of {}",
                                        subject_of(weakened, targets.size()), weakened.size() == 1 ? "is" : "are",
                                        -db_from_linear(least_part),
                                        weakened.size() == 1 ? "it" : "the one that they weaken most"));
  }
  return told;
}

/// Each from where and when the radar looks at it.
std::vector<TargetInSight> sights_of(std::span<const radar::Target> targets, const radar::Radar& radar,
                                     const radar::Rectangle& area, const terrain::HeightField& terrain,
                                     const radar::ObstacleMap* obstacles) {
  const Obstructions obstructions{terrain, obstacles, radar::earth_of(radar)};
  return targets_in_sight(targets, radar::vantage_of(radar, area.centre()),
                          [&](Vec3d from, Vec3d point) { return part_seen(obstructions, from, point); });
}

}  // namespace

std::string names_of(std::span<const radar::Target* const> targets) {
  constexpr std::size_t most = 4;
  const std::size_t named = targets.size() > most ? most - 1 : targets.size();
  std::string names;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) names += i + 1 == targets.size() ? " and " : ", ";
    names += targets[i]->name;
  }
  if (named < targets.size()) names += fmt::format(" and {} more", targets.size() - named);
  return names;
}

TargetsSeen targets_in_map(std::span<const radar::Target> targets, const radar::Radar& radar,
                           const radar::Rectangle& area, const terrain::HeightField& terrain,
                           const radar::ObstacleMap* obstacles) {
  if (targets.empty()) return {};
  return told_of(sights_of(targets, radar, area, terrain, obstacles), area);
}

TargetsSeen targets_in_pulses(std::span<const radar::Target> targets, const radar::Radar& radar,
                              const radar::Rectangle& area, const terrain::HeightField& terrain,
                              const radar::ObstacleMap* obstacles) {
  if (targets.empty()) return {};
  return told_of(sights_of(targets, radar, area, terrain, obstacles), std::nullopt);
}

TargetsSeen targets_in_traced(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                              std::span<const radar::Target> targets, const radar::Radar& radar,
                              const radar::Rectangle& area) {
  std::vector<radar::Target> all = targets_of(scene);
  all.insert(all.end(), targets.begin(), targets.end());
  if (all.empty()) return {};
  const auto surfaces = trace::surface_models(scene, radar.frequency_hz);
  return told_of(targets_in_sight(all, radar::Vantage(radar.position),
                                  [&](Vec3d from, Vec3d point) { return part_seen(geometry, surfaces, from, point); }),
                 area);
}

}  // namespace sigmascape::simulate
