#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include "command.h"
#include "number_within.h"
#include "plot_curves.h"
#include "polarization_option.h"
#include "standard_error.h"

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/base/toml_reader.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/npy_file.h"
#include "sigmascape/product/plot_file.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/scene_file.h"

namespace sigmascape::cli {
namespace {

struct PlotOptions {
  std::string out, input, scene;
  std::vector<std::string> materials;
  std::string area_m;
  std::array<double, 2> at{};
  double frequency_ghz = 10.0, looks = 1.0, reach_deg = 10.0, widths = 8.0;
  std::size_t bins = 50;
  std::string along = "range", over = "azimuth";
  bool is_latitude_longitude = false;
  radar::Polarization polarization = radar::Polarization::VV;
};

void finish(const PlotOptions& options, const product::Plot& plot, const Output& output,
            nlohmann::ordered_json summary = {}) {
  product::write_plot(options.out, plot);
  summary["plot"] = options.out;
  summary["x"] = plot.x_label;
  summary["y"] = plot.y_label;
  summary["series"] = nlohmann::ordered_json::array();
  for (const product::PlotSeries& series : plot.series) {
    std::vector<double> x, y;
    for (const auto& point : series.points) {
      x.push_back(point.first);
      y.push_back(point.second);
    }
    summary["series"].push_back({{"name", series.name}, {"x", x}, {"y", y}});
  }
  output.finish(fmt::format("{}: {}", options.out, plot.title), summary);
}

std::vector<scatter::Material> wanted_materials(const PlotOptions& options) {
  std::vector<scatter::Material> materials;
  if (options.materials.empty() && options.scene.empty())
    throw Error("MATERIAL", "is missing", "name materials, or a scene with --scene");
  if (options.materials.empty()) {
    const auto used = scene::read_scene(options.scene).materials;
    std::ranges::remove_copy_if(used, std::back_inserter(materials), &scatter::Material::is_medium);
    return materials;
  }
  // Those of the file whether something is made of them or not.
  const scene::MaterialTable known =
      options.scene.empty() ? scene::MaterialTable() : scene::MaterialTable(TomlSection::read_file(options.scene));
  for (const std::string& name : options.materials) materials.push_back(known.material(name, "MATERIAL"));
  return materials;
}

radar::Rectangle with_ends_in_order(const radar::Rectangle& area) {
  for (const auto& [lower, lower_m, upper, upper_m] :
       {std::tuple("west", area.west_m, "east", area.east_m), {"south", area.south_m, "north", area.north_m}}) {
    if (lower_m > upper_m)
      throw Error("--area", fmt::format("has {} at {:g} m and {} at {:g} m", lower, lower_m, upper, upper_m),
                  "exchange the two: the order is west, south, east, north");
  }
  return area;
}

radar::Rectangle area_of(const std::string& word) {
  std::array<double, 4> sides{};
  const char *at = word.data(), *const end = at + word.size();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ',')) break;
    const auto [stopped, fault] = std::from_chars(at, end, sides[i]);
    if (fault != std::errc{} || !std::isfinite(sides[i])) break;
    at = stopped;
    if (i + 1 == sides.size() && at == end) return with_ends_in_order({sides[0], sides[1], sides[2], sides[3]});
  }
  throw Error("--area", "is " + word, "give west, south, east and north in metres, with commas between: -200,-200,0,0");
}

std::vector<double> powers_of(const PlotOptions& options) {
  const radar::GroundMap map = product::read_ground_map(options.input, options.polarization);
  const radar::Rectangle all = map.grid.extent();
  const radar::Rectangle area = options.area_m.empty() ? all : area_of(options.area_m);
  std::vector<double> powers;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      const float power = map.sigma0(column, row).power(options.polarization);
      if (std::isfinite(power) && area.contains(map.grid.centre_of(column, row)))
        powers.push_back(static_cast<double>(power));
    }
  }
  return powers;
}

