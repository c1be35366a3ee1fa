#include "sigmascape/scene/material_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <variant>

#include "sigmascape/base/units.h"
#include "sigmascape/scene/permittivity_reader.h"

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

/// The place among `words` of the one that a key names, which `current` keeps when the key is absent.
template <typename Enum, std::size_t n>
Enum chosen(const TomlSection& section, std::string_view key, const std::array<const char*, n>& words, Enum current) {
  const std::vector<std::string> choices(words.begin(), words.end());
  const std::string word = section.choice_or(key, choices, choices[static_cast<std::size_t>(current)]);
  return static_cast<Enum>(std::ranges::find(choices, word) - choices.begin());
}

constexpr std::array gamma_laws{"as_stated", "square_root_from_10_ghz"};
constexpr std::array terrain_classes{"soil", "grass", "shrubs", "short_vegetation", "dry_snow", "wet_snow", "trees"};
constexpr std::array billingsley_terrains{"general_rural", "forest", "desert"};
constexpr std::array distributions{"beckmann", "ggx"};
constexpr std::array maskings{"correlated", "height_correlated", "separable"};

/// Overwrites those constants of a model that the section states.
struct ConstantsReader {
  const TomlSection& section;
  scatter::Material& material;

  void operator()(scatter::LambertParameters& lambert) const {
    lambert.albedo = section.number_or("albedo", {0.0, 1.0, ""}, lambert.albedo);
    read_depolarization(section, lambert.depolarization);
  }
  void operator()(scatter::ConstantGammaParameters& diffuse) const {
    if (const auto gamma_db = section.optional_number("gamma_db", {-80.0, 0.0, "dB"})) {
      diffuse.gamma = linear_from_db(*gamma_db);
      material.verified = true;
      leave_frequencies_to_the_model();
    }
    diffuse.frequency_law = chosen(section, "frequency_law", gamma_laws, diffuse.frequency_law);
    if (diffuse.frequency_law != scatter::GammaFrequencyLaw::AsStated) material.verified = false;
    read_depolarization(section, diffuse.depolarization);
  }
  void operator()(scatter::UlabyDobsonParameters& land) const {
    land.terrain = chosen(section, "terrain", terrain_classes, land.terrain);
    land.unverified_rows = section.flag_or("unverified_rows", land.unverified_rows);
    material.verified = !land.unverified_rows;
    material.plants = scatter::is_plant_cover(land.terrain);
    leave_frequencies_to_the_model();
    read_depolarization(section, land.depolarization);
  }
  void operator()(scatter::BillingsleyParameters& land) const {
    land.terrain = chosen(section, "terrain", billingsley_terrains, land.terrain);
    material.plants = scatter::is_plant_cover(land.terrain);
    leave_frequencies_to_the_model();
    read_depolarization(section, land.depolarization);
  }
  void operator()(scatter::NrlSeaParameters& sea) const {
    sea.sea_state = section.number_or("sea_state", {0.0, 6.0, ""}, sea.sea_state);
    read_depolarization(section, sea.depolarization);
  }
  void operator()(scatter::GitSeaParameters& sea) const {
    sea.sea_state = section.number_or("sea_state", {1.0, 6.0, ""}, sea.sea_state);
    sea.wind_angle_rad = radians_from_deg(
        section.number_or("wind_angle_deg", {0.0, 180.0, "deg"}, deg_from_radians(sea.wind_angle_rad)));
    sea.wind_speed_mps = section.number_or("wind_speed_mps", {0.0, 40.0, "m/s"}, sea.wind_speed_mps);
    read_depolarization(section, sea.depolarization);
  }
  void operator()(scatter::CookTorranceParameters& mirrors) const {
    const scatter::Permittivity before = mirrors.permittivity;
    if (read_permittivity(section, mirrors.permittivity)) {
      if (!keeps_a_law(before)) leave_frequencies_to_the_model();
      if (section.has("alpha")) material.verified = true;
    } else if (section.has("model")) {
      throw section.fault("permittivity", "is missing, without which nothing is reflected",
                          "give permittivity, permittivity_law, or a table water, soil or plant");
    }
    mirrors.alpha = section.number_or("alpha", {0.001, 2.0, ""}, mirrors.alpha);
    mirrors.scattering_coefficient =
        section.number_or("scattering_coefficient", {0.0, 1.0, ""}, mirrors.scattering_coefficient);
    if (mirrors.scattering_coefficient == 0.0) refuse_depolarization("without a scattering_coefficient");
    read_depolarization(section, mirrors.depolarization);
    mirrors.distribution = chosen(section, "distribution", distributions, mirrors.distribution);
    mirrors.masking = chosen(section, "masking", maskings, mirrors.masking);
    mirrors.multiple_scatter = section.flag_or("multi_scatter", mirrors.multiple_scatter);
  }
  void operator()(scatter::CrownParameters& crown) const {
    if (const auto db_per_m = section.optional_number("extinction_db_per_m", {0.0, 100.0, "dB/m"}))
      crown.extinction_per_m = std::log(linear_from_db(*db_per_m));
    crown.albedo = section.number_or("albedo", {0.0, 1.0, ""}, crown.albedo);
    scatter::Permittivity leaf;
    if (read_permittivity(section, leaf)) {
      if (section.has("albedo"))
        throw Error(section.where("albedo"), "is stated beside the permittivity of the leaves, which decides it",
                    "leave one of them out");
      crown.leaf = leaf;
    }
    if (crown.leaf) refuse_depolarization("beside the permittivity of the leaves, which are mirrors");
    crown.shares_gaps = section.flag_or("shares_gaps", crown.shares_gaps);
    read_depolarization(section, crown.depolarization);
  }

