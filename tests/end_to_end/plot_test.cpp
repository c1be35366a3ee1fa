#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "end_to_end/made_scene.h"
#include "scratch_folder.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/product/npy_bytes.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/scatter/material.h"

namespace sigmascape::end_to_end {
namespace {

using Json = nlohmann::json;

/// `sigmascape plot` as a user calls it; the numbers that it says it drew.
class Plots : public ::testing::Test {
 protected:
  [[nodiscard]] int run(const std::string& arguments) const {
    const int status = std::system(
        fmt::format("'{}' {} > '{}' 2>&1", SIGMASCAPE_CLI, arguments, folder_.path("told.json").string()).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string told() const {
    std::ifstream stream(folder_.path("told.json"));
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] Json drawn(const std::string& arguments, const std::string& ending = "svg") const {
    const auto picture = folder_.path("plot." + ending);
    EXPECT_EQ(run(fmt::format("plot {} --json --out '{}'", arguments, picture.string())), 0) << told();
    EXPECT_GT(std::filesystem::file_size(picture), 1000U);
    return Json::parse(told());
  }
  /// y of a series at the place nearest to x.
  static double value_at(const Json& series, double x) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < series.at("x").size(); ++i) {
      if (std::abs(series.at("x")[i].get<double>() - x) < std::abs(series.at("x")[best].get<double>() - x)) best = i;
    }
    return series.at("y")[best].get<double>();
  }

  std::string radar_file() const {
    return folder_
        .write("radar.toml",
               "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 2\nbeam_width_deg = 1\n"
               "[antenna]\nelevation_shape = \"gaussian\"\nelevation_width_deg = 4\ntilt_deg = -8\ngain_dbi = 30\n"
               "[waveform]\nwindow = \"rectangular\"\n"
               "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n")
        .string();
  }

