#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "array_view.h"
#include "gil.h"
#include "given_number.h"
#include "loaded_atlas.h"
#include "long_call.h"
#include "number_array.h"
#include "parts.h"
#include "text_with_file_names.h"
#include "whole_number.h"

#include "sigmascape/atlas/atlas_summary.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

py::array_t<double> degrees(std::vector<double> angles) {
  // Nine decimals: what a person wrote as 45 is to be 45 again.
  for (double& angle : angles) angle = std::round(deg_from_radians(angle) * 1e9) / 1e9;
  return copied_array(angles);
}

py::array_t<double> gigahertz(std::vector<double> frequencies) {
  for (double& frequency : frequencies) frequency /= 1e9;
  return copied_array(frequencies);
}

double checked_azimuth(double azimuth_deg) {
  return within("azimuth_deg", azimuth_deg, -1e6, 1e6);
}

/// The place on an axis of a value that differs from what it must be by its rounding alone.
template <typename Difference>
std::size_t place_on(const std::vector<double>& axis, double value, const char* name, const Difference& difference) {
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (std::abs(difference(axis[i], value)) <= 1e-7 * std::max(1.0, std::abs(value))) return i;
  }
  throw Error(name, "was not baked", "choose from the axes of the atlas");
}

std::shared_ptr<atlas::HalfTexture> texture(const LoadedAtlas& loaded, std::array<AnyWhole<"patch">, 2> given,
                                            double azimuth_deg, double elevation_deg, double frequency_ghz) {
  const std::array<int, 2> patch{given[0], given[1]};
  const atlas::AtlasDescription& description = loaded.description();
  const auto [first, last] = description.patches.block_over(description.extent);
  if (patch[0] < first.x || patch[0] > last.x || patch[1] < first.y || patch[1] > last.y)
    throw Error("patch", fmt::format("is ({}, {}), and there is none such", patch[0], patch[1]),
                "choose from the patches of the atlas");
  const atlas::AspectGrid& axes = description.aspects;
  checked_azimuth(azimuth_deg);
  // A little west of north is close to north.
  const auto turn = [](double one, double other) { return turned_by_least(one - other); };
  const auto look =
      axes.index_of(place_on(axes.azimuths_rad, wrapped_azimuth(radians_from_deg(azimuth_deg)), "azimuth_deg", turn),
                    place_on(axes.elevations_rad, radians_from_deg(elevation_deg), "elevation_deg", std::minus<>()),
                    place_on(axes.frequencies_hz, frequency_ghz * 1e9, "frequency_ghz", std::minus<>()));
  return std::make_shared<atlas::HalfTexture>(loaded.store().read_halves({patch[0], patch[1]}, look));
}

py::list levels_of(const py::object& self) {
  const auto& halves = self.cast<const atlas::HalfTexture&>();
  py::list levels;
  for (std::size_t level = 0; level < halves.levels.size(); ++level) {
    const auto side = static_cast<py::ssize_t>(halves.side >> level);
    const std::vector<py::ssize_t> shape{side, side, radar::Channels::count};
    const auto& numbers = halves.levels[level];
    levels.append(array_view(py::dtype("float16"), numbers.data(), shape, strides_of(shape, sizeof(numbers[0])), self,
                             Access::ReadWrite));
  }
  return levels;
}

/// A rectangle that holds all the points.
radar::Rectangle bounds_of(const double* x_m, const double* y_m, std::size_t count) {
  const auto [west, east] = std::minmax_element(x_m, x_m + count);
  const auto [south, north] = std::minmax_element(y_m, y_m + count);
  return {*west, *south, *east, *north};
}

