#include "sigmascape/scene/tree_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/crown.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr unsigned trunk_sides = 8, trunk_rings = 8;
constexpr unsigned branch_count = 12, branch_sides = 5, branch_rings = 3;
constexpr unsigned leaf_cards = 500;
static_assert(trunk_sides * trunk_rings + 1 + branch_count * (branch_sides * branch_rings + 1) + 4 * leaf_cards ==
              tree_vertex_count);

/// The n-th number in [0, 1) of the sequence named `key`.
float uniform(std::uint64_t key, unsigned n) {
  return unit_float(hashed(key, n));
}

Vec3f around(float angle_rad, float radius_m, float z_m) {
  return {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m};
}

/// A cone of rings from `foot` to `tip`, open at the foot, which the ground or the trunk hides.
void append_limb(Mesh& mesh, Vec3f foot, Vec3f tip, float foot_radius_m, unsigned sides, unsigned rings,
                 MaterialIndex bark) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Basis basis(normalized(tip - foot));
  for (unsigned ring = 0; ring < rings; ++ring) {
    const float along = static_cast<float>(ring) / static_cast<float>(rings);
    for (unsigned side = 0; side < sides; ++side) {
      const float angle = static_cast<float>(2.0 * pi * side / sides);
      mesh.vertices.push_back(foot + (tip - foot) * along +
                              basis.world_from_local(around(angle, foot_radius_m * (1.0F - along), 0.0F)));
    }
  }
  mesh.vertices.push_back(tip);
  const std::uint32_t tip_vertex = first + sides * rings;
  for (unsigned ring = 0; ring < rings; ++ring) {
    for (unsigned side = 0; side < sides; ++side) {
      const std::uint32_t low = first + ring * sides + side, next_low = first + ring * sides + (side + 1) % sides;
      if (ring + 1 == rings) {
        mesh.triangles.push_back({low, next_low, tip_vertex});
        continue;
      }
      mesh.triangles.push_back({low, next_low, next_low + sides});
      mesh.triangles.push_back({low, next_low + sides, low + sides});
    }
  }
  mesh.materials.resize(mesh.triangles.size(), bark);
}

/// Crown radius at a height given as a fraction of the crown, 0 at its base, 1 at the top; and the share of the tree
/// that is bare trunk.
struct CrownHull {
  TreeForm form;
  [[nodiscard]] float base_m() const { return form == TreeForm::Broadleaf ? 1.9F : 0.9F; }
  [[nodiscard]] float z_at(float fraction) const { return std::lerp(base_m(), tree_height_m, fraction); }
  [[nodiscard]] float radius_at(float fraction) const {
    if (form == TreeForm::Conifer) return tree_crown_radius_m * (1.0F - fraction);
    const float from_middle = (fraction - 0.45F) / 0.55F;
    return tree_crown_radius_m * std::sqrt(std::max(0.0F, 1.0F - from_middle * from_middle));
  }
};

void append_trunk_and_branches(Mesh& mesh, const CrownHull& crown, MaterialIndex bark, std::uint64_t seed) {
  const float lean = 0.15F * uniform(seed, 0);
  append_limb(mesh, {}, around(static_cast<float>(2.0 * pi) * uniform(seed, 1), lean, 0.92F * tree_height_m), 0.19F,
              trunk_sides, trunk_rings, bark);
  constexpr float golden_angle_rad = 2.39996F;
  for (unsigned branch = 0; branch < branch_count; ++branch) {
    const std::uint64_t key = hashed(seed, 2, branch);
    const float fraction = (static_cast<float>(branch) + 0.5F) / static_cast<float>(branch_count) * 0.75F;
    const float angle = golden_angle_rad * static_cast<float>(branch) + uniform(key, 0);
    const float rise = crown.form == TreeForm::Broadleaf ? 0.9F : -0.2F;
    const float reach = (0.65F + 0.2F * uniform(key, 1)) * crown.radius_at(std::min(fraction + 0.15F, 0.95F));
    const float z = crown.z_at(fraction * 0.9F);
    append_limb(mesh, {0.0F, 0.0F, z}, around(angle, reach, z + rise), 0.075F, branch_sides, branch_rings, bark);
  }
}

