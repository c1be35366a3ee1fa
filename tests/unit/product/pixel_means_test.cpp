#include "sigmascape/product/pixel_means.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vec.h"

namespace sigmascape::product {
namespace {

using radar::Channels;

/// 400 m of range from the first on, nothing in their bins.
radar::RangeAzimuthImage empty_image(double first_range_m, double range_step_m, double azimuth_step_deg,
                                     double turn_deg) {
  radar::RangeAzimuthImage image;
  image.grid = {.first_range_m = first_range_m,
                .range_step_m = range_step_m,
                .ranges = static_cast<std::size_t>(std::lround(400.0 / range_step_m)),
                .first_azimuth_rad = radians_from_deg(20.0),
                .azimuth_step_rad = radians_from_deg(azimuth_step_deg),
                .azimuths = static_cast<std::size_t>(std::lround(turn_deg / azimuth_step_deg))};
  image.rcs_m2 = Array2D<Channels>(image.grid.azimuths, image.grid.ranges);
  return image;
}

/// Pixels all round the radar, as far as its bins reach.
radar::GroundGrid pixels_about(const radar::RangeAzimuthImage& image, double pixel_m) {
  const double far_m = image.grid.first_range_m + 400.0;
  const auto side = static_cast<std::size_t>(std::ceil(2.0 * far_m / pixel_m));
  return {-far_m, far_m, pixel_m, side, side};
}

/// Of the bins: σ0 times their areas r Δr Δφ.
void fill_with(radar::RangeAzimuthImage& image, float sigma0) {
  for (std::size_t range = 0; range < image.grid.ranges; ++range) {
    const double range_m = image.grid.first_range_m + (static_cast<double>(range) + 0.5) * image.grid.range_step_m;
    const auto rcs_m2 = static_cast<float>(range_m * image.grid.range_step_m * image.grid.azimuth_step_rad) * sigma0;
    for (Channels& bin : image.rcs_m2.row(range)) bin = {rcs_m2, 2.0F * rcs_m2, 0.1F * rcs_m2, -rcs_m2};
  }
}

double cross_section_m2(const Array2D<Channels>& sigma0, const radar::GroundGrid& pixels) {
  double sum = 0.0;
  for (const Channels& pixel : sigma0.values()) sum += std::isnan(pixel.vv) ? 0.0 : static_cast<double>(pixel.vv);
  return sum * pixels.cell_area_m2();
}

// σ = Σ σ0 A over the pixels, wherever the bin lies between their centres: along a whole pixel in both directions.
TEST(PixelMeans, ABrightBinKeepsItsCrossSectionWhereverItLies) {
  for (const double range_step_m : {0.1, 0.5, 2.0, 20.0}) {
    for (const double azimuth_step_deg : {0.05, 0.5}) {
      radar::RangeAzimuthImage image = empty_image(600.0, range_step_m, azimuth_step_deg, 5.0);
      const radar::GroundGrid pixels = pixels_about(image, 4.0);
      for (std::size_t i = 0; i < 20; ++i) {
        const std::size_t azimuth = image.grid.azimuths / 3 + i % (image.grid.azimuths / 3);
        const std::size_t range = image.grid.ranges / 3 + i * 7 % (image.grid.ranges / 3);
        image.rcs_m2(azimuth, range).vv = 1e5F;
        const double kept_m2 = cross_section_m2(pixel_means(image, pixels, radians_from_deg(10.0)), pixels);
        EXPECT_NEAR(db_from_linear(kept_m2 / 1e5), 0.0, 0.5) << range_step_m << " m, bin " << azimuth << ", " << range;
        image.rcs_m2(azimuth, range).vv = 0.0F;
      }
    }
  }
}

// Bins before the opening of the gate and after its closing, and azimuths that the antenna never turned to.
TEST(PixelMeans, BinsThatWereNotSeenDarkenNoOthers) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const double range_step_m : {0.5, 40.0}) {
    radar::RangeAzimuthImage image = empty_image(600.0, range_step_m, 1.0, 40.0);
    fill_with(image, 0.25F);
    const double opens_m = 680.0, closes_m = 960.0;
    for (std::size_t range = 0; range < image.grid.ranges; ++range) {
      const double range_m = 600.0 + (static_cast<double>(range) + 0.5) * range_step_m;
      for (std::size_t azimuth = 0; azimuth < image.grid.azimuths; ++azimuth)
        if (range_m < opens_m || range_m > closes_m || azimuth < 10)
          image.rcs_m2(azimuth, range) = {nan, nan, nan, nan};
    }
    const radar::GroundGrid pixels = pixels_about(image, 5.0);
    const auto sigma0 = pixel_means(image, pixels, 0.0);
    double seen_m2 = 0.0;
    for (std::size_t row = 0; row < pixels.rows; ++row) {
      for (std::size_t column = 0; column < pixels.columns; ++column) {
        const float here = sigma0(column, row).vv;
        if (std::isnan(here)) continue;
        seen_m2 += pixels.cell_area_m2();
        ASSERT_NEAR(here, 0.25F, 1e-5F) << range_step_m;
        const double range_m = length(pixels.centre_of(column, row));
        ASSERT_GT(range_m, opens_m - 4.0);
        ASSERT_LT(range_m, closes_m + 4.0);
      }
    }
    const double sector_m2 = radians_from_deg(30.0) / 2.0 * (closes_m * closes_m - opens_m * opens_m);
    EXPECT_NEAR(seen_m2, sector_m2, 5.0 * (2.0 * 300.0 + radians_from_deg(30.0) * (opens_m + closes_m)));
  }
}

