#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "end_to_end/made_scene.h"
#include "scratch_folder.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/power_map_file.h"

namespace sigmascape::end_to_end {
namespace {

namespace fs = std::filesystem;

/// A radar 5 km to the south and 20° up that flies to the east at 100 m/s.
std::string radar_text(const std::string& mode, const std::string& frequency_ghz = "10") {
  return "[radar]\nname = \"test\"\nfrequency_ghz = " + frequency_ghz +
         "\nrange_resolution_m = 2\nbeam_width_deg = 1\n"
         "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n"
         "[map]\ncell_m = 1\nwest_m = -60\nsouth_m = -60\neast_m = 60\nnorth_m = 60\n"
         "[platform]\nspeed_mps = 100\nheading_deg = 90\n[waveform]\npulse_repetition_hz = 2000\n" +
         mode;
}

/// One bake for all, and the program run on it.
class Modes : public ::testing::Test {
 protected:
  int run(const std::string& arguments) const {
    const int status = std::system(
        fmt::format("'{}' {} > '{}' 2>&1", SIGMASCAPE_CLI, arguments, folder_.path("printed.txt").string()).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string printed() const {
    std::ifstream stream(folder_.path("printed.txt"));
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  int render(const std::string& mode, const std::string& options) const {
    folder_.write("radar.toml", radar_text(mode));
    return run(fmt::format("render '{}' --scene '{}' --out '{}' --png '{}' --atlas '{}' --targets '{}' {}",
                           folder_.path("radar.toml").string(), scene_.string(), folder_.path("map.tif").string(),
                           folder_.path("map.png").string(), folder_.path("atlas").string(),
                           folder_.path("targets.toml").string(), options));
  }
  [[nodiscard]] radar::GroundMap map() const { return product::read_ground_map(folder_.path("map.tif")); }

  /// At a frequency that was not baked the atlas is refused with those that were, and the nearest is taken when asked
  /// for; geometry and Doppler are the radar's own in any case.
  void expect_extrapolation_on_request() const {
    folder_.write(
        "targets.toml",
        "[[targets]]\nposition_m = [-20, 10]\nheight_m = 0\nheading_deg = 180\nspeed_mps = 0.8\nrcs_dbsm = 60\n");
    const std::string arguments =
        fmt::format("render '{}' --scene '{}' --out '{}' --atlas '{}' --targets '{}' --lod 1",
                    folder_.path("ka.toml").string(), scene_.string(), folder_.path("map.tif").string(),
                    folder_.path("atlas").string(), folder_.path("targets.toml").string());
    for (const std::string& mode : {std::string(), std::string("[mode]\nkind = \"spotlight\"\n")}) {
      folder_.write("ka.toml", radar_text(mode, "34"));
      EXPECT_EQ(run(arguments), 1);
      EXPECT_NE(printed().find("34"), std::string::npos) << printed();
      EXPECT_NE(printed().find("10"), std::string::npos) << printed();
      ASSERT_EQ(run(arguments + " --extrapolate"), 0) << printed();
    }
    // A mover's shift does not know of wavelength, the interval of a resolution does.
    const auto ka = map();
    EXPECT_NEAR(brightest(ka).x, -20.0 + 5e3 * 0.8 * std::cos(radians_from_deg(20.0)) / 100.0, 2.0);
    folder_.write("ka.toml", radar_text("[mode]\nkind = \"spotlight\"\n"));
    ASSERT_EQ(run(arguments), 0) << printed();
    EXPECT_NEAR(std::stod(map().metadata.at("interval_s")) / std::stod(ka.metadata.at("interval_s")), 3.4, 0.02);
  }

  /// The largest |VV| of the first pulse of a NumPy file.
  [[nodiscard]] double largest_of_the_first_pulse(const std::string& name, std::size_t ranges) const {
    std::ifstream stream(folder_.path(name), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t header = 10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
    std::vector<std::complex<float>> pulse(3 * ranges);
    std::memcpy(pulse.data(), &bytes.at(header), pulse.size() * sizeof(pulse[0]));
    double most = 0.0;
    for (std::size_t i = 0; i < ranges; ++i) most = std::max(most, static_cast<double>(std::abs(pulse[3 * i])));
    return most;
  }

  /// What a point of 80 dBsm at (−20, 10, 10) m answers with by docs/iq_files.md and the file's own words: 10⁴ m, and
  /// in volts V₁ √σ (1 km/r)² times the pattern of the Gaussian beam, both ways, so far from its axis.
  static double expected_answer(const nlohmann::json& said) {
    if (said["unit"] == "m") return 1e4;
    const auto at = said["platform_position_m"][0].get<std::array<double, 3>>();
    const double east_m = -20.0 - at[0], north_m = 10.0 - at[1];
    const double range_km = 1e-3 * std::hypot(east_m, north_m, 10.0 - at[2]);
    const double off_axis = (std::atan2(east_m, north_m) - said["beam_azimuth_rad"][0].get<double>()) /
                            (0.5 * said["beam_width_rad"].get<double>());
    return said["volts_from_1_m2_at_1_km"].get<double>() * 1e4 / (range_km * range_km) *
           std::pow(0.5, off_axis * off_axis);
  }

  /// Pulses on the command line have the targets in them, in metres or in volts with noise.
  void expect_volts_of_targets() const {
    folder_.write("radar.toml", radar_text(""));
    folder_.write("targets.toml", "[[targets]]\nposition_m = [-20, 10]\nheight_m = 0\nrcs_dbsm = 80\n");
    for (const std::string unit : {"m", "V"}) {
      SCOPED_TRACE(unit);
      ASSERT_EQ(
          run(fmt::format(
              "render '{}' --scene '{}' --atlas '{}' --targets '{}' --lod 1 --iq '{}' --interval-s 0.002 --iq-unit {}",
              folder_.path("radar.toml").string(), scene_.string(), folder_.path("atlas").string(),
              folder_.path("targets.toml").string(), folder_.path("pulses.npy").string(), unit)),
          0)
          << printed();
      const auto said = json("pulses.json");
      ASSERT_EQ(said["unit"], unit);
      const double most = largest_of_the_first_pulse("pulses.npy", said["slant_range_m"].size());
      // The nearest sample lies up to 0.61 m beside the target, where the response, 2 m wide at half its power, has
      // fallen by 1.1 dB.
      const double above_db = 2.0 * db_from_linear(most / expected_answer(said));
      EXPECT_GT(above_db, -1.3);
      EXPECT_LT(above_db, 0.1);
    }
  }

  /// Received power beside σ0 for a real beam; a mode of many pulses refuses it before any work.
  void expect_power_of_real_beams_alone() const {
    folder_.write("targets.toml", "[[targets]]\nposition_m = [-20, 10]\nrcs_dbsm = 40\n");
    const std::string option = fmt::format("--lod 1 --power '{}'", folder_.path("power.tif").string());
    EXPECT_EQ(render("[mode]\nkind = \"spotlight\"\n", option), 1);
    EXPECT_NE(printed().find("--power: is of single pulses"), std::string::npos) << printed();
    EXPECT_NE(printed().find("take the [mode] out of the radar file"), std::string::npos) << printed();
    EXPECT_FALSE(fs::exists(folder_.path("power.tif")));
    ASSERT_EQ(render("", option), 0) << printed();
    const auto power = product::read_power_map(folder_.path("power.tif"));
    const auto sigma0 = map();
    EXPECT_EQ(power.grid, sigma0.grid);
    // Power over σ0 goes as r⁻³: the nearest cells lie 60 m before the middle, the farthest 60 m behind it, at 20°.
    const auto ratio = [&](std::size_t row) {
      return static_cast<double>(power.power_w(60, row).vv) / static_cast<double>(sigma0.sigma0(60, row).vv);
    };
    EXPECT_NEAR(db_from_linear(ratio(119) / ratio(0)), 30.0 * std::log10(1.0 + 119.0 * std::cos(0.349) / 5000.0), 0.03);
  }

  [[nodiscard]] nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(std::ifstream(folder_.path(name)));
  }
  /// What the file of the complex image of a mode says of itself.
  [[nodiscard]] nlohmann::json slant_image(const std::string& mode) const {
    EXPECT_EQ(render(mode, fmt::format("--lod 1 --slant-image '{}'", folder_.path("slant.npy").string())), 0)
        << printed();
    return json("slant.json");
  }

  /// The complex image before it is brought onto the ground, of the modes that have one, under every ending.
  void expect_slant_images() const {
    folder_.write("targets.toml", "[[targets]]\nposition_m = [-20, 10]\nrcs_dbsm = 40\n");
    for (const std::string kind : {"spotlight", "stripmap", "doppler-beam-sharpening"}) {
      SCOPED_TRACE(kind);
      for (const std::string ending : {".npy", ".npz", ".h5", ".sigmf-meta"}) {
        const auto image = folder_.path(kind + ending);
        ASSERT_EQ(
            render("[mode]\nkind = \"" + kind + "\"\n", fmt::format("--lod 1 --slant-image '{}'", image.string())), 0)
            << printed();
        const fs::path samples = ending == ".sigmf-meta" ? folder_.path(kind + ".sigmf-data") : image;
        EXPECT_GT(fs::file_size(samples), 20'000U) << samples;
      }
      const auto said = json(kind + ".json");
      EXPECT_EQ(said["axes"][1], kind == "stripmap" ? "along_track" : "doppler");
      EXPECT_TRUE(said["interval_s"].is_number()) << said["interval_s"];
      EXPECT_EQ(said["mode"], kind);
      EXPECT_TRUE(said.contains("scene_hash"));
      // Abeam, but for the difference between the middle of the map and that of the scene.
      const double off_course_deg = said["angle_off_course_deg"].get<double>();
      EXPECT_NEAR(off_course_deg, 90.0, 0.1);
      if (kind == "stripmap") {
        EXPECT_NEAR(said["squint_rad"].get<double>(), radians_from_deg(90.0 - off_course_deg), 1e-5);
      }
      EXPECT_FALSE(said.contains("squint_deg"));
      const auto global = json(kind + ".sigmf-meta")["global"];
      EXPECT_FALSE(global.contains("core:sample_rate"));
      EXPECT_EQ(global["sigmascape:interval_s"], said["interval_s"]);
    }
    EXPECT_EQ(render("", "--lod 1 --slant-image x.npy"), 1);
    EXPECT_NE(printed().find("--slant-image: is a complex image, and a real beam has power alone"), std::string::npos)
        << printed();
  }

  /// Map and complex image that keep the antenna's pattern say where its axis points: to the middle, whence the radar
  /// is seen the other way round.
  void expect_patterns_to_say_where_the_beam_points() const {
    for (const std::string kind : {"spotlight", "stripmap"}) {
      SCOPED_TRACE(kind);
      const auto said = slant_image("[mode]\nkind = \"" + kind + "\"\nantenna_pattern = true\n");
      const auto metadata = map().metadata;
      const double beam_deg = std::stod(metadata.at("beam_azimuth_deg"));
      EXPECT_NEAR(std::abs(std::remainder(beam_deg - std::stod(metadata.at("radar_azimuth_deg")), 360.0)), 180.0, 0.02);
      ASSERT_EQ(said["beam_azimuth_rad"].size(), 1U);
      const double image_deg = deg_from_radians(said["beam_azimuth_rad"][0].get<double>());
      EXPECT_NEAR(std::remainder(beam_deg - image_deg, 360.0), 0.0, 0.02);
      EXPECT_EQ(said["look_side"], metadata.at("look_side"));
    }
    EXPECT_FALSE(slant_image("[mode]\nkind = \"spotlight\"\n").contains("beam_azimuth_rad"));
    EXPECT_FALSE(map().metadata.contains("beam_azimuth_deg"));
  }

  /// An image of all pulses is that of a mode of one look that is as many times sharper.
  void expect_slant_images_of_one_look() const {
    for (const std::string kind : {"spotlight", "stripmap"}) {
      SCOPED_TRACE(kind);
      const auto mode = [&](int along_m, int looks) {
        return fmt::format("[mode]\nkind = \"{}\"\nalong_resolution_m = {}\nlooks = {}\n", kind, along_m, looks);
      };
      const auto of_four = slant_image(mode(8, 4)), of_one = slant_image(mode(2, 1));
      // A pulse more or less a look.
      EXPECT_NEAR(std::stod(map().metadata.at("along_resolution_m")), 2.0, 0.01);
      EXPECT_EQ(of_four["looks"], 1);
      EXPECT_NEAR(of_four["along_resolution_m"].get<double>(), 2.0, 0.01);
      const std::string cell = kind == "stripmap" ? "along_cell_m" : "doppler_cell_hz";
      for (const std::string& key : {std::string("along_resolution_m"), std::string("interval_s"), cell})
        EXPECT_NEAR(of_four[key].get<double>() / of_one[key].get<double>(), 1.0, 5e-3) << key;
    }
  }

  /// Beside the map of a mode, pulses speak of themselves: of their own interval, and of noise and pattern that the map
  /// has not and they have.
  void expect_pulses_to_speak_of_themselves() const {
    const auto pulses = [&](const std::string& unit) {
      EXPECT_EQ(render("[mode]\nkind = \"spotlight\"\n", fmt::format("--lod 1 --iq '{}' --interval-s 0.05 --iq-unit {}",
                                                                     folder_.path("own.npy").string(), unit)),
                0)
          << printed();
      return json("own.json");
    };
    const auto volts = pulses("V"), metres = pulses("m");
    EXPECT_EQ(volts["interval_s"], 0.05);
    EXPECT_EQ(volts["antenna_pattern"], "left in");
    EXPECT_EQ(volts["thermal_noise"], "in it");
    EXPECT_EQ(volts["processing"], "scatterers from terrain and atlas");
    EXPECT_EQ(volts["targets"], 1.0);
    EXPECT_EQ(metres["antenna_pattern"], "none");
    EXPECT_EQ(metres["thermal_noise"], "none");
    for (const char* of_the_map : {"looks", "along_resolution_m", "angle_off_course_deg", "mode"})
      EXPECT_FALSE(volts.contains(of_the_map)) << of_the_map;
    for (const char* of_every_file : {"scene", "scene_hash", "crs", "seed", "software"})
      EXPECT_TRUE(volts.contains(of_every_file)) << of_every_file;
  }

  /// Pulses by themselves: no map is made beside them, which would refuse a radar as low as the roofs, and nothing is
  /// said of its cells. Left out, the interval is that of the mode, and a shorter one is told.
  void expect_pulses_without_a_map() const {
    const auto record = [&](const std::string& mode, const std::string& options) {
      std::string text = radar_text(mode);
      const auto begin = text.find("azimuth_deg"), end = text.find("[map]");
      text.replace(begin, end - begin, "east_m = 0\nnorth_m = -500\naltitude_m = 17\n");
      folder_.write("low.toml", text);
      return run(fmt::format("render '{}' --scene '{}' --atlas '{}' --iq '{}' {}", folder_.path("low.toml").string(),
                             scene_.string(), folder_.path("atlas").string(), folder_.path("low.npy").string(),
                             options));
    };
    EXPECT_EQ(record("", "--lod 0 --png '" + folder_.path("map.png").string() + "'"), 1);
    EXPECT_NE(printed().find("stands at 17.0 m, and the highest point of the scene at"), std::string::npos)
        << printed();
    ASSERT_EQ(record("", ""), 0) << printed();
    EXPECT_NE(printed().find("200 pulses x "), std::string::npos) << printed();
    EXPECT_NE(printed().find(" over 0.1 s, in "), std::string::npos) << printed();
    EXPECT_EQ(printed().find("cells"), std::string::npos) << printed();
    ASSERT_EQ(record("[mode]\nkind = \"spotlight\"\ninterval_s = 0.04\n", "--json"), 0) << printed();
    const auto told = nlohmann::json::parse(printed().substr(printed().find('{')));
    const auto said = json("low.json");
    EXPECT_EQ(told["pulses"], 80);
    EXPECT_EQ(told["pulse_samples"], said["slant_range_m"].size());
    EXPECT_EQ(told["pulse_first_range_m"], said["slant_range_m"].front());
    EXPECT_NEAR(told["pulse_last_range_m"].get<double>(), said["slant_range_m"].back().get<double>(), 1e-6);
    EXPECT_FALSE(told.contains("columns"));
    EXPECT_EQ(said["interval_s"], 0.04);
    EXPECT_EQ(said["mode_interval_s"], 0.04);
    EXPECT_EQ(said["radar_mode"], "spotlight");
    ASSERT_EQ(record("[mode]\nkind = \"spotlight\"\ninterval_s = 0.04\n", "--interval-s 0.01"), 0) << printed();
    EXPECT_NE(printed().find("pulses are recorded for 0.01 s, and the spotlight of this radar adds up 0.04 s"),
              std::string::npos)
        << printed();
    EXPECT_EQ(json("low.json")["mode_interval_s"], 0.04);
  }

  /// What is drawn, as the noise of the detector and fluctuating targets, can be drawn again.
  void expect_what_is_drawn_to_name_its_seed() const {
    EXPECT_EQ(render("", fmt::format("--lod 1 --seed 7 --video '{}'", folder_.path("video.npy").string())), 0)
        << printed();
    EXPECT_EQ(json("video.json")["seed"], "7");
    EXPECT_EQ(map().metadata.at("seed"), "7");
  }

  /// A gate that holds nothing of what is mapped is refused with the key that says so.
  void expect_an_empty_gate_to_name_its_key() const {
    // At level 0 before the map, which would take hours.
    for (const char* level : {"--lod 1", "--lod 0 --samples 1000000"}) {
      EXPECT_EQ(render("[receiver]\nfirst_range_km = 20\n",
                       fmt::format("{} --iq '{}'", level, folder_.path("late.npy").string())),
                1);
      EXPECT_NE(printed().find("radar test: receiver.first_range_km: opens the range gate at 20 km"), std::string::npos)
          << printed();
    }
  }

  /// Pulses over an Earth that curves say all that leads from a place to its range.
  void expect_pulses_to_say_how_the_earth_bends() const {
    folder_.write("targets.toml", "[[targets]]\nposition_m = [-20, 10]\nheight_m = 90\nrcs_dbsm = 80\n");
    std::string text = radar_text("[mode]\nkind = \"spotlight\"\ninterval_s = 0.1\n");
    text.replace(text.find("elevation_deg = 20\nslant_range_km = 5"), 36, "elevation_deg = 5\nslant_range_km = 60");
    text.insert(text.find("[position]"), "earth_refraction = 1.25\n");
    folder_.write("bent.toml", text);
    ASSERT_EQ(
        run(fmt::format(
            "render '{}' --scene '{}' --atlas '{}' --targets '{}' --lod 1 --iq '{}' --interval-s 0.002 --out '{}'",
            folder_.path("bent.toml").string(), scene_.string(), folder_.path("atlas").string(),
            folder_.path("targets.toml").string(), folder_.path("bent.sigmf-meta").string(),
            folder_.path("map.tif").string())),
        0)
        << printed();
    EXPECT_EQ(map().metadata.at("earth_refraction"), "1.25");
    const auto said = json("bent.sigmf-meta");
    const auto number = [&](const std::string& key) { return said["global"]["sigmascape:" + key].get<double>(); };
    // The brightest VV sample of the first pulse is the target's.
    const auto ranges = static_cast<std::size_t>(number("fast_count"));
    std::vector<std::complex<float>> pulse(3 * ranges);
    std::ifstream(folder_.path("bent.sigmf-data"), std::ios::binary)
        .read(reinterpret_cast<char*>(pulse.data()), static_cast<std::streamsize>(pulse.size() * sizeof(pulse[0])));
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < ranges; ++i)
      if (std::abs(pulse[3 * i]) > std::abs(pulse[3 * brightest])) brightest = i;
    const double found_m = number("first_range_m") + static_cast<double>(brightest) * number("range_step_m");
    // docs/iq_files.md, in its own words and from the file alone.
    const double radius_m = number("earth_refraction") * 6'371'008.8, height_m = 100.0;
    const double east_m = -20.0 - number("earth_foot_east_m"), north_m = 10.0 - number("earth_foot_north_m");
    const double distance_m = std::hypot(east_m, north_m);
    const double stretch = (radius_m + height_m) * std::sin(distance_m / radius_m) / distance_m;
    const auto at = said["captures"][0]["sigmascape:position_m"].get<std::array<double, 3>>();
    const double expected_m = std::hypot(number("earth_foot_east_m") + stretch * east_m - at[0],
                                         number("earth_foot_north_m") + stretch * north_m - at[1],
                                         (radius_m + height_m) * std::cos(distance_m / radius_m) - radius_m - at[2]);
    EXPECT_NEAR(found_m, expected_m, number("range_step_m"));
    const double straight_m = std::hypot(-20.0 - at[0], 10.0 - at[1], height_m - at[2]);
    EXPECT_GT(std::abs(straight_m - expected_m), 10.0) << "the bend must be more than what is allowed for";
  }

  void expect_the_choice_of_detail_to_be_explained() const {
    folder_.write("radar.toml", radar_text(""));
    ASSERT_EQ(run(fmt::format("render '{}' --scene '{}' --atlas '{}' --lod 1 --explain --png '{}'",
                              folder_.path("radar.toml").string(), scene_.string(), folder_.path("atlas").string(),
                              folder_.path("map.png").string())),
              0)
        << printed();
    // 160 m of houses seen closely can be traced; the numbers that say so are there.
    EXPECT_NE(printed().find("The resolution cell asks for level of detail 0: the full scene"), std::string::npos)
        << printed();
    EXPECT_NE(printed().find("a resolution cell is 2.13 m on its smaller side"), std::string::npos) << printed();
    EXPECT_NE(printed().find("geometry should stay"), std::string::npos) << printed();
    const auto said = [this](const std::string& mode, const std::string& options) {
      EXPECT_EQ(render(mode, "--lod 1 --explain " + options), 0) << printed();
      return printed();
    };
    EXPECT_NE(said("", "--detail-rule paper").find("a triangle of the full scene covers"), std::string::npos)
        << printed();
    // Across the line of sight as sharp as the mode, where the beam is 87 m wide.
    EXPECT_NE(said("[mode]\nkind = \"spotlight\"\nalong_resolution_m = 1\n", "").find("a resolution cell is 1 m"),
              std::string::npos)
        << printed();
    EXPECT_NE(printed().find("what is traced is power alone"), std::string::npos) << printed();
    EXPECT_NE(printed().find("shadows are cast at run time"), std::string::npos) << printed();
    EXPECT_NE(render("", "--lod 1 --detail-rule paper"), 0);
    EXPECT_NE(printed().find("--explain"), std::string::npos) << printed();
  }

  void expect_a_bent_earth_in_coherent_modes_alone() const {
    const auto rendered = [&](const std::string& mode) {
      std::string text = radar_text(mode);
      text.insert(text.find("[position]"), "earth_refraction = 1.3333\n");
      folder_.write("bent.toml", text);
      return run(fmt::format("render '{}' --scene '{}' --atlas '{}' --lod 1 --png '{}'",
                             folder_.path("bent.toml").string(), scene_.string(), folder_.path("atlas").string(),
                             folder_.path("map.png").string()));
    };
    EXPECT_EQ(rendered("[mode]\nkind = \"spotlight\"\n"), 0) << printed();
    EXPECT_EQ(rendered(""), 1);
    EXPECT_NE(printed().find("radar.earth_refraction: is given, and real-beam maps are made over a flat Earth"),
              std::string::npos)
        << printed();
  }

  static Vec2d brightest(const radar::GroundMap& map) {
    std::size_t best_column = 0, best_row = 0;
    for (std::size_t row = 0; row < map.grid.rows; ++row) {
      for (std::size_t column = 0; column < map.grid.columns; ++column) {
        if (map.sigma0(column, row).vv > map.sigma0(best_column, best_row).vv) {
          best_column = column;
          best_row = row;
        }
      }
    }
    return map.grid.centre_of(best_column, best_row);
  }

  ScratchFolder folder_;
  fs::path scene_ = write_made_scene(folder_.path("scene"), 160, 160);
};

/// From files to maps: every mode puts what stands where it is and shifts what moves by −r ṙ/V along the flight.
TEST_F(Modes, MapTheGroundAndTheTargets) {
  ASSERT_EQ(run(fmt::format("bake '{}' --out '{}' --patch-texels 256 --azimuths 2 --elevations-deg 20 --samples 4",
                            scene_.string(), folder_.path("atlas").string())),
            0)
      << printed();
  struct Case {
    std::string mode, name, looks;
    bool shifts;
    double cell_m;
  };
  const std::vector<Case> cases{{"", "", "", false, 90.0},
                                {"[mode]\nkind = \"spotlight\"\nlooks = 2\n", "spotlight", "2", true, 2.0},
                                {"[mode]\nkind = \"stripmap\"\n", "stripmap", "1", true, 2.0},
                                {"[mode]\nkind = \"doppler-beam-sharpening\"\nsharpening = 12\nlooks = 3\n",
                                 "doppler-beam-sharpening", "3", true, 8.0}};
  const Vec2d place{-20.0, 10.0};
  // Towards the radar: it seems to lie ahead, to the east.
  const double shift_m = 5e3 * 0.8 * std::cos(radians_from_deg(20.0)) / 100.0;
  for (const auto& [mode, name, looks, shifts, cell_m] : cases) {
    SCOPED_TRACE(mode);
    for (const double speed_mps : {0.0, 0.8}) {
      folder_.write("targets.toml",
                    fmt::format("[[targets]]\nposition_m = [{}, {}]\nheight_m = 0\nheading_deg = 180\nspeed_mps = {}\n"
                                "rcs_dbsm = 60\n",
                                place.x, place.y, speed_mps));
      ASSERT_EQ(render(mode, "--lod 1"), 0) << printed();
      const auto made = map();
      const Vec2d found = brightest(made);
      EXPECT_NEAR(found.x, place.x + (shifts && speed_mps > 0.0 ? shift_m : 0.0), 0.5 * cell_m + 1.0);
      EXPECT_NEAR(found.y, place.y, 3.0);
      EXPECT_TRUE(fs::exists(folder_.path("map.png")));
      if (name.empty()) continue;
      EXPECT_EQ(made.metadata.at("mode"), name);
      EXPECT_EQ(made.metadata.at("looks"), looks);
      EXPECT_EQ(made.metadata.at("seed"), "1");
      EXPECT_GT(std::stod(made.metadata.at("interval_s")), 0.0);
    }
  }

  EXPECT_EQ(render("[mode]\nkind = \"spotlight\"\n", "--lod 0"), 1);
  EXPECT_NE(printed().find("--lod: 0 traces power alone, and spotlight needs amplitudes"), std::string::npos)
      << printed();
  EXPECT_EQ(render("[mode]\nkind = \"spotlight\"\n", "--lod 1 --ppi x.png"), 1);
  EXPECT_NE(printed().find("--ppi: is of range and azimuth"), std::string::npos) << printed();
  expect_extrapolation_on_request();
  expect_volts_of_targets();
  expect_slant_images();
  expect_slant_images_of_one_look();
  expect_patterns_to_say_where_the_beam_points();
  expect_pulses_to_speak_of_themselves();
  expect_pulses_without_a_map();
  expect_what_is_drawn_to_name_its_seed();
  expect_an_empty_gate_to_name_its_key();
  expect_the_choice_of_detail_to_be_explained();
  expect_power_of_real_beams_alone();
  expect_a_bent_earth_in_coherent_modes_alone();
  expect_pulses_to_say_how_the_earth_bends();
  folder_.write("targets.toml", "[[targets]]\nposition_m = [9000, 0]\nrcs_dbsm = 20\n");
  EXPECT_EQ(render("", "--lod 1"), 1);
  EXPECT_NE(printed().find("outside the terrain"), std::string::npos) << printed();
}

}  // namespace
}  // namespace sigmascape::end_to_end
