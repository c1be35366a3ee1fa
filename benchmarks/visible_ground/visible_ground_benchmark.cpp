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

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/render/sweep_kernel.h"
#include "sigmascape/render/visible_ground.h"

namespace {

using namespace std::chrono_literals;
using sigmascape::Array2D;
using sigmascape::Vec3d;
using sigmascape::render::GroundSamples;
using sigmascape::render::GroundSector;
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

/// The floor: every byte that an answer consists of, written once.
void write_answers(GroundSamples& samples, unsigned threads) {
  const std::size_t rows_together = 16, groups = samples.distances() / rows_together;
  sigmascape::parallel_for(groups, threads, [&](std::size_t group, unsigned) {
    const std::size_t begin = samples.index(0, group * rows_together), count = rows_together * samples.stride();
    for (auto layer : {samples.height_m(), samples.range_excess_m(), samples.sin_grazing(), samples.sin_local_grazing(),
                       samples.slope_area()}) {
      std::fill_n(layer.data() + begin, count, static_cast<float>(group));
    }
    std::fill_n(samples.visible().data() + begin, count, static_cast<std::uint8_t>(group));
  });
}

/// The floor of a sweep: the same samples of a field already resampled to azimuth and distance, no gathers.
std::size_t polar_sweep(const std::vector<float>& slopes, GroundSamples& samples, unsigned threads) {
  constexpr std::size_t together = 64;
  sigmascape::parallel_for(samples.azimuths() / together, threads, [&](std::size_t block, unsigned) {
    float steepest[together];
    std::fill(std::begin(steepest), std::end(steepest), -1e30F);
    for (std::size_t k = 0; k < samples.distances(); ++k) {
      const std::size_t first = samples.index(block * together, k);
      std::uint8_t* const out = samples.visible().data() + first;
      for (std::size_t i = 0; i < together; ++i) {
        const float slope = slopes[first + i];
        out[i] = slope >= steepest[i] ? 1 : 0;
        steepest[i] = std::max(steepest[i], slope);
      }
    }
  });
  return samples.visible()[0];
}

}  // namespace

int main() {
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  fmt::print("# {} threads, {} for the sweep\n", threads, sigmascape::render::sweep_instruction_set());
  constexpr std::size_t azimuths = 1024, distances = 1024;
  constexpr double millions = static_cast<double>(azimuths * distances) / 1e6;
  const auto field = hills(1025, 4.0);
  const auto view = sigmascape::terrain::view_of(field);
  const double range_m = 20e3, across_m = 4096.0;
  const Vec3d radar{0.5 * across_m, -0.5 * across_m - range_m, 0.15 * range_m};
  const GroundSector sector{.first_azimuth_rad = -0.45 * across_m / range_m,
                            .azimuth_step_rad = 0.9 * across_m / range_m / azimuths,
                            .azimuths = azimuths,
                            .first_distance_m = range_m - 0.48 * across_m,
                            .distance_step_m = 0.96 * across_m / distances,
                            .distances = distances};
  GroundSamples samples;

  for (const unsigned used : {1U, threads}) {
    const std::string at = fmt::format(".threads_{}", used);
    const std::string unit = "ms per million samples";
    samples.fit(sector);
    report("visible_ground.floor.write_answers" + at, unit, millions, [&] { write_answers(samples, used); });
    std::vector<float> slopes(samples.stride() * distances);
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = std::sin(static_cast<float>(i));
    report("visible_ground.floor.polar_sweep" + at, unit, millions, [&] { polar_sweep(slopes, samples, used); });
    for (const double step_cells : {1.0, 0.5, 0.25}) {
      VisibleGround sweep({.longest_step_cells = step_cells, .threads = used});
      report(fmt::format("visible_ground.sweep.step_{}_cells{}", step_cells, at), unit, millions,
             [&] { sweep.find(radar, sector, view, samples); });
    }
    VisibleGround flags({.local_slopes = false, .threads = used});
    report("visible_ground.sweep.without_local_slopes" + at, unit, millions,
           [&] { flags.find(radar, sector, view, samples); });

    // The paper's way, with the mesh that its rule of 16 pixels a triangle leaves for a million pixels.
    const auto coarsest = hills(182, 22.6);
    VisibleGround paper({.method = VisibilityMethod::Rasterization, .threads = used});
    report("visible_ground.raster.65522_triangles_16_pixels_each" + at, unit, millions,
           [&] { paper.find(radar, sector, sigmascape::terrain::view_of(coarsest), samples); });
    // What the floor of 524,288 triangles in 1024² pixels is known for.
    const auto coarse = hills(513, 8.0);
    sigmascape::render::TerrainRaster drawn;
    const sigmascape::render::RasterSettings settings{.pixels_per_triangle = 16.0, .longest_side = 1024};
    report("visible_ground.raster.draw_524288_triangles_1024_pixels" + at, "ms", 1.0,
           [&] { drawn.draw(radar, {}, sector, sigmascape::terrain::view_of(coarse), settings, used); });
  }
  return 0;
}