/// A place in the crown, drawn so that leaves are denser toward its hull, as where the light falls.
Vec3f leaf_place(const CrownHull& crown, unsigned card, std::uint64_t key) {
  float fraction = (static_cast<float>(card) + uniform(key, 0)) / static_cast<float>(leaf_cards);
  if (crown.form == TreeForm::Conifer) fraction = 1.0F - std::sqrt(fraction);
  const float outward = std::pow(uniform(key, 1), 0.4F);
  return around(static_cast<float>(2.0 * pi) * uniform(key, 2), outward * crown.radius_at(fraction),
                crown.z_at(fraction));
}

void append_leaf_card(Mesh& mesh, Vec3f centre, MaterialIndex leaf, std::uint64_t key) {
  const float z = 2.0F * uniform(key, 3) - 1.0F;
  const Basis basis(around(static_cast<float>(2.0 * pi) * uniform(key, 4), std::sqrt(1.0F - z * z), z));
  const float turn = static_cast<float>(2.0 * pi) * uniform(key, 5), size = 0.2F + 0.12F * uniform(key, 6);
  const Vec3f u = basis.world_from_local(around(turn, size, 0.0F));
  const Vec3f v = basis.world_from_local(around(turn + static_cast<float>(pi / 2.0), size, 0.0F)) * 0.8F;
  const Vec3f corners[] = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
  append_facet(mesh, corners, leaf);
}

/// Stretches the vertices from `first` on so that the crown has exactly its nominal height and radius.
void fit_crown(std::span<Vec3f> crown) {
  float radius = 0.0F, top = 0.0F;
  for (const Vec3f& vertex : crown) {
    radius = std::max(radius, std::hypot(vertex.x, vertex.y));
    top = std::max(top, vertex.z);
  }
  for (Vec3f& vertex : crown) {
    vertex.x *= tree_crown_radius_m / radius;
    vertex.y *= tree_crown_radius_m / radius;
    vertex.z *= tree_height_m / top;
  }
}

}  // namespace

Mesh bare_tree_mesh(TreeForm form, MaterialIndex bark, std::uint64_t seed) {
  Mesh mesh{.name = form == TreeForm::Broadleaf ? "broadleaf tree" : "conifer",
            .vertices = {},
            .triangles = {},
            .materials = {}};
  append_trunk_and_branches(mesh, CrownHull{form}, bark, hashed(seed, 1));
  return mesh;
}

Ellipsoid crown_ellipsoid(TreeForm form) {
  const CrownHull hull{form};
  if (form == TreeForm::Conifer) {
    // The first and second moments of its leaves, see leaf_place: heights have the mean ⅓ and the variance 1/18,
    // squares of distances from the axis the mean ½ · 5/9. An even ellipsoid has a fifth of the squares of its radii.
    const float height = tree_height_m - hull.base_m();
    const float centre = hull.base_m() + height / 3.0F;
    const float across = tree_crown_radius_m * std::sqrt(5.0F * 0.5F * (5.0F / 18.0F));
    return {{0.0F, 0.0F, centre}, {across, across, std::min(height * std::sqrt(5.0F / 18.0F), centre)}};
  }
  const float middle = hull.z_at(0.45F);
  return {{0.0F, 0.0F, middle}, {tree_crown_radius_m, tree_crown_radius_m, tree_height_m - middle}};
}

Mesh tree_mesh(TreeForm form, TreeMaterials materials, std::uint64_t seed) {
  const CrownHull crown{form};
  Mesh mesh = bare_tree_mesh(form, materials.bark, seed);
  const std::size_t bark_vertices = mesh.vertices.size();
  for (unsigned card = 0; card < leaf_cards; ++card) {
    const std::uint64_t key = hashed(seed, 2, card);
    append_leaf_card(mesh, leaf_place(crown, card, key), materials.leaf, key);
  }
  fit_crown(std::span(mesh.vertices).subspan(bark_vertices));
  return mesh;
}

}  // namespace sigmascape::scene
