// Of ground of constant γ a radar receives γ times the area that it shows, square to the line of sight: γ ∫ R² dΩ over
// all that is in sight, whatever the ground's shape. What of it is in sight is found here by going out over the ground.
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>

#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/render/ground_renderer.h"

namespace sigmascape::live {
namespace {

constexpr double hills_gamma = 0.05;
constexpr std::size_t left_out = 1;  // bins at every edge, which share with what lies outside

/// Hills of about 25 m, some 400 m apart along one diagonal and 200 m along the other.
double hills_m(Vec2d from_middle) {
  return 25.0 * (std::sin(from_middle.x / 70.0) * std::cos(from_middle.y / 55.0) +
                 0.5 * std::sin((from_middle.x + from_middle.y) / 31.0));
}

ExampleGround bare_hills() {
  ExampleGround example;
  example.azimuths = 1;
  example.ground_elevations_deg = {0.5, 88.0};
  example.sigma0 = [](const radar::Look&) { return radar::Channels{}; };
  example.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(hills_gamma, look); };
  example.height_m = hills_m;
  return example;
}

/// What bins about a place hold together.
struct Powers {
  double frame = 0.0, map = 0.0, in_sight = 0.0;
};

class BareHills : public testing::Test {
 protected:
  BareHills() : example_(bare_hills()), terrain_(example_.terrain()) {
    const atlas::Store store = example_.store(folder_.path("atlas"));
    atlas::Pyramid(store).make_above(store.units());
    ground_ = example_.over(store);
    atlas_ = std::make_unique<atlas::Atlas>(atlas::load_atlas(atlas::Store::open(folder_.path("atlas"))));
  }

  void add(const ExampleView& view, const radar::CurvedEarth& earth, Powers& sum) {
    LiveSettings settings = view.settings(FrameContent::Powers);
    settings.refraction = earth.refraction;
    const Pose pose = view.pose();
    LiveRenderer renderer(ground_, settings);
    const Frame& frame = settled_frame(renderer, *ground_, pose);
    EXPECT_EQ(frame.report.coarse, 0U);
    radar::Radar radar;
    radar.position = pose.position;
    radar.range_resolution_m = 0.25 * settings.range_step_m;
    radar.beam_width_rad = 0.25 * std::sqrt(2.0) * settings.beam_step_rad;
    render::RenderCounts counts;
    const auto map =
        render::GroundRenderer(*atlas_, terrain_).render(radar, ground_->description().extent, frame.grid, {}, counts);
    for (std::size_t beam = left_out; beam + left_out < view.beams; ++beam) {
      for (std::size_t range = left_out; range + left_out < view.ranges; ++range) {
        sum.frame += static_cast<double>(frame.powers_m2[(beam * view.ranges + range) * 4]);
        sum.map += static_cast<double>(map.rcs_m2(beam, range).vv);
      }
    }
    sum.in_sight += in_sight_m2(frame.grid, pose.position, earth);
  }

  /// Along lines within the beams, from the radar outwards: each bit of ground that rises above all before it, in the
  /// space in which rays are straight.
  double in_sight_m2(const radar::RangeAzimuthGrid& bins, Vec3d radar, const radar::CurvedEarth& earth) const {
    constexpr int lines_a_beam = 4;
    constexpr double step_m = 0.25;
    const auto inner_beams = static_cast<double>(bins.azimuths - 2 * left_out);
    const double line_rad = bins.azimuth_step_rad / lines_a_beam;
    const double near_m = bins.first_range_m + left_out * bins.range_step_m;
    const double far_m = near_m + static_cast<double>(bins.ranges - 2 * left_out) * bins.range_step_m;
    double sum_m2 = 0.0;
    for (int line = 0; line < static_cast<int>(inner_beams) * lines_a_beam; ++line) {
      const double azimuth =
          bins.first_azimuth_rad + left_out * bins.azimuth_step_rad + (static_cast<double>(line) + 0.5) * line_rad;
      const Vec2d direction = radar::horizontal_direction(azimuth);
      double highest_rad = -0.5 * pi;
      bool is_over_ground = false;
      for (double distance_m = std::max(near_m - 2.0 * example_.side_m(), step_m); distance_m < far_m;
           distance_m += step_m) {
        const Vec2d place = Vec2d{radar.x, radar.y} + direction * distance_m;
        if (!terrain_.extent().contains(place)) continue;
        const Vec3d there = earth.bent({place.x, place.y, terrain_.height_at(place)}, {radar.x, radar.y}) - radar;
        const double away_m = std::hypot(there.x, there.y), range_m = std::hypot(away_m, there.z);
        const double elevation = std::atan2(there.z, away_m);
        if (elevation > highest_rad) {
          if (is_over_ground && range_m >= near_m && range_m < far_m)
            sum_m2 += hills_gamma * range_m * range_m * std::cos(elevation) * (elevation - highest_rad) * line_rad;
          highest_rad = elevation;
        }
        is_over_ground = true;
      }
    }
    return sum_m2;
  }

  /// Of some places among the hills.
  Powers seen_from(double slant_range_m, const radar::CurvedEarth& earth) {
    Powers sum;
    for (const Vec2d moved : {Vec2d{-200.0, -100.0}, {-90.0, 60.0}, {20.0, 220.0}, {130.0, 10.0}, {240.0, -150.0}}) {
      ExampleView view{.elevation_deg = 1.5, .slant_range_m = slant_range_m, .beams = 24, .ranges = 24, .bin_m = 8.0};
      view.target = view.target + moved;
      add(view, earth, sum);
    }
    return sum;
  }

  static void expect(const std::string& what, double slant_range_m, double power, const Powers& sum,
                     double tolerance_db) {
    validation::expect_close({.group = "Ground in sight",
                              .name = fmt::format("hills of 25 m at 1.5° from {:g} km, {}", slant_range_m * 1e-3, what),
                              .expected = 0.0,
                              .measured = db_from_linear(power / sum.in_sight),
                              .tolerance = tolerance_db,
                              .unit = "dB over γ ∫ R² dΩ",
                              .source = "closed form, what is in sight by going over the ground"});
  }

  ExampleGround example_;
  terrain::HeightField terrain_;
  ScratchFolder folder_;
  std::shared_ptr<LiveGround> ground_;
  std::unique_ptr<const atlas::Atlas> atlas_;
};

// From afar the ridges before the frame decide what is seen of it, and the way to them is long.
TEST_F(BareHills, AnswerWithTheAreaThatTheyShow) {
  for (const double slant_range_m : {3e3, 15e3, 60e3}) {
    const Powers sum = seen_from(slant_range_m, radar::CurvedEarth::flat());
    expect("map", slant_range_m, sum.map, sum, 0.1);
    expect("live frame", slant_range_m, sum.frame, sum, 0.2);
  }
}

// Real-beam maps are made over a flat Earth.
TEST_F(BareHills, AnswerSoOverTheRoundEarth) {
  for (const double slant_range_m : {60e3, 100e3}) {
    const Powers sum = seen_from(slant_range_m, {});
    expect("live frame over the round Earth", slant_range_m, sum.frame, sum, 0.2);
  }
}

}  // namespace
}  // namespace sigmascape::live
