#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "keep_worst.h"
#include "physics/level_scene.h"
#include "physics/ulaby_dobson_curves.h"
#include "scratch_folder.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"

namespace sigmascape::physics_test {
namespace {

constexpr double lambert_albedo = 0.4;
constexpr double cross_ratio = 0.1;
constexpr const char* flat_ground_group = "Flat ground, baked";

scatter::Material lambert_ground() {
  return {.name = "lambert", .model = scatter::LambertParameters{lambert_albedo, {cross_ratio, 0.5}}, .source = {}};
}

scatter::Material tabulated_ground(Class terrain) {
  return {.name = fmt::format("class {}", static_cast<int>(terrain)),
          .model = scatter::UlabyDobsonParameters{.terrain = terrain},
          .source = {}};
}

/// The albedo is that of both receive polarizations together.
double lambert_sigma0_vv(double elevation_rad) {
  return 4.0 * lambert_albedo * std::pow(std::sin(elevation_rad), 2) / (1.0 + cross_ratio);
}

double gamma_sigma0_vv(double elevation_rad) {
  return ground_gamma * std::sin(elevation_rad);
}

double channel_of(const radar::Channels& power, Channel channel) {
  return static_cast<double>(channel == Channel::HH ? power.hh : channel == Channel::VV ? power.vv : power.hv);
}

/// Squares of ground side by side, as a printer's colour card: baked, stored and read back, their inner texels
/// averaged.
class SampleCard {
 public:
  static constexpr double square_m = 32.0;

  SampleCard(std::filesystem::path folder, const std::vector<scatter::Material>& grounds, double texel_m,
             std::vector<double> elevations_rad, double at_frequency_hz)
      : folder_(std::move(folder)) {
    const auto count = grounds.size();
    const double width_m = square_m * static_cast<double>(count);
    scene::Scene scene;
    scene.name = "sample card";
    scene.extent = {0, 0, width_m, square_m};
    scene.terrain = {0, width_m, width_m, Array2D<float>(2, 2, 0.0F)};
    scene.ground = {{0, square_m, square_m, count, 1}, Array2D<scene::MaterialIndex>(count, 1)};
    for (std::size_t i = 0; i < count; ++i) scene.ground.material(i, 0) = scene.material_index(grounds[i]);
    settings_.aspects = {{radians_from_deg(130.0)}, std::move(elevations_rad), {at_frequency_hz}};
    settings_.patches = {texel_m, 256};
    settings_.sampling.samples_per_texel = 4;
    settings_.shadows = bake::Shadows::Baked;
    SilentProgress silent;
    bake::bake(scene, settings_, folder_, silent);
  }

  /// σ0 of square `square`, the outer 4 m left out.
  [[nodiscard]] radar::Channels sigma0(std::size_t square, std::size_t elevation) const {
    const auto store = atlas::Store::open(folder_);
    const double west = square_m * static_cast<double>(square) + 4.0, south = 4.0, inner = square_m - 8.0;
    const atlas::PatchIndex patch = settings_.patches.patch_at({west + inner / 2.0, south + inner / 2.0});
    const auto& texels = texture(store, patch, settings_.aspects.index_of(0, elevation, 0));
    const radar::GroundGrid grid = settings_.patches.texels_of(patch);
    const Vec2d corner = grid.cells_from({west, south + inner});
    const auto side = static_cast<std::size_t>(inner / grid.cell_m);
    radar::Channels mean;
    for (std::size_t row = 0; row < side; ++row) {
      for (std::size_t column = 0; column < side; ++column) {
        mean += texels(static_cast<std::size_t>(corner.x) + column, static_cast<std::size_t>(corner.y) + row) *
                (1.0F / static_cast<float>(side * side));
      }
    }
    return mean;
  }

 private:
  const Array2D<radar::Channels>& texture(const atlas::Store& store, atlas::PatchIndex patch,
                                          atlas::LookIndex look) const {
    auto& kept = textures_[{patch.x, look}];
    if (kept.size() == 0) kept = store.read(patch, look).front();
    return kept;
  }

