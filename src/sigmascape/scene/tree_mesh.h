#pragma once

#include <cstddef>
#include <cstdint>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

enum class TreeForm { Broadleaf, Conifer };

struct TreeMaterials {
  MaterialIndex bark = 0;
  MaterialIndex leaf = 0;
};

/// The size of every tree mesh; an instance is scaled from it with `tree_scale`.
inline constexpr std::size_t tree_vertex_count = 2257;
inline constexpr float tree_height_m = 7.8F;
inline constexpr float tree_crown_radius_m = 2.9F;

/// A tree of exactly `tree_vertex_count` vertices: a tapering trunk and twelve branches of bark (257 vertices) and a
/// crown of 500 leaf cards of four vertices each. It stands at the origin, z up, `tree_height_m` tall, with a crown of
/// `tree_crown_radius_m`. Trees of different seeds differ in the arrangement of their leaves and branches.
[[nodiscard]] Mesh tree_mesh(TreeForm form, TreeMaterials materials, std::uint64_t seed);

/// The trunk and branches of such a tree alone, as they stand within a crown of another kind.
[[nodiscard]] Mesh bare_tree_mesh(TreeForm form, MaterialIndex bark, std::uint64_t seed);

/// The instance scale that makes a tree mesh as tall and wide as wanted.
[[nodiscard]] constexpr Vec3f tree_scale(float height_m, float crown_radius_m) {
  const float across = crown_radius_m / tree_crown_radius_m;
  return {across, across, height_m / tree_height_m};
}

}  // namespace sigmascape::scene
