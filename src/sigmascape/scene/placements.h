#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/vector_source.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Places as a scene file may state them.
struct Placements {
  std::vector<std::array<double, 2>> in_frame_m;  ///< east, north of the origin
  std::vector<std::array<double, 2>> lat_lon_deg;
  std::optional<geo::VectorSource> points;  ///< of a CSV or OGR file

  [[nodiscard]] bool empty() const { return in_frame_m.empty() && lat_lon_deg.empty() && !points; }
};

/// Reads positions_m, positions_lat_lon_deg and [positions].
[[nodiscard]] Placements read_placements(const TomlSection& section);

/// Throws Error at a key whose pairs are not latitudes and longitudes.
void require_on_globe(const TomlSection& section, std::string_view key,
                      std::span<const std::array<double, 2>> lat_lon_deg);

/// Places in the scene's frame.
struct FoundPlaces {
  std::vector<Vec2d> positions;  ///< in the order frame, globe, file
  geo::FeatureCensus of_file{};  ///< of `Placements::points`
};

[[nodiscard]] FoundPlaces places_in(const Scene& scene, const Placements& placements);

}  // namespace sigmascape::scene
