#include "sigmascape/dataset/target_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::dataset {
namespace {

constexpr double plain_m = 2500.0;
constexpr radar::GroundGrid grid{-128.0, 128.0, 1.0, 256, 256};

/// A plain with a ridge from south to north on it, whose flanks rise by `slope`.
terrain::HeightField ridge(double slope) {
  terrain::HeightField field{.west_m = -300.0, .north_m = 300.0, .spacing_m = 2.0, .height_m = {301, 301}};
  for (std::size_t row = 0; row < 301; ++row) {
    for (std::size_t column = 0; column < 301; ++column) {
      const double east_m = -300.0 + 2.0 * static_cast<double>(column);
      const double above_m = slope > 0.0 ? std::max(0.0, 100.0 - slope * std::abs(east_m + 50.0)) : 0.0;
      field.height_m(column, row) = static_cast<float>(plain_m + above_m);
    }
  }
  return field;
}

radar::Radar seeing_from(double azimuth_deg, double elevation_deg) {
  radar::Radar radar;
  radar.range_resolution_m = 3.0;
  radar.beam_width_rad = 1e-3;
  radar.position = radar::position_seeing({0.0, 0.0, plain_m}, radians_from_deg(azimuth_deg),
                                          radians_from_deg(elevation_deg), 5000.0);
  return radar;
}

Vec3d above(const terrain::HeightField& terrain, Vec2d place, double height_m) {
  return {place.x, place.y, terrain.height_at(place) + height_m};
}

/// The same as `shown_stretch` by looking at every centimetre: how far from the target the nearest ground is that shows
/// it.
double distance_to_shown(Vec3d target, const radar::Radar& radar, const terrain::HeightField& terrain) {
  const Vec2d here{radar.position.x, radar.position.y}, away = Vec2d{target.x, target.y} - here;
  const double there_m = length(away), range_m = length(target - radar.position);
  for (double off_m = 0.0;; off_m += 0.01) {
    for (const double distance_m : {there_m - off_m, there_m + off_m}) {
      const Vec2d place = here + away * (distance_m / there_m);
      const double found_m = length(above(terrain, place, 0.0) - radar.position);
      if (std::abs(found_m - range_m) <= radar.range_resolution_m / 2.0) return off_m;
    }
  }
}

/// What a map shows of a target of 1 m².
Array2D<radar::Channels> response(Vec3d position, const radar::Radar& radar, const terrain::HeightField& terrain) {
  const radar::Target target{
      .name = "target", .track = radar::Track::straight(position), .rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F}};
  receiver::RangeAzimuthReceiver receiver(radar, simulate::bins_for(radar, grid.extent(), terrain));
  receiver.add(receiver::target_echoes({&target, 1}, radar, {}));
  return product::ground_map(receiver.image(), terrain, grid).sigma0;
}

float brightest(const Array2D<radar::Channels>& map, const product::TargetBox& box) {
  float most = 0.0F;
  for (std::size_t y = 0; y < map.rows(); ++y) {
    for (std::size_t x = 0; x < map.columns(); ++x) {
      const double column = static_cast<double>(x) + 0.5, row = static_cast<double>(y) + 0.5;
      if (column < box.x || column > box.x + box.width || row < box.y || row > box.y + box.height) continue;
      most = std::max(most, map(x, y).vv);
    }
  }
  return most;
}

// On level ground the response is ρ / cos ψ long and θ r cos ψ / √2 wide, wherever the ground lies over the sea.
TEST(TargetBox, IsAsLargeAsTheResponseOnAHighPlain) {
  const auto plain = ridge(0.0);
  const radar::Radar radar = seeing_from(180.0, 30.0);
  const auto box = target_box(above(plain, {0.0, 0.0}, 0.0), 5.0, radar, plain, grid);
  const double cosine = std::cos(radians_from_deg(30.0));
  EXPECT_NEAR(box.width, 1e-3 * 5000.0 * cosine / std::sqrt(2.0) + 5.0 + 1.0, 0.01);
  EXPECT_NEAR(box.height, 3.0 / cosine + 5.0 + 1.0, 0.01);
  EXPECT_NEAR(box.x + box.width / 2.0, 128.0, 0.01);
  EXPECT_NEAR(box.y + box.height / 2.0, 128.0, 0.01);
}

// A mast of 20 m is nearer to the radar by 20 m · sin ψ, and so shows 20 m · tan ψ before its foot.
TEST(TargetBox, LiesBeforeWhatStandsHigh) {
  const auto plain = ridge(0.0);
  const auto box = target_box(above(plain, {0.0, 0.0}, 20.0), 0.0, seeing_from(180.0, 30.0), plain, grid);
  EXPECT_NEAR(box.y + box.height / 2.0, 128.0 + 20.0 * std::tan(radians_from_deg(30.0)), 0.1);
}

// Where the beam peaks clockwise of its axis, the target shows when the axis has not come to it yet.
TEST(TargetBox, LiesWhereABeamThatPeaksOffItsAxisShowsTheTarget) {
  const auto plain = ridge(0.0);
  radar::Radar radar = seeing_from(140.0, 30.0);
  radar.beam_width_rad = 2e-3;
  radar.antenna.azimuth =
      radar::TabulatedBeam{{{-2.0, 1e-6}, {4.5, 1e-6}, {5.0, 0.5}, {5.5, 1.0}, {6.0, 0.5}, {6.5, 1e-6}}};
  const Vec3d target = above(plain, {5.0, -10.0}, 3.0);
  const auto box = target_box(target, 0.0, radar, plain, grid);
  const auto map = response(target, radar, plain);
  EXPECT_EQ(brightest(map, box), brightest(map, {.width = 256.0, .height = 256.0}));
  const double off_m = std::hypot(box.x + box.width / 2.0 - 133.0, box.y + box.height / 2.0 - 138.0) * grid.cell_m;
  EXPECT_NEAR(off_m, 5.5 * 2e-3 * 5000.0 * std::cos(radians_from_deg(30.0)), 3.0);
}

