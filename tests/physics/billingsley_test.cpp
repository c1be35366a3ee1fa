#include "sigmascape/scatter/billingsley.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/surface_model.h"

namespace sigmascape::physics_test {
namespace {

using scatter::BillingsleyTerrain;

struct MeanStrength {
  BillingsleyTerrain terrain;
  const char* name;
  double frequency_hz;
  double grazing_deg;
  double mean_db;
};

TEST(Billingsley, MeanStrengthByDepression) {
  const MeanStrength rows[] = {
      {BillingsleyTerrain::GeneralRural, "general rural", 10e9, 0.15, -33.0},
      {BillingsleyTerrain::GeneralRural, "general rural", 3e9, 0.5, -32.0},
      {BillingsleyTerrain::GeneralRural, "general rural", 1.3e9, 1.1, -30.0},
      {BillingsleyTerrain::GeneralRural, "general rural", 0.5e9, 2.5, -27.0},
      {BillingsleyTerrain::GeneralRural, "general rural", 0.1e9, 6.0, -25.0},
      {BillingsleyTerrain::Forest, "forest", 0.1e9, 0.2, -45.0},
      {BillingsleyTerrain::Forest, "forest", 0.1e9, 0.6, -30.0},
      {BillingsleyTerrain::Forest, "forest", 0.1e9, 3.0, -15.0},
      {BillingsleyTerrain::Desert, "desert", 0.1e9, 0.15, -68.0},
      {BillingsleyTerrain::Desert, "desert", 0.1e9, 0.5, -56.0},
      {BillingsleyTerrain::Desert, "desert", 0.1e9, 3.0, -38.0},
  };
  for (const MeanStrength& row : rows) {
    const scatter::SurfaceModel model(
        {.name = row.name, .model = scatter::BillingsleyParameters{row.terrain, {0.0, 1.0}}, .source = {}},
        row.frequency_hz);
    const double psi = radians_from_deg(row.grazing_deg);
    const Vec3f to_radar = Vec3d{std::cos(psi), 0.0, std::sin(psi)}.to<float>();
    const radar::Channels brdf = model.backscatter(to_radar, Vec3f{0.0F, 0.0F, 1.0F});
    validation::expect_close(
        {.group = "Billingsley",
         .name = fmt::format("{}, {} GHz, depression {}°", row.name, row.frequency_hz / 1e9, row.grazing_deg),
         .expected = row.mean_db,
         .measured = db_from_linear(4.0 * pi * static_cast<double>(brdf.vv) * std::pow(std::sin(psi), 2)),
         .tolerance = 0.05,
         .unit = "dB",
         .source = "Billingsley 2002, interim model, mean σ0 F⁴"});
    EXPECT_EQ(brdf.vv, brdf.hh);
  }
}

// The table's angles come to within 0.02° of the step.
TEST(Billingsley, ForestReturnsMostWhereItsFirstStepEnds) {
  validation::expect_close(
      {.group = "Billingsley",
       .name = "forest, greatest albedo up to 89° of incidence, just above 1° of grazing",
       .expected = 0.414,
       .measured = scatter::billingsley({BillingsleyTerrain::Forest, {0.1, 0.5}}).greatest_albedo(),
       .tolerance = 0.005,
       .unit = "1",
       .source = "diffuse.md, Eq. (5), by quadrature in a separate program"});
}

}  // namespace
}  // namespace sigmascape::physics_test
