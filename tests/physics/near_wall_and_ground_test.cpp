#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <string>

#include "physics/level_scene.h"
#include "validation/validation_record.h"

namespace sigmascape::physics_test {
namespace {

using Complex = std::complex<double>;

/// So near that wall and ground are seen at angles and ranges of their own in every place.
constexpr Vec3d near_radar{7.0, -30.0, 22.0};
constexpr double side_m = 10.0;  // of an upright wall and of the square of ground before it, which meet at y = 0
constexpr scatter::Depolarization depolarization{0.3, 0.4};

/// What a receiver gets, Σσ/r⁴ over all echoes of some number of bounces, and where it lies.
struct Received {
  double vv = 0.0, hh = 0.0, hv = 0.0, re_vvhh = 0.0;
  double range_m = 0.0, azimuth_rad = 0.0;  // mean, by the power in VV

  void add(const std::array<double, 4>& powers, double at_range_m, double at_azimuth_rad) {
    vv += powers[0];
    hh += powers[1];
    hv += powers[2];
    re_vvhh += powers[3];
    range_m += powers[0] * at_range_m;
    azimuth_rad += powers[0] * at_azimuth_rad;
  }
  void take_means() {
    range_m /= vv;
    azimuth_rad /= vv;
  }
};

/// A field on its way: along the vertical and the horizontal of its direction.
struct Wave {
  Complex v, h;
};

/// h = z × k, v = h × k.
struct WaveBasis {
  Vec3d v, h;

