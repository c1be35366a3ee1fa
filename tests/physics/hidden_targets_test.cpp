#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "physics/ground_with_box.h"
#include "physics/image_total.h"
#include "validation/validation_record.h"

#include "sigmascape/product/ground_projection.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

constexpr std::string_view hidden_targets_group = "Targets";
const double tangent = std::tan(radians_from_deg(seen_elevation_deg));
const radar::Rectangle seen_area{-120.0, -120.0, 120.0, 120.0};

/// From the south, with cells of 2 m both ways.
radar::Radar real_beam() {
  radar::Radar radar;
  radar.frequency_hz = frequency_hz;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(seen_elevation_deg), 5e3);
  radar.range_resolution_m = 2.0;
  radar.beam_width_rad = 2.0 * std::sqrt(2.0) / 5e3;
  return radar;
}

radar::Target target_at(Vec3d position, float rcs_m2, Vec3d size_m = {}) {
  radar::Target target;
  target.track = radar::Track::straight(position);
  target.rcs_m2 = radar::Channels{rcs_m2, rcs_m2, 0.0F, rcs_m2};
  target.size_m = size_m;
  return target;
}

/// The same scene at level of detail 0 and, baked, at level 1.
class BothLevels {
 public:
  explicit BothLevels(const scene::Scene& scene)
      : scene_(scene),
        geometry_(scene, trace::Footing::Terrain),
        atlas_(baked_from_south(scene, bake::Shadows::RunTime)) {}

  [[nodiscard]] radar::RangeAzimuthImage traced(std::span<const radar::Target> targets) const {
    trace::TraceCounts counts;
    return simulate::traced_image(scene_, geometry_, real_beam(), seen_area,
                                  {.cell_m = 2.0, .samples_per_cell = 16, .targets = targets}, counts);
  }
  [[nodiscard]] radar::RangeAzimuthImage baked(std::span<const radar::Target> targets, int level = 1) const {
    render::RenderCounts counts;
    return simulate::baked_image(atlas_, scene_.terrain, real_beam(), seen_area,
                                 {.level_of_detail = level, .targets = targets}, counts);
  }
  [[nodiscard]] const scene::Scene& scene() const { return scene_; }
  [[nodiscard]] const atlas::Atlas& atlas() const { return atlas_; }

 private:
  const scene::Scene& scene_;
  trace::SceneGeometry geometry_;
  atlas::Atlas atlas_;
};

/// A box keeps the radar from a target behind it at every level of detail and in a coherent mode; above the box's
/// shadow, beside it and before it the target has all of its cross-section.
TEST(HiddenTargets, behind_a_box_do_not_answer) {
  const scene::Scene scene = ground_with_box(0.0, true);
  const BothLevels levels(scene);
  const double traced_alone = total_vv_m2(levels.traced({})), baked_alone = total_vv_m2(levels.baked({}));
  constexpr double behind_m = half_box_m + 12.0, rcs_m2 = 3e4;
  const double shadow_top_m = box_height_m - (behind_m - half_box_m) * tangent;
  struct Case {
    Vec3d position;
    bool seen;
  };
  const std::vector<Case> cases{{{0.0, behind_m, 1.0}, false},
                                {{0.0, behind_m, shadow_top_m - 1.0}, false},
                                {{0.0, behind_m, shadow_top_m + 1.0}, true},
                                {{20.0, behind_m, 1.0}, true},
                                {{0.0, -20.0, 1.0}, true}};
  for (const auto& [position, seen] : cases) {
    SCOPED_TRACE(testing::Message() << position.x << ' ' << position.y << ' ' << position.z);
    const std::vector<radar::Target> targets{target_at(position, static_cast<float>(rcs_m2))};
    EXPECT_NEAR((total_vv_m2(levels.traced(targets)) - traced_alone) / rcs_m2, seen ? 1.0 : 0.0, 0.01);
    EXPECT_NEAR((total_vv_m2(levels.baked(targets)) - baked_alone) / rcs_m2, seen ? 1.0 : 0.0, 0.01);

    radar::Radar sar = real_beam();
    sar.mode = radar::Mode::Spotlight;
    sar.velocity_mps = {100.0, 0.0, 0.0};
    const simulate::CoherentScene coherent{&scene.terrain, render::reflectivity_of(levels.atlas(), frequency_hz, 2.0),
                                           targets};
    const auto image = simulate::range_doppler_image(coherent, sar, {-40.0, -40.0, 40.0, 40.0}, {.interval_s = 0.2});
    double brightest = 0.0;
    for (const auto& bin : image.amplitude_m.values())
      brightest = std::max(brightest, static_cast<double>(std::norm(bin.vv)));
    EXPECT_EQ(brightest > rcs_m2 / 4.0, seen);
  }
}

/// From the path tracer to the coarsest texture that the atlas holds a target of 10 m² adds 10 m² to the bins.
TEST(HiddenTargets, in_the_open_return_the_same_from_level_0_to_the_coarsest) {
  const scene::Scene scene = ground_with_box(0.0, true);
  const BothLevels levels(scene);
  const std::vector<radar::Target> targets{target_at({20.0, 14.0, 1.0}, 10.0F)};
  validation::expect_close({hidden_targets_group, "10 m² beside a box, traced", 10.0,
                            db_from_linear(total_vv_m2(levels.traced(targets)) - total_vv_m2(levels.traced({}))), 0.1,
                            "dBm²", "what was put in"});
  const int coarsest = static_cast<int>(levels.atlas().coarsest_level()) + 1;
  for (const int level : {1, 3, coarsest}) {
    validation::expect_close(
        {hidden_targets_group, "10 m² beside a box, level of detail " + std::to_string(level), 10.0,
         db_from_linear(total_vv_m2(levels.baked(targets, level)) - total_vv_m2(levels.baked({}, level))), 0.1, "dBm²",
         "what was put in"});
  }
}

/// A box that is a target casts a shadow in the real beam too: h / tan ψ of ground behind it is dark.
TEST(HiddenTargets, cast_a_shadow_in_the_real_beam) {
  const scene::Scene scene = ground_with_box(0.0, false);
  const BothLevels levels(scene);
  constexpr double across_m = 40.0, height_m = 15.0, sigma0_of_sine = ground_gamma;
  const std::vector<radar::Target> wall{target_at({0.0, 0.0, height_m / 2.0}, 0.0F, {1.0, across_m, height_m})};
  const double sigma0 = sigma0_of_sine * std::sin(radians_from_deg(seen_elevation_deg));
  const double expected_m2 = across_m * (1.0 + height_m / tangent);
  const auto dark_m2 = [&](const radar::RangeAzimuthImage& alone, const radar::RangeAzimuthImage& with) {
    return (total_vv_m2(alone) - total_vv_m2(with)) / sigma0;
  };
  validation::expect_close({hidden_targets_group, "shadow of a target in the real beam, traced", expected_m2,
                            dark_m2(levels.traced({}), levels.traced(wall)), 0.05 * expected_m2, "m²",
                            "width · h / tan ψ"});
  validation::expect_close({hidden_targets_group, "shadow of a target in the real beam, from the atlas", expected_m2,
                            dark_m2(levels.baked({}), levels.baked(wall)), 0.05 * expected_m2, "m²",
                            "width · h / tan ψ"});
}

}  // namespace
}  // namespace sigmascape::physics_test
