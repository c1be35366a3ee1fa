#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/radar/layer_stack.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::simulate {

/// What the shapes alone tell of a map's cells. A cell stands for the ground in its middle, and is seen from where the
/// radar is at time zero, or with Mode::Stripmap from where it is as its beam passes (radar::vantage_of). The Earth is
/// flat.
enum class LayerKind {
  Shadow,     ///< 1 where the radar does not see the ground, be it from beneath a roof or from behind a hill; else 0
  Layover,    ///< 1 where something else that the radar sees, terrain as well, lies over the ground, at the same range
              ///< and azimuth; else 0
  Incidence,  ///< angle between the terrain's normal and the direction to the radar
  Range,      ///< slant range of the ground
  Class,      ///< number of what is seen from straight above, see class_names
  Height,     ///< of what is seen from straight above, over mean sea level
};

/// The kind called "shadow", "layover", "incidence", "range", "class" or "height". Throws Error for another word.
[[nodiscard]] LayerKind layer_kind(std::string_view name);
[[nodiscard]] std::string_view name_of(LayerKind kind);

/// Behind crowns the ground counts as hidden when less than this part of its power comes back, through gaps that both
/// ways share or through a medium twice (docs/physics/vegetation.md).
inline constexpr double crown_hides_below = 0.5;

/// The layers of the full scene on its terrain, by rays: what level of detail 0 sees. Echoes of a cell that is in
/// shadow and not in layover are none but those of several bounces.
///
/// A surface lies over a cell when an arc of equal range and azimuth from the ground of the cell meets it, and the
/// radar sees it there. Arcs from places all over the cell are asked, as its echoes are gathered from all of it.
/// `geometry` stands on the terrain. Classes are the scene's materials. Behind the boxes of `targets` the radar sees
/// nothing, at the time at which each is looked at; otherwise they are in no layer, for each answers from one place
/// alone.
[[nodiscard]] radar::LayerStack traced_layers(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                              const radar::Radar& radar, const radar::GroundGrid& grid,
                                              std::span<const LayerKind> kinds, unsigned threads = 0,
                                              std::span<const radar::Target> targets = {});

/// What levels of detail from 1 on know of the ground. All must outlive the call.
struct CoarseGround {
  const terrain::HeightField* terrain = nullptr;
  const radar::ObstacleMap* obstacles = nullptr;  ///< may be absent: bare ground
  const scene::MaterialMap* materials = nullptr;  ///< asked for classes alone
  std::size_t material_count = 0;                 ///< of the scene: what the other classes are numbered after
  /// How high obstacles reach above their ground at most, when that is known: sweeps need go no further than where the
  /// highest could still lie over the map.
  double tallest_m = std::numeric_limits<double>::infinity();
};

/// The same from terrain and obstacles, as levels of detail from 1 on see them: by a sweep outwards along azimuths, or
/// a strip's parallel lines, that are half a cell apart. Layover is told for the ground that the radar is above.
/// Classes are the scene's materials for bare ground, then one for solid things and one for crowns. Where a box of
/// `targets` hides the ground, nothing that stands on it is seen either, as in the map.
[[nodiscard]] radar::LayerStack swept_layers(const CoarseGround& ground, const radar::Radar& radar,
                                             const radar::GroundGrid& grid, std::span<const LayerKind> kinds,
                                             unsigned threads = 0, std::span<const radar::Target> targets = {});

/// Names of the classes in the order of their numbers: the materials, then what swept_layers adds to them.
[[nodiscard]] std::vector<std::string> class_names(const scene::Scene& scene);

}  // namespace sigmascape::simulate