py::array_t<float> sigma0_at(const LoadedAtlas& loaded, const NumberArray& x_m, const NumberArray& y_m,
                             double azimuth_deg, double elevation_deg, double frequency_ghz, double level) {
  if (x_m.ndim() != y_m.ndim() || !std::equal(x_m.shape(), x_m.shape() + x_m.ndim(), y_m.shape()))
    throw Error("x_m and y_m", "differ in shape", "give as many eastings as northings");
  checked_azimuth(azimuth_deg);
  within("elevation_deg", elevation_deg, -90.0, 90.0);
  within("level", level, 0.0, 100.0);
  std::vector<py::ssize_t> shape(x_m.shape(), x_m.shape() + x_m.ndim());
  shape.push_back(radar::Channels::count);
  py::array_t<float> result(shape);
  const auto count = static_cast<std::size_t>(x_m.size());
  const double *x = x_m.data(), *y = y_m.data();
  for (std::size_t i = 0; i < count; ++i) (void)checked_place(x[i], y[i]);
  auto* out = reinterpret_cast<radar::Channels*>(result.mutable_data());
  long_call([&] {
    const atlas::Atlas& textures = loaded.textures();
    textures.check_frequency(frequency_ghz * 1e9);
    if (count > 0) textures.prepare(bounds_of(x, y, count), level);
    const auto weights =
        textures.weights_for({radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)}, frequency_ghz * 1e9);
    for (std::size_t i = 0; i < count; ++i) out[i] = textures.sigma0_at({x[i], y[i]}, weights, level);
    const atlas::GroundLayers* ground = textures.ground_layers();
    if (ground == nullptr) return;
    const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
    const radar::Rectangle& extent = loaded.description().extent;
    for (std::size_t i = 0; i < count; ++i) {
      if (extent.contains({x[i], y[i]}))
        out[i] += ground->sigma0.sigma0_at({x[i], y[i]}, aspect, frequency_ghz * 1e9, level);
    }
  });
  return result;
}

py::list list_of(const std::optional<atlas::StoreFault>& fault) {
  py::list faults;
  if (fault) faults.append(py::dict(py::arg("file") = fault->file.string(), py::arg("fault") = fault->what));
  return faults;
}

py::dict dict_of(const atlas::AtlasSummary::Files& files) {
  return py::dict(py::arg("files") = files.planned, py::arg("files_done") = files.done);
}

/// How many files a layer has nobody knows without its collection.
py::dict dict_of(const atlas::AtlasSummary::Layer& layer) {
  py::dict told = dict_of(layer.textures);
  if (layer.fault) told["files"] = py::none();
  told["faults"] = list_of(layer.fault);
  return told;
}

py::dict dict_of(const atlas::AtlasSummary::Buildings& buildings) {
  py::dict told(py::arg("faults") = list_of(buildings.fault), py::arg("textures") = py::none());
  if (buildings.textures) told["textures"] = dict_of(*buildings.textures);
  return told;
}

/// None of what this atlas is not to have.
template <typename Part>
py::object dict_of(const std::optional<Part>& part) {
  return part ? py::object(dict_of(*part)) : py::none();
}

py::dict info_of(const LoadedAtlas& loaded) {
  const atlas::AtlasDescription& description = loaded.description();
  const atlas::AtlasSummary summary = long_call([&] { return atlas::summary_of(loaded.store()); });
  py::dict info;
  info["name"] = description.name;
  info["crs"] = description.frame.proj();
  info["texel_m"] = description.patches.texel_m;
  info["texels_per_side"] = description.patches.texels_per_side;
  info["patches"] = summary.patches;
  info["looks"] = summary.looks;
  info["looks_done"] = summary.looks_done;
  info["pyramid"] = py::dict(py::arg("levels") = summary.pyramid_levels, py::arg("textures") = summary.pyramid.planned,
                             py::arg("textures_done") = summary.pyramid.done);
  info["obstacles"] = dict_of(summary.obstacles);
  info["ground"] = dict_of(summary.ground);
  info["buildings"] = dict_of(summary.buildings);
  info["bytes"] = summary.bytes;
  info["relative_standard_error"] = summary.errors.relative();
  info["above_target"] = summary.errors.part_above_target();
  info["part_of_all"] = summary.errors.part_of_all();
  info["looks_told"] = summary.looks_told;
  info["settings"] = description.settings;
  info["scene_hash"] = description.scene_hash;
  info["attribution"] = description.attribution;
  return info;
}

std::vector<std::array<int, 2>> patches_of(const LoadedAtlas& loaded) {
  std::vector<std::array<int, 2>> patches;
  for (const auto& patch : loaded.description().patches.covering(loaded.description().extent))
    patches.push_back({patch.x, patch.y});
  return patches;
}

