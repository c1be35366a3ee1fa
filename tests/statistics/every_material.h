#pragma once

#include <algorithm>
#include <vector>

#include "sigmascape/scatter/material.h"

namespace sigmascape::statistics_test {

/// The library, and what models can do that no material of it asks for: so that no model goes untested.
inline std::vector<scatter::Material> every_material() {
  std::vector<scatter::Material> materials = scatter::material_library();
  const auto add = [&](const char* name, const scatter::Material::Model& model) {
    materials.push_back({.name = name, .model = model, .source = {}});
  };
  add("Lambert, albedo 1", scatter::LambertParameters{1.0, {0.0, 1.0}});
  add("Lambert, albedo 1, depolarizing", scatter::LambertParameters{1.0, {0.5, 0.2}});
  add("constant gamma, -0.5 dB, depolarizing", scatter::ConstantGammaParameters{0.89, {0.12, 0.3}});
  const scatter::Permittivity conductor{1.0, 0.0, 1e9, 0.0};
  add("conductor, Beckmann 0.6", scatter::CookTorranceParameters{conductor, 0.6});
  add("conductor, GGX 0.3", scatter::CookTorranceParameters{conductor, 0.3, scatter::MicrofacetDistribution::Ggx});
  add("concrete, Beckmann 0.1, half of it scattered",
      scatter::CookTorranceParameters{
          {5.24, 0.0, 0.0462, 0.7822}, 0.1, scatter::MicrofacetDistribution::Beckmann, 0.7071, {0.2, 0.5}});
  return materials;
}

inline double frequency_within(const scatter::Material& material) {
  return std::clamp(10e9, material.lowest_frequency_hz, material.highest_frequency_hz);
}

/// Both ends of every range in which a material is known, drawn to 0.1 to 100 GHz.
inline std::vector<double> ends_of_frequencies(const scatter::Material& material) {
  std::vector<double> ends;
  for (const scatter::FrequencyRange& range : scatter::known_frequencies(material)) {
    ends.push_back(std::clamp(0.1e9, range.lowest_hz, range.highest_hz));
    ends.push_back(std::clamp(100e9, range.lowest_hz, range.highest_hz));
  }
  return ends;
}

}  // namespace sigmascape::statistics_test
