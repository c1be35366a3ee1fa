#include "sigmascape/radar/radar_file_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/advised_number.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/radar/pattern_table.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::radar {
namespace {

constexpr Interval below_peak_db{-100.0, -10.0, "dB below the peak"};

/// The window of keys that begin with `prefix`, of a shape already known by its word.
Window window_of(const TomlSection& section, const std::string& prefix, const std::string& shape) {
  if (shape == "rectangular" || shape == "uniform") return {.shape = WindowShape::Rectangular};
  if (shape == "cosine") return {.shape = WindowShape::Cosine};
  if (shape == "hamming") return {.shape = WindowShape::Hamming};
  const Window defaults;
  const std::string terms_key = prefix + "taylor_terms";
  const double side_lobe_db =
      section.number_or(prefix + "side_lobe_db", below_peak_db, db_from_linear(defaults.taylor_side_lobe));
  const int asked = static_cast<int>(section.whole_number_or(terms_key, {2.0, 32.0, "terms"}, defaults.taylor_terms));
  const double side_lobe = linear_from_db(side_lobe_db);
  const int needed = taylor_terms_for(side_lobe, asked);
  if (section.has(terms_key) && asked < needed) {
    throw section.fault(terms_key, fmt::format("is {}, too few to hold side lobes at {:g} dB", asked, side_lobe_db),
                        fmt::format("give at least {}, or leave it out", needed));
  }
  return {.shape = WindowShape::Taylor, .taylor_side_lobe = side_lobe, .taylor_terms = needed};
}

/// Keys that are right with another shape and would do nothing with this: `{key, shape}`.
void refuse_keys_of_other_shapes(const TomlSection& section, const std::string& shape_key, const std::string& shape,
                                 std::initializer_list<std::pair<std::string, std::string>> keys) {
  for (const auto& [key, wanted] : keys) {
    if (shape == wanted || !section.has(key)) continue;
    throw section.fault(key, fmt::format("means nothing where {} is \"{}\"", shape_key, shape),
                        fmt::format("leave it out, or state {} = \"{}\"", shape_key, wanted));
  }
}

/// A key that says more of what another one states.
void refuse_key_without(const TomlSection& section, const std::string& key, const std::string& wanted) {
  if (!section.has(key) || section.has(wanted)) return;
  throw section.fault(key, fmt::format("means nothing where {} is not stated", wanted),
                      fmt::format("leave it out, or state {}", wanted));
}

/// A key that some shapes do without.
void refuse_key_of_shape(const TomlSection& section, const std::string& key, const std::string& shape_key,
                         const std::string& shape) {
  if (!section.has(key)) return;
  throw section.fault(key, fmt::format("means nothing where {} is \"{}\"", shape_key, shape),
                      fmt::format("leave it out, or state another {}", shape_key));
}

/// A cut of the antenna; `width_rad` becomes that of the table when there is one.
BeamShape beam_of(const TomlSection& section, const std::string& plane, const std::string& shape, double& width_rad) {
  if (shape == "even") return EvenBeam{};
  if (shape == "gaussian") return GaussianBeam{};
  if (shape == "table") {
    auto table = read_pattern_table(section.file(plane + "_csv"));
    width_rad = table.half_power_width_rad;
    return std::move(table.beam);
  }
  return ApertureBeam{window_of(section, plane + "_", shape)};
}

CosecantSquaredBeam cosecant_of(const TomlSection& section, double tilt_rad) {
  if (tilt_rad >= 0.0) {
    throw section.fault("tilt_deg", "does not point below the horizontal, as a cosecant-squared beam must",
                        "give a negative angle");
  }
  const CosecantSquaredBeam beam{
      radians_from_deg(section.number("steepest_depression_deg", {0.1, 90.0, "degrees below the horizontal"}))};
  if (beam.steepest_depression_rad <= -tilt_rad) {
    throw section.fault("steepest_depression_deg", "is not steeper than the peak of the beam",
                        fmt::format("give more than {:g}", deg_from_radians(-tilt_rad)));
  }
  return beam;
}

void read_elevation(const TomlSection& section, Antenna& antenna) {
  const std::string shape = section.choice_or(
      "elevation_shape", {"even", "gaussian", "uniform", "cosine", "taylor", "cosecant-squared", "table"}, "even");
  antenna.tilt_rad = radians_from_deg(section.number_or("tilt_deg", bounds::tilts_deg, 0.0));
  refuse_keys_of_other_shapes(section, "elevation_shape", shape,
                              {{"elevation_csv", "table"},
                               {"elevation_side_lobe_db", "taylor"},
                               {"elevation_taylor_terms", "taylor"},
                               {"steepest_depression_deg", "cosecant-squared"}});
  if (shape == "even") refuse_key_of_shape(section, "tilt_deg", "elevation_shape", shape);
  if (shape == "even" || shape == "table") {
    refuse_key_of_shape(section, "elevation_width_deg", "elevation_shape", shape);
  } else {
    antenna.elevation_width_rad = radians_from_deg(section.number("elevation_width_deg", {1e-3, 90.0, "degrees"}));
  }
  antenna.elevation = shape == "cosecant-squared" ? BeamShape{cosecant_of(section, antenna.tilt_rad)}
                                                  : beam_of(section, "elevation", shape, antenna.elevation_width_rad);
}

double power_of_db(const TomlSection& section, std::string_view key, Interval allowed, double fallback) {
  return linear_from_db(section.number_or(key, allowed, db_from_linear(fallback)));
}

std::optional<double> metres_of_km(const TomlSection& section, std::string_view key) {
  const auto km = section.optional_number(key, bounds::gate_ranges_km);
  return km ? std::optional(*km * 1e3) : std::nullopt;
}

struct KeyOfModes {
  std::string_view key;
  std::initializer_list<Mode> modes;
};
const std::array<KeyOfModes, 7> processing_keys{{
    {"interval_s", {Mode::DopplerBeamSharpening, Mode::Spotlight}},
    {"along_resolution_m", {Mode::Stripmap, Mode::Spotlight}},
    {"sharpening", {Mode::DopplerBeamSharpening}},
    {"looks", {Mode::DopplerBeamSharpening, Mode::Stripmap, Mode::Spotlight}},
    {"ambiguities", {Mode::Stripmap}},
    {"antenna_pattern", {Mode::DopplerBeamSharpening, Mode::Stripmap, Mode::Spotlight}},
    {"thermal_noise", {Mode::DopplerBeamSharpening, Mode::Stripmap, Mode::Spotlight}},
}};

/// Keys that are right in another mode and would do nothing in this.
void refuse_idle_keys(const TomlSection& section, Mode mode) {
  for (const auto& [key, modes] : processing_keys) {
    if (section.has(key) && std::ranges::find(modes, mode) == modes.end()) {
      std::vector<std::string_view> words(modes.size());
      std::ranges::transform(modes, words.begin(), &mode_word);
      throw section.fault(key, fmt::format("means nothing in a {} mode", mode_word(mode)),
                          fmt::format("leave it out, or use it with {}", fmt::join(words, " or ")));
    }
  }
}

void read_processing(const TomlSection& section, Radar& radar) {
  if (!(length(radar.velocity_mps) > 0.0)) {
    throw section.fault("kind", fmt::format("is {}, and the platform stands still", mode_word(radar.mode)),
                        "give platform.speed_mps: these modes live from motion");
  }
  refuse_idle_keys(section, radar.mode);
  Processing& processing = radar.processing;
  processing.interval_s = section.optional_number("interval_s", bounds::intervals_s);
  processing.along_resolution_m = section.optional_number("along_resolution_m", bounds::along_resolutions_m);
  processing.sharpening = section.optional_number("sharpening", bounds::sharpenings);
  processing.looks = static_cast<int>(section.whole_number_or("looks", bounds::looks, 1));
  processing.ambiguities = section.flag_or("ambiguities", processing.ambiguities);
  processing.antenna_pattern = section.flag_or("antenna_pattern", processing.antenna_pattern);
  processing.thermal_noise = section.flag_or("thermal_noise", processing.thermal_noise);
  if (processing.interval_s && (processing.along_resolution_m || processing.sharpening)) {
    throw section.fault(
        "interval_s",
        fmt::format("and {} say the same thing", processing.sharpening ? "sharpening" : "along_resolution_m"),
        "leave out one of them");
  }
}

/// No pulse of the bandwidth is short enough for a repetition at which the shortest is not.
void require_time_for_shortest_pulse(const TomlSection& section, const Waveform& waveform, double bandwidth_hz) {
  const double repetition_hz = waveform.pulse_repetition_hz, least_hz = 1.0 / longest_pulse_s(repetition_hz);
  if (bandwidth_hz >= least_hz) return;
  const std::string of_pulse = section.has("bandwidth_mhz")
                                   ? fmt::format("a bandwidth_mhz of at least {:.6g}", rounded_up(least_hz / 1e6, 6))
                                   : fmt::format("a radar.range_resolution_m of at most {:.6g}",
                                                 rounded_down(range_resolution_of(least_hz, waveform.window), 6));
  throw section.fault("pulse_repetition_hz",
                      fmt::format("is {:g}, at which the shortest pulse of a band of {:g} MHz, {:g} µs, leaves the "
                                  "receiver less than half of the time between pulses",
                                  repetition_hz, bandwidth_hz / 1e6, 1e6 / bandwidth_hz),
                      fmt::format("give at most {:.6g}, or {}", rounded_down(0.5 * bandwidth_hz, 6), of_pulse));
}

}  // namespace

