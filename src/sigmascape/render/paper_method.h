#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/mip_chain.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// The paper's method of rendering, taken at its word: the baseline that the rest of this room is measured against.
/// What the paper leaves open, and how it is read here, stands in docs/decisions/0050-the-paper-literally.md.

/// Where the method may leave the paper, one thing at a time; as it stands it is the paper's.
struct PaperLookUp {
  /// Elevations are blended linearly in cot ψ, in which the lengths of shadows are linear, instead of in the angle.
  bool by_cotangent = false;
  /// What is blended is γ = σ0 / sin ψ instead of σ0.
  bool blends_gamma = false;
  /// A sample stands for its area on the map instead of that of its slope, which is what Eq. (5) comes to.
  bool by_map_area = false;
  /// Azimuths are blended over the middle of their gap alone, as atlas::azimuth_blend_rad says.
  bool in_the_middle = false;
  /// Textures are read at their finest level, however coarse the pixels.
  bool finest_only = false;
};

/// The paper's textures in memory: one for each look over one patch of ground, in single precision, with mips that are
/// made when they are loaded.
class PaperTextures {
 public:
  /// `looks` in the order of `aspects`, which has one frequency; each [column, row] on `grid`, whose columns and rows
  /// are equal in number and a power of two.
  PaperTextures(const radar::GroundGrid& grid, const atlas::AspectGrid& aspects,
                const std::vector<Array2D<radar::Channels>>& looks);

  [[nodiscard]] const radar::GroundGrid& grid() const { return grid_; }
  [[nodiscard]] const atlas::AspectGrid& aspects() const { return aspects_; }
  /// As the paper counts: four floats a texel and look, without mips.
  [[nodiscard]] std::size_t texture_bytes() const;
  /// With mips.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Multilinear over azimuth and elevation; beyond the ends of the elevations the nearest.
  [[nodiscard]] atlas::AspectWeights weights_for(const radar::Aspect& aspect, const PaperLookUp& look_up) const;
  /// Trilinear: bilinear in place, linear between mip levels, 0 the finest.
  [[nodiscard]] radar::Channels sigma0_at(Vec2d point, const atlas::AspectWeights& weights, double level) const;

 private:
  [[nodiscard]] radar::Channels at_level(Vec2d point, const atlas::AspectWeights& weights, std::size_t level) const;

  radar::GroundGrid grid_;
  atlas::AspectGrid aspects_;
  std::vector<atlas::MipChain> looks_;
};

/// Eq. (5) of the paper: the radiance C_r = P_t σ0 / (16π² r² (n·l)), in W/(sr m²) for a transmitted power of 1 W.
[[nodiscard]] double radiance_of(double sigma0, double range_m, double cos_incidence);

/// Eqs. (1) and (2) of the paper: the cross-section 16π² r⁴ C_r ΔΩ / P_t of what fills a solid angle with radiance, m².
[[nodiscard]] double rcs_of_radiance(double radiance, double range_m, double solid_angle_sr);

/// Renders what of `area` the bins of `grid` hold. A pixel is a ray through one of evenly spaced points of a level
/// plane, two a range bin and one on the centre of every azimuth bin: the paper's oblique camera, whose pixels cover
/// the same ground and, from afar, the same solid angle. It takes the first terrain that it meets, looks σ0 up at the
/// angles of the line of sight, at the mip that a graphics card would choose, makes radiance of it, and adds what that
/// comes to in the pixel's solid angle to the bin at its true slant range. Throws Error for a radar that does not stand
/// above all of the terrain.
[[nodiscard]] radar::RangeAzimuthImage paper_image(const PaperTextures& textures, const terrain::HeightField& terrain,
                                                   const radar::Radar& radar, const radar::Rectangle& area,
                                                   const radar::RangeAzimuthGrid& grid, const PaperLookUp& look_up = {},
                                                   unsigned threads = 0);

}  // namespace sigmascape::render
