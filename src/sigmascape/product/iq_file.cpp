#include "sigmascape/product/iq_file.h"

#include <algorithm>
#include <array>
#include <complex>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/product/iq_formats.h"
#include "sigmascape/product/json_text.h"

namespace sigmascape::product {
namespace {

using Writer = void (*)(const std::filesystem::path&, const IqRecord&);

const std::map<std::string, Writer>& writers() {
  static const std::map<std::string, Writer> by_ending{{".npy", write_iq_npy},
                                                       {".npz", write_iq_npz},
                                                       {".h5", write_iq_hdf5},
                                                       {".hdf5", write_iq_hdf5},
                                                       {".sigmf-meta", write_iq_sigmf}};
  return by_ending;
}

void check(const std::filesystem::path& path, const IqRecord& record) {
  const std::size_t expected = record.slow.values.size() * record.fast.values.size() * record.polarizations.size();
  if (record.samples.size() != expected || record.samples.empty()) {
    throw Error(path.string(),
                fmt::format("{} samples do not fill {} x {} places in {} polarizations", record.samples.size(),
                            record.slow.values.size(), record.fast.values.size(), record.polarizations.size()),
                "give one sample a place and polarization");
  }
  if (record.platform.size() != 1 && record.platform.size() != record.slow.values.size()) {
    throw Error(path.string(), fmt::format("{} motions of the platform were given", record.platform.size()),
                "give one, or one for each place on the slow axis");
  }
  if (!record.beam_azimuth_rad.empty() && record.beam_azimuth_rad.size() != record.platform.size()) {
    throw Error(path.string(), fmt::format("{} azimuths of the beam were given", record.beam_azimuth_rad.size()),
                "give one for each motion of the platform, or none");
  }
}

Error said_twice(const std::filesystem::path& path, const std::string& key) {
  return Error(path.string(), fmt::format("would say {} twice", key),
               "report this: it is a fault of the program and not of what it was given");
}

/// Every key stands in a file once: formats differ in what they make of a second one. Whoever fills the record is to
/// blame, and no user can help it.
void check_keys(const std::filesystem::path& path, const IqRecord& record) {
  constexpr std::array<std::string_view, 6> own{"kind", "quantity", "unit", "axes", "units", "polarizations"};
  const auto refuse_own = [&](const std::string& key) {
    if (std::ranges::find(own, key) != own.end()) throw said_twice(path, key);
  };
  for (const auto& [key, number] : record.numbers) refuse_own(key);
  for (const auto& [key, word] : record.words) {
    refuse_own(key);
    if (record.numbers.contains(key)) throw said_twice(path, key);
  }
}

}  // namespace

void check_iq_name(const std::filesystem::path& path) {
  if (!writers().contains(file_ending(path))) {
    throw Error(path.string(), "is no kind of file that I/Q is written as",
                "end the name in .npy, .npz, .h5 or .sigmf-meta");
  }
}

void check_iq_size(const std::filesystem::path& path, std::size_t samples, double memory_bytes) {
  const std::string ending = file_ending(path);
  const double bytes = static_cast<double>(samples) * sizeof(std::complex<float>);
  // Its directory and the axes take little beside them.
  if (ending == ".npz" && bytes > 0.999 * UINT32_MAX)
    throw Error(path.string(), "would be larger than 4 GiB", "write HDF5 or SigMF");
  // As they are received and as they are recorded; NumPy's file is put together before it is written, an archive twice.
  const double copies = ending == ".npz" ? 4.0 : ending == ".npy" ? 3.0 : 2.0;
  if (copies * bytes > memory_bytes) {
    throw Error(
        path.string(),
        fmt::format("holds {:.3g} GB of samples, which take {:.3g} GB of memory to write, and there are {:.3g}",
                    bytes / 1e9, copies * bytes / 1e9, memory_bytes / 1e9),
        copies > 2.0 ? "write HDF5 or SigMF, or record less" : "record a shorter interval or a shorter range gate");
  }
}

void write_iq(const std::filesystem::path& path, const IqRecord& record) {
  check_iq_name(path);
  check(path, record);
  check_keys(path, record);
  writers().at(file_ending(path))(path, record);
}

std::string axis_name(const IqAxis& axis) {
  return axis.name + "_" + axis.unit;
}

std::vector<double> platform_numbers(const IqRecord& record, Vec3d radar::Motion::*member) {
  std::vector<double> numbers;
  for (const radar::Motion& motion : record.platform) {
    const Vec3d& v = motion.*member;
    numbers.insert(numbers.end(), {v.x, v.y, v.z});
  }
  return numbers;
}

std::string iq_description(const IqRecord& record) {
  nlohmann::ordered_json json{{"kind", record.kind},
                              {"quantity", record.quantity},
                              {"unit", record.unit},
                              {"axes", {record.slow.name, record.fast.name, "polarization"}},
                              {"units", {record.slow.unit, record.fast.unit, ""}},
                              {"polarizations", record.polarizations}};
  for (const auto& [key, number] : record.numbers) json[key] = number;
  for (const auto& [key, word] : record.words) json[key] = word;
  return json_text(json, 2);
}

}  // namespace sigmascape::product