void read_platform(const TomlSection& section, Radar& radar) {
  const double speed_mps = section.number_or("speed_mps", {0.0, 20'000.0, "m/s"}, 0.0);
  radar.heading_rad = radians_from_deg(section.number_or("heading_deg", {-360.0, 360.0, "degrees"}, 0.0));
  const double course_rad = radians_from_deg(
      section.number_or("course_deg", {-360.0, 360.0, "degrees"}, deg_from_radians(radar.heading_rad)));
  radar.velocity_mps = {speed_mps * std::sin(course_rad), speed_mps * std::cos(course_rad),
                        section.number_or("climb_mps", {-1000.0, 1000.0, "m/s"}, 0.0)};
  section.refuse_unknown_keys();
}

std::optional<double> read_antenna(const std::optional<TomlSection>& section, Radar& radar) {
  Antenna& antenna = radar.antenna;
  if (!section) {
    antenna.gain = directivity(antenna, radar.beam_width_rad);
    return 1.0;
  }
  const std::string shape =
      section->choice_or("azimuth_shape", {"gaussian", "uniform", "cosine", "hamming", "taylor", "table"}, "gaussian");
  refuse_keys_of_other_shapes(
      *section, "azimuth_shape", shape,
      {{"azimuth_csv", "table"}, {"azimuth_side_lobe_db", "taylor"}, {"azimuth_taylor_terms", "taylor"}});
  if (shape == "table" && section->has("azimuth_csv") && radar.beam_width_rad > 0.0)
    throw section->fault("azimuth_csv", "and radar.beam_width_deg both give the beam its width",
                         "leave out one of them");
  antenna.azimuth = beam_of(*section, "azimuth", shape, radar.beam_width_rad);
  read_elevation(*section, antenna);
  if (const auto floor_db = section->optional_number("side_lobe_floor_db", {-200.0, -10.0, "dB below the peak"}))
    antenna.side_lobe_floor = linear_from_db(*floor_db);
  std::optional<double> efficiency;
  if (const auto gain_dbi = section->optional_number("gain_dbi", bounds::gains_dbi)) {
    if (section->has("efficiency"))
      throw section->fault("efficiency", "means nothing beside gain_dbi, which holds it", "leave out one of them");
    antenna.gain = linear_from_db(*gain_dbi);
  } else {
    efficiency = section->number_or("efficiency", {0.01, 1.0, "of the power"}, 1.0);
    antenna.gain = *efficiency * directivity(antenna, radar.beam_width_rad);
  }
  section->refuse_unknown_keys();
  return efficiency;
}

void read_waveform(const TomlSection& section, Radar& radar) {
  Waveform& waveform = radar.waveform;
  const std::string window = section.choice_or("window", {"rectangular", "cosine", "hamming", "taylor"}, "taylor");
  refuse_keys_of_other_shapes(section, "window", window, {{"side_lobe_db", "taylor"}, {"taylor_terms", "taylor"}});
  waveform.window = window_of(section, "", window);
  if (const auto bandwidth_mhz = section.optional_number("bandwidth_mhz", {1e-3, 20'000.0, "MHz"})) {
    if (radar.range_resolution_m > 0.0) {
      throw section.fault("bandwidth_mhz", "and radar.range_resolution_m say the same thing", "leave out one of them");
    }
    if (*bandwidth_mhz * 1e6 >= widest_band_hz(radar.frequency_hz)) {
      throw section.fault("bandwidth_mhz",
                          fmt::format("is {:g}, a band about {:g} GHz that reaches down to no frequency at all",
                                      *bandwidth_mhz, radar.frequency_hz / 1e9),
                          fmt::format("give less than {:g}", widest_band_hz(radar.frequency_hz) / 1e6));
    }
    radar.range_resolution_m = range_resolution_of(*bandwidth_mhz * 1e6, waveform.window);
  }
  const double bandwidth_hz = bandwidth_of(radar.range_resolution_m, waveform.window);
  waveform.peak_power_w = section.number_or("peak_power_w", bounds::peak_powers_w, waveform.peak_power_w);
  waveform.pulse_repetition_hz =
      section.number_or("pulse_repetition_hz", bounds::pulse_repetitions_hz, waveform.pulse_repetition_hz);
  require_time_for_shortest_pulse(section, waveform, bandwidth_hz);
  waveform.pulse_length_s = section.number_or("pulse_length_us", bounds::pulse_lengths_us, 1e6 / bandwidth_hz) * 1e-6;
  if (waveform.pulse_length_s * bandwidth_hz < 1.0 - 1e-9) {
    throw section.fault("pulse_length_us",
                        fmt::format("is {:g}, too short a pulse to have its bandwidth of {:g} MHz",
                                    waveform.pulse_length_s * 1e6, bandwidth_hz / 1e6),
                        fmt::format("give at least {:.6g}", 1e6 / bandwidth_hz));
  }
  if (const double longest_s = longest_pulse_s(waveform.pulse_repetition_hz); waveform.pulse_length_s > longest_s) {
    throw section.fault("pulse_length_us", "leaves the receiver less than half of the time between pulses",
                        fmt::format("give at most {:g}", longest_s * 1e6));
  }
  section.refuse_unknown_keys();
}

void read_receiver(const TomlSection& section, Radar& radar) {
  Receiver& receiver = radar.receiver;
  receiver.losses = power_of_db(section, "losses_db", bounds::losses_db, receiver.losses);
  receiver.noise_figure = power_of_db(section, "noise_figure_db", bounds::noise_figures_db, receiver.noise_figure);
  receiver.gain = power_of_db(section, "gain_db", bounds::receiver_gains_db, receiver.gain);
  receiver.impedance_ohm = section.number_or("impedance_ohm", {1.0, 1e4, "Ω"}, receiver.impedance_ohm);
  receiver.first_range_m = metres_of_km(section, "first_range_km");
  receiver.last_range_m = metres_of_km(section, "last_range_km");
  if (receiver.last_range_m && *receiver.last_range_m <= receiver.first_range_m.value_or(0.0))
    throw section.fault("last_range_km", "does not lie beyond the gate's opening",
                        "exchange the two, or leave one out");
  refuse_key_without(section, "stc_exponent", "stc_full_gain_range_km");
  if (section.has("stc_full_gain_range_km")) {
    receiver.sensitivity_time_control =
        SensitivityTimeControl{section.number("stc_full_gain_range_km", {1e-3, 10'000.0, "km"}) * 1e3,
                               section.number_or("stc_exponent", {0.1, 8.0, "powers of range"}, 3.0)};
  }
  const std::string detector = section.choice_or("detector", {"linear", "square-law", "log"}, "square-law");
  receiver.detector = detector == "linear" ? Detector::Linear : detector == "log" ? Detector::Log : Detector::SquareLaw;
  receiver.pulses_integrated = static_cast<int>(section.whole_number_or("pulses_integrated", {1.0, 1e4, "pulses"}, 1));
  refuse_key_without(section, "adc_full_scale_v", "adc_bits");
  if (section.has("adc_bits")) {
    receiver.analog_to_digital =
        AnalogToDigital{static_cast<int>(section.whole_number_or("adc_bits", {1.0, 24.0, "bits"}, 12)),
                        section.number("adc_full_scale_v", {1e-9, 1e4, "V"})};
  }
  section.refuse_unknown_keys();
}

void read_scan(const TomlSection& section, Radar& radar) {
  const std::string kind = section.choice_or("kind", {"fixed", "sector", "rotating"}, "rotating");
  Scan& scan = radar.scan;
  scan.kind = kind == "fixed" ? ScanKind::Fixed : kind == "sector" ? ScanKind::Sector : ScanKind::Rotating;
  refuse_keys_of_other_shapes(section, "kind", kind, {{"sector_deg", "sector"}});
  if (scan.kind == ScanKind::Fixed) refuse_key_of_shape(section, "rate_deg_per_s", "kind", kind);
  if (const auto azimuth_deg = section.optional_number("azimuth_deg", {-360.0, 360.0, "degrees"}))
    scan.azimuth_rad = radians_from_deg(*azimuth_deg);
  if (scan.kind == ScanKind::Sector)
    scan.sector_width_rad = radians_from_deg(section.number("sector_deg", {0.01, 360.0, "degrees"}));
  if (scan.kind != ScanKind::Fixed)
    scan.rate_rad_per_s = radians_from_deg(section.number("rate_deg_per_s", {0.01, 1e5, "degrees per second"}));
  section.refuse_unknown_keys();
}

Mode mode_asked(const TomlSection& section) {
  return *mode_of(section.choice_or("kind", words_of_modes(), std::string(mode_words.front().first)));
}

void read_mode(const TomlSection& section, Radar& radar) {
  radar.mode = mode_asked(section);
  if (radar.mode != Mode::RealBeam) read_processing(section, radar);
  refuse_idle_keys(section, radar.mode);
  section.refuse_unknown_keys();
}

}  // namespace sigmascape::radar
