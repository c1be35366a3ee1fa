#include "sigmascape/scene/permittivity_reader.h"

#include <algorithm>
#include <array>

namespace sigmascape::scene {
namespace {

/// The law that the base states, whose constants stay where nothing is said of them, or that law's own.
template <typename Law>
Law begun_with(const scatter::Permittivity& permittivity) {
  const Law* stated = std::get_if<Law>(&permittivity.law());
  return stated != nullptr ? *stated : Law{};
}

bool read_constant(const TomlSection& section, scatter::Permittivity& permittivity) {
  const auto relative = section.optional_number("permittivity", {1.0, 1e6, ""});
  const auto conductivity = section.optional_number("conductivity_s_per_m", {0.0, 1e9, "S/m"});
  if (!relative && !conductivity) return false;
  const auto* stated = std::get_if<scatter::PowerLawPermittivity>(&permittivity.law());
  if (!relative && (stated == nullptr || *stated == scatter::PowerLawPermittivity{}))
    throw section.fault("conductivity_s_per_m", "is stated without a permittivity to go with it",
                        "state permittivity as well");
  scatter::PowerLawPermittivity law = stated != nullptr ? *stated : scatter::PowerLawPermittivity{};
  if (relative) law.a = *relative, law.b = 0.0;
  if (conductivity) law.c = *conductivity, law.d = 0.0;
  permittivity = {law.a, law.b, law.c, law.d};
  return true;
}

bool read_power_law(const TomlSection& section, scatter::Permittivity& permittivity) {
  const auto constants = section.numbers("permittivity_law", {-1e9, 1e9, ""});
  if (constants.empty()) return false;
  if (constants.size() != 4)
    throw section.fault("permittivity_law", "does not hold four numbers", "give a, b, c and d of ITU-R P.2040");
  permittivity = {constants[0], constants[1], constants[2], constants[3]};
  return true;
}

bool read_water(const TomlSection& section, scatter::Permittivity& permittivity) {
  const auto water = section.section("water");
  if (!water) return false;
  auto law = begun_with<scatter::WaterPermittivity>(permittivity);
  law.temperature_c = water->number_or("temperature_c", {-4.0, 40.0, "°C"}, law.temperature_c);
  law.salinity_g_per_kg = water->number_or("salinity_g_per_kg", {0.0, 40.0, "g/kg"}, law.salinity_g_per_kg);
  water->refuse_unknown_keys();
  permittivity = law;
  return true;
}

bool read_soil(const TomlSection& section, scatter::Permittivity& permittivity) {
  const auto soil = section.section("soil");
  if (!soil) return false;
  auto law = begun_with<scatter::SoilPermittivity>(permittivity);
  law.sand_percent = soil->number_or("sand_percent", {1.0, 98.0, "%"}, law.sand_percent);
  law.clay_percent = soil->number_or("clay_percent", {1.0, 98.0, "%"}, law.clay_percent);
  law.volumetric_moisture = soil->number_or("moisture", {0.01, 0.5, ""}, law.volumetric_moisture);
  law.temperature_c = soil->number_or("temperature_c", {0.0, 40.0, "°C"}, law.temperature_c);
  if (law.sand_percent + law.clay_percent > 99.0)
    throw soil->fault("clay_percent", "leaves no silt beside the sand", "let both add up to 99 % at most");
  soil->refuse_unknown_keys();
  permittivity = law;
  return true;
}

bool read_plant(const TomlSection& section, scatter::Permittivity& permittivity) {
  const auto plant = section.section("plant");
  if (!plant) return false;
  auto law = begun_with<scatter::VegetationPermittivity>(permittivity);
  law.gravimetric_moisture = plant->number_or("moisture", {0.0, 0.7, ""}, law.gravimetric_moisture);
  law.salinity_g_per_kg = plant->number_or("salinity_g_per_kg", {0.0, 40.0, "g/kg"}, law.salinity_g_per_kg);
  plant->refuse_unknown_keys();
  permittivity = law;
  return true;
}

}  // namespace

bool read_permittivity(const TomlSection& section, scatter::Permittivity& permittivity) {
  const std::array taken{read_constant(section, permittivity), read_power_law(section, permittivity),
                         read_water(section, permittivity), read_soil(section, permittivity),
                         read_plant(section, permittivity)};
  const auto ways = std::ranges::count(taken, true);
  if (ways > 1)
    throw Error(section.where(), "states its permittivity in more than one way",
                "keep one of permittivity with conductivity_s_per_m, permittivity_law, water, soil and plant");
  return ways == 1;
}

}  // namespace sigmascape::scene
