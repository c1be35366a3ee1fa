#include "results/plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>
#include <utility>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::cli {
namespace {

constexpr double resolution_m = 2.0;
constexpr double lowest_elevation_deg = 3.0, highest_elevation_deg = 40.0;
constexpr std::uint64_t held_out_stream = 0x76696577;  // keeps the views' numbers apart from those of the rays

/// A view on the first grid, so that all grids hold it; neighbours in the list differ in both angles, and none comes
/// twice before all have come.
PlannedView view_on(const ResultsPlan& plan, std::size_t index) {
  const LookGrid& grid = plan.grids.front();
  const std::size_t azimuth = (3 + 5 * index) % grid.azimuths;
  const std::size_t period = std::lcm(std::size_t{grid.azimuths}, grid.elevations_deg.size());
  const std::size_t elevation = (index + index / period) % grid.elevations_deg.size();
  return {.kind = ViewKind::OnGrid,
          .azimuth_deg = 360.0 * static_cast<double>(azimuth) / grid.azimuths,
          .elevation_deg = grid.elevations_deg[elevation],
          .traced_samples = plan.traced_samples_of(ViewKind::OnGrid)};
}

PlannedView held_out_view(const ResultsPlan& plan, std::size_t index) {
  const auto uniform = [&](std::uint64_t dimension) {
    return static_cast<double>(unit_float(hashed(plan.seed, held_out_stream, index, dimension)));
  };
  return {.kind = ViewKind::HeldOut,
          .azimuth_deg = 360.0 * uniform(0),
          .elevation_deg = lowest_elevation_deg + (highest_elevation_deg - lowest_elevation_deg) * uniform(1),
          .traced_samples = plan.traced_samples_of(ViewKind::HeldOut)};
}

/// Places of `values` on `axis`, which holds them all.
std::vector<std::size_t> places_on(const std::vector<double>& axis, const std::vector<double>& values) {
  std::vector<std::size_t> places;
  for (const double value : values) {
    const auto nearest = std::ranges::min_element(axis, {}, [&](double node) { return std::abs(node - value); });
    places.push_back(static_cast<std::size_t>(nearest - axis.begin()));
  }
  return places;
}

}  // namespace

std::string LookGrid::name() const {
  return fmt::format("{} × {}{}{}", azimuths, elevations_deg.size(), spacing.empty() ? "" : " ", spacing);
}

atlas::AspectGrid LookGrid::aspects() const {
  atlas::AspectGrid grid;
  grid.azimuths_rad = atlas::even_azimuths(azimuths);
  for (const double elevation : elevations_deg) grid.elevations_rad.push_back(radians_from_deg(elevation));
  grid.frequencies_hz = {10e9};
  return grid;
}

std::string text_of(ViewKind kind) {
  switch (kind) {
    case ViewKind::OnGrid:
      return "on grid";
    case ViewKind::HeldOut:
      return "held out";
    case ViewKind::Paper:
      return "Figure 8 view";
  }
  return "";
}

std::string PlannedView::file_name() const {
  return fmt::format("az{:06.2f}_el{:05.2f}", azimuth_deg, elevation_deg);
}

std::string PlannedView::description() const {
  return fmt::format("azimuth {:.1f}°, elevation {:.1f}°", azimuth_deg, elevation_deg);
}

radar::RadarFile PlannedView::radar() const {
  return {.radar = {.name = fmt::format("{:g} km, {}", slant_range_m / 1e3, description()),
                    .position = {},
                    .frequency_hz = 10e9,
                    .polarization = radar::Polarization::Sum,
                    .range_resolution_m = resolution_m,
                    // The two-way beam is √2 narrower than the one-way beam that a radar is described by.
                    .beam_width_rad = resolution_m * std::numbers::sqrt2 / slant_range_m},
          .place = radar::SeenFrom{.azimuth_rad = radians_from_deg(azimuth_deg),
                                   .elevation_rad = radians_from_deg(elevation_deg),
                                   .slant_range_m = slant_range_m,
                                   .target = {}},
          .map = {}};
}

PlannedView PlannedView::from_afar() const {
  PlannedView view = *this;
  view.slant_range_m *= 10.0;
  return view;
}

double ResultsPlan::rim_m() const {
  constexpr double widest_m = 64.0, largest_share = 0.128;  // of the side, so that small scenes keep a middle
  return std::min(widest_m, largest_share * side_m());
}

std::string text_of(Method method) {
  switch (method) {
    case Method::Paper:
      return "paper";
    case Method::BakedShadows:
      return "ours, shadows baked";
    case Method::LevelGround:
      return "ours, on level ground";
    case Method::OwnGround:
      return "ours, on its own ground";
    case Method::Apart:
      return "ours, buildings apart";
    case Method::Traced:
      return "path-traced";
  }
  return "";
}

