#include "sigmascape/scatter/surface_model.h"

#include <complex>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sigmascape/base/error.h"
#include "sigmascape/scatter/billingsley.h"
#include "sigmascape/scatter/git_sea.h"
#include "sigmascape/scatter/nrl_sea.h"
#include "sigmascape/scatter/ulaby_dobson.h"

namespace sigmascape::scatter {
namespace {

struct ModelMaker {
  double frequency_hz;
  using Model = std::variant<Lambert, ConstantGamma, CookTorrance, ReciprocalBackscatter, CrownMedium>;
  Model operator()(const LambertParameters& p) const { return Lambert(p); }
  Model operator()(const ConstantGammaParameters& p) const { return ConstantGamma(p, frequency_hz); }
  Model operator()(const CookTorranceParameters& p) const { return CookTorrance(p, frequency_hz); }
  Model operator()(const UlabyDobsonParameters& p) const { return ulaby_dobson(p, frequency_hz); }
  Model operator()(const BillingsleyParameters& p) const { return billingsley(p); }
  Model operator()(const NrlSeaParameters& p) const { return nrl_sea(p, frequency_hz); }
  Model operator()(const GitSeaParameters& p) const { return git_sea(p, frequency_hz); }
  Model operator()(const CrownParameters& p) const { return CrownMedium(p, frequency_hz); }
};

/// The greatest part of arriving power that a diffuse surface returns; nought for models that are passive by their
/// form.
double greatest_albedo(const Material& material, const ModelMaker::Model& model, double frequency_hz) {
  if (const auto* p = std::get_if<ConstantGammaParameters>(&material.model))
    return gamma_at(*p, frequency_hz) * (1.0 + p->depolarization.cross_ratio);
  if (const auto* p = std::get_if<LambertParameters>(&material.model)) return p->albedo;
  if (const auto* p = std::get_if<CrownParameters>(&material.model)) return p->leaf ? 0.0 : p->albedo;
  const auto* table = std::get_if<ReciprocalBackscatter>(&model);
  if (table == nullptr) return 0.0;
  return table->greatest_albedo();
}

void require_known_frequency(const Material& material, double frequency_hz) {
  std::vector<std::string> known;
  for (const FrequencyRange& range : known_frequencies(material)) {
    if (range.holds(frequency_hz)) return;
    known.push_back(fmt::format("{:g} to {:g} GHz", range.lowest_hz / 1e9, range.highest_hz / 1e9));
  }
  throw Error("material " + material.name, fmt::format("its constants do not hold at {:g} GHz", frequency_hz / 1e9),
              known.empty() ? std::string("use another material, since its model knows none of its frequencies")
                            : fmt::format("use {} or another material", fmt::join(known, " or ")));
}

const Permittivity* permittivity_of(const Material& material) {
  if (const auto* mirrors = std::get_if<CookTorranceParameters>(&material.model)) return &mirrors->permittivity;
  const auto* crown = std::get_if<CrownParameters>(&material.model);
  return crown != nullptr && crown->leaf ? &*crown->leaf : nullptr;
}

/// Four constants of a power law may make anything of a material: a source of power where the conductivity is negative,
/// and a perfect mirror where the permittivity is.
void require_passive_permittivity(const Material& material, double frequency_hz) {
  /// Squares have to be numbers in single precision. Copper has 1e10 at 100 MHz.
  constexpr double greatest = 1e18;
  const Permittivity* permittivity = permittivity_of(material);
  if (permittivity == nullptr) return;
  const std::complex<double> relative = permittivity->relative_at(frequency_hz);
  if (relative.real() >= 1.0 && relative.imag() <= 0.0 && std::abs(relative) <= greatest) return;
  throw Error(
      "material " + material.name,
      fmt::format("its relative permittivity at {:g} GHz is {:.4g} with a loss of {:.4g}, which no material has",
                  frequency_hz / 1e9, relative.real(), -relative.imag()),
      "state constants that make it 1, as of vacuum, or more and its conductivity 0 or more");
}

}  // namespace

SurfaceModel::Model SurfaceModel::model_of(const Material& material, double frequency_hz) {
  require_known_frequency(material, frequency_hz);
  require_passive_permittivity(material, frequency_hz);
  Model model = std::visit(ModelMaker{frequency_hz}, material.model);
  if (const double albedo = greatest_albedo(material, model, frequency_hz); albedo > 1.0) {
    throw Error("material " + material.name, fmt::format("it would return {:.2f} times the power that arrives", albedo),
                "lower its reflectivity or its cross-polarization, or build the bright parts as geometry");
  }
  return model;
}

SurfaceModel::SurfaceModel(const Material& material, double frequency_hz) : model_(model_of(material, frequency_hz)) {}

}  // namespace sigmascape::scatter
