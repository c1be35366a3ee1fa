#include "sigmascape/product/iq_file.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "scratch_folder.h"

#include "sigmascape/base/error.h"
#include "sigmascape/radar/pattern_table.h"

namespace sigmascape::product {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> endings{".npy", ".npz", ".h5", ".sigmf-meta"};

radar::Radar moving_radar() {
  radar::Radar radar;
  radar.position = {300.0, -4000.0, 1500.0};
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.waveform.pulse_repetition_hz = 2000.0;
  return radar;
}

radar::PhaseHistory two_pulses() {
  return {.frequency_hz = 10e9,
          .bandwidth_hz = 75e6,
          .first_range_m = 4000.0,
          .range_step_m = 1.5,
          .pulses = {{-0.0005, {}}, {0.0, {}}},
          .samples = Array2D<radar::ComplexChannels>(3, 2)};
}

radar::RangeDopplerImage doppler_image() {
  radar::RangeDopplerImage image;
  image.range_m = {4000.0, 1.5, 3};
  image.doppler_hz = {-1.0, 0.5, 4};
  image.amplitude_m = Array2D<radar::ComplexChannels>(4, 3);
  image.interval_s = 1.9965;
  return image;
}

radar::StripmapImage strip_image() {
  radar::StripmapImage image;
  image.closest_range_m = {4000.0, 1.5, 3};
  image.along_m = {-10.0, 2.0, 4};
  image.amplitude_m = Array2D<radar::ComplexChannels>(4, 3);
  return image;
}

nlohmann::json json_of(const std::filesystem::path& path) {
  return nlohmann::json::parse(std::ifstream(path));
}

TEST(IqFile, HasEveryKindUnderEveryEnding) {
  const ScratchFolder folder;
  const radar::Radar radar = moving_radar();
  const auto history = two_pulses();
  const auto doppler = doppler_image();
  const auto strip = strip_image();
  const std::vector<IqRecord> records{iq_record(history, radar), iq_record(doppler, radar), iq_record(strip, radar)};
  for (const IqRecord& record : records) {
    for (const std::string& ending : endings) {
      SCOPED_TRACE(record.kind + ending);
      const auto file = folder.path(record.kind + ending);
      write_iq(file, record);
      EXPECT_GT(std::filesystem::file_size(file), 100U);
    }
  }
}

/// An archive holds 4 GiB, and what is put together before it is written takes memory once more.
TEST(IqFile, TellsBeforeTheWorkWhatIsTooLarge) {
  constexpr std::size_t many = 600'000'000;
  EXPECT_NO_THROW(check_iq_size("pulses.h5", many, 10e9));
  EXPECT_THROW(check_iq_size("pulses.npz", many, 1e12), Error);
  EXPECT_THROW(check_iq_size("pulses.npy", many, 10e9), Error);
  EXPECT_NO_THROW(check_iq_size("pulses.npy", many, 15e9));
}

TEST(IqFile, TellsBesideAnArrayWhereItsSamplesStand) {
  const ScratchFolder folder;
  const radar::Radar radar = moving_radar();
  radar::PhaseHistory history = two_pulses();
  history.pulses[0].platform = {.position = {299.95, -4000.0, 1500.0}, .velocity_mps = radar.velocity_mps};
  history.pulses[1].platform = {.position = radar.position, .velocity_mps = radar.velocity_mps};
  write_iq(folder.path("pulses.npy"), iq_record(history, radar));
  const nlohmann::json told = json_of(folder.path("pulses.json"));
  EXPECT_EQ(told.at("slant_range_m"), nlohmann::json({4000.0, 4001.5, 4003.0}));
  EXPECT_EQ(told.at("pulse_time_s"), nlohmann::json({-0.0005, 0.0}));
  EXPECT_EQ(told.at("platform_position_m"), nlohmann::json({{299.95, -4000.0, 1500.0}, {300.0, -4000.0, 1500.0}}));
  EXPECT_EQ(told.at("platform_velocity_mps"), nlohmann::json({{100.0, 0.0, 0.0}, {100.0, 0.0, 0.0}}));
}

/// JSON would let the second win and HDF5 refuse it: no ending may make anything of such a record.
TEST(IqFile, SaysNoKeyTwice) {
  const ScratchFolder folder;
  const auto doppler = doppler_image();
  const IqRecord rounded = iq_record(doppler, moving_radar(), {{"interval_s", "2.0"}});
  const IqRecord of_its_own = iq_record(doppler, moving_radar(), {{"kind", "another"}});
  for (const std::string& ending : endings) {
    SCOPED_TRACE(ending);
    EXPECT_THAT(message_of_error([&] { write_iq(folder.path("image" + ending), rounded); }),
                HasSubstr("image" + ending + ": would say interval_s twice; report this"));
    EXPECT_THAT(message_of_error([&] { write_iq(folder.path("image" + ending), of_its_own); }),
                HasSubstr("would say kind twice"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path(".")));
}

TEST(IqFile, KeepsNumbersAsTheyAre) {
  const auto doppler = doppler_image();
  EXPECT_EQ(nlohmann::json::parse(iq_description(iq_record(doppler, moving_radar())))["interval_s"], 1.9965);
  const auto history = two_pulses();
  EXPECT_EQ(nlohmann::json::parse(iq_description(iq_record(history, moving_radar())))["interval_s"], 0.001);
}

/// Samples a second are c/(2 Δr) over slant range and nothing over metres of another kind.
TEST(IqFile, ThroughALinkWhatBelongsTogetherLiesTogether) {
  const ScratchFolder folder;
  const auto history = two_pulses();
  const IqRecord record = iq_record(history, moving_radar());
  for (const auto& [ending, companion] : {std::pair{".npy", ".json"}, {".sigmf-meta", ".sigmf-data"}}) {
    const std::string latest = "latest", today = "there/today";
    std::filesystem::create_symlink(today + ending, folder.path(latest + ending));
    write_iq(folder.path(latest + ending), record);
    EXPECT_TRUE(std::filesystem::exists(folder.path(today + ending)));
    EXPECT_TRUE(std::filesystem::exists(folder.path(today + companion)));
    EXPECT_FALSE(std::filesystem::exists(folder.path(latest + companion)));
  }
}

TEST(IqFile, HasASampleRateOverSlantRangeAlone) {
  const ScratchFolder folder;
  const auto global_of = [&](const IqRecord& record) {
    write_iq(folder.path("x.sigmf-meta"), record);
    return json_of(folder.path("x.sigmf-meta"))["global"];
  };
  const auto history = two_pulses();
  EXPECT_DOUBLE_EQ(global_of(iq_record(history, moving_radar()))["core:sample_rate"], 299'792'458.0 / 3.0);
  const auto strip = strip_image();
  EXPECT_FALSE(global_of(iq_record(strip, moving_radar())).contains("core:sample_rate"));
  const auto doppler = doppler_image();
  EXPECT_FALSE(global_of(iq_record(doppler, moving_radar())).contains("core:sample_rate"));
  const std::vector<std::complex<float>> frame(2 * 3 * 4);
  const radar::RangeAzimuthGrid grid{.first_range_m = 1000.0,
                                     .range_step_m = 2.5,
                                     .ranges = 3,
                                     .first_azimuth_rad = 0.0,
                                     .azimuth_step_rad = 0.01,
                                     .azimuths = 2};
  EXPECT_DOUBLE_EQ(global_of(iq_record(grid, frame, std::vector{radar::Motion{}}, 10e9))["core:sample_rate"],
                   299'792'458.0 / 5.0);
}

TEST(IqFile, SaysHowTheEarthBendsAndAboutWhichFoot) {
  radar::Radar radar = moving_radar();
  const auto history = two_pulses();
  const auto doppler = doppler_image();
  const auto strip = strip_image();
  EXPECT_FALSE(iq_record(history, radar).numbers.contains("earth_refraction"));
  EXPECT_FALSE(iq_record(history, radar).words.contains("positions"));
  radar.earth_refraction = 1.3;
  for (const IqRecord& record : {iq_record(history, radar), iq_record(doppler, radar), iq_record(strip, radar)}) {
    SCOPED_TRACE(record.kind);
    EXPECT_EQ(record.numbers.at("earth_refraction"), 1.3);
    EXPECT_EQ(record.numbers.at("earth_foot_east_m"), 300.0);
    EXPECT_EQ(record.numbers.at("earth_foot_north_m"), -4000.0);
    EXPECT_THAT(record.words.at("positions"), HasSubstr("bent about earth_foot"));
  }
}

TEST(IqFile, SaysUnderWhichWindowItsBandIs) {
  radar::Radar radar = moving_radar();
  radar.waveform.window.taylor_side_lobe = 1e-6;
  radar.waveform.window.taylor_terms = 9;
  const auto history = two_pulses();
  const auto doppler = doppler_image();
  const auto strip = strip_image();
  for (const IqRecord& record : {iq_record(history, radar), iq_record(doppler, radar), iq_record(strip, radar)}) {
    SCOPED_TRACE(record.kind);
    EXPECT_EQ(record.words.at("window"), "taylor");
    EXPECT_DOUBLE_EQ(record.numbers.at("window_side_lobe_db"), -60.0);
    EXPECT_EQ(record.numbers.at("window_taylor_terms"), 9.0);
  }
  radar.waveform.window.shape = radar::WindowShape::Rectangular;
  EXPECT_EQ(iq_record(history, radar).words.at("window"), "rectangular");
  EXPECT_FALSE(iq_record(history, radar).numbers.contains("window_side_lobe_db"));
}

TEST(IqFile, DescribesTheAntennaThatIsInTheSamples) {
  radar::Radar radar = moving_radar();
  radar.antenna = {.azimuth = radar::ApertureBeam{{.taylor_side_lobe = 1e-3, .taylor_terms = 5}},
                   .elevation = radar::CosecantSquaredBeam{0.5},
                   .elevation_width_rad = 0.06,
                   .tilt_rad = -0.1,
                   .gain = 100.0,
                   .side_lobe_floor = 1e-5};
  auto history = two_pulses();
  const auto in_metres = iq_record(history, radar);
  EXPECT_FALSE(in_metres.words.contains("azimuth_shape"));
  EXPECT_FALSE(in_metres.numbers.contains("tilt_rad"));
  history.unit = "V";
  const auto doppler = doppler_image();
  const auto strip = strip_image();
  EXPECT_FALSE(iq_record(doppler, radar).numbers.contains("tilt_rad"));
  radar.processing.antenna_pattern = true;
  for (const IqRecord& record : {iq_record(history, radar), iq_record(doppler, radar), iq_record(strip, radar)}) {
    SCOPED_TRACE(record.kind);
    EXPECT_EQ(record.words.at("azimuth_shape"), "taylor");
    EXPECT_DOUBLE_EQ(record.numbers.at("azimuth_side_lobe_db"), -30.0);
    EXPECT_EQ(record.numbers.at("azimuth_taylor_terms"), 5.0);
    EXPECT_EQ(record.words.at("elevation_shape"), "cosecant-squared");
    EXPECT_EQ(record.numbers.at("elevation_width_rad"), 0.06);
    EXPECT_EQ(record.numbers.at("steepest_depression_rad"), 0.5);
    EXPECT_EQ(record.numbers.at("tilt_rad"), -0.1);
    EXPECT_DOUBLE_EQ(record.numbers.at("gain_dbi"), 20.0);
    EXPECT_DOUBLE_EQ(record.numbers.at("side_lobe_floor_db"), -50.0);
  }
  radar.antenna.elevation = radar::EvenBeam{};
  EXPECT_EQ(iq_record(history, radar).words.at("elevation_shape"), "even");
  EXPECT_FALSE(iq_record(history, radar).numbers.contains("elevation_width_rad"));
}

/// What a radar file names as azimuth_csv comes back, gains relative to their peak, and nothing of it in metres.
TEST(IqFile, HoldsTheTableOfAMeasuredAntenna) {
  const ScratchFolder folder;
  const auto table =
      radar::read_pattern_table(folder.write("cut.csv", "offset_deg,gain_db\n-4,5\n-1.5,20\n0.25,30\n1,24\n6,-10\n"));
  radar::Radar radar = moving_radar();
  radar.antenna.azimuth = table.beam;
  radar.beam_width_rad = table.half_power_width_rad;
  auto history = two_pulses();
  EXPECT_TRUE(iq_record(history, radar).cuts.empty());
  history.unit = "V";
  const IqRecord record = iq_record(history, radar);
  EXPECT_EQ(record.words.at("azimuth_shape"), "table");
  for (const std::string& ending : endings) write_iq(folder.path("pulses" + ending), record);
  const auto told = json_of(folder.path("pulses.json"));
  const auto global = json_of(folder.path("pulses.sigmf-meta")).at("global");
  const std::vector<double> offsets_deg{-4.0, -1.5, 0.25, 1.0, 6.0}, gains_db{-25.0, -10.0, 0.0, -6.0, -40.0};
  for (std::size_t i = 0; i < offsets_deg.size(); ++i) {
    EXPECT_NEAR(told.at("azimuth_offset_deg").at(i).get<double>(), offsets_deg[i], 1e-12);
    EXPECT_NEAR(told.at("azimuth_gain_dB").at(i).get<double>(), gains_db[i], 1e-9);
  }
  EXPECT_EQ(global.at("sigmascape:azimuth_offset_deg"), told.at("azimuth_offset_deg"));
  EXPECT_EQ(global.at("sigmascape:azimuth_gain_dB"), told.at("azimuth_gain_dB"));
  EXPECT_FALSE(told.contains("elevation_offset_deg"));
}

TEST(IqFile, TellsOfEachPulseWhereTheBeamPointed) {
  const ScratchFolder folder;
  const radar::Radar radar = moving_radar();
  auto history = two_pulses();
  write_iq(folder.path("bare.npy"), iq_record(history, radar));
  EXPECT_FALSE(json_of(folder.path("bare.json")).contains("beam_azimuth_rad"));
  history.pulses[0].beam_azimuth_rad = 0.25;
  history.pulses[1].beam_azimuth_rad = 0.5;
  const IqRecord record = iq_record(history, radar);
  for (const std::string& ending : endings) write_iq(folder.path("pulses" + ending), record);
  EXPECT_EQ(json_of(folder.path("pulses.json")).at("beam_azimuth_rad"), nlohmann::json({0.25, 0.5}));
  const auto captures = json_of(folder.path("pulses.sigmf-meta")).at("captures");
  EXPECT_EQ(captures.at(0).at("sigmascape:beam_azimuth_rad"), 0.25);
  EXPECT_EQ(captures.at(1).at("sigmascape:beam_azimuth_rad"), 0.5);
  IqRecord short_of_one = record;
  short_of_one.beam_azimuth_rad.pop_back();
  EXPECT_THAT(message_of_error([&] { write_iq(folder.path("short.npy"), short_of_one); }),
              HasSubstr("1 azimuths of the beam were given; give one for each motion of the platform, or none"));
}

TEST(IqFile, TellsWhereTheBeamPointedWhosePatternIsInAnImage) {
  const ScratchFolder folder;
  radar::Radar radar = moving_radar();
  auto doppler = doppler_image();
  auto strip = strip_image();
  doppler.beam_azimuth_rad = strip.beam_azimuth_rad = 0.25;
  EXPECT_TRUE(iq_record(doppler, radar).beam_azimuth_rad.empty()) << "an image without pattern";
  radar.processing.antenna_pattern = true;
  for (const IqRecord& record : {iq_record(doppler, radar), iq_record(strip, radar)}) {
    SCOPED_TRACE(record.kind);
    for (const std::string& ending : endings) write_iq(folder.path("image" + ending), record);
    EXPECT_EQ(json_of(folder.path("image.json")).at("beam_azimuth_rad"), nlohmann::json({0.25}));
    const auto described = json_of(folder.path("image.sigmf-meta"));
    for (const auto& capture : described.at("captures")) EXPECT_EQ(capture.at("sigmascape:beam_azimuth_rad"), 0.25);
  }
  doppler.beam_azimuth_rad.reset();
  EXPECT_TRUE(iq_record(doppler, radar).beam_azimuth_rad.empty()) << "of a beam that scans";
}

/// The slow axis stands in the captures, the fast one nowhere else.
TEST(IqFile, GivesAReaderOfSigmfTheWholeFastAxis) {
  const ScratchFolder folder;
  const auto strip = strip_image();
  write_iq(folder.path("x.sigmf-meta"), iq_record(strip, moving_radar()));
  const auto global = json_of(folder.path("x.sigmf-meta"))["global"];
  EXPECT_EQ(global["sigmascape:fast_first"], -10.0);
  EXPECT_DOUBLE_EQ(global["sigmascape:fast_step"], 2.0);
  EXPECT_EQ(global["sigmascape:fast_count"], 4);
}

}  // namespace
}  // namespace sigmascape::product
