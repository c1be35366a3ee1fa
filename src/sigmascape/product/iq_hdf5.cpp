#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <mutex>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/iq_formats.h"

namespace sigmascape::product {
namespace {

/// A call to HDF5 that went wrong, on its way to where the name of the file is known.
struct FailedCall {
  const char* name;
};

/// What a call to HDF5 returned, if it went well.
template <typename Result>
Result checked(Result result, const char* doing) {
  if (result < 0) throw FailedCall{doing};
  return result;
}

/// An identifier of HDF5 with the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const char* doing) : id_(checked(id, doing)), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Without the time of writing, which HDF5 else notes with every object.
Handle timeless(hid_t kind) {
  Handle properties(H5Pcreate(kind), H5Pclose, "H5Pcreate");
  checked(H5Pset_obj_track_times(properties, false), "H5Pset_obj_track_times");
  return properties;
}

void put_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "H5Tcopy");
  checked(H5Tset_size(type, text.size() + 1), "H5Tset_size");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "H5Tset_cset");
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "H5Screate");
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "H5Acreate2");
  checked(H5Awrite(attribute, type, text.c_str()), "H5Awrite");
}

void put_attribute(hid_t object, const std::string& name, double number) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "H5Screate");
  const Handle attribute(H5Acreate2(object, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "H5Acreate2");
  checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &number), "H5Awrite");
}

template <std::size_t Rank>
Handle dataset(hid_t file, const std::string& name, hid_t type, const std::array<hsize_t, Rank>& shape) {
  const Handle space(H5Screate_simple(static_cast<int>(Rank), shape.data(), nullptr), H5Sclose, "H5Screate_simple");
  const Handle properties = timeless(H5P_DATASET_CREATE);
  return Handle(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
                "H5Dcreate2");
}

void write_numbers(hid_t file, const std::string& name, const std::string& unit, const std::vector<double>& numbers) {
  const Handle set = dataset<1>(file, name, H5T_IEEE_F64LE, {numbers.size()});
  checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), "H5Dwrite");
  put_attribute(set, "units", unit);
}

void write_axis(hid_t file, const IqAxis& axis) {
  write_numbers(file, axis.name, axis.unit, axis.values);
  const Handle set(H5Dopen2(file, axis.name.c_str(), H5P_DEFAULT), H5Dclose, "H5Dopen2");
  checked(H5DSset_scale(set, axis.name.c_str()), "H5DSset_scale");
}

void write_vectors(hid_t file, const std::string& name, const std::string& unit, const std::vector<double>& numbers) {
  const Handle set = dataset<2>(file, name, H5T_IEEE_F64LE, {numbers.size() / 3, 3});
  checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), "H5Dwrite");
  put_attribute(set, "units", unit);
  put_attribute(set, "axes", "place on the slow axis (or one for all); x east, y north, z up");
}

/// Two floats called r and i: what h5py reads as complex64 and MATLAB as a structure of two matrices.
Handle complex_type(hid_t part) {
  const std::size_t size = sizeof(float);
  Handle type(H5Tcreate(H5T_COMPOUND, 2 * size), H5Tclose, "H5Tcreate");
  checked(H5Tinsert(type, "r", 0, part), "H5Tinsert");
  checked(H5Tinsert(type, "i", size, part), "H5Tinsert");
  return type;
}

void write_polarization(hid_t file, const IqRecord& record, std::size_t polarization) {
  std::vector<std::complex<float>> samples;
  samples.reserve(record.samples.size() / record.polarizations.size());
  for (std::size_t i = polarization; i < record.samples.size(); i += record.polarizations.size())
    samples.push_back(record.samples[i]);
  const Handle set = dataset<2>(file, record.polarizations[polarization], complex_type(H5T_IEEE_F32LE),
                                {record.slow.values.size(), record.fast.values.size()});
  checked(H5Dwrite(set, complex_type(H5T_NATIVE_FLOAT), H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data()), "H5Dwrite");
  put_attribute(set, "units", record.unit);
  unsigned dimension = 0;
  for (const IqAxis* axis : {&record.slow, &record.fast}) {
    const Handle scale(H5Dopen2(file, axis->name.c_str(), H5P_DEFAULT), H5Dclose, "H5Dopen2");
    checked(H5DSattach_scale(set, scale, dimension++), "H5DSattach_scale");
  }
}

void write_file(const std::filesystem::path& path, const IqRecord& record) {
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, timeless(H5P_FILE_CREATE), H5P_DEFAULT), H5Fclose,
                    "H5Fcreate");
  put_attribute(file, "kind", record.kind);
  put_attribute(file, "quantity", record.quantity);
  put_attribute(file, "unit", record.unit);
  put_attribute(file, "axes", fmt::format("{}, {}", record.slow.name, record.fast.name));
  put_attribute(file, "units", fmt::format("{}, {}", record.slow.unit, record.fast.unit));
  put_attribute(file, "polarizations", fmt::format("{}", fmt::join(record.polarizations, ", ")));
  for (const auto& [name, number] : record.numbers) put_attribute(file, name, number);
  for (const auto& [name, word] : record.words) put_attribute(file, name, word);
  write_axis(file, record.slow);
  write_axis(file, record.fast);
  write_vectors(file, "platform_position", "m", platform_numbers(record, &radar::Motion::position));
  write_vectors(file, "platform_velocity", "m/s", platform_numbers(record, &radar::Motion::velocity_mps));
  if (!record.beam_azimuth_rad.empty()) write_numbers(file, "beam_azimuth", "rad", record.beam_azimuth_rad);
  for (const IqAxis& column : record.cuts) write_numbers(file, column.name, column.unit, column.values);
  for (std::size_t i = 0; i < record.polarizations.size(); ++i) write_polarization(file, record, i);
}

/// Upper bound of what HDF5 makes of the recording: its numbers, and what it says about them.
std::uintmax_t most_bytes(const IqRecord& record) {
  constexpr std::uintmax_t said_about_them = 64 << 10;
  const std::uintmax_t samples = record.samples.size() * sizeof(record.samples[0]);
  const std::uintmax_t axes = (record.slow.values.size() + record.fast.values.size()) * sizeof(double);
  const std::uintmax_t platform = record.platform.size() * sizeof(record.platform[0]);
  const std::uintmax_t beam = record.beam_azimuth_rad.size() * sizeof(double);
  std::uintmax_t cuts = 0;
  for (const IqAxis& column : record.cuts) cuts += column.values.size() * sizeof(double);
  return samples + axes + platform + beam + cuts + said_about_them;
}

}  // namespace

void write_iq_hdf5(const std::filesystem::path& path, const IqRecord& record) {
  // Debian's HDF5 is not made for several threads.
  static std::mutex guard;
  const std::lock_guard lock(guard);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  try {
    // HDF5 notices a full disk only while it closes the file, cannot say so, and crashes when the program ends.
    geo::write_atomically(path, most_bytes(record),
                          [&](const std::filesystem::path& temporary) { write_file(temporary, record); });
  } catch (const FailedCall& call) {
    throw Error(path.string(), fmt::format("cannot be written ({} failed)", call.name),
                "free some space or choose another disk");
  }
}

}  // namespace sigmascape::product