  explicit WaveBasis(Vec3d k) : h(normalized(Vec3d{-k.y, k.x, 0.0})) { v = cross(h, k); }
};

/// A Lambert surface of albedo 1: of the power 1/π a steradian the cross-polarized part is x/(1 + x), and the phases of
/// HH and HV over VV are random, with a mean cosine of ρ and of zero. `hh_sign` and `hv_turn` are one draw of them.
Wave scattered(const Wave& in, double hh_sign, double hv_turn) {
  const double co = std::sqrt(1.0 / pi / (1.0 + depolarization.cross_ratio)),
               crossed = std::sqrt(depolarization.cross_ratio) * co;
  const Complex hh = std::polar(co, hh_sign * std::acos(depolarization.vv_hh_correlation)),
                hv = std::polar(crossed, hv_turn);
  return {co * in.v + hv * in.h, -hv * in.v - hh * in.h};
}

/// Radar, wall, ground, radar, and that way reversed, which adds its amplitude:
///
///     Σσ/r⁴ = 4π ∬ ⟨|S + Sᵀ|²⟩ cos θ₁ cos θ₂ cos θ₃ cos θ₄ / (r_w² r_g² d²) dA_w dA_g
///
/// over places on both by the midpoint rule, and over the phases of both exactly: powers are of first order in each, so
/// that three turns have the mean of all. No tracer and no surface of the program has a part in this.
Received received_by_integral() {
  constexpr int steps = 16, points = steps * steps * steps * steps;
  constexpr int turns = 3;
  Received sum;
  for (int i = 0; i < points; ++i) {
    const auto middle = [](int step) { return (step % steps + 0.5) / steps; };
    const Vec2d first{middle(i), middle(i / steps)},
        second{middle(i / steps / steps), middle(i / steps / steps / steps)};
    // About the edge where the two meet, by distance and angle, so that nothing grows without end there.
    const double angle = 0.5 * pi * first.x, most_m = side_m / std::max(std::sin(angle), std::cos(angle));
    const double from_edge_m = most_m * first.y, wall_x = side_m * (second.x - 0.5);
    const double low = std::atan((-0.5 * side_m - wall_x) / from_edge_m),
                 high = std::atan((0.5 * side_m - wall_x) / from_edge_m);
    const double aside_m = from_edge_m * std::tan(std::lerp(low, high, second.y));
    const Vec3d wall{wall_x, 0.0, from_edge_m * std::sin(angle)},
        ground{wall_x + aside_m, -from_edge_m * std::cos(angle), 0.0};
    const double d2 = from_edge_m * from_edge_m + aside_m * aside_m;
    const double areas_m4 = side_m * 0.5 * pi * most_m * from_edge_m * (high - low) * d2 / from_edge_m;
    const double wall_m = length(near_radar - wall), ground_m = length(near_radar - ground), between_m = std::sqrt(d2);
    const Vec3d to_wall = normalized(wall - near_radar), down = normalized(ground - wall),
                back = normalized(near_radar - ground);
    const double cosines = to_wall.y * -down.y * -down.z * back.z;
    const double weight = 4.0 * pi * cosines / (wall_m * wall_m * ground_m * ground_m * d2) * areas_m4;
    // The antenna's own basis is that of the wave which it would send to the ground.
    const WaveBasis arriving(back), antenna(-back);
    std::array<double, 4> powers{};
    for (int draw = 0; draw < 4 * turns * turns; ++draw) {
      const double wall_sign = draw % 2 == 0 ? 1.0 : -1.0, ground_sign = draw / 2 % 2 == 0 ? 1.0 : -1.0;
      const double wall_turn = 2.0 * pi * (draw / 4 % turns) / turns,
                   ground_turn = 2.0 * pi * (draw / 4 / turns) / turns;
      const auto received = [&](const Wave& sent) {
        const Wave wave = scattered(scattered(sent, wall_sign, wall_turn), ground_sign, ground_turn);
        const auto along = [&](Vec3d axis) { return wave.v * dot(arriving.v, axis) + wave.h * dot(arriving.h, axis); };
        return Wave{along(antenna.v), along(antenna.h)};
      };
      const Wave of_v = received({1.0, 0.0}), of_h = received({0.0, 1.0});
      const Complex vv = 2.0 * of_v.v, hh = 2.0 * of_h.h, hv = of_v.h + of_h.v;
      const std::array<double, 4> drawn{std::norm(vv), std::norm(hh), std::norm(hv), (vv * std::conj(hh)).real()};
      for (std::size_t channel = 0; channel < 4; ++channel)
        powers[channel] += drawn[channel] * weight / (4.0 * turns * turns * points);
    }
    const auto azimuth = [](Vec3d place) { return std::atan2(place.x - near_radar.x, place.y - near_radar.y); };
    sum.add(powers, 0.5 * (wall_m + between_m + ground_m), 0.5 * (azimuth(wall) + azimuth(ground)));
  }
  sum.take_means();
  return sum;
}

/// By number of bounces, less one.
std::array<Received, 2> received_by_tracer(std::uint32_t samples) {
  const scatter::Material white{
      .name = "white", .model = scatter::LambertParameters{1.0, depolarization}, .source = {}};
  scatter::Material black = white;
  black.name = "black";
  std::get<scatter::LambertParameters>(black.model).albedo = 0.0;
  scene::Scene scene = level_scene(black);
  add_wall(scene, white, side_m, side_m, pi);
  scene.ground.grid = {-15.0, 10.0, 10.0, 3, 3};
  scene.ground.material = Array2D<scene::MaterialIndex>(3, 3, scene.material_index(black));
  scene.ground.material(1, 1) = scene.material_index(white);
  const trace::SceneGeometry geometry(scene, trace::Footing::LevelPlane);
  const auto viewpoint = trace::Viewpoint::located(near_radar);
  const trace::PathTracer tracer(geometry, trace::surface_models(scene, frequency_hz), viewpoint, {.max_bounces = 2},
                                 1);
  // The ground before the wall and all that the wall hides.
  const auto launch = trace::launch_area(viewpoint, {-16, -11, 6, 26}, 0.5, 0.0, geometry.highest_m() + 1.0, {});
  std::array<Received, 2> sums;
  tracer.trace(launch, {0, samples, samples}, 1, [&](std::span<const radar::Echo> echoes, unsigned) {
    for (const radar::Echo& echo : echoes) {
      const double r4 = std::pow(echo.range_m, 4);
      const radar::Channels& rcs_m2 = echo.rcs_m2;
      sums[echo.bounces - 1U].add({static_cast<double>(rcs_m2.vv) / r4, static_cast<double>(rcs_m2.hh) / r4,
                                   static_cast<double>(rcs_m2.hv) / r4, static_cast<double>(rcs_m2.re_vvhh) / r4},
                                  echo.range_m, echo.cross);
    }
  });
  for (Received& sum : sums) sum.take_means();
  return sums;
}

void expect_close(const std::string& what, double expected, double measured, double tolerance, const char* unit) {
  validation::expect_close({.group = "Wall and ground",
                            .name = "Lambert wall and ground from 30 m, " + what,
                            .expected = expected,
                            .measured = measured,
                            .tolerance = tolerance,
                            .unit = unit,
                            .source = "integral over both surfaces and their random phases"});
}

TEST(NearWallAndGround, TwoBouncesAreTheIntegralOverBoth) {
  const Received expected = received_by_integral(), measured = received_by_tracer(192)[1];
  const auto expect_power = [](const char* channel, double expected_power, double measured_power, double part) {
    constexpr double scale = 1e6;
    expect_close(channel, scale * expected_power, scale * measured_power, part * scale * std::abs(expected_power),
                 "10⁻⁶/m²");
  };
  expect_power("VV", expected.vv, measured.vv, 0.008);
  expect_power("HH", expected.hh, measured.hh, 0.008);
  expect_power("HV", expected.hv, measured.hv, 0.01);
  expect_power("Re VV·HH*", expected.re_vvhh, measured.re_vvhh, 0.02);
  expect_close("mean range", expected.range_m, measured.range_m, 0.02, "m");
  expect_close("mean azimuth", expected.azimuth_rad, measured.azimuth_rad, 0.001, "rad");
}

// 4π ∫ cos²θ/(π (1 + x) r⁴) dA of either.
TEST(NearWallAndGround, WhatComesStraightBackIsTheIntegralOverEither) {
  constexpr int steps = 200;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double across = side_m * ((i + 0.5) / steps - 0.5), along = side_m * (j + 0.5) / steps;
      const Vec3d from_wall = near_radar - Vec3d{across, 0.0, along},
                  from_ground = near_radar - Vec3d{across, -along, 0.0};
      sum += std::pow(from_wall.y, 2) / std::pow(length(from_wall), 6) +
             std::pow(from_ground.z, 2) / std::pow(length(from_ground), 6);
    }
  }
  const double expected = 4.0 / (1.0 + depolarization.cross_ratio) * sum * std::pow(side_m / steps, 2);
  expect_close("straight back, VV", 1e6 * expected, 1e6 * received_by_tracer(8)[0].vv, 1e6 * 0.002 * expected,
               "10⁻⁶/m²");
}

}  // namespace
}  // namespace sigmascape::physics_test
