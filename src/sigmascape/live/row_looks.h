#pragma once

#include <array>
#include <cstddef>

#include "sigmascape/live/lattice_row.h"
#include "sigmascape/live/page_rows.h"

namespace sigmascape::live {

struct Extremes {
  float least, greatest;
};
/// Of the texels that there are.
[[nodiscard]] Extremes cotangent_extremes(const LatticeRow& row);
[[nodiscard]] Extremes beam_extremes(const LatticeRow& row);

/// Below the lowest baked elevation γ is held, as it is over a slope: makes `sine` what gives that look as much less as
/// the slope has less of the beam, where that is more than over level ground (ReflectingGround::upright_sine). To be
/// called where the ground's slope is known, before `blend`.
void hold_lowest_look(LatticeRow& row, const RowGeometry& geometry, float lowest_cotangent, float lowest_sine);

/// Looks that lie about the aspect of a stretch of texels.
struct BlendOf {
  TexelBlocks blocks;
  const atlas::Half* next_blocks = nullptr;  ///< of the row that comes next, to be fetched meanwhile; may be null
  const float* scale = nullptr;
  std::size_t looks = 4;                 ///< or 8, see GroundPage
  float area_m2 = 1.0F;                  ///< of a texel
  float second_azimuth_at_zero = 0.0F;   ///< part of the cell's second azimuth at beam 0, before it is held to 0 and 1
  float second_azimuth_per_beam = 0.0F;  ///< and its growth with beams
  std::array<float, 2> cotangent;        ///< of the two elevations
  std::array<float, 2> sine;
  std::array<float, 2> frequency_part;
};
/// Fills `returned` of the texels from `first` on, `count` of them, which lie in one aspect cell, with the
/// cross-section of what is seen of them: σ0 blended as atlas::weights_for says, times area and `lit`.
void blend(LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks);
/// The same where there is nothing.
void blend_nothing(LatticeRow& row, std::size_t first, std::size_t count);

/// Fills local_cotangent, local_sine and ground_area_m2: what bare ground is looked up and weighted with. Ground that
/// faces away has no area. Returns the extremes of local_cotangent where there is any.
[[nodiscard]] Extremes face(LatticeRow& row, const RowGeometry& geometry, float area_m2);

/// One elevation of bare ground among others: cotangents of the one below it, its own and the one above; where it has
/// no neighbour its own again.
struct GroundElevation {
  float below = 0.0F, own = 0.0F, above = 0.0F;
  float sine = 1.0F;
  std::array<float, 2> factor{};  ///< σ0 of a stored 1 times the part of its frequency, of one or two frequencies
};
/// Elevations of a page of bare ground.
struct GroundLooks {
  TexelBlocks blocks;
  const atlas::Half* next_blocks = nullptr;  ///< of the row that comes next, to be fetched meanwhile; may be null
  std::size_t frequencies = 1;               ///< looks of an elevation, 1 or 2
  std::size_t first = 0, end = 1;            ///< which of the page's elevations
  std::array<GroundElevation, GroundPage::elevations> elevations;
  float highest_sine = 1.0F;  ///< of the highest of the atlas
};
/// Adds what the ground of all texels returns as seen by these elevations' parts: γ is linear in the cotangent between
/// elevations and held below the lowest; above the highest σ0 is held.
void add_ground(LatticeRow& row, const GroundLooks& looks);

}  // namespace sigmascape::live