  ScratchFolder folder_;
};

// σ0 = γ sin ψ of a material of constant γ: 10 lg of the sine between any two angles.
TEST_F(Plots, Sigma0OverGrazingAngleIsTheMaterialsLaw) {
  const Json plot = drawn("sigma0 urban grass --frequency-ghz 10");
  const Json& urban = plot.at("series")[0];
  EXPECT_EQ(urban.at("name").get<std::string>().substr(0, 5), "urban");
  const auto& model = std::get<scatter::ConstantGammaParameters>(scatter::library_material("urban").model);
  for (const double grazing_deg : {5.0, 30.0, 60.0, 85.0}) {
    EXPECT_NEAR(value_at(urban, grazing_deg), db_from_linear(model.gamma * std::sin(radians_from_deg(grazing_deg))),
                0.02);
  }
  EXPECT_EQ(plot.at("series").size(), 2U);
  // Of the file, before anything is made of it.
  const auto file = folder_.write("own.toml",
                                  "[terrain]\nfile = \"none.tif\"\n[materials.urban]\nbase = \"urban\"\n"
                                  "gamma_db = -15\n[materials.mine]\nbase = \"grass\"\n");
  const Json own = drawn("sigma0 urban mine --frequency-ghz 10 --scene '" + file.string() + "'");
  EXPECT_NEAR(value_at(own.at("series")[0], 30.0), -15.0 + db_from_linear(0.5), 0.02);
  EXPECT_EQ(run("plot sigma0 --out x.svg"), 1);
  EXPECT_NE(told().find("MATERIAL: is missing; name materials, or a scene with --scene"), std::string::npos) << told();
  EXPECT_EQ(run("plot sigma0 gras --out x.svg"), 1);
  EXPECT_NE(told().find("grass"), std::string::npos) << told();
}

TEST_F(Plots, AntennaIsThreeDecibelsDownAtHalfItsWidth) {
  const Json plot = drawn("antenna '" + radar_file() + "' --reach-deg 6", "png");
  const Json &azimuth = plot.at("series")[0], &elevation = plot.at("series")[1];
  EXPECT_NEAR(value_at(azimuth, 0.0), 30.0, 1e-6);
  EXPECT_NEAR(value_at(azimuth, 0.5), 30.0 - 3.0103, 0.001);
  EXPECT_NEAR(value_at(elevation, 2.0), 30.0 - 3.0103, 0.001);
  EXPECT_NEAR(value_at(elevation, -2.0), 30.0 - 3.0103, 0.001);
}

// A rectangular band: sinc² with side lobes of −13.26 dB; the two-way Gaussian beam: 6.02 dB down where one way is 3.
TEST_F(Plots, ResponsesAreThoseOfPulseAndBeam) {
  const Json pulse = drawn("response '" + radar_file() + "' --along range --widths 5").at("series")[0];
  EXPECT_NEAR(value_at(pulse, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(value_at(pulse, 1.0), -3.0103, 0.01);
  // The half-power width of sinc² is 0.8859 cells, its first side lobe at 1.4303.
  EXPECT_NEAR(value_at(pulse, 2.0 / 0.8859 * 1.4303), -13.26, 0.02);
  const Json beam = drawn("response '" + radar_file() + "' --along azimuth --widths 2").at("series")[0];
  EXPECT_NEAR(value_at(beam, 0.5), -6.0206, 0.002);
  // The numbers go on where the picture ends, 80 dB below the peak.
  EXPECT_NEAR(value_at(beam, 2.0), 16.0 * -6.0206, 0.05);
}

TEST_F(Plots, HistogramsOfSpeckleFollowTheirDensities) {
  const std::size_t side = 256;
  const radar::ScattererLattice lattice({.seed = 5, .cell_m = 1.0, .levels = 1});
  radar::GroundMap map{.grid = {0.0, 256.0, 1.0, side, side},
                       .sigma0 = Array2D<radar::Channels>(side, side),
                       .crs = geo::LocalFrame().proj(),
                       .metadata = {}};
  std::vector<std::complex<float>> samples;
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      const auto drawn = lattice.drawn({static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)}, 0);
      const radar::ComplexChannels amplitude = radar::polarized(drawn, {0.2F, 0.1F, 0.05F, 0.0F});
      map.sigma0(column, row) = radar::power_of(amplitude);
      samples.push_back(amplitude.vv);
    }
  }
  product::write_map(folder_.path("map.tif"), map);
  const std::array<std::size_t, 3> shape{side, side, 1};
  folder_.write("iq.npy", product::npy_bytes("<c8", shape, std::as_bytes(std::span(samples))));

  const Json powers = drawn("histogram '" + folder_.path("map.tif").string() + "' --polarization vv");
  EXPECT_NEAR(powers.at("mean").get<double>(), 0.2, 0.003);
  EXPECT_NEAR(powers.at("deviation_over_mean").get<double>(), 1.0, 0.02);
  const Json amplitudes = drawn("histogram '" + folder_.path("iq.npy").string() + "'", "png");
  // √(4/π − 1)
  EXPECT_NEAR(amplitudes.at("deviation_over_mean").get<double>(), 0.5227, 0.005);
  for (const auto& [plot, density] :
       {std::pair<const Json&, double (*)(double)>{powers, [](double x) { return std::exp(-x); }},
        {amplitudes, [](double x) { return 2.0 * x * std::exp(-x * x); }}}) {
    for (const double x : {0.3, 0.75, 1.5}) {
      const Json &measured = plot.at("series")[0], &expected = plot.at("series")[1];
      EXPECT_NEAR(value_at(expected, x), density(x), 0.02);
      // 65,536 samples over bins of a tenth or less: some 3 % of a density.
      EXPECT_NEAR(value_at(measured, x), density(x), 0.06);
    }
  }
  for (const char* option : {"--area 0,0,64,64", "--looks 2"})
    EXPECT_NE(run("histogram '" + folder_.path("iq.npy").string() + "' " + option + " --out '" +
                  folder_.path("no.svg").string() + "'"),
              0)
        << option;
  EXPECT_EQ(run("plot histogram '" + folder_.path("map.tif").string() + "' --area 64,0,0,64 --out x.svg"), 1);
  EXPECT_NE(told().find("--area: has west at 64 m and east at 0 m; exchange the two"), std::string::npos) << told();
  const Json part = drawn("histogram '" + folder_.path("map.tif").string() + "' --area 0,0,64,64");
  EXPECT_EQ(part.at("samples"), 64 * 64);