  std::filesystem::path folder_;
  bake::BakeSettings settings_;
  mutable std::map<std::pair<int, atlas::LookIndex>, Array2D<radar::Channels>> textures_;
};

std::vector<double> in_radians(std::vector<double> degrees) {
  for (double& angle : degrees) angle = radians_from_deg(angle);
  return degrees;
}

void expect_baked_db(const std::string& name, double expected, double measured, const char* source) {
  validation::expect_close({.group = flat_ground_group,
                            .name = name,
                            .expected = db_from_linear(expected),
                            .measured = db_from_linear(measured),
                            .tolerance = 0.05,
                            .unit = "dB",
                            .source = source});
}

TEST(FlatGround, LambertAndConstantGammaFromTwoToSixtyDegreesOfGrazing) {
  const std::vector<double> elevations_deg{2.0, 5.0, 13.0, 30.0, 45.0, 60.0};
  const ScratchFolder folder;
  const SampleCard card(folder.path("card"), {lambert_ground(), gamma_ground()}, 1.0, in_radians(elevations_deg),
                        frequency_hz);
  for (std::size_t i = 0; i < elevations_deg.size(); ++i) {
    const double elevation_rad = radians_from_deg(elevations_deg[i]);
    const auto name = [&](const char* ground, const char* channel) {
      return fmt::format("{}, elevation {}°, {}", ground, elevations_deg[i], channel);
    };
    const radar::Channels lambert = card.sigma0(0, i), natural = card.sigma0(1, i);
    expect_baked_db(name("Lambert, albedo 0.4, a tenth across", "VV"), lambert_sigma0_vv(elevation_rad),
                    static_cast<double>(lambert.vv), "4ρ sin²ψ / (1 + x)");
    expect_baked_db(name("Lambert, albedo 0.4, a tenth across", "all receive"),
                    4.0 * lambert_albedo * std::pow(std::sin(elevation_rad), 2),
                    static_cast<double>(lambert.vv + lambert.hv), "4ρ sin²ψ");
    expect_baked_db(name("constant gamma 0.03", "VV"), gamma_sigma0_vv(elevation_rad), static_cast<double>(natural.vv),
                    "γ sin ψ");
    expect_baked_db(name("constant gamma 0.03", "HV"), cross_ratio * gamma_sigma0_vv(elevation_rad),
                    static_cast<double>(natural.hv), "γ x sin ψ");
  }
}

// All 51 rows, each in its band, from almost the zenith to 70° of incidence.
TEST(FlatGround, EveryVerifiedRowOfUlabyAndDobson) {
  // The angles of the curves as elevations, in the order in which an axis must ascend, and one more next to the zenith.
  std::vector<double> elevations_deg{89.0};
  for (const double incidence_deg : incidences_deg) elevations_deg.insert(elevations_deg.begin(), 90.0 - incidence_deg);
  for (const Band band : {Band::L, Band::S, Band::C}) {
    std::vector<Class> classes;
    for (const Curve& curve : curves) {
      if (curve.band == band && curve.channel == Channel::VV) classes.push_back(curve.terrain);
    }
    std::vector<scatter::Material> grounds(classes.size());
    std::ranges::transform(classes, grounds.begin(), tabulated_ground);
    const ScratchFolder folder;
    const SampleCard card(folder.path("card"), grounds, 1.0, in_radians(elevations_deg), frequency_in(band));
    for (const Curve& curve : curves) {
      if (curve.band != band) continue;
      const auto square = static_cast<std::size_t>(std::ranges::find(classes, curve.terrain) - classes.begin());
      const auto error_db = [&](std::size_t elevation, double expected_db) {
        return db_from_linear(channel_of(card.sigma0(square, elevation), curve.channel)) - expected_db;
      };
      const auto& row = row_of(curve);
      double worst = error_db(7, db_from_linear(row.sigma0(radians_from_deg(1.0))));
      for (std::size_t i = 0; i < incidences_deg.size(); ++i) {
        // Some rows end before the curves do.
        const bool is_fit = incidences_deg[i] <= row.greatest_incidence_deg;
        const double expected_db =
            is_fit ? curve.sigma0_db[i] : db_from_linear(row.sigma0(radians_from_deg(incidences_deg[i])));
        const double error = error_db(6 - i, expected_db);
        keep_worst(worst, error);
      }
      validation::expect_close({.group = flat_ground_group,
                                .name = name_of(curve) + ", worst error of 1 to 70° of incidence",
                                .expected = 0.0,
                                .measured = worst,
                                .tolerance = 0.05,
                                .unit = "dB",
                                .source = ulaby_dobson_source});
    }
  }
}

TEST(FlatGround, TheSizeOfTexelsDoesNotMatter) {
  const std::vector<scatter::Material> grounds{lambert_ground(), gamma_ground(), tabulated_ground(Class::Grass)};
  const std::vector<double> elevations_rad = in_radians({2.0, 20.0, 60.0});
  const ScratchFolder folder;
  const SampleCard middle(folder.path("1"), grounds, 1.0, elevations_rad, 5.405e9);
  for (const double texel_m : {0.5, 2.0, 4.0}) {
    const SampleCard other(folder.path(fmt::format("{}", texel_m)), grounds, texel_m, elevations_rad, 5.405e9);
    double worst = 0.0;
    for (std::size_t square = 0; square < grounds.size(); ++square) {
      for (std::size_t elevation = 0; elevation < elevations_rad.size(); ++elevation) {
        const double change_db = db_from_linear(
            static_cast<double>(other.sigma0(square, elevation).vv / middle.sigma0(square, elevation).vv));
        keep_worst(worst, change_db);
      }
    }
    validation::expect_close(
        {.group = flat_ground_group,
         .name = fmt::format("texels of {} m against 1 m, worst change of three grounds at 2, 20 and 60°", texel_m),
         .expected = 0.0,
         .measured = worst,
         .tolerance = 0.02,
         .unit = "dB",
         .source = "σ0 is a density over area"});
  }
}

/// Mean σ0_VV of the middle of level ground, by way of texels of 1 m.
double sigma0_vv(const scatter::Material& ground, double elevation_deg, double launch_cell_m, std::uint32_t samples) {
  const radar::Aspect aspect{radians_from_deg(130.0), radians_from_deg(elevation_deg)};
  const auto echoes = traced_echoes(level_scene(ground), aspect,
                                    {.area = {-32, -32, 32, 32}, .cell_m = launch_cell_m, .samples = samples}, 5.405e9);
  return landed(echoes, aspect, {-32, 32, 1.0, 64, 64}).bins().total()[0] / (64.0 * 64.0);
}

TEST(FlatGround, TheSizeOfPixelsDoesNotMatter) {
  for (const double cell_m : {0.5, 2.0, 4.0}) {
    double worst = 0.0;
    for (const scatter::Material& ground : {lambert_ground(), gamma_ground(), tabulated_ground(Class::Grass)}) {
      for (const double elevation_deg : {2.0, 20.0, 60.0}) {
        const double change = sigma0_vv(ground, elevation_deg, cell_m, 16) / sigma0_vv(ground, elevation_deg, 1.0, 16);
        keep_worst(worst, db_from_linear(change));
      }
    }
    validation::expect_close(
        {.group = flat_ground_group,
         .name = fmt::format("pixels of {} m against 1 m, worst change of three grounds at 2, 20 and 60°", cell_m),
         .expected = 0.0,
         .measured = worst,
         .tolerance = 0.02,
         .unit = "dB",
         .source = "a ray stands for the area it was drawn from"});
  }
}

// Kirchhoff: σ0 = π D |R|² G, for Beckmann exp(−tan²θ/α²) / (α² cos⁴θ) where masking is absent.
TEST(FlatGround, BeckmannIsGeometricOptics) {
  const std::vector<double> incidences{30.0, 20.0, 10.0, 1.0};
  std::vector<double> elevations_deg;
  for (const double incidence : incidences) elevations_deg.push_back(90.0 - incidence);
  const ScratchFolder folder;
  const SampleCard card(folder.path("card"), {rough_conductor("rough", 0.3)}, 1.0, in_radians(elevations_deg),
                        frequency_hz);
  for (std::size_t i = 0; i < incidences.size(); ++i) {
    const double theta = radians_from_deg(incidences[i]);
    expect_baked_db(fmt::format("conductor, Beckmann α 0.3, incidence {}°, VV", incidences[i]),
                    std::exp(-std::pow(std::tan(theta) / 0.3, 2)) / (0.09 * std::pow(std::cos(theta), 4)),
                    static_cast<double>(card.sigma0(0, i).vv), "Kirchhoff geometric optics");
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