LookGrid ResultsPlan::even_in_cotangent() const {
  const auto cotangent = [](double elevation_deg) { return 1.0 / std::tan(radians_from_deg(elevation_deg)); };
  LookGrid grid{paper_grid().azimuths, paper_grid().elevations_deg, "in cot ψ"};
  std::vector<double>& elevations_deg = grid.elevations_deg;
  const double first = cotangent(elevations_deg.front()), last = cotangent(elevations_deg.back());
  for (std::size_t i = 0; i < elevations_deg.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(elevations_deg.size() - 1);
    // To the hundredth, as they are printed.
    elevations_deg[i] = std::round(100.0 * deg_from_radians(std::atan(1.0 / std::lerp(first, last, share)))) / 100.0;
  }
  return grid;
}

bake::BakeSettings ResultsPlan::bake_settings(Method method) const {
  const bool on_own_ground = method == Method::OwnGround || method == Method::Apart;
  const LookGrid& looks = method == Method::OwnGround ? grids.back()
                          : method == Method::Apart   ? finest_grid_apart()
                                                      : paper_grid();
  const bool shadows_at_run_time = on_own_ground || method == Method::LevelGround;
  return {.aspects = looks.aspects(),
          .patches = {.texel_m = texel_m, .texels_per_side = 256},
          .sampling = {.samples_per_texel = baked_samples},
          .max_bounces = bounces,
          .seed = seed,
          .shadows = shadows_at_run_time ? bake::Shadows::RunTime : bake::Shadows::Baked,
          .footing = on_own_ground ? trace::Footing::Terrain : trace::Footing::LevelPlane,
          .buildings = method == Method::Apart ? bake::Buildings::Apart : bake::Buildings::Baked,
          .threads = threads};
}

atlas::AspectSelection ResultsPlan::selection_of(const LookGrid& grid, const atlas::AspectGrid& within) {
  const atlas::AspectGrid wanted = grid.aspects();
  return {places_on(within.azimuths_rad, wanted.azimuths_rad), places_on(within.elevations_rad, wanted.elevations_rad)};
}

double ResultsPlan::distance_deg(const PlannedView& view, const LookGrid& grid) {
  const auto direction = [](double azimuth_deg, double elevation_deg) {
    return radar::direction_to_radar({radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)});
  };
  const Vec3d seen = direction(view.azimuth_deg, view.elevation_deg);
  double nearest_rad = pi;
  for (unsigned i = 0; i < grid.azimuths; ++i) {
    for (const double elevation_deg : grid.elevations_deg) {
      const Vec3d baked = direction(360.0 * i / grid.azimuths, elevation_deg);
      nearest_rad = std::min(nearest_rad, std::acos(std::clamp(dot(seen, baked), -1.0, 1.0)));
    }
  }
  return deg_from_radians(nearest_rad);
}

ResultsPlan results_plan(const ResultsOptions& options) {
  ResultsPlan plan;
  plan.scale = options.scale.value_or(options.small ? 0.2 : 0.5);
  plan.materials = options.itu_materials ? scene::PaperMaterials::Itu : scene::PaperMaterials::Paper;
  plan.scene_file = options.scene_file;
  if (!options.around_m.empty()) plan.around_m = {options.around_m[0], options.around_m[1]};
  plan.grids = {{8, {5, 13, 21, 29}}, {8, {5, 13, 21, 29, 37}}, {16, {5, 9, 13, 21, 29, 37}}};
  if (!options.small && !options.without_finest_grid) plan.grids.push_back(ResultsPlan::finest_grid());
  plan.baked_samples = options.baked_samples.value_or(options.small ? 64 : 100);
  plan.traced_samples = options.traced_samples.value_or(options.small ? 256 : 1024);
  plan.most_traced_samples = std::max(plan.traced_samples, options.most_traced_samples.value_or(0));
  plan.finer_samples =
      options.finer_samples.value_or(std::max(plan.baked_samples, (options.small ? 1 : 4) * plan.traced_samples));
  for (const auto& [option, rays] :
       {std::pair("--samples", plan.baked_samples), {"--finer-samples", plan.finer_samples}}) {
    if (rays < 2) throw Error(option, fmt::format("is {}", rays), "give at least 2, which tell the noise of a texel");
  }
  if (plan.traced_samples == 0)
    throw Error("--traced-samples", "is 0", "give at least 1: without rays there is no map to hold against");
  const std::size_t on_first_grid = plan.grids.front().azimuths * plan.grids.front().elevations_deg.size();
  const std::size_t on_grid = options.on_grid.value_or(options.small ? 3 : 8);
  if (on_grid > on_first_grid)
    throw Error("--on-grid", fmt::format("is {}", on_grid), fmt::format("the first grid has {} looks", on_first_grid));
  plan.has_default_bake = !options.small;
  plan.bounces = options.bounces;
  plan.seed = options.seed;
  plan.threads = options.threads;

  plan.views = {{.kind = ViewKind::Paper,
                 .azimuth_deg = 130.0,
                 .elevation_deg = 8.6,
                 .traced_samples = plan.traced_samples_of(ViewKind::Paper)}};
  for (std::size_t i = 0; i < on_grid; ++i) {
    plan.views.push_back(view_on(plan, i));
    plan.views.back().is_repeated = i < options.repeated;
  }
  for (std::size_t i = 0; i < options.held_out.value_or(options.small ? 4 : 24); ++i)
    plan.views.push_back(held_out_view(plan, i));
  return plan;
}

}  // namespace sigmascape::cli
