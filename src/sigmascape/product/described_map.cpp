#include "sigmascape/product/described_map.h"

#include <fmt/format.h>
#include <optional>

#include "sigmascape/product/ground_projection.h"
#include "sigmascape/product/software.h"
#include "sigmascape/radar/azimuth_text.h"
#include "sigmascape/radar/polarization_words.h"

namespace sigmascape::product {
namespace {

/// From the middle of the map to the radar, clockwise from north; nothing where the radar stands over what is mapped.
std::optional<double> azimuth_of_radar_rad(const radar::GroundGrid& grid, const radar::Radar& radar) {
  const Vec2d place{radar.position.x, radar.position.y};
  if (grid.extent().contains(place)) return std::nullopt;
  const Vec2d towards = place - grid.extent().centre();
  return azimuth_of(towards);
}

template <typename Map>
void describe(Map& map, const radar::Radar& radar, const geo::LocalFrame& frame, const Provenance& provenance) {
  map.crs = frame.proj();
  map.metadata = provenance;
  map.metadata["radar"] = radar.name;
  map.metadata["radar_position_m"] = vector_text(radar.position);
  if (const auto azimuth_rad = azimuth_of_radar_rad(map.grid, radar))
    map.metadata[radar_azimuth_key] = radar::azimuth_text_deg(*azimuth_rad, 2);
  map.metadata["radar_velocity_mps"] = vector_text(radar.velocity_mps);
  map.metadata.try_emplace("time_s", "0");
  map.metadata["software"] = software_name();
  map.metadata["frequency_hz"] = fmt::format("{:.0f}", radar.frequency_hz);
  map.metadata[polarization_key] = radar::polarization_word(radar.polarization);
  map.metadata["range_resolution_m"] = fmt::format("{}", radar.range_resolution_m);
  map.metadata["beam_width_rad"] = fmt::format("{:.6g}", radar.beam_width_rad);
}

}  // namespace

std::string vector_text(Vec3d vector) {
  return fmt::format("{:.2f} {:.2f} {:.2f}", vector.x, vector.y, vector.z);
}

radar::GroundMap described_map(radar::GroundMap map, const radar::Radar& radar, const geo::LocalFrame& frame,
                               const Provenance& provenance) {
  describe(map, radar, frame, provenance);
  map.metadata["quantity"] = "sigma0 with respect to horizontal area";
  return map;
}

radar::PowerMap described_map(radar::PowerMap map, const radar::Radar& radar, const geo::LocalFrame& frame,
                              const Provenance& provenance) {
  describe(map, radar, frame, provenance);
  map.metadata["quantity"] = "mean power of one compressed pulse at the antenna's terminals";
  map.metadata["noise_w"] = fmt::format("{}", map.noise_w);
  return map;
}

radar::GroundMap described_map(const radar::RangeAzimuthImage& image, const radar::Radar& radar,
                               const terrain::HeightField& terrain, const radar::GroundGrid& grid,
                               const geo::LocalFrame& frame, const Provenance& provenance) {
  return described_map(ground_map(image, terrain, grid), radar, frame, provenance);
}

}  // namespace sigmascape::product
