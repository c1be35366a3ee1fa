#include <array>
#include <nlohmann/json.hpp>

#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/iq_file.h"
#include "sigmascape/product/iq_formats.h"
#include "sigmascape/product/npy_bytes.h"
#include "sigmascape/product/zip_bytes.h"

namespace sigmascape::product {
namespace {

constexpr const char* positions_name = "platform_position_m";
constexpr const char* velocities_name = "platform_velocity_mps";
constexpr const char* beam_name = "beam_azimuth_rad";

std::string samples_bytes(const IqRecord& record) {
  const std::array shape{record.slow.values.size(), record.fast.values.size(), record.polarizations.size()};
  return npy_bytes("<c8", shape, std::as_bytes(record.samples));
}

ZipEntry numbers_entry(const std::string& name, const std::vector<double>& numbers) {
  const std::array shape{numbers.size()};
  return {name + ".npy", npy_bytes("<f8", shape, std::as_bytes(std::span(numbers)))};
}

ZipEntry vectors_entry(const std::string& name, const std::vector<double>& numbers) {
  const std::array<std::size_t, 2> shape{numbers.size() / 3, 3};
  return {name + ".npy", npy_bytes("<f8", shape, std::as_bytes(std::span(numbers)))};
}

/// The description with what other formats keep as arrays of their own.
std::string description_with_places(const IqRecord& record) {
  using Json = nlohmann::ordered_json;
  Json json = Json::parse(iq_description(record));
  for (const IqAxis* axis : {&record.slow, &record.fast}) json[axis_name(*axis)] = axis->values;
  const auto add_vectors = [&](const char* name, Vec3d radar::Motion::*member) {
    json[name] = Json::array();
    for (const radar::Motion& motion : record.platform) {
      const Vec3d& v = motion.*member;
      json[name].push_back({v.x, v.y, v.z});
    }
  };
  add_vectors(positions_name, &radar::Motion::position);
  add_vectors(velocities_name, &radar::Motion::velocity_mps);
  if (!record.beam_azimuth_rad.empty()) json[beam_name] = record.beam_azimuth_rad;
  for (const IqAxis& column : record.cuts) json[axis_name(column)] = column.values;
  return json.dump() + "\n";
}

}  // namespace

void write_iq_npy(const std::filesystem::path& path, const IqRecord& record) {
  const std::string description = description_with_places(record), samples = samples_bytes(record);
  geo::write_together({{geo::companion_of(path, ".json"), description}, {path, samples}});
}

void write_iq_npz(const std::filesystem::path& path, const IqRecord& record) {
  std::vector<ZipEntry> entries{{"samples.npy", samples_bytes(record)},
                                numbers_entry(axis_name(record.slow), record.slow.values),
                                numbers_entry(axis_name(record.fast), record.fast.values),
                                vectors_entry(positions_name, platform_numbers(record, &radar::Motion::position)),
                                vectors_entry(velocities_name, platform_numbers(record, &radar::Motion::velocity_mps))};
  if (!record.beam_azimuth_rad.empty()) entries.push_back(numbers_entry(beam_name, record.beam_azimuth_rad));
  for (const IqAxis& column : record.cuts) entries.push_back(numbers_entry(axis_name(column), column.values));
  entries.push_back({"description_json.npy", npy_text(iq_description(record))});
  geo::write_atomically(path, zip_bytes(entries, path.string(), "write HDF5 or SigMF"));
}

}  // namespace sigmascape::product