TEST(PixelMeans, EvenGroundIsEvenInEveryPixel) {
  for (const auto& [first_range_m, range_step_m, azimuth_step_deg, turn_deg] :
       {std::array{600.0, 0.5, 0.05, 5.0}, std::array{600.0, 40.0, 2.0, 60.0}, std::array{0.0, 1.0, 0.5, 360.0},
        std::array{0.0, 40.0, 45.0, 360.0}}) {
    radar::RangeAzimuthImage image = empty_image(first_range_m, range_step_m, azimuth_step_deg, turn_deg);
    fill_with(image, 0.25F);
    const radar::GroundGrid pixels = pixels_about(image, 5.0);
    const auto sigma0 = pixel_means(image, pixels, 0.0);
    double seen_m2 = 0.0;
    for (const Channels& pixel : sigma0.values()) {
      if (std::isnan(pixel.vv)) continue;
      seen_m2 += pixels.cell_area_m2();
      ASSERT_NEAR(pixel.vv, 0.25F, 1e-5F);
      ASSERT_NEAR(pixel.hh, 0.5F, 2e-5F);
      ASSERT_NEAR(pixel.hv, 0.025F, 1e-6F);
      ASSERT_NEAR(pixel.re_vvhh, -0.25F, 1e-5F);
    }
    // Every pixel that the sector reaches into, and no other.
    const double far_m = first_range_m + 400.0, turn_rad = radians_from_deg(turn_deg);
    const double sector_m2 = turn_rad / 2.0 * (far_m * far_m - first_range_m * first_range_m);
    const double edge_m = turn_rad * (far_m + first_range_m) + (turn_deg < 360.0 ? 800.0 : 0.0);
    EXPECT_GE(seen_m2, 0.999 * sector_m2);
    EXPECT_LE(seen_m2, sector_m2 + edge_m * std::sqrt(2.0) * pixels.cell_m);
  }
}

// One ring of bins is of σ0 = 1 among others of none: a linear fall from its centre to theirs.
TEST(PixelMeans, IsLinearBetweenBinsWiderThanPixels) {
  radar::RangeAzimuthImage image = empty_image(1000.0, 50.0, 10.0, 140.0);
  radar::RangeAzimuthImage even = image;
  fill_with(even, 1.0F);
  for (Channels& bin : image.rcs_m2.row(3)) bin = even.rcs_m2(0, 3);
  const radar::GroundGrid pixels{0.0, 1450.0, 1.0, 1450, 2900};
  const auto sigma0 = pixel_means(image, pixels, 0.0);
  const auto at = [&](double range_m) {
    const Vec2d cells = pixels.cells_from({range_m, 0.0});
    return sigma0(static_cast<std::size_t>(cells.x), static_cast<std::size_t>(cells.y)).vv;
  };
  const double centre_m = 1000.0 + 3.5 * 50.0;
  EXPECT_NEAR(at(centre_m), 1.0F, 0.03F);
  EXPECT_NEAR(at(centre_m + 10.0), 0.8F, 0.03F);
  EXPECT_NEAR(at(centre_m - 25.0), 0.5F, 0.03F);
  EXPECT_NEAR(at(centre_m + 40.0), 0.2F, 0.03F);
  EXPECT_EQ(at(centre_m + 60.0), 0.0F);
}

}  // namespace
}  // namespace sigmascape::product
