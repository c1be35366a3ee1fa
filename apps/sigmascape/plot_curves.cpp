#include "plot_curves.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/units.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/radar/range_response.h"
#include "sigmascape/scatter/surface_sigma0.h"

namespace sigmascape::cli {
namespace {

using product::Plot;
using product::PlotSeries;

/// σ0 of no more than this, −80 dB, is none.
constexpr double least_power = 1e-8;
/// What lies so far below the highest point is not drawn: about zeros of a response decibels go down without end.
constexpr double deepest_db = 80.0;

PlotSeries curve(std::string name) {
  return {.name = std::move(name), .points = {}, .joined = true, .dots = false};
}

Plot decibel_plot(std::string title, std::string x_label, std::string y_label) {
  return {.title = std::move(title),
          .x_label = std::move(x_label),
          .y_label = std::move(y_label),
          .x_from_zero = false,
          .y_from_zero = false};
}

/// Adds values of a response between −reach and +reach, dB over 1, `label_scale` turning places into what is shown.
template <typename Response>
void add_response(PlotSeries& series, double reach, double label_scale, const Response& response) {
  constexpr int steps = 600;
  for (int i = -steps; i <= steps; ++i) {
    const double offset = reach * i / steps;
    const double power = response(offset);
    series.points.emplace_back(offset * label_scale, power > 0.0 ? db_from_linear(power) : std::nan(""));
  }
}

/// The same plot, drawn from `deepest_db` below its highest point on and over all its places, drawn or not.
Plot down_to_floor(Plot plot) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const PlotSeries& series : plot.series) {
    for (const auto& point : series.points)
      if (point.second > highest) highest = point.second;
  }
  plot.y_floor = highest - deepest_db;
  const auto& places = plot.series.front().points;
  plot.x_ends = {places.front().first, places.back().first};
  return plot;
}

double sigma0_db(double power) {
  return power > least_power ? db_from_linear(power) : std::nan("");
}

/// A curve that none is left to draw of is told by its name, or it would be missed.
void name_what_is_not_seen(PlotSeries& series) {
  if (std::ranges::none_of(series.points, [](const auto& point) { return std::isfinite(point.second); }))
    series.name += fmt::format(" (below {:.0f} dB)", db_from_linear(least_power));
}

/// Densities of values over bins from 0 to `highest`; what lies above or, as resampled maps have it beside bright
/// points, below is counted but not shown.
PlotSeries densities(std::span<const double> values, double unit, double highest, std::size_t bins) {
  std::vector<std::size_t> counts(bins, 0);
  for (const double value : values) {
    const double place = value / unit / highest * static_cast<double>(bins);
    if (place >= 0.0 && place < static_cast<double>(bins)) ++counts[static_cast<std::size_t>(place)];
  }
  PlotSeries series{.name = "measured"};
  const double width = highest / static_cast<double>(bins);
  for (std::size_t i = 0; i < bins; ++i) {
    series.points.emplace_back((static_cast<double>(i) + 0.5) * width,
                               static_cast<double>(counts[i]) / (static_cast<double>(values.size()) * width));
  }
  return series;
}

template <typename Density>
PlotSeries density_curve(std::string name, double highest, const Density& density) {
  PlotSeries series = curve(std::move(name));
  constexpr int steps = 300;
  for (int i = 0; i <= steps; ++i) series.points.emplace_back(highest * i / steps, density(highest * i / steps));
  return series;
}

Histogram moments_of(std::span<const double> values) {
  Histogram histogram{.samples = values.size(), .plot = {}};
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  histogram.mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - histogram.mean) * (value - histogram.mean);
  histogram.deviation_over_mean = std::sqrt(squares / static_cast<double>(values.size())) / histogram.mean;
  return histogram;
}

/// σ0 of a point under an aspect, with the ground that may be kept apart.
double sigma0_db(const atlas::Atlas& atlas, Vec2d point, const radar::Aspect& aspect, double frequency_hz,
                 radar::Polarization polarization) {
  radar::Channels sigma0 = atlas.sigma0_at(point, aspect, frequency_hz, 0.0);
  if (const atlas::GroundLayers* ground = atlas.ground_layers())
    sigma0 += ground->sigma0.sigma0_at(point, aspect, frequency_hz, 0.0);
  return sigma0_db(static_cast<double>(sigma0.power(polarization)));
}

}  // namespace

Plot sigma0_plot(std::span<const scatter::Material> materials, double frequency_hz, radar::Polarization polarization) {
  Plot plot = decibel_plot(fmt::format("{} at {:g} GHz", product::polarization_name(polarization), frequency_hz / 1e9),
                           "grazing angle [°]", "σ0 [dB]");
  plot.x_ends = {0.5, 89.5};
  for (const scatter::Material& material : materials) {
    const scatter::SurfaceModel surface(material, frequency_hz);
    PlotSeries& series = plot.series.emplace_back(curve(material.name + (material.verified ? "" : " (not verified)")));
    for (double grazing_deg = 0.5; grazing_deg < 90.0; grazing_deg += 0.5) {
      const auto power =
          static_cast<double>(scatter::surface_sigma0(surface, radians_from_deg(grazing_deg)).power(polarization));
      series.points.emplace_back(grazing_deg, sigma0_db(power));
    }
    name_what_is_not_seen(series);
  }
  return plot;
}

