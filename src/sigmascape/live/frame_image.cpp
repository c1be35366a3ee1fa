#include "sigmascape/live/frame_image.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <tuple>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/live/frame_power.h"
#include "sigmascape/live/frame_reach.h"
#include "sigmascape/live/ground_along.h"
#include "sigmascape/live/ground_hearing.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/receiver/response_spread.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/terrain/terrain_view.h"
#include "sigmascape/terrain/terrain_window.h"

namespace sigmascape::live {
namespace {

constexpr std::size_t most_nodes_across = 2048;

radar::RangeAzimuthImage dark_image(const Frame& frame) {
  check_holds(frame, "image of a live frame");
  return {frame.grid, drawn_last(frame.beams).radar, Array2D<radar::Channels>(frame.grid.azimuths, frame.grid.ranges)};
}

/// Puts `put(beam, range)` into every bin, for some beams together: they lie side by side in an image, and in a
/// frame one after the other.
template <typename Put>
void for_each_bin(radar::RangeAzimuthImage& image, Put&& put) {
  constexpr std::size_t together = 8;
  const radar::RangeAzimuthGrid& grid = image.grid;
  for (std::size_t first = 0; first < grid.azimuths; first += together) {
    const std::size_t end = std::min(first + together, grid.azimuths);
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      for (std::size_t beam = first; beam < end; ++beam) image.rcs_m2(beam, range) = put(beam, range);
    }
  }
}

/// Of targets, each once: what two beams of a step hold of one is put together again.
std::vector<radar::Echo> echoes_of(const receiver::TargetsApart& targets) {
  std::vector<radar::Echo> echoes;
  echoes.reserve(targets.echoes.size());
  for (const receiver::EchoInBeam& of_beam : targets.echoes) echoes.push_back(of_beam.echo);
  const auto place = [](const radar::Echo& echo) { return std::tuple(echo.range_m, echo.cross, echo.sin_depression); };
  std::ranges::stable_sort(echoes, {}, place);
  std::size_t count = 0;
  for (const radar::Echo& echo : echoes) {
    if (count > 0 && place(echoes[count - 1]) == place(echo))
      echoes[count - 1].rcs_m2 += echo.rcs_m2;
    else
      echoes[count++] = echo;
  }
  echoes.resize(count);
  return echoes;
}

/// `weigh(hearing, beam, weights)` says how strongly the ground of a beam is heard.
template <typename Weigh>
radar::RangeAzimuthImage heard_image(const Frame& frame, const radar::Radar& radar, Weigh&& weigh) {
  check_frequency(frame, radar);
  radar::RangeAzimuthImage image = dark_image(frame);
  const radar::RangeAzimuthGrid& grid = image.grid;
  const GroundHearing hearing(that_scans(radar), grid);
  Array2D<radar::Channels> heard(grid.ranges, grid.azimuths);
  std::vector<radar::Channels> held(grid.ranges);
  std::vector<float> weights(grid.ranges);
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    ground_of_beam(
        frame, beam, [](const radar::Channels& bin) { return bin; }, std::span(held));
    weigh(hearing, beam, std::span(weights));
    hearing.hear<radar::Channels>(held, weights, heard.row(beam));
  }
  for_each_bin(image, [&](std::size_t beam, std::size_t range) { return heard(range, beam); });
  receiver::spread_responses(image, radar);
  receiver::add_echoes(image, hearing_first_bins(radar, grid), echoes_of(frame.targets));
  hearing.places().blank_unheard(image);
  return image;
}

radar::RangeAzimuthImage image_of_even_antenna(const Frame& frame, const radar::Radar& radar) {
  return heard_image(frame, radar, [](const GroundHearing& hearing, std::size_t, std::span<float> weights) {
    hearing.weigh_evenly(weights);
  });
}

}  // namespace

radar::RangeAzimuthImage image_of(const Frame& frame) {
  radar::RangeAzimuthImage image = dark_image(frame);
  for_each_bin(image, [&](std::size_t beam, std::size_t range) {
    return power_of_bin(frame, beam * frame.grid.ranges + range);
  });
  return image;
}

radar::RangeAzimuthImage image_of(const Frame& frame, const radar::Radar& radar) {
  if (!radar::antenna_pattern(radar).elevation().even()) {
    throw Error(radar::title_of(radar), "has an antenna that tells elevations apart, which bins do not",
                "give the ground that they lie on too (live::ground_below), or an antenna that is even in elevation");
  }
  return image_of_even_antenna(frame, radar);
}

radar::RangeAzimuthImage image_of(const Frame& frame, const radar::Radar& radar, const GroundHeight& ground) {
  if (radar::antenna_pattern(radar).elevation().even()) return image_of_even_antenna(frame, radar);
  return heard_image(frame, radar, [&](const GroundHearing& hearing, std::size_t beam, std::span<float> weights) {
    if (frame.beams[beam].drawing == 0) return;
    GroundAlong along(frame.beams[beam].radar, middle_rad(frame.grid, beam), last_range_m(frame.grid), ground,
                      frame.earth);
    hearing.weigh([&](double range_m) { return along.sin_depression(range_m); }, weights);
  });
}

GroundHeight ground_below(const Frame& frame, const LiveGround& ground) {
  check_holds(frame, "ground below a live frame");
  const radar::RangeAzimuthGrid& grid = frame.grid;
  const FrameReach reach{0.0, farthest_ground_m(frame.earth, last_range_m(grid))};
  std::optional<radar::Rectangle> seen;
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    const Vec3d radar = frame.beams[beam].radar;
    if (frame.beams[beam].drawing == 0) continue;
    const double left_rad = grid.first_azimuth_rad + static_cast<double>(beam) * grid.azimuth_step_rad;
    const radar::Rectangle below = ground_under({radar.x, radar.y}, left_rad, grid.azimuth_step_rad, reach);
    seen = seen ? radar::joined(*seen, below) : below;
  }
  const auto window = std::make_shared<const terrain::TerrainWindow>(
      ground.terrain().window_over(*seen, grid.range_step_m, most_nodes_across).nodes);
  return [window, view = window->view()](Vec2d place) { return terrain::height_at(view, place); };
}

}  // namespace sigmascape::live
