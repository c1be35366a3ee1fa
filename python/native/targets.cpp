#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <utility>
#include <variant>

#include "given_number.h"
#include "loaded_atlas.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "parts.h"
#include "whole_number.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/corner_reflector.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/target_file.h"
#include "sigmascape/simulate/placement.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using radar::TargetSource;
using Pair = std::array<double, 2>;
using Triple = std::array<double, 3>;
using WayPoint = std::array<double, 4>;
using SwerlingCase = Whole<"swerling", int, 0, 4>;

struct TargetArguments {
  Pair position_m{};
  std::optional<double> height_m, altitude_m;
  double speed_mps = 0.0, heading_deg = 0.0, climb_mps = 0.0;
  std::vector<WayPoint> way_points;
};

radar::Channels rcs_of(double rcs_dbsm, const std::optional<double>& hv_dbsm, const std::string& bounces) {
  if (bounces != "odd" && bounces != "even") throw Error("bounces", "is '" + bounces + "'", "give 'odd' or 'even'");
  const auto co = static_cast<float>(linear_from_db(rcs_dbsm));
  return {co, co, hv_dbsm ? static_cast<float>(linear_from_db(*hv_dbsm)) : 0.0F, bounces == "odd" ? co : -co};
}

void check(const WayPoint& point) {
  const auto& [time_s, x_m, y_m, height_m] = point;
  within("way_points: time_s", time_s, radar::bounds::moments_s);
  within("way_points: x_m", x_m, -1e7, 1e7);
  within("way_points: y_m", y_m, -1e7, 1e7);
  within("way_points: height_m", height_m, 0.0, 1e6);
}

/// As in files: a track says all of where the target is.
void check_alone(const TargetArguments& arguments) {
  const auto refuse_when = [](bool is_given, const char* name, const char* told) {
    if (is_given) throw Error(name, fmt::format("and way_points both say {}", told), "leave out one of them");
  };
  refuse_when(arguments.position_m != Pair{}, "position_m", "where it is");
  refuse_when(arguments.speed_mps != 0.0, "speed_mps", "how it moves");
  refuse_when(arguments.climb_mps != 0.0, "climb_mps", "how it moves");
  refuse_when(arguments.height_m.has_value(), "height_m", "how high it is");
  if (arguments.altitude_m) {
    throw Error("altitude_m", "is given, and way_points are above the ground",
                "leave it out, or state the altitude of each way-point in a targets file, for read_targets()");
  }
}

void place(TargetSource& source, const TargetArguments& arguments) {
  if (arguments.height_m && arguments.altitude_m)
    throw Error("altitude_m", "and height_m both say how high the target is", "leave out one of them");
  if (!arguments.way_points.empty()) check_alone(arguments);
  const double height_m = arguments.altitude_m.value_or(arguments.height_m.value_or(source.target.size_m.z / 2.0));
  source.target.heading_rad = radians_from_deg(arguments.heading_deg);
  if (arguments.way_points.empty()) {
    const double heading_rad = source.target.heading_rad;
    source.places = {{.time_s = 0.0,
                      .place = Vec2d{arguments.position_m[0], arguments.position_m[1]},
                      .height_m = height_m,
                      .above_ground = !arguments.altitude_m}};
    source.velocity_mps = {arguments.speed_mps * std::sin(heading_rad), arguments.speed_mps * std::cos(heading_rad),
                           arguments.climb_mps};
    return;
  }
  for (const WayPoint& point : arguments.way_points) {
    if (!source.places.empty() && point[0] <= source.places.back().time_s)
      throw Error("way_points", "do not follow one another in time", "put them in the order of time");
    source.places.push_back(
        {.time_s = point[0], .place = Vec2d{point[1], point[2]}, .height_m = point[3], .above_ground = true});
  }
}

TargetSource made_target(const Pair& position_m, const std::string& name, double rcs_dbsm,
                         const std::optional<double>& hv_dbsm, const std::string& bounces,
                         const std::optional<double>& height_m, const std::optional<double>& altitude_m,
                         double speed_mps, double heading_deg, double climb_mps,
                         const std::vector<WayPoint>& way_points, SwerlingCase swerling, const Triple& size_m,
                         Seed seed) {
  all_within("position_m", position_m, -1e7, 1e7);
  within("rcs_dbsm", rcs_dbsm, -100.0, 100.0);
  if (hv_dbsm) within("hv_dbsm", *hv_dbsm, -100.0, 100.0);
  if (height_m) within("height_m", *height_m, 0.0, 1e6);
  if (altitude_m) within("altitude_m", *altitude_m, -500.0, 1e6);
  within("speed_mps", speed_mps, 0.0, 2e4);
  within("heading_deg", heading_deg, -1e6, 1e6);
  within("climb_mps", climb_mps, -1000.0, 1000.0);
  for (const WayPoint& point : way_points) check(point);
  all_within("size_m", size_m, 0.0, 1e4);
  TargetSource source;
  source.where = name;
  source.target.name = name;
  source.target.rcs_m2 = rcs_of(rcs_dbsm, hv_dbsm, bounces);
  source.target.fluctuation = static_cast<radar::Swerling>(int{swerling});
  source.target.seed = seed;
  source.target.size_m = {size_m[0], size_m[1], size_m[2]};
  place(source, {position_m, height_m, altitude_m, speed_mps, heading_deg, climb_mps, way_points});
  return source;
}

