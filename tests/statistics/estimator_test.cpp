#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "physics/level_scene.h"
#include "validation/validation_record.h"

namespace sigmascape::statistics_test {
namespace {

using physics_test::LookSettings;
using trace::Estimator;

constexpr radar::Aspect from_south{std::numbers::pi, 0.5};

scatter::Material lambert(const char* name, double albedo) {
  return {.name = name, .model = scatter::LambertParameters{albedo, {0.2, 0.5}}, .source = {}};
}

/// Two boxes either side of a street, on a bright square with black around it, so that all paths of several bounces
/// have both ends where rays are launched.
scene::Scene street(const scatter::Material& box, const scatter::Material& ground) {
  scene::Scene scene = physics_test::level_scene(lambert("black", 0.0));
  scene.ground = {{-60, 60, 40, 3, 3}, Array2D<scene::MaterialIndex>(3, 3, 0)};
  scene.ground.material(1, 1) = scene.material_index(ground);
  scene.prototypes.push_back(scene::box_mesh({8, 20, 10}, scene.material_index(box)));
  scene.instances = {{.x_m = -9.0F}, {.x_m = 9.0F, .yaw_rad = 0.4F}};
  return scene;
}

scene::Scene bright_street() {
  return street(lambert("wall", 0.8), lambert("ground", 0.8));
}

scene::Scene glossy_street() {
  return street(physics_test::rough_conductor("wall", 0.2), lambert("ground", 0.5));
}

/// Cross-sections of echoes of two bounces and more.
struct Return {
  double co = 0.0;      ///< VV + HH
  double across = 0.0;  ///< HV
};

Return seen(const trace::SceneGeometry& geometry, const scene::Scene& scene, const LookSettings& settings) {
  const auto viewpoint = trace::Viewpoint::distant(from_south);
  const trace::PathTracer tracer(geometry, trace::surface_models(scene, 10e9), viewpoint, settings.options,
                                 settings.seed);
  const auto launch =
      trace::launch_area(viewpoint, settings.area, settings.cell_m, 0.0, geometry.highest_m() + 1.0, {});
  Return sum;
  tracer.trace(launch, {0, settings.samples, settings.samples}, 1, [&](std::span<const radar::Echo> echoes, unsigned) {
    for (const radar::Echo& echo : echoes) {
      if (echo.bounces < 2) continue;
      sum.co += static_cast<double>(echo.rcs_m2.vv + echo.rcs_m2.hh);
      sum.across += static_cast<double>(echo.rcs_m2.hv);
    }
  });
  return sum;
}

/// Mean and variance over independent seeds.
struct Sample {
  double mean = 0.0, variance = 0.0;
  double count = 0.0;
};

Sample sample_of(const std::vector<double>& values) {
  Sample sample{.count = static_cast<double>(values.size())};
  for (const double value : values) sample.mean += value / sample.count;
  for (const double value : values) sample.variance += std::pow(value - sample.mean, 2) / (sample.count - 1.0);
  return sample;
}

struct Samples {
  Sample co, across;
};

Samples over_seeds(const scene::Scene& scene, LookSettings settings, std::uint64_t first_seed, int seeds) {
  const trace::SceneGeometry geometry(scene, trace::Footing::LevelPlane);
  std::vector<double> co, across;
  for (int i = 0; i < seeds; ++i) {
    settings.seed = first_seed + static_cast<std::uint64_t>(i);
    const Return found = seen(geometry, scene, settings);
    co.push_back(found.co);
    across.push_back(found.across);
  }
  return {sample_of(co), sample_of(across)};
}

void expect_same_mean(const std::string& name, const Samples& a, const Samples& b) {
  const auto report = [&](const char* channel, const Sample& x, const Sample& y) {
    validation::expect_close(
        {.group = "Estimators",
         .name = fmt::format("{}, {}, difference of means {:+.2f} %", name, channel, 100.0 * (x.mean / y.mean - 1.0)),
         .expected = 0.0,
         .measured = (x.mean - y.mean) / std::sqrt(x.variance / x.count + y.variance / y.count),
         .tolerance = 3.0,
         .unit = "standard errors",
         .source = "unbiased estimators have one mean"});
  };
  report("VV + HH", a.co, b.co);
  report("HV", a.across, b.across);
}

constexpr int seeds = 48;
const LookSettings plain{.area = {-30, -30, 30, 30}, .cell_m = 2.0, .samples = 8};

TEST(Estimators, ReciprocalWeightingHasNoBias) {
  LookSettings one_way = plain;
  one_way.options.estimator = Estimator::OneWay;
  for (const bool glossy : {false, true}) {
    const scene::Scene scene = glossy ? glossy_street() : bright_street();
    expect_same_mean(fmt::format("reciprocal against one-way, {} street", glossy ? "glossy" : "bright"),
                     over_seeds(scene, plain, 1000, seeds), over_seeds(scene, one_way, 2000, seeds));
  }
}

// Dark enough that most paths are ended early and most connections to the radar are left to chance.
TEST(Estimators, RouletteHasNoBias) {
  LookSettings without = plain;
  without.options.roulette = false;
  const struct {
    const char* name;
    scene::Scene scene;
  } cases[] = {{"albedo 0.002", street(lambert("wall", 0.002), lambert("ground", 0.002))},
               {"albedo 0.15", street(lambert("wall", 0.15), lambert("ground", 0.15))},
               {"glossy", glossy_street()}};
  for (const auto& [name, scene] : cases) {
    expect_same_mean(fmt::format("roulette on against off, street, {}", name),
                     over_seeds(scene, plain, 3000, 2 * seeds), over_seeds(scene, without, 4000, 2 * seeds));
  }
}

// Any beginning of the sequence of points, be it a power of two or not, on cells of any size.
TEST(Estimators, NumbersOfPointsAndCellsHaveNoBias) {
  const scene::Scene scene = bright_street();
  const Samples reference = over_seeds(scene, plain, 5000, seeds);
  LookSettings odd = plain;
  odd.samples = 7;
  expect_same_mean("8 points a cell against 7", reference, over_seeds(scene, odd, 6000, seeds));
  LookSettings small = plain;
  small.cell_m = 1.0;
  small.samples = 2;
  expect_same_mean("cells of 2 m with 8 points against 1 m with 2", reference, over_seeds(scene, small, 7000, seeds));
}

// The scatter over seeds against the number of points a cell, fitted in logarithms.
TEST(Estimators, ErrorFallsWithTheRootOfTheNumberOfPoints) {
  const struct {
    const char* name;
    scene::Scene scene;
    Estimator estimator;
  } cases[] = {{"bright street, reciprocal", bright_street(), Estimator::Reciprocal},
               {"bright street, one-way", bright_street(), Estimator::OneWay},
               {"glossy street, reciprocal", glossy_street(), Estimator::Reciprocal}};
  for (const auto& [name, scene, estimator] : cases) {
    double n = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
    for (const std::uint32_t points : {1U, 4U, 16U, 64U}) {
      LookSettings settings = plain;
      settings.samples = points;
      settings.options.estimator = estimator;
      const Sample co = over_seeds(scene, settings, 100 * points, points < 64 ? 64 : 32).co;
      const double x = std::log(points), y = 0.5 * std::log(co.variance / (co.mean * co.mean));
      n += 1.0;
      sum_x += x;
      sum_y += y;
      sum_xx += x * x;
      sum_xy += x * y;
    }
    validation::expect_at_most({.group = "Estimators",
                                .name = fmt::format("slope of error over points a cell, 1 to 64, {}", name),
                                .limit = -0.5,
                                .measured = (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x),
                                .unit = "1",
                                .source = "independent points have −0.5, well spread ones better"});
  }
}

/// Sum and sum of squares over all paths of the double bounce of a wall of width α on natural ground, seen from 20°
/// above; a path has one such echo or none.
struct Moments {
  double mean = 0.0, variance = 0.0;
  double relative_standard_error = 0.0;  // of the mean
};

Moments double_bounce(double alpha, Estimator estimator, std::uint32_t samples) {
  const scatter::Material ground{
      .name = "ground", .model = scatter::ConstantGammaParameters{0.1, {0.1, 0.5}}, .source = {}};
  // A square before the wall and black around it: every path has both ends where rays are launched.
  scene::Scene scene = physics_test::level_scene(lambert("black", 0.0));
  scene.ground = {{-45, 30, 30, 3, 3}, Array2D<scene::MaterialIndex>(3, 3, 0)};
  scene.ground.material(1, 1) = scene.material_index(ground);
  physics_test::add_wall(scene, physics_test::rough_conductor("wall", alpha), 10.0F, 10.0F, pi);
  const trace::SceneGeometry geometry(scene, trace::Footing::LevelPlane);
  const auto viewpoint = trace::Viewpoint::distant({pi, radians_from_deg(20.0)});
  const trace::PathTracer tracer(geometry, trace::surface_models(scene, 10e9), viewpoint,
                                 {.max_bounces = 2, .estimator = estimator, .roulette = false}, 1);
  const auto launch = trace::launch_area(viewpoint, {-16, -32, 16, 4}, 1.0, 0.0, geometry.highest_m() + 1.0, {});
  double sum = 0.0, squares = 0.0;
  const auto counts =
      tracer.trace(launch, {0, samples, samples}, 1, [&](std::span<const radar::Echo> echoes, unsigned) {
        for (const radar::Echo& echo : echoes) {
          if (echo.bounces != 2) continue;
          const double vv = static_cast<double>(echo.rcs_m2.vv);
          sum += vv;
          squares += vv * vv;
        }
      });
  const auto paths = static_cast<double>(counts.paths);
  return {sum, paths * squares - sum * sum, std::sqrt(squares - sum * sum / paths) / sum};
}

TEST(ReciprocalWeighting, KeepsTheMeanAndLowersTheVariance) {
  const struct { double alpha, least_gain; } rows[] = {{0.3, 1.5}, {0.1, 6.0}, {0.03, 50.0}, {0.01, 300.0}};
  for (const auto& row : rows) {
    const Moments one_way = double_bounce(row.alpha, Estimator::OneWay, 2048);
    const Moments reciprocal = double_bounce(row.alpha, Estimator::Reciprocal, 256);
    const std::string name = fmt::format("wall α {} on constant-gamma ground, elevation 20°", row.alpha);
    validation::expect_close({.group = "Reciprocal weighting",
                              .name = name + ", reciprocal mean over one-way mean",
                              .expected = 0.0,
                              .measured = db_from_linear(reciprocal.mean / one_way.mean),
                              // What little noise the plain estimator leaves at 0.01 comes on top.
                              .tolerance = std::max(0.1, 3.0 * db_from_linear(1.0 + one_way.relative_standard_error)),
                              .unit = "dB",
                              .source = "both estimate the same integral"});
    validation::expect_at_least({.group = "Reciprocal weighting",
                                 .name = name + ", variance of a path, one-way over reciprocal",
                                 .limit = row.least_gain,
                                 .measured = one_way.variance / reciprocal.variance,
                                 .unit = "times",
                                 .source = "gains seen in a separate experiment, less its scatter"});
  }
}

}  // namespace
}  // namespace sigmascape::statistics_test
