#include "sigmascape/scene/tree_reader.h"

#include <fmt/format.h>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/crown.h"
#include "sigmascape/scene/partner_key.h"
#include "sigmascape/scene/vector_section.h"

namespace sigmascape::scene {
namespace {

/// Taller than any tree that grows (116 m), with some room for its measurement.
constexpr double tallest_tree_m = 125.0;
constexpr double widest_crown_m = 40.0;
constexpr double usual_crown_radius_per_height = 0.3;

std::optional<double> height_m(const geo::Feature& feature, const TreeSource& source, FlawTally& tally) {
  if (!source.height_attribute) return source.default_height_m;
  const auto stated = number_in(feature, source.height_attribute, source.metres_per_plain_number);
  if (stated) refuse_negative(*stated, feature, *source.height_attribute, source.vector);
  if (stated && *stated > 0.0 && *stated <= tallest_tree_m) return stated;
  tell_of_doubtful_comma(feature, source.height_attribute, tally);
  if (source.default_height_m) {
    tally.note(fmt::format("trees without a height, given {:g} m", *source.default_height_m), feature.id);
  } else {
    tally.flaw("trees without a height, left out", feature.id);
  }
  return source.default_height_m;
}

double crown_radius_m(const geo::Feature& feature, const TreeSource& source, double height_m, FlawTally& tally) {
  const double usual = source.crown_radius_per_height.value_or(usual_crown_radius_per_height) * height_m;
  if (!source.crown_radius_attribute) return usual;
  const auto stated = number_in(feature, source.crown_radius_attribute, source.metres_per_plain_number);
  if (stated && *stated > 0.0 && *stated <= widest_crown_m) return *stated;
  tell_of_doubtful_comma(feature, source.crown_radius_attribute, tally);
  if (source.crown_radius_per_height) {
    tally.note(fmt::format("trees without a crown radius, given {:g} of their height", *source.crown_radius_per_height),
               feature.id);
  } else {
    tally.flaw("trees without a crown radius, given the usual one", feature.id);
  }
  return usual;
}

scatter::Material medium_of(const TreeSource& source, TreeForm form) {
  if (source.crown) return *source.crown;
  constexpr MaterialIndex bark = 0, leaf = 1;
  const Mesh tree = tree_mesh(form, {bark, leaf}, source.seed);
  scatter::Material medium = crown_material(source.leaf, effective_extinction_per_m(tree, leaf, crown_ellipsoid(form)));
  medium.name += form == TreeForm::Conifer ? ", conifer" : ", broadleaf";
  return medium;
}

/// Adds the tree meshes that this source chooses from; returns the first one's number.
std::uint32_t add_prototypes(Scene& scene, const TreeSource& source) {
  const auto first = static_cast<std::uint32_t>(scene.prototypes.size());
  const MaterialIndex bark = scene.material_index(source.bark);
  for (const TreeForm form : source.forms) {
    for (std::size_t variant = 0; variant < source.variants; ++variant) {
      const std::uint64_t seed = hashed(source.seed, variant);
      if (source.kind == CrownKind::Leaves) {
        scene.prototypes.push_back(tree_mesh(form, {bark, scene.material_index(source.leaf)}, seed));
      } else {
        scene.crowns.push_back({.prototype = static_cast<std::uint32_t>(scene.prototypes.size()),
                                .shape = crown_ellipsoid(form),
                                .medium = scene.material_index(medium_of(source, form)),
                                .grows_with_tree = !source.crown.has_value()});
        scene.prototypes.push_back(bare_tree_mesh(form, bark, seed));
      }
    }
  }
  return first;
}

}  // namespace

TreeSource read_tree_source(const TomlSection& section, const MaterialTable& materials, const FlawLimit& limit) {
  TreeSource source;
  source.where = section.where();
  source.vector = read_vector_source(section, geo::GeometryKind::Points);
  source.vector.osm_tag = "natural=tree";
  source.height_attribute = section.optional_text("height_attribute");
  source.crown_radius_attribute = section.optional_text("crown_radius_attribute");
  source.metres_per_plain_number =
      read_metres_per_plain_number(section, {"height_attribute", "crown_radius_attribute"});
  source.default_height_m = section.optional_number("default_height_m", {0.1, tallest_tree_m, "m"});
  source.crown_radius_per_height = section.optional_number("crown_radius_per_height", {0.02, 2.0, ""});
  for (const std::string& form : section.texts("prototypes")) {
    if (form != "broadleaf" && form != "conifer") {
      throw section.fault("prototypes", fmt::format("names '{}'", form), "choose among broadleaf, conifer");
    }
    source.forms.push_back(form == "conifer" ? TreeForm::Conifer : TreeForm::Broadleaf);
  }
  if (source.forms.empty()) source.forms = {TreeForm::Broadleaf};
  source.variants = static_cast<std::size_t>(section.whole_number_or("variants", {1, 64, ""}, 4));
  source.seed = static_cast<std::uint64_t>(section.whole_number_or("seed", {0, 1e15, ""}, 1));
  source.leaf = materials.named_by(section, "leaf_material", "leaf");
  if (section.choice_or("kind", {"leaves", "crowns"}, "leaves") == "crowns") {
    source.kind = CrownKind::Medium;
    if (const auto crown = section.optional_text("crown_material")) {
      source.crown = materials.crown(*crown, section.where("crown_material"));
    } else if (!makes_crowns(source.leaf)) {
      throw section.fault("leaf_material",
                          fmt::format("'{}' is of no leaves that crowns can be made of", source.leaf.name),
                          leaves_of_crowns);
    }
  }
  refuse_without(section, "crown_material", "kind = \"crowns\"", source.kind == CrownKind::Medium);
  source.bark = materials.named_by(section, "bark_material", "bark");
  source.limit = read_flaw_limit(section, limit);
  section.refuse_unknown_keys();
  if (!source.height_attribute && !source.default_height_m) {
    throw Error(section.where(), "does not say how tall the trees are", "give height_attribute or default_height_m");
  }
  return source;
}

void add_trees(Scene& scene, const TreeSource& source, const WaterMask& water) {
  const std::uint32_t first_prototype = add_prototypes(scene, source);
  const std::uint64_t prototypes = scene.prototypes.size() - first_prototype;
  const std::string outside = "trees outside the scene, left out";
  FlawTally tally;
  std::size_t inside = 0;
  std::uint64_t number = 0;
  const auto census = geo::for_each_feature(source.vector, scene.frame, [&](const geo::Feature& feature) {
    for (const Vec2d& position : feature.points) {
      const std::uint64_t draw = hashed(source.seed, number++);
      if (!scene.extent.contains(position)) {
        tally.note(outside, feature.id);
        continue;
      }
      ++inside;
      if (in_water(scene.ground.grid, water, position)) {
        tally.flaw("trees standing in water, left out", feature.id);
        continue;
      }
      const auto height = height_m(feature, source, tally);
      if (!height) continue;
      const double crown = crown_radius_m(feature, source, *height, tally);
      scene.instances.push_back({.prototype = first_prototype + static_cast<std::uint32_t>(draw % prototypes),
                                 .x_m = static_cast<float>(position.x),
                                 .y_m = static_cast<float>(position.y),
                                 .yaw_rad = unit_float(mixed(draw)) * static_cast<float>(2.0 * pi),
                                 .scale = tree_scale(static_cast<float>(*height), static_cast<float>(crown))});
    }
  });
  require_attribute(census, source.height_attribute, source.vector, source.where + ".height_attribute", tally);
  require_attribute(census, source.crown_radius_attribute, source.vector, source.where + ".crown_radius_attribute",
                    tally);
  if (inside == 0) tally.leaves_nothing(outside);
  settle_census(census, source.vector, source.limit, scene.remarks);
  tally.settle(source.vector.file.string(), inside, source.limit, scene.remarks);
}

}  // namespace sigmascape::scene
