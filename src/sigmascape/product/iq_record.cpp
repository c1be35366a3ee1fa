#include "sigmascape/product/iq_record.h"

#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "sigmascape/base/units.h"
#include "sigmascape/product/receiver_output.h"
#include "sigmascape/product/software.h"
#include "sigmascape/product/told_numbers.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/range_cell.h"

namespace sigmascape::product {
namespace {

constexpr const char* amplitude_words = "|a|^2 is a cross-section in m^2; the phase of the way is in it";

std::vector<double> evenly(double first, double step, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = first + step * static_cast<double>(i);
  return values;
}

std::vector<double> middles(const radar::ImageAxis& axis) {
  return evenly(axis.first, axis.step, axis.bins);
}

std::span<const std::complex<float>> numbers_of(const Array2D<radar::ComplexChannels>& samples) {
  static_assert(sizeof(radar::ComplexChannels) == radar::ComplexChannels::count * sizeof(std::complex<float>));
  return {reinterpret_cast<const std::complex<float>*>(samples.values().data()),
          samples.size() * radar::ComplexChannels::count};
}

/// Over an Earth that curves, ranges and positions are those of a space in which rays are straight, and the local frame
/// is bent about the foot that the radar has in the middle of the interval.
void describe_earth(IqRecord& record, double refraction, Vec3d radar_position) {
  record.numbers["earth_refraction"] = refraction;
  record.numbers["earth_foot_east_m"] = radar_position.x;
  record.numbers["earth_foot_north_m"] = radar_position.y;
  record.words["positions"] =
      "of the platform: in the straight space over the k-Earth, k = earth_refraction, into which points of the local "
      "frame are bent about earth_foot: docs/iq_files.md";
}

/// A taper as a radar file names it, and its side lobes under keys that begin with `prefix`.
std::string described_taper(IqRecord& record, const std::string& prefix, const radar::Window& window,
                            const char* rectangular) {
  switch (window.shape) {
    case radar::WindowShape::Rectangular:
      return rectangular;
    case radar::WindowShape::Cosine:
      return "cosine";
    case radar::WindowShape::Hamming:
      return "hamming";
    case radar::WindowShape::Taylor:
      record.numbers[prefix + "side_lobe_db"] = db_from_linear(window.taylor_side_lobe);
      record.numbers[prefix + "taylor_terms"] = window.taylor_terms;
      return "taylor";
  }
  return "";
}

/// The columns of the table that a radar file names, gains relative to their peak: of them only differences matter.
void describe_table(IqRecord& record, const std::string& prefix, const radar::TabulatedBeam& beam, double width_rad) {
  IqAxis offsets{prefix + "offset", "deg", {}}, gains{prefix + "gain", "dB", {}};
  for (const radar::TabulatedBeam::Sample& sample : beam.samples) {
    offsets.values.push_back(deg_from_radians(sample.offset * width_rad));
    gains.values.push_back(db_from_linear(sample.power));
  }
  record.cuts.push_back(std::move(offsets));
  record.cuts.push_back(std::move(gains));
}

std::string described_beam(IqRecord& record, const std::string& prefix, const radar::BeamShape& beam,
                           double width_rad) {
  if (std::holds_alternative<radar::EvenBeam>(beam)) return "even";
  if (std::holds_alternative<radar::GaussianBeam>(beam)) return "gaussian";
  if (const auto* table = std::get_if<radar::TabulatedBeam>(&beam)) {
    describe_table(record, prefix, *table, width_rad);
    return "table";
  }
  if (const auto* cosecant = std::get_if<radar::CosecantSquaredBeam>(&beam)) {
    record.numbers["steepest_depression_rad"] = cosecant->steepest_depression_rad;
    return "cosecant-squared";
  }
  return described_taper(record, prefix, std::get<radar::ApertureBeam>(beam).taper, "uniform");
}

/// Of an antenna whose pattern is in the samples: its cuts, and where it points in elevation.
void describe_antenna(IqRecord& record, const radar::Radar& radar) {
  const radar::Antenna& antenna = radar.antenna;
  record.words["azimuth_shape"] = described_beam(record, "azimuth_", antenna.azimuth, radar.beam_width_rad);
  record.words["elevation_shape"] =
      described_beam(record, "elevation_", antenna.elevation, antenna.elevation_width_rad);
  if (!std::holds_alternative<radar::EvenBeam>(antenna.elevation))
    record.numbers["elevation_width_rad"] = antenna.elevation_width_rad;
  record.numbers["tilt_rad"] = antenna.tilt_rad;
  record.numbers["gain_dbi"] = db_from_linear(antenna.gain);
  if (antenna.side_lobe_floor > 0.0) record.numbers["side_lobe_floor_db"] = db_from_linear(antenna.side_lobe_floor);
}

void describe(IqRecord& record, const radar::Radar& radar) {
  if (radar.earth_refraction) describe_earth(record, *radar.earth_refraction, radar.position);
  record.words["window"] = described_taper(record, "window_", radar.waveform.window, "rectangular");
  record.words["software"] = software_name();
  record.words["radar"] = radar.name;
  record.numbers["range_resolution_m"] = radar.range_resolution_m;
  record.numbers["beam_width_rad"] = radar.beam_width_rad;
  record.numbers["pulse_repetition_hz"] = radar.waveform.pulse_repetition_hz;
}

/// With the antenna, if its pattern is in the image, and where its axis pointed, if at one azimuth.
void describe_image(IqRecord& record, std::optional<double> beam_azimuth_rad, const radar::Radar& radar) {
  describe(record, radar);
  if (!radar.processing.antenna_pattern) return;
  describe_antenna(record, radar);
  if (beam_azimuth_rad) record.beam_azimuth_rad = {*beam_azimuth_rad};
}

/// What turns volts back into watts and cross-sections.
void describe_calibration(IqRecord& record, const radar::Radar& radar) {
  record.numbers["impedance_ohm"] = radar.receiver.impedance_ohm;
  record.numbers["noise_power_w"] = radar::noise_power_w(radar) * radar.receiver.gain;
  record.numbers["volts_from_1_m2_at_1_km"] = radar::received_voltage_v(radar, 1.0, 1e3);
  // While a pulse is sent the receiver is deaf, which weakens echoes by what the true range and this length tell.
  record.numbers["pulse_length_s"] = radar.waveform.pulse_length_s;
  record.numbers["atmosphere_db_per_km"] = db_from_linear(std::exp(1e3 * radar.atmosphere_per_m));
}

}  // namespace

IqRecord iq_record(const radar::PhaseHistory& history, const radar::Radar& radar,
                   std::map<std::string, std::string> words) {
  IqRecord record{
      .kind = "phase history",
      .unit = history.unit,
      .quantity = "compressed pulses before any processing; a point at range r answers with exp(-4 pi i r f / c)",
      .slow = {"pulse_time", "s", {}},
      .fast = {"slant_range", "m", evenly(history.first_range_m, history.range_step_m, history.samples.columns())},
      .polarizations = {"VV", "HH", "HV"},
      .samples = numbers_of(history.samples),
      .platform = {},
      .numbers = {{"frequency_hz", history.frequency_hz},
                  {"bandwidth_hz", history.bandwidth_hz},
                  {"interval_s", static_cast<double>(history.pulses.size()) / radar.waveform.pulse_repetition_hz},
                  {"first_range_m", history.first_range_m},
                  {"range_step_m", history.range_step_m},
                  {"range_cell_m", radar::range_cell_m(history.bandwidth_hz, radar.waveform.window)}},
      .words = std::move(words)};
  for (const radar::Pulse& pulse : history.pulses) {
    record.slow.values.push_back(pulse.time_s);
    record.platform.push_back(pulse.platform);
    if (pulse.beam_azimuth_rad) record.beam_azimuth_rad.push_back(*pulse.beam_azimuth_rad);
  }
  record.numbers.merge(numbers_taken_from(record.words));
  describe(record, radar);
  if (record.unit == "V") {
    describe_calibration(record, radar);
    record.numbers.merge(
        output_numbers(history.sensitivity_time_control, history.analog_to_digital, history.saturated));
    describe_antenna(record, radar);
  }
  return record;
}

IqRecord iq_record(const radar::RangeDopplerImage& image, const radar::Radar& radar,
                   std::map<std::string, std::string> words) {
  IqRecord record{.kind = "range-Doppler image",
                  .unit = "m",
                  .quantity = "|a|^2 is a cross-section in m^2; a point at range r has the phase -4 pi r f / c",
                  .slow = {"slant_range", "m", middles(image.range_m)},
                  .fast = {"doppler", "Hz", middles(image.doppler_hz)},
                  .polarizations = {"VV", "HH", "HV"},
                  .samples = numbers_of(image.amplitude_m),
                  .platform = {image.platform},
                  .numbers = {{"frequency_hz", image.frequency_hz},
                              {"interval_s", image.interval_s},
                              {"range_cell_m", image.range_cell_m},
                              {"doppler_cell_hz", image.doppler_cell_hz}},
                  .words = std::move(words)};
  record.numbers.merge(numbers_taken_from(record.words));
  describe_image(record, image.beam_azimuth_rad, radar);
  return record;
}

IqRecord iq_record(const radar::StripmapImage& image, const radar::Radar& radar,
                   std::map<std::string, std::string> words) {
  IqRecord record{.kind = "stripmap image",
                  .unit = "m",
                  .quantity = "|a|^2 is a cross-section in m^2; a point of closest range r has the phase -4 pi r f / c",
                  .slow = {"closest_slant_range", "m", middles(image.closest_range_m)},
                  .fast = {"along_track", "m", middles(image.along_m)},
                  .polarizations = {"VV", "HH", "HV"},
                  .samples = numbers_of(image.amplitude_m),
                  .platform = {image.platform},
                  .numbers = {{"frequency_hz", image.frequency_hz},
                              {"squint_rad", image.squint_rad},
                              {"closest_range_cell_m", image.closest_range_cell_m},
                              {"along_cell_m", image.along_cell_m}},
                  .words = std::move(words)};
  record.numbers.merge(numbers_taken_from(record.words));
  describe_image(record, image.beam_azimuth_rad, radar);
  return record;
}

IqRecord iq_record(const radar::RangeAzimuthGrid& grid, std::span<const std::complex<float>> amplitudes_m,
                   std::vector<radar::Motion> platform, double frequency_hz, const radar::CurvedEarth& earth,
                   std::map<std::string, std::string> words) {
  words["software"] = software_name();
  std::map<std::string, double> numbers = numbers_taken_from(words);
  numbers.insert({{"frequency_hz", frequency_hz}, {"range_step_m", grid.range_step_m}});
  IqRecord record{
      .kind = "live frame",
      .unit = "m",
      .quantity = amplitude_words,
      .slow = {"azimuth", "rad",
               evenly(grid.first_azimuth_rad + grid.azimuth_step_rad / 2.0, grid.azimuth_step_rad, grid.azimuths)},
      .fast = {"slant_range", "m",
               evenly(grid.first_range_m + grid.range_step_m / 2.0, grid.range_step_m, grid.ranges)},
      .polarizations = {"VV", "HH", "HV", "VH"},
      .samples = amplitudes_m,
      .platform = std::move(platform),
      .numbers = std::move(numbers),
      .words = std::move(words)};
  if (earth.curvature_per_m() == 0.0) return record;
  record.numbers["earth_refraction"] = earth.refraction;
  record.words["positions"] =
      "of the platform: in the local frame, which is bent about the platform's foot where the beam was drawn: "
      "docs/iq_files.md";
  return record;
}

}  // namespace sigmascape::product