/// Zeros are of the spread: what a converter rounded away, or ground that nothing returns from.
std::vector<double> amplitudes_of(const PlotOptions& options) {
  const auto array = product::read_complex_npy(options.input);
  const std::size_t channels = array.shape.size() == 3 ? array.shape[2] : 1;
  const auto channel = static_cast<std::size_t>(options.polarization);
  if (channel >= channels)
    throw Error("--polarization", "is none that the recording has", "choose among its first, VV, HH and HV");
  std::vector<double> amplitudes;
  for (std::size_t i = channel; i < array.numbers.size(); i += channels) {
    const auto amplitude = static_cast<double>(std::abs(array.numbers[i]));
    if (std::isfinite(amplitude)) amplitudes.push_back(amplitude);
  }
  return amplitudes;
}

void plot_histogram(const PlotOptions& options, const Output& output) {
  const bool is_iq = file_ending(options.input) == ".npy";
  if (!is_iq && !geo::is_geotiff_name(options.input)) {
    throw Error(options.input, "is neither a ground map nor I/Q that can be read",
                "give a map that ends in .tif or I/Q that ends in .npy");
  }
  for (const auto& [option, is_given] :
       {std::pair{"--area", !options.area_m.empty()}, {"--looks", options.looks != 1.0}}) {
    if (is_iq && is_given)
      throw Error(option, fmt::format("is of ground maps, and {} holds I/Q", options.input), "leave it out");
  }
  const std::vector<double> values = is_iq ? amplitudes_of(options) : powers_of(options);
  if (values.empty() || !(std::accumulate(values.begin(), values.end(), 0.0) > 0.0))
    throw Error(options.input, is_iq ? "has no samples with power" : "has no cells with power there",
                is_iq ? "choose another --polarization or recording" : "choose another --area");
  const Histogram histogram =
      is_iq ? amplitude_histogram(values, options.bins) : power_histogram(values, options.looks, options.bins);
  finish(options, histogram.plot, output,
         {{"samples", histogram.samples},
          {"mean", histogram.mean},
          {"deviation_over_mean", histogram.deviation_over_mean}});
}

void plot_aspects(const PlotOptions& options, const Output& output) {
  const auto store = atlas::Store::open(options.input);
  const atlas::Atlas textures = atlas::load_atlas(store, {.reading = atlas::Reading::AsAsked});
  const Vec2d point = options.is_latitude_longitude
                          ? geo::position_in_frame(store.description().frame, {options.at[0], options.at[1]})
                          : Vec2d{options.at[0], options.at[1]};
  const radar::Rectangle& all = store.description().extent;
  if (!all.contains(point)) {
    throw Error(
        "--at", fmt::format("{:g},{:g} m lies outside the atlas", point.x, point.y),
        fmt::format("stay within x {:g} to {:g} and y {:g} to {:g}", all.west_m, all.east_m, all.south_m, all.north_m));
  }
  const double frequency_hz = options.frequency_ghz * 1e9;
  textures.check_frequency(frequency_hz);
  textures.prepare({point.x, point.y, point.x, point.y}, 0.0);
  if (atlas::keeps_buildings_apart(store.description()))
    warn(fmt::format("{}: what walls and roofs return directly is kept apart, and not in these curves", options.input));
  finish(options, aspect_plot(textures, point, frequency_hz, options.polarization, options.over == "elevation"), output,
         {{"x_m", point.x}, {"y_m", point.y}});
}

}  // namespace

