// How long does it take to find the visible ground among a million samples, by sweep and by raster, and how long would
// the least take that any sweep must do?

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <thread>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/base/worker_team.h"
#include "sigmascape/render/visible_ground.h"

namespace {

using namespace std::chrono_literals;
using sigmascape::Array2D;
using sigmascape::Vec3d;
using sigmascape::WorkerTeam;
using sigmascape::render::HorizonGrid;
using sigmascape::render::VisibilityMethod;
using sigmascape::render::VisibleGround;

void report(const std::string& name, double value, const std::string& unit) {
  fmt::print("{{\"name\": \"{}\", \"value\": {:.4g}, \"unit\": \"{}\"}}\n", name, value, unit);
  std::fflush(stdout);
}

struct Cost {
  double wall_ms = 1e30, processor_ms = 1e30;  ///< the latter of all threads together
};

/// Least of many runs: what the work takes when nothing else does.
Cost least_cost(const std::function<void()>& work) {
  Cost least;
  const auto end = std::chrono::steady_clock::now() + 1500ms;
  for (int run = 0; run < 5 || std::chrono::steady_clock::now() < end; ++run) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor_start = std::clock();
    work();
    const double processor_ms = 1e3 * static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
    const double wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    least = {std::min(least.wall_ms, wall_ms), std::min(least.processor_ms, processor_ms)};
  }
  return least;
}

void report(const std::string& name, const std::string& unit, double per, const std::function<void()>& work) {
  const Cost cost = least_cost(work);
  report(name, cost.wall_ms / per, unit);
  report(name + ".processor", cost.processor_ms / per, unit);
}

/// Hills of several sizes, 300 m high.
sigmascape::terrain::HeightField hills(std::size_t side, double spacing_m) {
  sigmascape::terrain::HeightField field{.spacing_m = spacing_m, .height_m = Array2D<float>(side, side)};
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      double height_m = 150.0;
      for (const double length : {0.31, 0.093, 0.021}) {
        const double x = static_cast<double>(column) / (length * static_cast<double>(side));
        const double y = static_cast<double>(row) / (length * static_cast<double>(side));
        height_m += 230.0 * length * (std::sin(6.0 * x + 2.1 * y) + std::cos(4.7 * y - 1.3 * x));
      }
      field.height_m(column, row) = static_cast<float>(height_m);
    }
  }
  return field;
}

/// The floor of a sweep: the same nodes of a field already resampled to azimuth and distance, no gathers.
void polar_sweep(const std::vector<float>& slopes, const HorizonGrid& grid, std::vector<float>& steepest,
                 WorkerTeam& team) {
  team.run(grid.azimuths, [&](std::size_t azimuth, unsigned) {
    float so_far = -1e30F;
    for (std::size_t i = azimuth * grid.distances; i < (azimuth + 1) * grid.distances; ++i) {
      so_far = std::max(so_far, slopes[i]);
      steepest[i] = so_far;
    }
  });
}

}  // namespace

int main() {
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  constexpr std::size_t azimuths = 1024, distances = 1024;
  constexpr double millions = static_cast<double>(azimuths * distances) / 1e6;
  const double range_m = 20e3, across_m = 4096.0;
  const Vec3d radar{0.5 * across_m, -0.5 * across_m - range_m, 0.15 * range_m};
  const HorizonGrid grid{.first_azimuth_rad = -0.45 * across_m / range_m,
                         .azimuth_step_rad = 0.9 * across_m / range_m / azimuths,
                         .azimuths = azimuths,
                         .near_m = range_m - 0.48 * across_m,
                         .step_m = 0.96 * across_m / distances,
                         .distances = distances};

  for (const unsigned used : {1U, threads}) {
    WorkerTeam team(used);
    const std::string at = fmt::format(".threads_{}", used), unit = "ms per million nodes";
    std::vector<float> slopes(azimuths * distances), steepest(slopes.size());
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = std::sin(static_cast<float>(i));
    report("visible_ground.floor.write" + at, unit, millions, [&] { std::ranges::fill(steepest, 1.0F); });
    report("visible_ground.floor.polar_sweep" + at, unit, millions, [&] { polar_sweep(slopes, grid, steepest, team); });
    const auto found = [&](const std::string& name, const sigmascape::terrain::HeightField& field,
                           const sigmascape::render::VisibleGroundSettings& settings) {
      VisibleGround ground(settings, used);
      ground.reset(grid, false);
      report(name + at, unit, millions,
             [&] { ground.find(0, azimuths, radar, {.terrain = sigmascape::terrain::view_of(field)}, team); });
    };
    for (const double spacing_m : {4.0, 8.0, 16.0}) {
      found(fmt::format("visible_ground.sweep.step_{:g}_cells", grid.step_m / spacing_m),
            hills(static_cast<std::size_t>(across_m / spacing_m) + 1, spacing_m), {});
    }
    // The paper's way, with the mesh that its rule of 16 pixels a triangle leaves for a million pixels.
    found("visible_ground.raster.65522_triangles_16_pixels_each", hills(182, 22.6),
          {.method = VisibilityMethod::Rasterization});
    // What the floor of 524,288 triangles in 1024² pixels is known for.
    const auto coarse = hills(513, 8.0);
    sigmascape::render::TerrainRaster drawn;
    const sigmascape::render::RasterSettings settings{.pixels_per_triangle = 16.0, .longest_side = 1024};
    report("visible_ground.raster.draw_524288_triangles_1024_pixels" + at, "ms", 1.0,
           [&] { drawn.draw(radar, grid, sigmascape::terrain::view_of(coarse), settings, team); });
  }
  return 0;
}