Plot antenna_plot(const radar::Radar& radar, double reach_rad) {
  const auto pattern = radar::antenna_pattern(radar);
  Plot plot =
      decibel_plot(radar.name + ": one-way antenna pattern", "angle from the axis [°]", "gain [dB over isotropic]");
  add_response(plot.series.emplace_back(curve("azimuth")), reach_rad, deg_from_radians(1.0),
               [&](double offset) { return pattern.gain(offset, pattern.tilt_rad()); });
  add_response(plot.series.emplace_back(curve("elevation")), reach_rad, deg_from_radians(1.0),
               [&](double offset) { return pattern.gain(0.0, pattern.tilt_rad() + offset); });
  return down_to_floor(std::move(plot));
}

Plot range_response_plot(const radar::Radar& radar, double widths) {
  const auto response = radar::RangeResponse::of_width(radar.range_resolution_m, radar.waveform.window);
  Plot plot = decibel_plot(radar.name + ": answer to a point over slant range", "slant range from the point [m]",
                           "power [dB below the peak]");
  add_response(plot.series.emplace_back(curve("compressed pulse")), widths * radar.range_resolution_m, 1.0,
               [&](double offset_m) { return response.power(offset_m); });
  return down_to_floor(std::move(plot));
}

Plot azimuth_response_plot(const radar::Radar& radar, double widths) {
  const auto pattern = radar::antenna_pattern(radar);
  Plot plot = decibel_plot(radar.name + ": answer to a point over azimuth", "azimuth from the point [°]",
                           "power [dB below the peak]");
  add_response(plot.series.emplace_back(curve("two-way beam")), widths * radar.beam_width_rad, deg_from_radians(1.0),
               [&](double offset) { return pattern.azimuth().two_way_power(offset); });
  return down_to_floor(std::move(plot));
}

Histogram power_histogram(std::span<const double> powers, double looks, std::size_t bins) {
  constexpr double highest = 5.0;
  Histogram histogram = moments_of(powers);
  histogram.plot = {
      .title = fmt::format("{} cells, deviation over mean {:.3f}", histogram.samples, histogram.deviation_over_mean),
      .x_label = "power over its mean",
      .y_label = "probability density"};
  histogram.plot.series.push_back(densities(powers, histogram.mean, highest, bins));
  const double scale = looks * std::log(looks) - std::lgamma(looks);
  histogram.plot.series.push_back(
      density_curve(looks == 1.0 ? "exponential" : fmt::format("Gamma, {:g} looks", looks), highest, [&](double x) {
        if (x <= 0.0) return looks == 1.0 ? 1.0 : 0.0;
        return std::exp(scale + (looks - 1.0) * std::log(x) - looks * x);
      }));
  return histogram;
}

Histogram amplitude_histogram(std::span<const double> amplitudes, std::size_t bins) {
  constexpr double highest = 3.0;
  Histogram histogram = moments_of(amplitudes);
  double squares = 0.0;
  for (const double amplitude : amplitudes) squares += amplitude * amplitude;
  const double rms = std::sqrt(squares / static_cast<double>(amplitudes.size()));
  histogram.plot = {.title = fmt::format("{} samples, deviation over mean {:.3f} (Rayleigh: 0.523)", histogram.samples,
                                         histogram.deviation_over_mean),
                    .x_label = "amplitude over its root mean square",
                    .y_label = "probability density"};
  histogram.plot.series.push_back(densities(amplitudes, rms, highest, bins));
  histogram.plot.series.push_back(
      density_curve("Rayleigh", highest, [](double x) { return 2.0 * x * std::exp(-x * x); }));
  return histogram;
}

Plot aspect_plot(const atlas::Atlas& atlas, Vec2d point, double frequency_hz, radar::Polarization polarization,
                 bool over_elevation) {
  const atlas::AspectGrid& baked = atlas.aspects();
  Plot plot =
      decibel_plot(fmt::format("{} at x {:g} m, y {:g} m", product::polarization_name(polarization), point.x, point.y),
                   over_elevation ? "elevation [°]" : "azimuth [°]", "σ0 [dB]");
  const auto highest = static_cast<int>(std::ceil(deg_from_radians(baked.elevations_rad.back())));
  const int first = over_elevation ? 1 : 0, last = over_elevation ? std::max(60, highest) : 360;
  plot.x_ends = {first, last};
  for (const double fixed_rad : over_elevation ? baked.azimuths_rad : baked.elevations_rad) {
    PlotSeries& series = plot.series.emplace_back(curve(fmt::format(
        "{} {:g}°", over_elevation ? "azimuth" : "elevation", std::round(deg_from_radians(fixed_rad) * 1e3) / 1e3)));
    for (int degree = first; degree <= last; ++degree) {
      const double angle_rad = radians_from_deg(degree);
      const radar::Aspect aspect =
          over_elevation ? radar::Aspect{fixed_rad, angle_rad} : radar::Aspect{wrapped_azimuth(angle_rad), fixed_rad};
      series.points.emplace_back(degree, sigma0_db(atlas, point, aspect, frequency_hz, polarization));
    }
    name_what_is_not_seen(series);
  }
  return plot;
}

}  // namespace sigmascape::cli
