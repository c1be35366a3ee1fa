#include "sigmascape/render/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/units.h"

namespace sigmascape::render {
namespace {

/// Whether what stands on the ground may be left out of the geometry, because it is too small, or too finely meshed,
/// to be told apart.
bool may_go(const DetailChoice& choice, const DetailSettings& settings) {
  if (settings.rule == DetailRule::PixelsPerTriangle) return choice.pixels_per_triangle < settings.pixels_per_triangle;
  return std::max(choice.layover_m, choice.shadow_m) <= choice.allowed_reach_m;
}

}  // namespace

int terrain_level_for(double sample_m, double spacing_m, int levels) {
  const double nodes = std::log2(2.0 * sample_m / spacing_m);
  return static_cast<int>(std::clamp(std::floor(nodes), 0.0, static_cast<double>(levels - 1)));
}

DetailChoice choose_detail(const DetailQuestion& question, const DetailSettings& settings) {
  DetailChoice choice{.traceable = question.traceable, .ground_apart = question.ground_apart, .rule = settings.rule};
  const double grazing = std::clamp(question.grazing_rad, 1e-4, 0.5 * pi - 1e-4);
  choice.cell_m = std::min(question.range_resolution_m / std::cos(grazing), question.cross_range_m);
  choice.sample_m = choice.cell_m / question.samples_per_cell;
  choice.layover_m = question.tallest_object_m * std::tan(grazing);
  choice.shadow_m = question.tallest_object_m / std::tan(grazing);
  choice.allowed_reach_m = settings.reach_per_cell * choice.cell_m;
  choice.pixels_per_triangle = 1.0 / (question.triangles_per_m2 * choice.sample_m * choice.sample_m);
  choice.geometry_may_go = may_go(choice, settings);
  choice.traced_for_size = question.area_m2 <= settings.largest_traced_m2;

  const double finest = std::log2(choice.sample_m / question.texel_m);
  choice.finer_than_atlas = finest < 0.0;
  choice.mip = std::clamp(finest, 0.0, static_cast<double>(question.mips - 1));
  choice.terrain_level = terrain_level_for(question.texel_m * std::exp2(std::floor(choice.mip)),
                                           question.terrain_spacing_m, question.terrain_levels);

  const bool traced = choice.traceable && choice.traced_for_size && !choice.geometry_may_go;
  choice.wanted_level = traced ? std::min(0.0, finest) : 1.0 + std::max(finest, 0.0);
  choice.level = traced ? 0 : 1 + static_cast<int>(std::floor(choice.mip));
  return choice;
}

std::string explained(const DetailChoice& choice) {
  std::string text = fmt::format(
      "level of detail {}: {}\n", choice.level,
      choice.level == 0 ? "the full scene, path-traced"
                        : fmt::format("terrain level {}, atlas mip {:.2f}", choice.terrain_level, choice.mip));
  text += fmt::format("  a resolution cell is {:.3g} m on its smaller side, a ground sample {:.3g} m\n", choice.cell_m,
                      choice.sample_m);
  if (choice.rule == DetailRule::PixelsPerTriangle) {
    text += fmt::format("  a triangle of the full scene covers {:.3g} samples: geometry {}\n",
                        choice.pixels_per_triangle, choice.geometry_may_go ? "may go" : "stays");
  } else {
    text += fmt::format(
        "  the tallest object lays over {:.3g} m and shadows {:.3g} m; {:.3g} m may be dropped: geometry {}\n",
        choice.layover_m, choice.shadow_m, choice.allowed_reach_m, choice.geometry_may_go ? "may go" : "should stay");
  }
  if (!choice.geometry_may_go && choice.level > 0) {
    text += fmt::format("  {}: the atlas stands in for geometry, shadows are {}\n",
                        choice.traceable ? "the area is too large to be traced" : "what is traced is power alone",
                        choice.ground_apart ? "cast at run time" : "the baked ones");
  }
  if (choice.finer_than_atlas && choice.level > 0) text += "  samples lie closer than the texels of the atlas\n";
  return text;
}

DetailBlend DetailTransition::advance(const DetailChoice& choice, const DetailSettings& settings) {
  if (!begun_) {
    begun_ = true;
    level_ = next_ = choice.level;
    return {level_, level_, 0.0};
  }
  if (next_ == level_) {
    // A level holds for wishes from `level` to `level` + 1, and for a margin beyond either.
    const double position = choice.wanted_level - static_cast<double>(level_);
    const bool coarser = choice.level > level_ && position >= 1.0 + settings.hysteresis;
    const bool finer = choice.level < level_ && position < -settings.hysteresis;
    if (!coarser && !finer) return {level_, level_, 0.0};
    next_ = choice.level;
    frame_ = 0;
  }
  ++frame_;
  const DetailBlend blend{level_, next_, std::min(1.0, static_cast<double>(frame_) / static_cast<double>(frames_))};
  if (frame_ >= frames_) level_ = next_;
  return blend;
}

}  // namespace sigmascape::render
