#include "sigmascape/scatter/surface_model.h"

#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::scatter {
namespace {

struct ModelMaker {
  double frequency_hz;
  using Model = std::variant<Lambert, ConstantGamma, CookTorrance>;
  Model operator()(const LambertParameters& p) const { return Lambert(p); }
  Model operator()(const ConstantGammaParameters& p) const { return ConstantGamma(p); }
  Model operator()(const CookTorranceParameters& p) const { return CookTorrance(p, frequency_hz); }
};

}  // namespace

SurfaceModel::Model SurfaceModel::model_of(const Material& material, double frequency_hz) {
  if (frequency_hz < material.lowest_frequency_hz || frequency_hz > material.highest_frequency_hz) {
    throw Error("material " + material.name, fmt::format("its constants do not hold at {:.3f} GHz", frequency_hz / 1e9),
                fmt::format("use a frequency between {:.3f} and {:.3f} GHz or another material", material.lowest_frequency_hz / 1e9,
                            material.highest_frequency_hz / 1e9));
  }
  return std::visit(ModelMaker{frequency_hz}, material.model);
}

SurfaceModel::SurfaceModel(const Material& material, double frequency_hz) : model_(model_of(material, frequency_hz)) {}

}  // namespace sigmascape::scatter
