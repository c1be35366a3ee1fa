// How long does it take to find the visible ground among a million samples, by sweep and by raster, and how long would
// the least take that any sweep must do?

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <thread>
#include <vector>

#include "figures.h"

#include "sigmascape/base/units.h"
#include "sigmascape/base/worker_team.h"
#include "sigmascape/live/visible_ground.h"

namespace {

using namespace std::chrono_literals;
using sigmascape::Array2D;
using sigmascape::Vec3d;
using sigmascape::WorkerTeam;
using sigmascape::bench::Figures;
using sigmascape::bench::processor_seconds;
using sigmascape::bench::prove;
using sigmascape::live::HorizonGrid;
using sigmascape::live::VisibilityMethod;
using sigmascape::live::VisibleGround;

struct Cost {
  double wall_ms = 1e30, processor_ms = 1e30;  ///< the latter of all threads together
};

/// Least of many runs: what the work takes when nothing else does.
Cost least_cost(std::chrono::milliseconds time, const std::function<void()>& work) {
  Cost least;
  const auto end = std::chrono::steady_clock::now() + time;
  for (int run = 0; run < 5 || std::chrono::steady_clock::now() < end; ++run) {
    const auto start = std::chrono::steady_clock::now();
    const double processor_start_s = processor_seconds();
    work();
    const double processor_ms = 1e3 * (processor_seconds() - processor_start_s);
    const double wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    least = {std::min(least.wall_ms, wall_ms), std::min(least.processor_ms, processor_ms)};
  }
  return least;
}

/// Times work for a figure, on the wall and of all threads together.
class Stopwatch {
 public:
  Stopwatch(Figures& figures, bool quick) : figures_(figures), time_(quick ? 100ms : 1500ms) {}

  void report(const std::string& name, const std::string& unit, double per, const std::function<void()>& work) {
    const Cost cost = least_cost(time_, work);
    figures_.add(name, cost.wall_ms / per, unit);
    figures_.add(name + ".processor", cost.processor_ms / per, unit);
  }

 private:
  Figures& figures_;
  std::chrono::milliseconds time_;
};

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

/// Both ways see all of a plane that nothing stands on, and nothing right behind a wall.
void prove_both_ways(const HorizonGrid& grid, Vec3d radar, WorkerTeam& team) {
  sigmascape::terrain::HeightField wall{.spacing_m = 8.0, .height_m = Array2D<float>(513, 513, 0.0F)};
  const sigmascape::terrain::HeightField plane = wall;
  for (float& height_m : wall.height_m.row(256)) height_m = 300.0F;
  for (const VisibilityMethod method : {VisibilityMethod::HorizonSweep, VisibilityMethod::Rasterization}) {
    VisibleGround ground({.method = method}, team.size());
    ground.reset(grid, false);
    const auto seen = [&](const sigmascape::terrain::HeightField& field, std::size_t node) {
      ground.find(0, grid.azimuths, radar, {.terrain = sigmascape::terrain::view_of(field)}, team);
      const double distance_m = grid.near_m + static_cast<double>(node) * grid.step_m;
      return -radar.z / distance_m >= static_cast<double>(ground.horizon().slopes(grid.azimuths / 2)[node]) - 1e-6;
    };
    prove(seen(plane, 900) && seen(plane, 600), "level ground is seen");
    prove(!seen(wall, 600) && seen(wall, 100), "a wall hides what is behind it and nothing before it");
  }
}

}  // namespace

int main(int count, char** words) {
  const auto arguments = sigmascape::bench::Arguments::parsed(count, words);
  Figures figures(arguments.out);
  Stopwatch stopwatch(figures, arguments.quick);
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

  WorkerTeam provers(1);
  prove_both_ways(grid, radar, provers);
  for (const unsigned used : {1U, threads}) {
    WorkerTeam team(used);
    const std::string at = fmt::format(".threads_{}", used), unit = "ms per million nodes";
    std::vector<float> slopes(azimuths * distances), steepest(slopes.size());
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = std::sin(static_cast<float>(i));
    stopwatch.report("visible_ground.floor.write" + at, unit, millions, [&] { std::ranges::fill(steepest, 1.0F); });
    stopwatch.report("visible_ground.floor.polar_sweep" + at, unit, millions,
                     [&] { polar_sweep(slopes, grid, steepest, team); });
    const auto found = [&](const std::string& name, const sigmascape::terrain::HeightField& field,
                           const sigmascape::live::VisibleGroundSettings& settings) {
      VisibleGround ground(settings, used);
      ground.reset(grid, false);
      stopwatch.report(name + at, unit, millions, [&] {
        ground.find(0, azimuths, radar, {.terrain = sigmascape::terrain::view_of(field)}, team);
      });
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
    sigmascape::live::TerrainRaster drawn;
    const sigmascape::live::RasterSettings settings{.pixels_per_triangle = 16.0, .longest_side = 1024};
    stopwatch.report("visible_ground.raster.draw_524288_triangles_1024_pixels" + at, "ms", 1.0,
                     [&] { drawn.draw(radar, grid, sigmascape::terrain::view_of(coarse), settings, team); });
  }
  return 0;
}
