#include "sigmascape/dataset/sample_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "sigmascape/atlas/half.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/speckle.h"
#include "sigmascape/product/npy_bytes.h"
#include "sigmascape/product/picture.h"
#include "sigmascape/product/png_file.h"
#include "sigmascape/product/software.h"

namespace sigmascape::dataset {
namespace {

using Json = nlohmann::ordered_json;

/// Powers below this are this in decibels: the logarithm of nothing is of no use to anyone.
constexpr float least_power = 1e-10F;

/// The nearest half that is a number: what is greater than the greatest becomes that.
atlas::Half finite_half(float value) {
  return atlas::half_from_float(std::clamp(value, -atlas::largest_half, atlas::largest_half));
}

std::string map_bytes(const DatasetSpec& spec, const radar::GroundMap& map) {
  std::vector<float> numbers;
  for (const radar::Polarization polarization : spec.polarizations) {
    for (const radar::Channels& cell : map.sigma0.values()) {
      const float power = cell.power(polarization);
      numbers.push_back(spec.in_decibels ? 10.0F * std::log10(std::max(power, least_power)) : power);
    }
  }
  const std::array<std::size_t, 3> shape{spec.polarizations.size(), map.grid.rows, map.grid.columns};
  if (!spec.is_half) return product::npy_bytes("<f4", shape, std::as_bytes(std::span(numbers)));
  std::vector<atlas::Half> halves(numbers.size());
  std::ranges::transform(numbers, halves.begin(), finite_half);
  return product::npy_bytes("<f2", shape, std::as_bytes(std::span(halves)));
}

std::string label_bytes(const radar::Layer& layer) {
  const std::array<std::size_t, 2> shape{layer.values.rows(), layer.values.columns()};
  if (layer.unit.empty()) {
    std::vector<std::uint8_t> numbers(layer.values.size());
    std::ranges::transform(layer.values.values(), numbers.begin(),
                           [](float v) { return static_cast<std::uint8_t>(v); });
    return product::npy_bytes("|u1", shape, std::as_bytes(std::span(numbers)));
  }
  Array2D<float> numbers = layer.values;
  if (layer.unit == "rad") {
    for (float& value : numbers.values()) value = static_cast<float>(deg_from_radians(value));
  }
  return product::npy_bytes("<f4", shape, std::as_bytes(numbers.values()));
}

/// To the given number of decimals, so that the text does not hang on a machine's last bit.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}

Json target_json(const DatasetSpec& spec, const SampleTarget& target) {
  const TargetClass& kind = spec.targets[target.planned.target_class];
  return {{"class", kind.name},
          {"east_m", target.planned.position.x},
          {"north_m", target.planned.position.y},
          {"velocity_mps", {target.planned.velocity_mps.x, target.planned.velocity_mps.y}},
          {"size_m", kind.size_m},
          {"height_m", kind.height_m},
          {"track", target.planned.track},
          {"rcs_dbsm", rounded(db_from_linear(target.planned.rcs_m2), 1e-6)},
          {"part_seen", rounded(target.part_seen, 1e-9)},
          {"is_seen", target.is_seen},
          {"bbox", {target.box.x, target.box.y, target.box.width, target.box.height}}};
}

/// Of a map's cells those in which the receiver did not listen.
double part_without_data(const radar::GroundMap& map) {
  const auto without = std::ranges::count_if(map.sigma0.values(), [](const auto& cell) { return std::isnan(cell.vv); });
  return static_cast<double>(without) / static_cast<double>(map.sigma0.size());
}

/// Of each polarization that is written, in their order.
Json noise_json(const DatasetSpec& spec, double noise_sigma0) {
  Json noise = Json::array();
  for (const radar::Polarization polarization : spec.polarizations)
    noise.push_back(static_cast<double>(even_noise(1.0F).power(polarization)) * noise_sigma0);
  return noise;
}

Json metadata_of(const DatasetSpec& spec, const Sample& sample) {
  const SamplePlan& plan = sample.plan;
  const radar::Aspect& seen = sample.aspect;
  Json polarizations = Json::array(), targets = Json::array(), layers = Json::object();
  for (const radar::Polarization polarization : spec.polarizations) polarizations.push_back(word_of(polarization));
  for (const SampleTarget& target : sample.targets) targets.push_back(target_json(spec, target));
  for (const radar::Layer& layer : sample.labels.layers) layers[layer.name] = layer.unit == "rad" ? "deg" : layer.unit;
  Json json{{"sample", plan.index},
            {"quantity", spec.in_decibels ? "sigma0 in dB" : "sigma0, linear"},
            {"polarizations", polarizations},
            {"rows", plan.grid.rows},
            {"columns", plan.grid.columns},
            {"cell_m", plan.grid.cell_m},
            {"west_m", plan.grid.west_m},
            {"north_m", plan.grid.north_m},
            {"crs", sample.map.crs},
            {"sequence", plan.sequence},
            {"frame", plan.frame},
            {"time_s", plan.time_s},
            {"azimuth_deg", rounded(deg_from_radians(seen.azimuth_rad), 1e-9)},
            {"elevation_deg", rounded(deg_from_radians(seen.elevation_rad), 1e-9)},
            {"slant_range_m", rounded(sample.slant_range_m, 1e-6)},
            {"radar_position_m", {sample.radar_position.x, sample.radar_position.y, sample.radar_position.z}},
            {"radar_velocity_mps", {plan.flight_mps.x, plan.flight_mps.y, 0.0}},
            {"frequency_hz", plan.frequency_hz},
            {"range_resolution_m", plan.range_resolution_m},
            {"beam_width_deg", deg_from_radians(plan.beam_width_rad)},
            {"level_of_detail", spec.level_of_detail},
            {"part_without_data", rounded(part_without_data(sample.map), 1e-9)},
            {"looks", spec.looks},
            {"speckle", spec.looks == 0 ? "none: mean power"
                                        : fmt::format("{} look{}, independent from cell to cell", spec.looks,
                                                      spec.looks == 1 ? "" : "s")},
            // Of 64 bits, more than numbers of JSON keep in many a reader.
            {"seed", std::to_string(plan.seed)},
            {"software", product::software_name()},
            {"scene_hash", sample.scene_hash},
            {"layers", layers},
            {"targets", targets}};
  if (plan.snr_db) json["snr_db"] = *plan.snr_db;
  if (plan.snr_db || plan.noise_sigma0_db) json["noise_sigma0"] = noise_json(spec, sample.noise_sigma0);
  return json;
}

}  // namespace

std::string_view word_of(radar::Polarization polarization) {
  switch (polarization) {
    case radar::Polarization::VV:
      return "VV";
    case radar::Polarization::HH:
      return "HH";
    case radar::Polarization::HV:
    case radar::Polarization::VH:
      return "HV";
    case radar::Polarization::Sum:
      break;
  }
  return "sum";
}

radar::Polarization pictured_polarization(const DatasetSpec& spec) {
  const auto shows_targets = [&](radar::Polarization of) {
    return spec.targets.empty() || target_channels(1.0).power(of) > 0.0F;
  };
  const auto found = std::ranges::find_if(spec.polarizations, shows_targets);
  return found == spec.polarizations.end() ? spec.polarizations.front() : *found;
}

std::vector<SampleFile> sample_files(const DatasetSpec& spec, const Sample& sample) {
  std::vector<SampleFile> files{{"map.npy", map_bytes(spec, sample.map)}};
  for (const radar::Layer& layer : sample.labels.layers) files.push_back({layer.name + ".npy", label_bytes(layer)});
  files.push_back({"metadata.json", metadata_of(spec, sample).dump(1) + "\n"});
  if (spec.with_preview) {
    files.push_back({"preview.png", product::png_bytes(product::picture_of(
                                        sample.map, {.polarization = pictured_polarization(spec)}))});
  }
  return files;
}

}  // namespace sigmascape::dataset
