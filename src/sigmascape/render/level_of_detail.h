#pragma once

#include <string>

namespace sigmascape::render {

/// How detail is chosen; docs/decisions/0036-level-of-detail.md.
enum class DetailRule {
  /// Geometry goes when neither its layover nor its shadow reaches further than a part of the resolution cell.
  LayoverAndShadow,
  /// The paper's: geometry goes when its triangles cover fewer than 16 pixels on average.
  PixelsPerTriangle,
};

/// What the choice follows from.
struct DetailQuestion {
  double range_resolution_m = 2.0;  ///< half-power width of the pulse, along the line of sight
  double cross_range_m = 2.0;     ///< half-power width of the beam on the ground: r·θ, or λ·r/(2·L) of an aperture
  double grazing_rad = 0.15;      ///< ψ, somewhere in the middle of the sector
  double samples_per_cell = 2.0;  ///< ground samples wanted along the smaller side of a cell
  double tallest_object_m = 25.0;  ///< above the ground, of what would be dropped
  double area_m2 = 0.0;            ///< of ground to be mapped
  /// What the store offers: level k of the terrain has nodes 2ᵏ, and mip m of the atlas texels 2ᵐ as far apart.
  double terrain_spacing_m = 5.0;
  int terrain_levels = 1;
  double texel_m = 2.0;
  int mips = 1;
  bool ground_apart = false;       ///< the atlas keeps the ground apart, and what stands on it hides it at run time
  double triangles_per_m2 = 0.01;  ///< of the full scene; for DetailRule::PixelsPerTriangle
  bool traceable = true;           ///< false for maps of a coherent mode, of which level 0 gives none
};

struct DetailSettings {
  DetailRule rule = DetailRule::LayoverAndShadow;
  /// ε: the part of a cell that layover and shadow may reach before geometry has to stay.
  double reach_per_cell = 0.5;
  double pixels_per_triangle = 16.0;
  /// Largest area that is traced live; beyond it the atlas stands in, whatever the rule says: LOD 0 costs by area.
  double largest_traced_m2 = 512.0 * 512.0;
  /// How far, in levels, the wish must have moved before a level in use is left.
  double hysteresis = 0.25;
};

/// The level of detail, and how it came about.
struct DetailChoice {
  /// 0 traces the full scene; from 1 on, coarse terrain and mip `mip` of the atlas.
  int level = 1;
  double wanted_level = 1.0;     ///< before rounding: 1 + mip, whether there is one so coarse or not, or below 1 where
                                 ///< geometry should stay
  double mip = 0.0;              ///< fractional: maps blend two levels of texture, live frames take the finer
  int terrain_level = 0;         ///< whose nodes stand at most two texels of the mip apart
  double cell_m = 0.0;           ///< smaller side of the resolution cell on the ground
  double sample_m = 0.0;         ///< distance of ground samples
  double layover_m = 0.0;        ///< h·tan ψ
  double shadow_m = 0.0;         ///< h·cot ψ
  double allowed_reach_m = 0.0;  ///< ε·cell
  double pixels_per_triangle = 0.0;
  bool geometry_may_go = false;  ///< by the rule in use
  bool traceable = true;
  bool traced_for_size = false;  ///< small enough to be traced
  bool ground_apart = false;
  bool finer_than_atlas = false;  ///< samples lie closer than texels: the atlas blurs
  DetailRule rule = DetailRule::LayoverAndShadow;
};

/// The level of terrain whose nodes stand no more than two texels, or samples, apart: what lies between them none would
/// show.
[[nodiscard]] int terrain_level_for(double sample_m, double spacing_m, int levels);

/// Chooses the level of detail for a question. A pure function.
///
/// The smaller side of the cell decides, never derivatives on a screen: a beam 1.4 km wide must not blur a range
/// resolution of 75 m. Where geometry should stay but the area is too large to be traced the atlas stands in, at
/// the level that its samples ask for, and `geometry_may_go` says that it is a compromise.
[[nodiscard]] DetailChoice choose_detail(const DetailQuestion& question, const DetailSettings& settings = {});

/// A few lines for people: what was chosen and which number decided it.
[[nodiscard]] std::string explained(const DetailChoice& choice);

/// Two levels of detail in use at once, the second with the given share of the power.
struct DetailBlend {
  int level = 1;
  int next = 1;             ///< equal to `level` while nothing changes
  double next_share = 0.0;  ///< 0..1, for linear power: sums of two levels stay calibrated
};

/// Levels along a flight path: keeps a level until the wish has clearly moved, then goes over to the next one step by
/// step, so that no step shows.
class DetailTransition {
 public:
  /// `frames` is how many calls of `advance` a change takes.
  explicit DetailTransition(int frames = 30) : frames_(frames) {}

  /// Takes the choice for the next frame. The first call adopts it at once.
  DetailBlend advance(const DetailChoice& choice, const DetailSettings& settings = {});

 private:
  int frames_;
  bool begun_ = false;
  int level_ = 1, next_ = 1, frame_ = 0;
};

}  // namespace sigmascape::render
