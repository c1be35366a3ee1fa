#include "sigmascape/bake/mean_ground.h"

#include <algorithm>
#include <cstddef>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scatter/surface_sigma0.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {

MeanGround::MeanGround(const scene::Scene& scene, const atlas::AspectGrid& aspects, const atlas::PatchGrid& patches)
    : scene_(scene), patches_(patches) {
  const trace::SpectralSurfaces surfaces = trace::surface_models(scene, aspects.frequencies_hz);
  for (atlas::LookIndex index = 0; index < aspects.look_count(); ++index) {
    const radar::Look look = aspects.look(index);
    const auto frequency = std::ranges::find(aspects.frequencies_hz, look.frequency_hz);
    std::vector<double>& powers = powers_.emplace_back();
    for (const scatter::SurfaceModel& surface :
         surfaces[static_cast<std::size_t>(frequency - aspects.frequencies_hz.begin())]) {
      const radar::Channels sigma0 = scatter::surface_sigma0(surface, look.aspect.elevation_rad);
      powers.push_back(static_cast<double>(sigma0.power(radar::Polarization::Sum)));
    }
  }
}

double MeanGround::power_of(atlas::PatchIndex patch, atlas::LookIndex look) const {
  const std::vector<double>& shares = shares_of(patch);
  double power = 0.0;
  for (std::size_t material = 0; material < shares.size(); ++material)
    power += shares[material] * powers_[look][material];
  return power;
}

const std::vector<double>& MeanGround::shares_of(atlas::PatchIndex patch) const {
  if (shares_ && shares_->patch == patch) return shares_->of_materials;
  const radar::GroundGrid texels = patches_.texels_of(patch);
  const double share = 1.0 / static_cast<double>(texels.columns * texels.rows);
  shares_ = Shares{patch, std::vector<double>(scene_.materials.size(), 0.0)};
  for (std::size_t row = 0; row < texels.rows; ++row) {
    for (std::size_t column = 0; column < texels.columns; ++column) {
      const Vec2d centre = texels.centre_of(column, row);
      if (scene_.extent.contains(centre)) shares_->of_materials[scene_.ground.at(centre)] += share;
    }
  }
  return shares_->of_materials;
}

}  // namespace sigmascape::bake