 private:
  /// Of what leaves diffusely, where nothing does.
  void refuse_depolarization(std::string_view where_idle) const {
    for (const char* key : {"cross_ratio_db", "vv_hh_correlation"}) {
      if (section.has(key)) throw section.fault(key, fmt::format("means nothing {}", where_idle), "leave it out");
    }
  }
  /// Whether the half of the base's power law that the section leaves as it is changes with frequency: it is known
  /// where the base was measured and nowhere else.
  [[nodiscard]] bool keeps_a_law(const scatter::Permittivity& base) const {
    const auto* law = std::get_if<scatter::PowerLawPermittivity>(&base.law());
    if (law == nullptr || section.has("permittivity_law")) return false;
    const bool has_real = section.has("permittivity"), has_conductivity = section.has("conductivity_s_per_m");
    return (has_conductivity && !has_real && law->b != 0.0) ||
           (has_real && !has_conductivity && law->c != 0.0 && law->d != 0.0);
  }
  /// What is stated anew is known where its law or table is, not where the base material was.
  void leave_frequencies_to_the_model() const {
    material.lowest_frequency_hz = scatter::FrequencyRange{}.lowest_hz;
    material.highest_frequency_hz = scatter::FrequencyRange{}.highest_hz;
  }
};

struct NamedModel {
  const char* name;
  scatter::Material::Model model;
};

const std::vector<NamedModel>& models() {
  static const std::vector<NamedModel> all{{"lambert", scatter::LambertParameters{}},
                                           {"constant_gamma", scatter::ConstantGammaParameters{}},
                                           {"cook_torrance", scatter::CookTorranceParameters{}},
                                           {"ulaby_dobson", scatter::UlabyDobsonParameters{}},
                                           {"billingsley", scatter::BillingsleyParameters{}},
                                           {"nrl_sea", scatter::NrlSeaParameters{}},
                                           {"git_sea", scatter::GitSeaParameters{}},
                                           {"crown", scatter::CrownParameters{}}};
  return all;
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const NamedModel& model : models()) names.emplace_back(model.name);
  return names;
}

/// A material of the library. Throws Error, and tells of one of the file's `own` that it cannot be a base.
const scatter::Material& stated_base(const TomlSection& section, const std::string& name,
                                     const std::vector<std::string>& own) {
  if (find_in_library(name) == nullptr && std::ranges::find(own, name) != own.end()) {
    throw section.fault("base", fmt::format("names '{}' of the same file, and takes names of the library only", name),
                        "name the library material that both start from, and state the constants again");
  }
  static const MaterialTable library;
  return library.material(name, section.where("base"));
}

/// `own`: the names of all materials of the file.
scatter::Material read_material(const TomlSection& section, const std::string& name,
                                const std::vector<std::string>& own) {
  const auto base = section.optional_text("base");
  const bool has_model = section.has("model");
  if (base.has_value() == has_model) {
    throw Error(
        section.where(), base ? "states both base and model" : "states neither base nor model",
        fmt::format("give base = a library name to start from, or model = one of {}", fmt::join(model_names(), ", ")));
  }
  scatter::Material material;
  if (base) {
    material = stated_base(section, *base, own);
  } else {
    const std::string model = section.choice_or("model", model_names(), "");
    material.model = std::ranges::find(models(), model, &NamedModel::name)->model;
  }
  material.name = name;
  material.source = section.text_or("source", fmt::format("scene file, {}", section.where()));
  std::visit(ConstantsReader{section, material}, material.model);
  material.plants = section.flag_or("plants", material.plants);
  section.refuse_unknown_keys();
  return material;
}

}  // namespace

MaterialTable::MaterialTable(const TomlSection& root) {
  const auto materials = root.section("materials");
  if (!materials) return;
  const std::vector<std::string> names = materials->keys();
  for (const std::string& name : names) {
    const TomlSection section = *materials->section(name);
    own_[name] = read_material(section, name, names);
    if (const auto base = section.optional_text("base")) bases_[name] = *base;
  }
}

bool MaterialTable::knows(const std::string& name) const {
  return own_.contains(name) || find_in_library(name) != nullptr;
}

std::optional<std::string> MaterialTable::base_of(const std::string& name) const {
  const auto found = bases_.find(name);
  return found == bases_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> MaterialTable::unasked() const {
  std::vector<std::string> names;
  for (const auto& [name, unused] : own_) {
    if (!asked_.contains(name)) names.push_back(name);
  }
  return names;
}

const scatter::Material& MaterialTable::material(const std::string& name, const std::string& where) const {
  const scatter::Material& surface = found(name, where);
  if (surface.is_medium())
    throw Error(where, fmt::format("'{}' is the medium of a tree's crown, of which no surface is made", name),
                "name it with crown_material in [[trees]], or give another material here");
  return surface;
}

const scatter::Material& MaterialTable::crown(const std::string& name, const std::string& where) const {
  const scatter::Material& medium = found(name, where);
  if (!medium.is_medium())
    throw Error(where, fmt::format("'{}' is the material of a surface, not the medium of a crown", name),
                "name a material of model crown");
  return medium;
}

const scatter::Material& MaterialTable::found(const std::string& name, const std::string& where) const {
  if (const auto own = own_.find(name); own != own_.end()) {
    asked_.insert(name);
    return own->second;
  }
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
