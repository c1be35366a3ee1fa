#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "physics/textbook_strip.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/receiver/pulse_receiver.h"
#include "sigmascape/receiver/stripmap_imager.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

constexpr std::string_view ambiguity_group = "Azimuth ambiguities";
constexpr double x_band_m = 0.03, speed_mps = 100.0, middle_range_m = 10e3, thin_resolution_m = 1.0;

/// Flies north and looks east, with a uniform aperture of two degrees and far too few pulses: the first ambiguity is in
/// the first side lobe.
radar::Radar thin_radar() {
  radar::Radar radar;
  radar.frequency_hz = speed_of_light_mps / x_band_m;
  radar.range_resolution_m = thin_resolution_m;
  radar.beam_width_rad = radians_from_deg(2.0);
  radar.antenna.azimuth = radar::ApertureBeam{{.shape = radar::WindowShape::Rectangular}};
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  radar.waveform.pulse_repetition_hz = 300.0;
  radar.velocity_mps = {0.0, speed_mps, 0.0};
  radar.mode = radar::Mode::Stripmap;
  return radar;
}

const double processed_hz = 0.8859 * speed_mps / thin_resolution_m;  // of the even window

/// Energy and middle of what a patch of an image holds.
struct Patch {
  double energy = 0.0, along_m = 0.0, across_m = 0.0;
  void add(double power, double s, double r) {
    energy += power;
    along_m += power * s;
    across_m += power * r;
  }
  [[nodiscard]] Patch over(double cells) const { return {energy * cells, along_m / energy, across_m / energy}; }
};

Patch from_pulses(const radar::PhaseHistory& history, const TextbookStrip& processor, double middle_m,
                  double half_along_m, double half_across_m) {
  constexpr double step_m = 0.6;
  Patch patch;
  for (double r = middle_range_m - half_across_m; r <= middle_range_m + half_across_m; r += step_m) {
    for (double s = middle_m - half_along_m; s <= middle_m + half_along_m; s += step_m)
      patch.add(std::norm(processor.focused(history, s, r)), s, r);
  }
  return patch.over(step_m * step_m);
}

Patch from_image(const radar::StripmapImage& image, double middle_m, double half_along_m) {
  Patch patch;
  for (std::size_t row = 0; row < image.closest_range_m.bins; ++row) {
    for (std::size_t column = 0; column < image.along_m.bins; ++column) {
      const double s = image.along_m.middle_of(static_cast<double>(column) + 0.5);
      if (std::abs(s - middle_m) > half_along_m) continue;
      patch.add(std::norm(image.amplitude_m(column, row).vv), s,
                image.closest_range_m.middle_of(static_cast<double>(row) + 0.5));
    }
  }
  return patch.over(image.along_m.step * image.closest_range_m.step);
}