void add_plot_command(Command app, Output& output) {
  const auto command = app.add_subcommand("plot", "Draw what materials, radars, maps and atlases do, as SVG or PNG");
  command.require_subcommand(1);
  auto options = std::make_shared<PlotOptions>();
  const auto subcommand = [&](const char* name, const char* description, const char* example) {
    const auto added = command.add_subcommand(name, description);
    added.add_option("--out", options->out, "picture to draw (.svg or .png)")
        .required()
        .check({[](const std::string& file) { return product::check_plot_name(file), std::string(); }, "FILE"});
    added.add_flag("--json", output.json, "print the numbers as JSON");
    added.footer(fmt::format("Example:\n  sigmascape plot {}", example));
    return added;
  };

  const auto sigma0 = subcommand("sigma0", "sigma0 of materials over grazing angle",
                                 "sigma0 grass concrete --frequency-ghz 10 --out sigma0.svg");
  sigma0.add_option("MATERIAL", options->materials, "names of materials; all of --scene when there are none");
  sigma0.add_option("--scene", options->scene, "scene file whose materials are known too");
  sigma0.add_option("--frequency-ghz", options->frequency_ghz).capture_default_str().check(number_within(0.1, 300.0));
  add_polarization_option(sigma0, options->polarization);
  sigma0.callback([options, &output] {
    const auto materials = wanted_materials(*options);
    if (materials.empty())
      throw Error(options->scene, "is made of no material that has a surface", "name materials to plot");
    finish(*options, sigma0_plot(materials, options->frequency_ghz * 1e9, options->polarization), output);
  });

  const auto antenna = subcommand("antenna", "One-way antenna pattern in azimuth and elevation",
                                  "antenna examples/radars/fighter_ground_map.toml --reach-deg 20 --out antenna.svg");
  antenna.add_option("RADAR", options->input, "radar file (TOML)").required();
  antenna.add_option("--reach-deg", options->reach_deg, "angle to either side of the axis")
      .capture_default_str()
      .check(number_within(1e-5, 90.0));
  antenna.callback([options, &output] {
    const auto radar = radar::read_radar_file(options->input, radar::PlaceOfRadar::Optional).radar;
    finish(*options, antenna_plot(radar, radians_from_deg(options->reach_deg)), output);
  });

  const auto response = subcommand("response", "Answer to a point: the compressed pulse, or the two-way beam",
                                   "response examples/radars/fighter_ground_map.toml --along range --out pulse.svg");
  response.add_option("RADAR", options->input, "radar file (TOML)").required();
  response.add_option("--along", options->along, "range or azimuth")
      .capture_default_str()
      .check(one_of({"range", "azimuth"}));
  response.add_option("--widths", options->widths, "half-power widths to either side")
      .capture_default_str()
      .check(number_within(0.5, 200.0));
  response.callback([options, &output] {
    const auto radar = radar::read_radar_file(options->input, radar::PlaceOfRadar::Optional).radar;
    finish(*options,
           options->along == "range" ? range_response_plot(radar, options->widths)
                                     : azimuth_response_plot(radar, options->widths),
           output);
  });

  const auto histogram =
      subcommand("histogram", "Spread of a map's powers beside the exponential density, or of I/Q beside Rayleigh's",
                 "histogram map.tif --area=-200,-200,0,0 --out histogram.svg");
  histogram.add_option("FILE", options->input, "ground map (GeoTIFF from render) or pulses (.npy from render --iq)")
      .required();
  histogram.add_option("--area", options->area_m, "part of a map: west,south,east,north in metres of its frame");
  histogram.add_option("--looks", options->looks, "looks of the map: more than one follow Gamma")
      .capture_default_str()
      .check(number_within(0.5, 1000.0));
  histogram.add_option("--bins", options->bins, "bars of the histogram")
      .capture_default_str()
      .check(count_within(5, 500));
  add_polarization_option(histogram, options->polarization);
  histogram.callback([options, &output] { plot_histogram(*options, output); });

  const auto aspects = subcommand("aspects", "sigma0 of one place of an atlas by the direction it is seen from",
                                  "aspects out/bilbao_atlas --at 120,-340 --out aspects.svg");
  aspects.add_option("ATLAS", options->input, "folder of the atlas").required();
  aspects.add_option("--at", options->at, "x,y of the place in metres of the atlas' frame").delimiter(',').required();
  aspects.add_flag("--lat-lon", options->is_latitude_longitude, "--at is latitude and longitude in degrees");
  aspects.add_option("--over", options->over, "azimuth or elevation")
      .capture_default_str()
      .check(one_of({"azimuth", "elevation"}));
  aspects.add_option("--frequency-ghz", options->frequency_ghz).capture_default_str();
  add_polarization_option(aspects, options->polarization);
  aspects.callback([options, &output] { plot_aspects(*options, output); });
}

}  // namespace sigmascape::cli
