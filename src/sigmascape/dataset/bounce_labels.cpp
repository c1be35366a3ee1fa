#include "sigmascape/dataset/bounce_labels.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/product/ground_projection.h"

namespace sigmascape::dataset {
namespace {

Array2D<float> power_on_ground(const radar::RangeAzimuthImage& image, const terrain::HeightField& terrain,
                               const radar::GroundGrid& grid, radar::Polarization polarization) {
  const auto map = product::ground_map(image, terrain, grid);
  Array2D<float> power(grid.columns, grid.rows);
  std::ranges::transform(map.sigma0.values(), power.values().begin(),
                         [&](const radar::Channels& cell) { return cell.power(polarization); });
  return power;
}

/// 1 − first/all, drawn into [0, 1]: two bakes differ by their noise.
radar::Layer part_beyond(const Array2D<float>& first, const Array2D<float>& all) {
  radar::Layer layer{
      .name = std::string(multibounce), .unit = "1", .values = Array2D<float>(all.columns(), all.rows())};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float whole = all.values()[i];
    // What the radar did not look at stays NaN.
    layer.values.values()[i] = whole == 0.0F ? 0.0F : std::clamp(1.0F - first.values()[i] / whole, 0.0F, 1.0F);
  }
  return layer;
}

}  // namespace

std::size_t bounce_order(std::string_view name) {
  const bool is_bounce = name.size() == 7 && name.starts_with("bounce") && name[6] >= '1' && name[6] <= '9';
  return is_bounce ? static_cast<std::size_t>(name[6] - '0') : 0;
}

bool tells_bounces(std::string_view name) {
  return bounce_order(name) > 0 || name == multibounce;
}

std::size_t bounces_to_know(std::string_view name) {
  return name == multibounce ? 1 : bounce_order(name);
}

std::vector<radar::Layer> traced_bounce_layers(std::span<const std::string> names, const scene::Scene& scene,
                                               const trace::SceneGeometry& geometry, const radar::Radar& radar,
                                               const radar::GroundGrid& grid, const simulate::TraceSettings& settings,
                                               ProgressListener* progress, radar::RangeAzimuthImage* image) {
  std::size_t orders = 2;
  for (const std::string& name : names) {
    if (bounce_order(name) > static_cast<std::size_t>(settings.max_bounces)) {
      throw Error(name, fmt::format("asks for more bounces than are traced, which are {}", settings.max_bounces),
                  "trace as many bounces, or leave the layer out");
    }
    orders = std::max(orders, bounce_order(name) + 1);
  }
  trace::TraceCounts counts;
  const auto images =
      simulate::traced_bounces(scene, geometry, radar, grid.extent(), settings, orders, counts, progress);
  radar::RangeAzimuthImage sum = images.front();
  for (std::size_t order = 1; order < images.size(); ++order) {
    for (std::size_t i = 0; i < sum.rcs_m2.size(); ++i) sum.rcs_m2.values()[i] += images[order].rcs_m2.values()[i];
  }
  std::vector<radar::Layer> layers;
  for (const std::string& name : names) {
    if (const std::size_t order = bounce_order(name)) {
      layers.push_back({name, "m2/m2", power_on_ground(images[order - 1], scene.terrain, grid, radar.polarization)});
    } else if (name == multibounce) {
      layers.push_back(part_beyond(power_on_ground(images.front(), scene.terrain, grid, radar.polarization),
                                   power_on_ground(sum, scene.terrain, grid, radar.polarization)));
    }
  }
  if (image != nullptr) *image = std::move(sum);
  return layers;
}

std::vector<radar::Layer> baked_bounce_layers(std::span<const std::string> names, const radar::RangeAzimuthImage& all,
                                              std::span<const radar::RangeAzimuthImage> up_to,
                                              const terrain::HeightField& terrain, const radar::GroundGrid& grid,
                                              radar::Polarization polarization) {
  std::vector<radar::Layer> layers;
  for (const std::string& name : names) {
    const std::size_t order = bounces_to_know(name);
    if (order == 0) continue;
    Array2D<float> power = power_on_ground(up_to[order - 1], terrain, grid, polarization);
    if (name == multibounce) {
      layers.push_back(part_beyond(power, power_on_ground(all, terrain, grid, polarization)));
      continue;
    }
    if (order > 1) {
      const Array2D<float> fewer = power_on_ground(up_to[order - 2], terrain, grid, polarization);
      for (std::size_t i = 0; i < power.size(); ++i) {
        const float more = power.values()[i] - fewer.values()[i];
        power.values()[i] = more < 0.0F ? 0.0F : more;
      }
    }
    layers.push_back({name, "m2/m2", std::move(power)});
  }
  return layers;
}

}  // namespace sigmascape::dataset
