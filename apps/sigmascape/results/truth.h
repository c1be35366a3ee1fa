#pragma once

#include <cstdint>
#include <filesystem>

#include "results/plan.h"

#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::cli {

/// A scene that is measured, under its short name.
struct MeasuredScene {
  std::string name;  ///< "hills", "level" or "place"
  scene::Scene scene;
  trace::SceneGeometry geometry;

  MeasuredScene(std::string short_name, scene::Scene of)
      : name(std::move(short_name)), scene(std::move(of)), geometry(scene, trace::Footing::Terrain) {}
};

/// The scene with its ground at height zero and every building upon it.
[[nodiscard]] scene::Scene levelled(scene::Scene scene);

/// What a path tracer makes of the scene with so many rays a cell, in range and azimuth.
[[nodiscard]] radar::RangeAzimuthImage traced_image(const MeasuredScene& measured, const radar::Radar& radar,
                                                    const radar::GroundGrid& grid, const ResultsPlan& plan,
                                                    std::uint32_t samples, std::uint64_t seed);

/// The path-traced map of a view, from two traced maps that differ in their seed alone.
struct Truth {
  radar::GroundMap first, second;
  radar::GroundMap mean;       ///< of the two, with half the variance of either: what baked maps are held against
  double trace_seconds = 0.0;  ///< processor time of one
};

/// Rays a cell of the two maps of the view that an earlier run has left in `folder`, with the same scene and settings;
/// 0 where they are not both there.
[[nodiscard]] std::uint32_t samples_kept(const MeasuredScene& measured, const PlannedView& view,
                                         const ResultsPlan& plan, const std::filesystem::path& folder);

/// Traces the view, or reads from `folder` what an earlier run traced there with the same scene, view and settings.
/// Where that has fewer rays than the view wants, the missing ones are traced and both count as one map.
[[nodiscard]] Truth traced_truth(const MeasuredScene& measured, const PlannedView& view, const ResultsPlan& plan,
                                 const std::filesystem::path& folder);

}  // namespace sigmascape::cli