/// Holds the stretch and the box of a target against all ground of its azimuth and against the map of its response.
/// False when the box is empty: the target is laid over to beyond the map.
bool holds_nearest_response(Vec3d target, const radar::Radar& radar, const terrain::HeightField& terrain) {
  const auto stretch = shown_stretch(target, radar, terrain, grid.cell_m);
  EXPECT_TRUE(stretch);
  if (!stretch) return false;
  const Vec2d here{radar.position.x, radar.position.y}, away = Vec2d{target.x, target.y} - here;
  const double there_m = length(away), middle_m = 0.5 * (stretch->near_m + stretch->far_m);
  const double off_m = std::max({0.0, stretch->near_m - there_m, there_m - stretch->far_m});
  EXPECT_NEAR(off_m, distance_to_shown(target, radar, terrain), 0.3);
  const Vec3d ground = above(terrain, here + away * (middle_m / there_m), 0.0);
  EXPECT_NEAR(length(ground - radar.position), length(target - radar.position), radar.range_resolution_m / 2.0);

  const auto box = target_box(target, 0.0, radar, terrain, grid);
  if (box.width == 0.0) return false;
  const auto map = response(target, radar, terrain);
  EXPECT_GT(brightest(map, box), 0.5F * brightest(map, {.width = 256.0, .height = 256.0}));
  return true;
}

// Flanks of 50 degrees under waves from 25 to 65: they are laid over, lie in shadow, or neither.
TEST(TargetBox, HoldsTheResponseNearestTheTargetOnSteepFlanks) {
  const auto terrain = ridge(1.2);
  int boxes = 0;
  for (const double azimuth_deg : {240.0, 90.0}) {
    for (const double elevation_deg : {25.0, 45.0, 55.0, 65.0}) {
      const radar::Radar radar = seeing_from(azimuth_deg, elevation_deg);
      for (double east_m = -110.0; east_m <= 60.0; east_m += 5.3) {
        for (const double height_m : {1.0, 12.0}) {
          SCOPED_TRACE(::testing::Message()
                       << azimuth_deg << ", " << elevation_deg << ", " << east_m << ", " << height_m);
          if (holds_nearest_response(above(terrain, {east_m, 10.0}, height_m), radar, terrain)) ++boxes;
        }
      }
    }
  }
  EXPECT_GT(boxes, 400);
}

// From 80 degrees above, a balloon 4 km up is nearer than any ground.
// Of a plain the ground whose range is the target's to within half the resolution is known in closed form. Here it ends
// in the north at the map's southern edge, while the target stands further north, on the map, with 5 m of its size to
// each side and half a cell beyond that.
TEST(TargetBox, IsEmptyWhereTheMapEndsBeforeTheResponse) {
  const terrain::HeightField terrain = ridge(0.0);
  const radar::Radar radar = seeing_from(180.0, 45.0);
  const auto box_of_response_up_to = [&](double north_m) {
    const double altitude_m = radar.position.z - plain_m, target_north_m = -120.0;
    const double range_m = std::hypot(north_m - radar.position.y, altitude_m) - radar.range_resolution_m / 2.0;
    const double away_m = target_north_m - radar.position.y;
    const double height_m = altitude_m - std::sqrt(range_m * range_m - away_m * away_m);
    return target_box(above(terrain, {0.0, target_north_m}, height_m), 10.0, radar, terrain, grid);
  };
  const auto beyond = box_of_response_up_to(-129.0), across = box_of_response_up_to(-127.0);
  EXPECT_EQ(beyond.width, 0.0);
  EXPECT_EQ(beyond.height, 0.0);
  EXPECT_NEAR(across.height, 1.0 + 5.0 + 0.5, 1e-3);
  EXPECT_EQ(across.y + across.height, 256.0);
}

TEST(TargetBox, IsEmptyForWhatNoGroundShows) {
  const auto plain = ridge(0.0);
  const Vec3d balloon = above(plain, {0.0, 0.0}, 4000.0);
  EXPECT_FALSE(shown_stretch(balloon, seeing_from(180.0, 80.0), plain, 1.0));
  const auto box = target_box(balloon, 5.0, seeing_from(180.0, 80.0), plain, grid);
  EXPECT_EQ(box.width, 0.0);
  EXPECT_EQ(box.height, 0.0);
}

// Sent and received over a flat top the response is as wide as the top, not narrower by √2 as of a Gaussian.
TEST(TargetBox, IsAsWideAsTheBeamIsSentAndReceived) {
  const terrain::HeightField terrain = ridge(0.0);
  radar::Radar radar = seeing_from(0.0, 20.0);
  const Vec3d target = above(terrain, {0.0, 0.0}, 0.0);
  const product::TargetBox gaussian = target_box(target, 0.0, radar, terrain, grid);
  radar.antenna.azimuth = radar::TabulatedBeam{{{-0.6, 1e-4}, {-0.5, 1.0}, {0.5, 1.0}, {0.6, 1e-4}}};
  const product::TargetBox flat = target_box(target, 0.0, radar, terrain, grid);
  EXPECT_NEAR((flat.width - 1.0) / (gaussian.width - 1.0), 1.0075 * std::sqrt(2.0), 0.01);
  EXPECT_NEAR(flat.height, gaussian.height, 0.1);
}

}  // namespace
}  // namespace sigmascape::dataset
