#include <array>

#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/iq_file.h"
#include "sigmascape/product/iq_formats.h"
#include "sigmascape/product/npy_bytes.h"
#include "sigmascape/product/zip_bytes.h"

namespace sigmascape::product {
namespace {

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

/// The description as an array of bytes: text of NumPy's own would take four bytes a letter.
ZipEntry words_entry(const std::string& name, const std::string& words) {
  const std::array shape{words.size()};
  return {name + ".npy", npy_bytes("|u1", shape, std::as_bytes(std::span(words)))};
}

}  // namespace

void write_iq_npy(const std::filesystem::path& path, const IqRecord& record) {
  const std::string description = iq_description(record), samples = samples_bytes(record);
  geo::write_together({{std::filesystem::path(path).replace_extension(".json"), description}, {path, samples}});
}

void write_iq_npz(const std::filesystem::path& path, const IqRecord& record) {
  geo::write_atomically(
      path, zip_bytes({{"samples.npy", samples_bytes(record)},
                       numbers_entry(record.slow.name + "_" + record.slow.unit, record.slow.values),
                       numbers_entry(record.fast.name + "_" + record.fast.unit, record.fast.values),
                       vectors_entry("platform_position_m", platform_numbers(record, &radar::Motion::position)),
                       vectors_entry("platform_velocity_mps", platform_numbers(record, &radar::Motion::velocity_mps)),
                       words_entry("description_json", iq_description(record))},
                      path.string()));
}

}  // namespace sigmascape::product