/// A ghost of a point has the place, the extent and the energy that a processor makes of the pulses themselves.
TEST(AzimuthAmbiguity, is_where_and_what_a_processor_makes_of_thin_pulses) {
  const auto radar = thin_radar();
  const radar::AntennaCut beam = radar::antenna_pattern(radar).azimuth();
  const TextbookStrip processor{x_band_m, speed_mps, processed_hz, beam};
  radar::Target target;
  target.track = radar::Track::straight({middle_range_m, 0.0, 0.0});
  target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  const std::vector<radar::Target> targets{target};
  // A ghost lies λ r f_p/2V = 450 m off; the pulses that show it are sent from there.
  const double shift_m = x_band_m * middle_range_m * 300.0 / (2.0 * speed_mps);
  const auto pulses_about = [&](double along_m) {
    const receiver::PulseReceiver receiver(radar, {middle_range_m - 40.0, middle_range_m + 60.0, 8.0});
    const auto voltage = [&beam](const radar::Pulse& pulse, Vec3d position, double) {
      const Vec3d away = position - pulse.platform.position;
      return static_cast<float>(beam.power(std::atan2(away.y, away.x)));
    };
    return receiver.receive(radar::Track::straight({}, radar.velocity_mps),
                            {.first_time_s = along_m / speed_mps - 1.2, .count = 721, .repetition_hz = 300.0}, {},
                            targets, voltage);
  };
  receiver::StripmapImager alone(radar, {{}, radar.velocity_mps},
                                 {.first_along_m = -600.0,
                                  .last_along_m = 600.0,
                                  .resolution_m = thin_resolution_m,
                                  .window = radar.waveform.window},
                                 {middle_range_m - 60.0, middle_range_m + 60.0, 1.5});
  // Side lobes of the point itself are as strong as its ghosts: they are looked at apart.
  receiver::StripmapImager ghosts = alone;
  alone.add(targets);
  for (const auto& ambiguity : ghosts.ambiguities()) ghosts.add(targets, ambiguity.order);
  const auto image = ghosts.image();

  const Patch main_pulses = from_pulses(pulses_about(0.0), processor, 0.0, 12.0, 12.0),
              main_image = from_image(alone.image(), 0.0, 40.0);
  EXPECT_NEAR(db_from_linear(main_image.energy / main_pulses.energy), 0.0, 0.4);
  for (const int side : {-1, 1}) {
    const double there_m = side * shift_m;
    const Patch of_pulses = from_pulses(pulses_about(there_m), processor, there_m, 40.0, 20.0);
    const Patch of_image = from_image(image, there_m, 60.0);
    const std::string name = side < 0 ? ", behind" : ", ahead";
    validation::expect_close({ambiguity_group, "energy of the first ghost over the point's" + name,
                              db_from_linear(of_pulses.energy / main_pulses.energy),
                              db_from_linear(of_image.energy / main_image.energy), 0.5, "dB",
                              "back-projected pulses, pattern undone"});
    validation::expect_close({ambiguity_group, "place of the first ghost" + name, of_pulses.along_m, of_image.along_m,
                              1.5, "m", "back-projected pulses"});
    validation::expect_close({ambiguity_group, "closest range of the first ghost" + name, of_pulses.across_m,
                              of_image.across_m, 1.0, "m", "back-projected pulses"});
    EXPECT_NEAR(of_pulses.along_m, there_m, 10.0);
    // And there is none half way.
    EXPECT_LT(from_image(image, 0.5 * there_m, 60.0).energy, 0.05 * of_image.energy);
  }
}

/// Of a wide beam a ghost comes from far off: what is seen at the range r k λ f_p/2v ahead of where it is believed.
TEST(AzimuthAmbiguity, of_wide_beams_comes_from_where_the_range_says) {
  constexpr double p_band_m = 0.7, height_m = 3e3, near_m = 10.4e3, far_m = 10.9e3;
  radar::Radar radar = thin_radar();
  radar.frequency_hz = speed_of_light_mps / p_band_m;
  radar.beam_width_rad = radians_from_deg(40.0);
  radar.range_resolution_m = 5.0;
  radar.waveform.pulse_repetition_hz = 150.0;
  const receiver::StripmapImager imager(
      radar, {{0.0, 0.0, height_m}, radar.velocity_mps},
      {.first_along_m = -250.0, .last_along_m = 250.0, .resolution_m = 10.0, .window = radar.waveform.window},
      {near_m, far_m, 1.5});
  std::size_t first_ghosts = 0;
  for (const receiver::AzimuthAmbiguity& ghost : imager.ambiguities()) {
    if (std::abs(ghost.order) != 1) continue;
    ++first_ghosts;
    const double ahead = ghost.order * p_band_m * 150.0 / (2.0 * speed_mps);
    const auto [least, most] = std::minmax({-ahead * near_m, -ahead * far_m});
    EXPECT_NEAR(ghost.least_shift_m, least, 0.02 * std::abs(least)) << ghost.order;
    EXPECT_NEAR(ghost.most_shift_m, most, 0.02 * std::abs(most)) << ghost.order;
  }
  EXPECT_EQ(first_ghosts, 2U);
}

/// A gate that opens at the radar holds nothing before the ground below it.
TEST(AzimuthAmbiguity, of_a_gate_from_nought_begins_at_the_ground) {
  radar::Radar radar = thin_radar();
  radar.range_resolution_m = 3.0;
  const auto imager = [&](double first_m) {
    return receiver::StripmapImager(radar, {{0.0, 0.0, 3e3}, radar.velocity_mps},
                                    {.first_along_m = -50.0, .last_along_m = 50.0, .resolution_m = 3.0},
                                    {first_m, 12.1e3, 1.5});
  };
  EXPECT_NO_THROW((void)imager(0.0));
  const auto of_nought = imager(0.0).ambiguities(), of_ground = imager(3e3).ambiguities();
  ASSERT_FALSE(of_nought.empty());
  ASSERT_EQ(of_nought.size(), of_ground.size());
  for (std::size_t i = 0; i < of_nought.size(); ++i) {
    EXPECT_NEAR(of_nought[i].least_shift_m, of_ground[i].least_shift_m, 1e-3 * std::abs(of_ground[i].least_shift_m));
    EXPECT_NEAR(of_nought[i].most_shift_m, of_ground[i].most_shift_m, 1e-3 * std::abs(of_ground[i].most_shift_m));
  }
}

