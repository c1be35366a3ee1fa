#include <cmath>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "given_number.h"
#include "number_array.h"
#include "parts.h"
#include "polarization.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/product/plot.h"
#include "sigmascape/product/plot_file.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/range_response.h"
#include "sigmascape/scatter/surface_sigma0.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using Curve = std::pair<std::vector<double>, std::vector<double>>;

/// Beyond them sine and cosine of a number say little.
constexpr Interval azimuths_deg{-1e6, 1e6, "°"};
constexpr Interval offsets_m{-1e7, 1e7, "m"};

std::vector<py::ssize_t> shape_of(const NumberArray& numbers) {
  return {numbers.shape(), numbers.shape() + numbers.ndim()};
}

py::array_t<float> material_sigma0(const std::string& name, const NumberArray& grazing_deg, double frequency_ghz) {
  within("frequency_ghz", frequency_ghz, radar::bounds::frequencies_ghz);
  const scatter::SurfaceModel model(scatter::library_material(name), frequency_ghz * 1e9);
  auto shape = shape_of(grazing_deg);
  shape.push_back(radar::Channels::count);
  py::array_t<float> result(shape);
  auto* out = reinterpret_cast<radar::Channels*>(result.mutable_data());
  // Along a surface nothing comes back: the limit, where angles and fields themselves are not defined.
  for (py::ssize_t i = 0; i < grazing_deg.size(); ++i) {
    const double degrees = within("grazing_deg", grazing_deg.data()[i], 0.0, 90.0);
    out[i] = degrees > 0.0 ? scatter::surface_sigma0(model, radians_from_deg(degrees)) : radar::Channels{};
  }
  return result;
}

/// Over every number of an array, of which all lie within these bounds.
template <typename Function>
py::array_t<double> mapped(const std::string& name, const NumberArray& numbers, const Interval& allowed,
                           const Function& function) {
  py::array_t<double> result(shape_of(numbers));
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    result.mutable_data()[i] = function(within(name, numbers.data()[i], allowed));
  return result;
}

Curve curve_of(const std::string& name, const py::handle& places) {
  try {
    return places.cast<Curve>();
  } catch (const py::cast_error&) {
    throw Error("series '" + name + "'", "is not a pair of lists of numbers", "give x and y, as many of each");
  }
}

void plot(const std::filesystem::path& path, const py::dict& series, const std::string& title,
          const std::string& x_label, const std::string& y_label, bool dots, bool log_x) {
  product::Plot plot{.title = title, .x_label = x_label, .y_label = y_label, .x_is_logarithmic = log_x};
  for (const auto& [key, places] : series) {
    const auto name = py::str(key).cast<std::string>();
    const auto [x, y] = curve_of(name, places);
    if (x.size() != y.size()) throw Error("series '" + name + "'", "has other numbers of x and y", "give as many");
    product::PlotSeries& added = plot.series.emplace_back(product::PlotSeries{.name = name, .joined = !dots});
    added.dots = dots;
    for (std::size_t i = 0; i < x.size(); ++i) added.points.emplace_back(x[i], y[i]);
  }
  plot.x_from_zero = plot.y_from_zero = false;
  product::write_plot(path, plot);
}

}  // namespace

void add_curves(py::module_& module) {
  module.def(
      "material_names",
      [] {
        std::vector<std::string> names;
        for (const auto& material : scatter::material_library()) names.push_back(material.name);
        return names;
      },
      "The materials that are known by name, as a list.");
  module.def(
      "material_sigma0", &material_sigma0, py::arg("name"), py::arg("grazing_deg"), py::kw_only(),
      py::arg("frequency_ghz") = 10.0,
      "sigma0 of even ground of a material of the library, linear: float32 [..., 4] (VV, HH, HV, Re VV HH*) for\n"
      "grazing angles above the ground of shape [...].");
  module.def(
      "antenna_gain_db",
      [](const radar::RadarFile& radar, const NumberArray& azimuth_deg, double elevation_deg) {
        within("elevation_deg", elevation_deg, -90.0, 90.0);
        const auto pattern = radar::antenna_pattern(radar.radar);
        return mapped("azimuth_deg", azimuth_deg, azimuths_deg, [&](double offset_deg) {
          return db_from_linear(pattern.gain(radians_from_deg(offset_deg), radians_from_deg(elevation_deg)));
        });
      },
      py::arg("radar"), py::arg("azimuth_deg"), py::kw_only(), py::arg("elevation_deg") = 0.0,
      "One-way gain over isotropic of the radar's antenna, dB, float64 of the shape of azimuth_deg, offsets from the\n"
      "beam's axis; elevation_deg above the horizontal.");
  module.def(
      "range_response_db",
      [](const radar::RadarFile& radar, const NumberArray& offset_m) {
        const auto response =
            radar::RangeResponse::of_width(radar.radar.range_resolution_m, radar.radar.waveform.window);
        return mapped("offset_m", offset_m, offsets_m,
                      [&](double offset) { return db_from_linear(response.power(offset)); });
      },
      py::arg("radar"), py::arg("offset_m"),
      "Power of the compressed pulse at offsets of slant range from a point, dB relative to its peak, negative beside\n"
      "it: float64 of the shape of offset_m.");
  module.def("plot", &plot, py::arg("path"), py::arg("series"), py::kw_only(), py::arg("title") = "",
             py::arg("x_label") = "", py::arg("y_label") = "", py::arg("dots") = false, py::arg("log_x") = false,
             "Draws curves into an .svg or .png: `series` is a dict of name: (x, y). dots: unjoined points.");
}

}  // namespace sigmascape::python
