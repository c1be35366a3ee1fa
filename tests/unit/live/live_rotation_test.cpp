#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "live_ground_example.h"

namespace sigmascape::live {
namespace {

/// A made-up place that is turned clockwise by an angle about its middle: reflectivity that changes with place and
/// aspect, over a hill. Baked anew for every angle.
class TurnedPlace {
 public:
  explicit TurnedPlace(double angle_deg) : angle_rad_(radians_from_deg(angle_deg)) {
    example_.patches_a_side = 1;
    example_.height_m = [this](Vec2d p) { return 40.0 * bump(p, {150.0, -80.0}, 180.0); };
    example_.sigma0 = [](const radar::Look&) { return radar::Channels{}; };
    store_ = std::make_unique<atlas::Store>(store());
    atlas::Pyramid(*store_).make_above(store_->units());
    ground_ = example_.over(*store_);
  }

  /// VV of blocks of 8 × 8 bins as the radar sees them that is turned along; m².
  [[nodiscard]] std::vector<double> blocks() const {
    ExampleView view{.target = example_.middle()};
    view.azimuth_deg = 20.0 + deg_from_radians(angle_rad_);
    LiveRenderer renderer(ground_, view.settings(FrameContent::Powers));
    const Frame& frame = settled_frame(renderer, *ground_, view.pose());
    EXPECT_EQ(frame.report.coarse + frame.report.dark, 0U);
    std::vector<double> sums(view.beams / 8 * (view.ranges / 8));
    for (std::size_t beam = 0; beam < view.beams; ++beam) {
      for (std::size_t range = 0; range < view.ranges; ++range) {
        sums[beam / 8 * (view.ranges / 8) + range / 8] +=
            static_cast<double>(frame.powers_m2[(beam * view.ranges + range) * 4]);
      }
    }
    return sums;
  }

 private:
  [[nodiscard]] double bump(Vec2d p, Vec2d at, double width_m) const {
    const double sine = std::sin(angle_rad_), cosine = std::cos(angle_rad_);
    // Back to where it stood before the turn.
    const Vec2d before{p.x * cosine - p.y * sine, p.x * sine + p.y * cosine};
    const Vec2d away = before - at;
    return std::exp(-dot(away, away) / (2.0 * width_m * width_m));
  }
  [[nodiscard]] radar::Channels sigma0(Vec2d p, const radar::Look& look) const {
    const double azimuth = look.aspect.azimuth_rad - angle_rad_;
    const double level = 0.05 + bump(p, {-120.0, 60.0}, 60.0) + 0.5 * bump(p, {60.0, 140.0}, 90.0);
    return constant_gamma(level * (1.0 + 0.3 * std::cos(azimuth - 0.7)), look);
  }
  [[nodiscard]] atlas::Store store() const {
    atlas::AtlasDescription description;
    description.name = "turned";
    description.extent = {0.0, 0.0, example_.side_m(), example_.side_m()};
    description.patches = {example_.texel_m, atlas::tile_side};
    description.scene_hash = "none";
    for (int i = 0; i < 12; ++i) description.aspects.azimuths_rad.push_back(i * pi / 6.0);
    for (const double elevation : {5.0, 37.0}) {
      description.aspects.elevations_rad.push_back(radians_from_deg(elevation));
    }
    description.aspects.frequencies_hz = {10e9};
    const atlas::Store made = atlas::Store::create(folder_.path("atlas"), description);
    for (const atlas::Unit& unit : made.units()) {
      const radar::GroundGrid grid = description.patches.texels_of(unit.patch);
      Array2D<radar::Channels> texels(grid.columns, grid.rows);
      for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
          texels(column, row) =
              sigma0(grid.centre_of(column, row) - example_.middle(), description.aspects.look(unit.look));
        }
      }
      made.write(unit.patch, unit.look, texels, {});
    }
    return made;
  }

  double angle_rad_;
  ScratchFolder folder_;
  ExampleGround example_;
  std::unique_ptr<atlas::Store> store_;
  std::shared_ptr<LiveGround> ground_;
};

TEST(LiveRotation, OfPlaceAndRadarTogetherChangesNothing) {
  const std::vector<double> upright = TurnedPlace(0.0).blocks();
  double greatest = 0.0;
  for (const double block : upright) greatest = std::max(greatest, block);
  for (const double angle_deg : {37.0, 145.0}) {
    const std::vector<double> turned = TurnedPlace(angle_deg).blocks();
    double sum = 0.0, sum_turned = 0.0;
    for (std::size_t i = 0; i < upright.size(); ++i) {
      sum += upright[i];
      sum_turned += turned[i];
      // Scatterers stand elsewhere in their cells: at edges of blocks that shows, most where they are dark.
      EXPECT_NEAR(turned[i], upright[i], 0.02 * greatest) << angle_deg << "°, block " << i;
    }
    EXPECT_NEAR(db_from_linear(sum_turned / sum), 0.0, 0.1) << angle_deg;
    EXPECT_GT(greatest, 3.0 * sum / static_cast<double>(upright.size())) << "the place has a shape";
  }
}

}  // namespace
}  // namespace sigmascape::live