void add_texture(py::module_& module) {
  py::class_<atlas::HalfTexture, std::shared_ptr<atlas::HalfTexture>>(
      module, "Texture", "The stored sigma0 of one patch from one look: half floats times `scale`.")
      .def_property_readonly("levels", &levels_of,
                             "float16 [row, column, 4] of each level, the finest first, north up: VV, HH, HV,\n"
                             "Re<S_VV S_HH*>. Share the texture's memory. `sigma0` scales them: multiplied as halves,\n"
                             "small numbers vanish.")
      .def_readonly("scale", &atlas::HalfTexture::scale, "sigma0, linear, of a stored 1: a power of two.")
      .def(
          "sigma0",
          [](const py::object& self, Whole<"level", std::size_t> level) {
            const py::list levels = levels_of(self);
            if (level >= levels.size()) throw Error("level", "is not stored", "choose one of `levels`");
            return levels[level].attr("astype")("float32") * py::float_(self.cast<const atlas::HalfTexture&>().scale);
          },
          py::arg("level") = 0, "A level in float32, scaled: sigma0, linear. A copy.");
}

}  // namespace

void add_atlas(py::module_& module) {
  add_texture(module);
  py::class_<LoadedAtlas, std::shared_ptr<LoadedAtlas>>(
      module, "Atlas",
      "Baked reflectivity: sigma0 of every texel over azimuth, elevation and frequency. Opening reads its description\n"
      "only; textures come into memory when a map or sigma0_at first needs them, and stay.")
      .def(py::init<const std::filesystem::path&>(), py::arg("folder"),
           "Opens the folder that bake() or `sigmascape bake` wrote.")
      .def_property_readonly("folder", [](const LoadedAtlas& a) { return a.store().folder(); })
      .def_property_readonly("name", [](const LoadedAtlas& a) { return a.description().name; })
      .def_property_readonly("azimuths_deg",
                             [](const LoadedAtlas& a) { return degrees(a.description().aspects.azimuths_rad); })
      .def_property_readonly("elevations_deg",
                             [](const LoadedAtlas& a) { return degrees(a.description().aspects.elevations_rad); })
      .def_property_readonly("frequencies_ghz",
                             [](const LoadedAtlas& a) { return gigahertz(a.description().aspects.frequencies_hz); })
      .def_property_readonly("texel_m", [](const LoadedAtlas& a) { return a.description().patches.texel_m; })
      .def_property_readonly(
          "extent_m",
          [](const LoadedAtlas& a) {
            const auto& e = a.description().extent;
            return py::make_tuple(e.west_m, e.south_m, e.east_m, e.north_m);
          },
          "West, south, east, north.")
      .def_property_readonly("crs", [](const LoadedAtlas& a) { return a.description().frame.proj(); })
      .def_property_readonly("scene_hash", [](const LoadedAtlas& a) { return a.description().scene_hash; })
      .def_property_readonly("patches", &patches_of,
                             "(x, y) of every patch; patch (0, 0) has its south-western corner at the frame's origin.")
      .def_property_readonly(
          "terrain_m",
          [](const py::object& self) {
            const auto& loaded = self.cast<const LoadedAtlas&>();
            // Another thread that reads it may want the GIL meanwhile.
            const auto* const terrain = long_call([&] { return &loaded.terrain(); });
            return layer_view<float>(terrain->height_m, 0, self, Access::ReadOnly);
          },
          "Heights under the scene, float32 [row, column], north up; no copy.")
      .def("texture", &texture, py::arg("patch"), py::kw_only(), py::arg("azimuth_deg"), py::arg("elevation_deg"),
           py::arg("frequency_ghz"), py::call_guard<WithoutGil>(),
           "The stored Texture of one patch from one baked look. Where shadows are made at run time it holds all "
           "echoes\n"
           "but the bare ground's own, and those of buildings' walls and roofs where these are kept apart.")
      .def("sigma0_at", &sigma0_at, py::arg("x_m"), py::arg("y_m"), py::kw_only(), py::arg("azimuth_deg"),
           py::arg("elevation_deg"), py::arg("frequency_ghz"), py::arg("level") = 0.0,
           "sigma0 at points, interpolated in place, level and look (linear power): float32 [..., 4] for x_m and y_m "
           "of\n"
           "shape [...], within 1e7 m of the origin. Of atlases that keep bare ground apart, as bake() makes them "
           "unless\n"
           "told otherwise, it is in it, unshadowed; what buildings that are kept apart return directly is not. 0 "
           "outside "
           "the\natlas.")
      .def(
          "load", [](const LoadedAtlas& a) { long_call([&a] { a.textures().prepare(a.description().extent, 0.0); }); },
          "Reads all textures now rather than when first needed.")
      .def("info", &info_of, "What is there, how large and how noisy it is, as a dict.")
      .def("__repr__", [](const LoadedAtlas& a) {
        return text_with_file_names("<sigmascape.Atlas '" + a.store().folder().string() + "'>");
      });
}

}  // namespace sigmascape::python