/// Of even ground the ghosts have what the integral of the pattern says: the azimuth ambiguity ratio of the textbook.
TEST(AzimuthAmbiguity, of_even_ground_is_the_integral_of_the_pattern) {
  constexpr double along_resolution_m = 4.0, depression = 0.3;
  const double cosine = std::cos(depression);
  auto radar = thin_radar();
  radar.position = {0.0, 0.0, middle_range_m * std::sin(depression)};
  const terrain::HeightField terrain{
      .west_m = 9000.0, .north_m = 6000.0, .spacing_m = 100.0, .height_m = Array2D<float>(11, 121, 0.0F)};
  const render::Reflectivity even = [](Vec2d, const radar::Aspect&) { return radar::Channels{0.1F, 0.1F, 0.0F, 0.0F}; };
  const double ground_m = middle_range_m * cosine;
  // A strip so long that ghosts of the first orders fall into its middle third from both sides.
  const auto scatterers = render::ground_scatterers(
      terrain, even, radar::ScattererLattice({.seed = 5, .cell_m = 2.0}),
      {.vantage = radar::Vantage(radar.position), .area = {ground_m - 90.0, -1150.0, ground_m + 60.0, 1150.0}});
  const auto power_of = [&](bool ghosts) {
    receiver::StripmapImager imager(radar, {radar.position, radar.velocity_mps},
                                    {.first_along_m = -100.0,
                                     .last_along_m = 100.0,
                                     .resolution_m = along_resolution_m,
                                     .window = radar.waveform.window},
                                    {middle_range_m - 20.0, middle_range_m + 20.0, 1.5});
    if (!ghosts) imager.add(scatterers);
    for (const auto& ambiguity : imager.ambiguities()) {
      if (ghosts && std::abs(ambiguity.order) <= 2) imager.add(scatterers, 0, ambiguity.order);
    }
    double sum = 0.0;
    const auto image = imager.image();
    for (const auto& bin : image.amplitude_m.values()) sum += static_cast<double>(std::norm(bin.vv));
    return sum;
  };
  const radar::AntennaCut beam = radar::antenna_pattern(radar).azimuth();
  const double band_hz = 0.8859 * speed_mps / along_resolution_m;
  const auto angle = [&](double hz) { return std::asin(x_band_m * hz / (2.0 * speed_mps * cosine)); };
  double ratio = 0.0;
  constexpr int parts = 200;
  for (const int order : {-2, -1, 1, 2}) {
    for (int k = 0; k < parts; ++k) {
      const double f = ((k + 0.5) / parts - 0.5) * band_hz;
      ratio += std::pow(beam.power(angle(f + order * 300.0)) / beam.power(angle(f)), 2.0) / parts;
    }
  }
  validation::expect_close({ambiguity_group, "ghosts over ground, even ground", db_from_linear(ratio),
                            db_from_linear(power_of(true) / power_of(false)), 0.5, "dB", "∫ g⁴(f + k f_p)/g⁴(f) df"});
}

/// The map of a mode shows ghosts of what lies beside it, unless they are refused.
TEST(AzimuthAmbiguity, falls_into_maps_from_beside_them) {
  auto radar = thin_radar();
  radar.position = {-middle_range_m * std::cos(0.3), 0.0, middle_range_m * std::sin(0.3)};
  const terrain::HeightField terrain{
      .west_m = -300.0, .north_m = 1000.0, .spacing_m = 100.0, .height_m = Array2D<float>(7, 21, 0.0F)};
  // Bright ground from 400 m north on, and none in the map, which ends 300 m before it.
  const render::Reflectivity far_off = [](Vec2d place, const radar::Aspect&) {
    const float sigma0 = place.y > 400.0 && place.y < 500.0 ? 1.0F : 0.0F;
    return radar::Channels{sigma0, sigma0, 0.0F, 0.0F};
  };
  // In the part of the image that is of the map, be it all of it or not.
  const auto power = [&](bool ambiguities, double north_m) {
    radar.processing.ambiguities = ambiguities;
    const auto image = simulate::stripmap_image({&terrain, far_off}, radar, {-50.0, -60.0, 50.0, north_m},
                                                {.along_resolution_m = 4.0, .scatterer_spacing_m = 2.0});
    double sum = 0.0;
    for (std::size_t column = 0; column < image.along_m.bins; ++column) {
      if (std::abs(image.along_m.middle_of(static_cast<double>(column) + 0.5)) > 60.0) continue;
      for (std::size_t row = 0; row < image.closest_range_m.bins; ++row)
        sum += static_cast<double>(std::norm(image.amplitude_m(column, row).vv));
    }
    return sum;
  };
  EXPECT_EQ(power(false, 60.0), 0.0);
  EXPECT_GT(power(true, 60.0), 0.0);
  // But for the side lobes of the bright ground, which a map that holds it has as well.
  const double of_ghosts = power(true, 520.0) - power(false, 520.0);
  EXPECT_NEAR(db_from_linear(power(true, 60.0) / of_ghosts), 0.0, 0.3);
}

