#include "sigmascape/receiver/target_echoes.h"

#include <utility>

#include "sigmascape/receiver/bin_response.h"
#include "sigmascape/receiver/echo_places.h"

namespace sigmascape::receiver {
namespace {

using Bins = Array2D<radar::Channels>;

/// The part of the weights that falls into so many bins, the first of them and one past the last.
std::pair<std::ptrdiff_t, std::ptrdiff_t> inside(const PlacedResponse::Weights& weights, std::size_t bins) {
  const auto count = static_cast<std::ptrdiff_t>(weights.of_bins.size());
  return {std::clamp<std::ptrdiff_t>(-weights.first_bin, 0, count),
          std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(bins) - weights.first_bin, 0, count)};
}

/// What falls outside the bins is left out; where columns go round it comes in at their other end.
void add_point(Bins& bins, const PlacedResponse::Weights& across, const PlacedResponse::Weights& along, bool goes_round,
               const radar::Channels& rcs_m2) {
  const auto columns = static_cast<std::ptrdiff_t>(bins.columns());
  const auto [near, far] = inside(along, bins.rows());
  const auto [left, right] =
      goes_round ? std::pair<std::ptrdiff_t, std::ptrdiff_t>(0, across.of_bins.size()) : inside(across, bins.columns());
  for (std::ptrdiff_t row = near; row < far; ++row) {
    const auto to = bins.row(static_cast<std::size_t>(along.first_bin + row));
    const radar::Channels of_row = rcs_m2 * along.of_bins[static_cast<std::size_t>(row)];
    for (std::ptrdiff_t k = left; k < right; ++k) {
      const std::ptrdiff_t column = ((across.first_bin + k) % columns + columns) % columns;
      to[static_cast<std::size_t>(column)] += of_row * across.of_bins[static_cast<std::size_t>(k)];
    }
  }
}

}  // namespace

std::vector<radar::Echo> target_echoes(std::span<const radar::Target> targets, const radar::Radar& radar,
                                       const radar::Moment& moment) {
  std::vector<radar::Echo> echoes;
  echoes.reserve(targets.size());
  for (const radar::Target& target : targets) {
    const Vec3d away = target.track.position_at(moment.time_s) - radar.position;
    const double range_m = length(away);
    echoes.push_back({.range_m = range_m,
                      .cross = azimuth_of(away),
                      .rcs_m2 = radar::rcs_of(target, radar.position, radar.frequency_hz, moment),
                      .bounces = 1,
                      .sin_depression = range_m > 0.0 ? static_cast<float>(-away.z / range_m) : 0.0F});
  }
  return echoes;
}

void add_echoes(radar::RangeAzimuthImage& image, const radar::Radar& radar, std::span<const radar::Echo> echoes) {
  if (echoes.empty()) return;
  const radar::RangeAzimuthGrid& grid = image.grid;
  const EchoPlaces places(radar, grid);
  const PlacedResponse across = placed_azimuth_response(radar, grid.azimuth_step_rad);
  const PlacedResponse along = placed_range_response(radar, grid.range_step_m);
  // By themselves, lest many weak ones be rounded to nothing beside bright ground.
  radar::RangeAzimuthImage answers{grid, image.radar_position, Bins(grid.azimuths, grid.ranges)};
  for (const radar::Echo& echo : echoes) {
    const auto heard = places.heard(echo);
    if (!heard) continue;
    add_point(answers.rcs_m2, across.at(places.column_of(echo.cross)), along.at(heard->row), grid.goes_round(),
              heard->rcs_m2);
  }
  places.blank_unheard(answers);
  for (std::size_t i = 0; i < image.rcs_m2.size(); ++i) image.rcs_m2.values()[i] += answers.rcs_m2.values()[i];
}

}  // namespace sigmascape::receiver