  geo::GeoRaster raster = geo::read_geotiff(folder_.path("map.tif"));
  std::erase_if(raster.bands, [](const geo::NamedBand& band) { return band.name != "VV"; });
  geo::write_geotiff(folder_.path("vv.tif"), raster);
  const Json of_one_band = drawn("histogram '" + folder_.path("vv.tif").string() + "' --polarization vv");
  EXPECT_EQ(of_one_band.at("mean"), powers.at("mean"));
}

// One sample of ten is one and the rest none: the mean is p = 0.1 and the variance p − p², nine times the mean squared.
TEST_F(Plots, ZerosAreOfTheSpreadOfIq) {
  const auto recording = [&](float last) {
    std::vector<std::complex<float>> samples(10);
    samples.back() = {0.0F, last};
    const std::array<std::size_t, 3> shape{10, 1, 1};
    return folder_.write("iq.npy", product::npy_bytes("<c8", shape, std::as_bytes(std::span(samples)))).string();
  };
  const Json amplitudes = drawn("histogram '" + recording(1.0F) + "'");
  EXPECT_EQ(amplitudes.at("samples"), 10);
  EXPECT_NEAR(amplitudes.at("mean").get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(amplitudes.at("deviation_over_mean").get<double>(), 3.0, 1e-12);
  EXPECT_EQ(run("plot histogram '" + recording(0.0F) + "' --out x.svg"), 1);
  EXPECT_NE(told().find("iq.npy: has no samples with power; choose another --polarization"), std::string::npos)
      << told();
}

// Level grass with houses: open ground answers alike from everywhere, as sin ψ goes.
TEST_F(Plots, APlaceOfAnAtlasAnswersByAspect) {
  const auto scene = write_made_scene(folder_.path("scene"), 160, 160);
  const std::string atlas = folder_.path("atlas").string();
  ASSERT_EQ(run(fmt::format("bake '{}' --out '{}' --patch-texels 256 --azimuths 4 --elevations-deg 10,30 --samples 2",
                            scene.string(), atlas)),
            0)
      << told();
  // Between two rows of houses, of which the nearest stands 20 m away.
  const Json over_azimuth = drawn("aspects '" + atlas + "' --at=-10,21");
  ASSERT_EQ(over_azimuth.at("series").size(), 2U);
  const Json &low = over_azimuth.at("series")[0], &high = over_azimuth.at("series")[1];
  EXPECT_EQ(high.at("name"), "elevation 30°");
  EXPECT_GT(value_at(high, 45.0), value_at(low, 45.0));
  const Json over_elevation = drawn("aspects '" + atlas + "' --at=-10,21 --over elevation", "png");
  EXPECT_EQ(over_elevation.at("series").size(), 4U);
  EXPECT_NEAR(value_at(over_elevation.at("series")[1], 30.0), value_at(high, 90.0), 0.01);
  // A curve that there is nothing to draw of is told beside its name.
  const Json crossed = drawn("aspects '" + atlas + "' --at=-10,21 --polarization hv");
  for (const Json& series : crossed.at("series")) {
    const bool is_seen = std::ranges::any_of(series.at("y"), [](const Json& y) { return y.is_number(); });
    EXPECT_EQ(series.at("name").get<std::string>().ends_with(" (below -80 dB)"), !is_seen) << series.at("name");
  }
  EXPECT_EQ(run("plot aspects '" + atlas + "' --at 900,0 --out x.svg"), 1);
  EXPECT_NE(told().find("lies outside the atlas"), std::string::npos) << told();
}

}  // namespace
}  // namespace sigmascape::end_to_end