/// A ghost stands farther out than what casts it, here by λ² r f_p²/8V² and as much again for the slope of the sight:
/// ground nearer to the track than the map has its ghosts in it, with the energy that a map of both shows there.
TEST(AzimuthAmbiguity, falls_into_maps_from_before_their_near_edge) {
  auto radar = thin_radar();
  radar.position = {-middle_range_m * std::cos(0.3), 0.0, middle_range_m * std::sin(0.3)};
  const double folded_m = x_band_m * middle_range_m * radar.waveform.pulse_repetition_hz / (2.0 * speed_mps);
  const double outwards_m = 0.5 * folded_m * folded_m / middle_range_m / std::cos(0.3);
  const terrain::HeightField terrain{
      .west_m = -300.0, .north_m = 1000.0, .spacing_m = 100.0, .height_m = Array2D<float>(7, 21, 0.0F)};
  const double middle_m = -50.0 - 0.4 * outwards_m;
  const render::Reflectivity patch = [=](Vec2d place, const radar::Aspect&) {
    const bool is_in = std::abs(place.x - middle_m) < 4.0 && std::abs(place.y - folded_m) < 20.0;
    const float sigma0 = is_in ? 1.0F : 0.0F;
    return radar::Channels{sigma0, sigma0, 0.0F, 0.0F};
  };
  const auto energy_beyond = [&](double west_m) {
    const auto image = simulate::stripmap_image({&terrain, patch}, radar, {west_m, -60.0, 50.0, 60.0},
                                                {.along_resolution_m = 4.0, .scatterer_spacing_m = 2.0});
    const double first_m = length(Vec3d{-50.0, 0.0, 0.0} - radar.position);
    double sum = 0.0;
    for (std::size_t row = 0; row < image.closest_range_m.bins; ++row) {
      if (image.closest_range_m.middle_of(static_cast<double>(row) + 0.5) < first_m) continue;
      for (std::size_t column = 0; column < image.along_m.bins; ++column)
        sum += static_cast<double>(std::norm(image.amplitude_m(column, row).vv));
    }
    return sum;
  };
  const double with_both = energy_beyond(-50.0 - 2.0 * outwards_m), with_map_alone = energy_beyond(-50.0);
  EXPECT_GT(with_both, 0.0);
  EXPECT_NEAR(db_from_linear(with_map_alone / with_both), 0.0, 1.0);
}

/// What is 3 km above the sea is seen as what is not, from as high above it.
TEST(AzimuthAmbiguity, goes_by_the_height_above_the_ground) {
  auto radar = thin_radar();
  const auto ghosts_over = [&](double ground_m) {
    radar.position = {0.0, 0.0, ground_m + 0.3 * middle_range_m};
    return receiver::StripmapImager(radar, {radar.position, radar.velocity_mps},
                                    {.first_along_m = -100.0,
                                     .last_along_m = 100.0,
                                     .resolution_m = 4.0,
                                     .window = radar.waveform.window,
                                     .ground_m = ground_m},
                                    {middle_range_m - 20.0, middle_range_m + 20.0, 1.5})
        .ambiguities();
  };
  const auto low = ghosts_over(0.0), high = ghosts_over(0.9 * middle_range_m);
  ASSERT_FALSE(low.empty());
  ASSERT_EQ(high.size(), low.size());
  for (std::size_t i = 0; i < low.size(); ++i) EXPECT_NEAR(high[i].power, low[i].power, 1e-9 * low[i].power);
}

}  // namespace
}  // namespace sigmascape