/// Its phase centre at a moment, on the ground that the track is over.
py::tuple position_on(const TargetSource& source, const geo::LocalFrame& frame, const terrain::HeightField& terrain,
                      double time_s) {
  within("time_s", time_s, radar::bounds::moments_s);
  const Vec3d place =
      simulate::placed_targets({&source, 1}, frame, terrain, source.target.seed).front().track.position_at(time_s);
  return py::make_tuple(place.x, place.y, place.z);
}

py::object rcs_dbsm_of(const TargetSource& source) {
  const auto* same_from_everywhere = std::get_if<radar::Channels>(&source.target.rcs_m2);
  if (same_from_everywhere == nullptr) return py::none();
  py::dict rcs;
  rcs["vv"] = db_from_linear(static_cast<double>(same_from_everywhere->vv));
  rcs["hh"] = db_from_linear(static_cast<double>(same_from_everywhere->hh));
  rcs["hv"] = db_from_linear(static_cast<double>(same_from_everywhere->hv));
  return rcs;
}

double trihedral_rcs_dbsm(double leg_m, double frequency_ghz) {
  positive("leg_m", leg_m);
  within("frequency_ghz", frequency_ghz, radar::bounds::frequencies_ghz);
  return db_from_linear(radar::triangular_trihedral_rcs_m2(leg_m, wavelength_m(frequency_ghz * 1e9)));
}

}  // namespace

void add_targets(py::module_& module) {
  py::class_<TargetSource>(module, "Target",
                           "A point that answers on its own: a vehicle, a ship, a reflector. Maps are of the\n"
                           "moment time_s, zero when nothing is said.")
      .def(py::init(&made_target), py::arg("position_m") = Pair{}, py::kw_only(), py::arg("name") = "target",
           py::arg("rcs_dbsm") = 10.0, py::arg("hv_dbsm") = py::none(), py::arg("bounces") = "odd",
           py::arg("height_m") = py::none(), py::arg("altitude_m") = py::none(), py::arg("speed_mps") = 0.0,
           py::arg("heading_deg") = 0.0, py::arg("climb_mps") = 0.0, py::arg("way_points") = std::vector<WayPoint>{},
           py::arg("swerling") = 0, py::arg("size_m") = Triple{}, py::arg("seed") = 0,
           "position_m: x, y in the local frame at time zero. rcs_dbsm: cross-section in VV and HH, dB over 1 m^2;\n"
           "hv_dbsm: in HV, none when None. bounces: 'odd' or 'even', VV and HH in or out of phase.\n"
           "height_m: of the phase centre above the ground (half of size_m's height when None), or altitude_m above\n"
           "mean sea level. heading_deg: clockwise from north, of nose and motion. way_points: (time_s, x_m, y_m,\n"
           "height_m above the ground) each, instead of position, height and speed. swerling: case of fluctuation,\n"
           "0 steady; seed: of it, when 0 that of the call with the target's place in the list, so that no two fade\n"
           "together.\n"
           "size_m: length, width, height of what casts a shadow.")
      .def_property_readonly("name", [](const TargetSource& t) { return t.target.name; })
      .def_property_readonly(
          "rcs_dbsm", &rcs_dbsm_of,
          "Mean cross-section in vv, hh and hv, dB over 1 m^2: a dict; None where it goes by aspect.")
      .def_property_readonly(
          "size_m",
          [](const TargetSource& t) { return py::make_tuple(t.target.size_m.x, t.target.size_m.y, t.target.size_m.z); },
          "Length, width and height of what casts a shadow; zeros: nothing.")
      .def(
          "position_m",
          [](const TargetSource& t, const LoadedScene& scene, double time_s) {
            return position_on(t, scene.scene().frame, scene.scene().terrain, time_s);
          },
          py::arg("over"), py::arg("time_s") = 0.0,
          "Where its phase centre is at that time over the ground of a Scene or an Atlas: x, y and height above mean\n"
          "sea level in the local frame.")
      .def(
          "position_m",
          [](const TargetSource& t, const LoadedAtlas& atlas, double time_s) {
            // Another thread that reads it may want the GIL meanwhile.
            const terrain::HeightField* const terrain = long_call([&] { return &atlas.terrain(); });
            return position_on(t, atlas.description().frame, *terrain, time_s);
          },
          py::arg("over"), py::arg("time_s") = 0.0)
      .def("__copy__", [](const TargetSource& t) { return TargetSource(t); })
      .def(
          "__deepcopy__", [](const TargetSource& t, const py::dict&) { return TargetSource(t); }, py::arg("memo"))
      .def("__repr__", [](const TargetSource& t) { return "<sigmascape.Target '" + t.target.name + "'>"; });
  module.def(
      "trihedral_rcs_dbsm", &trihedral_rcs_dbsm, py::arg("leg_m"), py::kw_only(), py::arg("frequency_ghz"),
      "Greatest cross-section of a conducting corner reflector of three triangles with right angles and legs of\n"
      "so many metres, dB over 1 m^2: 4 pi a^4/(3 lambda^2). docs/physics/targets.md, Eq. (4).");
  module.def(
      "read_targets", [](const std::filesystem::path& path) { return radar::read_target_file(path); }, py::arg("path"),
      "The Targets of a targets file (TOML, docs/target_file.md), as a list.");
}

}  // namespace sigmascape::python
