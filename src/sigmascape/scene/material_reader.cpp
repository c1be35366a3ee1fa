#include "sigmascape/scene/material_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <variant>

#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

const scatter::Material* find_in_library(const std::string& name) {
  const auto& library = scatter::material_library();
  const auto found = std::ranges::find(library, name, &scatter::Material::name);
  return found == library.end() ? nullptr : &*found;
}

void read_depolarization(const TomlSection& section, scatter::Depolarization& depolarization) {
  if (const auto ratio_db = section.optional_number("cross_ratio_db", {-60.0, 0.0, "dB"})) {
    depolarization.cross_ratio = linear_from_db(*ratio_db);
  }
  depolarization.vv_hh_correlation =
      section.number_or("vv_hh_correlation", {0.0, 1.0, ""}, depolarization.vv_hh_correlation);
}

/// A stated relative permittivity or conductivity holds at all frequencies; of a power law the other part stays.
void read_permittivity(const TomlSection& section, scatter::Permittivity& permittivity) {
  const auto relative = section.optional_number("permittivity", {1.0, 1e6, ""});
  const auto conductivity = section.optional_number("conductivity_s_per_m", {0.0, 1e9, "S/m"});
  if (!relative && !conductivity) return;
  const auto* stated = std::get_if<scatter::PowerLawPermittivity>(&permittivity.law());
  scatter::PowerLawPermittivity law = stated != nullptr ? *stated : scatter::PowerLawPermittivity{};
  if (relative) law.a = *relative, law.b = 0.0;
  if (conductivity) law.c = *conductivity, law.d = 0.0;
  permittivity = {law.a, law.b, law.c, law.d};
}

/// Overwrites those constants of a model that the section states.
struct ConstantsReader {
  const TomlSection& section;

  void operator()(scatter::LambertParameters& lambert) const {
    lambert.albedo = section.number_or("albedo", {0.0, 1.0, ""}, lambert.albedo);
    read_depolarization(section, lambert.depolarization);
  }
  void operator()(scatter::ConstantGammaParameters& diffuse) const {
    if (const auto gamma_db = section.optional_number("gamma_db", {-80.0, 0.0, "dB"}))
      diffuse.gamma = linear_from_db(*gamma_db);
    read_depolarization(section, diffuse.depolarization);
  }
  void operator()(scatter::UlabyDobsonParameters& land) const { read_depolarization(section, land.depolarization); }
  void operator()(scatter::BillingsleyParameters& land) const { read_depolarization(section, land.depolarization); }
  void operator()(scatter::NrlSeaParameters& sea) const {
    sea.sea_state = section.number_or("sea_state", {0.0, 6.0, ""}, sea.sea_state);
    read_depolarization(section, sea.depolarization);
  }
  void operator()(scatter::GitSeaParameters& sea) const {
    sea.sea_state = section.number_or("sea_state", {1.0, 6.0, ""}, sea.sea_state);
    sea.wind_angle_rad =
        radians_from_deg(section.number_or("wind_angle_deg", {0.0, 180.0, "deg"}, deg_from_radians(sea.wind_angle_rad)));
    sea.wind_speed_mps = section.number_or("wind_speed_mps", {0.0, 40.0, "m/s"}, sea.wind_speed_mps);
    read_depolarization(section, sea.depolarization);
  }
  void operator()(scatter::CookTorranceParameters& mirrors) const {
    read_permittivity(section, mirrors.permittivity);
    mirrors.alpha = section.number_or("alpha", {0.001, 2.0, ""}, mirrors.alpha);
    const bool was_ggx = mirrors.distribution == scatter::MicrofacetDistribution::Ggx;
    const std::string distribution =
        section.choice_or("distribution", {"beckmann", "ggx"}, was_ggx ? "ggx" : "beckmann");
    mirrors.distribution =
        distribution == "ggx" ? scatter::MicrofacetDistribution::Ggx : scatter::MicrofacetDistribution::Beckmann;
  }
};

scatter::Material read_material(const TomlSection& section, const std::string& name) {
  const auto base = section.optional_text("base");
  const bool has_model = section.has("model");
  if (base.has_value() == has_model) {
    throw Error(
        section.where(), base ? "states both base and model" : "states neither base nor model",
        "give base = a library name to start from, or model = \"lambert\", \"constant_gamma\" or \"cook_torrance\"");
  }
  scatter::Material material;
  if (base) {
    material = MaterialTable().material(*base, section.where("base"));
  } else {
    const std::string model = section.choice_or("model", {"lambert", "constant_gamma", "cook_torrance"}, "");
    if (model == "constant_gamma") material.model = scatter::ConstantGammaParameters{};
    if (model == "cook_torrance") material.model = scatter::CookTorranceParameters{};
  }
  material.name = name;
  material.source = section.text_or("source", fmt::format("scene file, {}", section.where()));
  std::visit(ConstantsReader{section}, material.model);
  section.refuse_unknown_keys();
  return material;
}

}  // namespace

MaterialTable::MaterialTable(const TomlSection& root) {
  const auto materials = root.section("materials");
  if (!materials) return;
  for (const std::string& name : materials->keys()) own_[name] = read_material(*materials->section(name), name);
}

bool MaterialTable::knows(const std::string& name) const {
  return own_.contains(name) || find_in_library(name) != nullptr;
}

const scatter::Material& MaterialTable::material(const std::string& name, const std::string& where) const {
  if (const auto own = own_.find(name); own != own_.end()) return own->second;
  if (const scatter::Material* known = find_in_library(name)) return *known;
  std::vector<std::string> names;
  for (const auto& [own_name, unused] : own_) names.push_back(own_name);
  for (const scatter::Material& known : scatter::material_library()) names.push_back(known.name);
  const auto nearest = nearest_word(name, names);
  throw Error(where, fmt::format("the material '{}' is not known", name),
              nearest ? fmt::format("did you mean {}?", *nearest)
                      : fmt::format("define it under [materials.{}] or use one of {}", name, fmt::join(names, ", ")));
}

const scatter::Material& MaterialTable::named_by(const TomlSection& section, std::string_view key,
                                                 const std::string& fallback) const {
  return material(section.text_or(key, fallback), section.where(key));
}

}  // namespace sigmascape::scene
