#include "received_files.h"

#include <fmt/format.h>

#include "standard_error.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/product/range_azimuth_file.h"
#include "sigmascape/product/receiver_output.h"
#include "sigmascape/product/software.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/receiver/receive_chain.h"

namespace sigmascape::cli {
namespace {

const char* video_quantity(radar::Detector detector) {
  switch (detector) {
    case radar::Detector::Linear:
      return "detected voltage, V";
    case radar::Detector::SquareLaw:
      return "detected voltage squared, V²";
    case radar::Detector::Log:
      return "detected voltage squared, dB over 1 V²";
  }
  return "";
}

}  // namespace

void add_received_options(Command command, ReceivedFiles& files) {
  command.add_option(
      "--snr", files.snr,
      "signal-to-noise ratio of one pulse over range and azimuth to write (.npy, with a .json beside it)");
  command.add_option("--video", files.video,
                     "output of the detector, with noise, over range and azimuth to write (.npy, with a .json)");
}

void check(const ReceivedFiles& files) {
  for (const std::string& file : {files.snr, files.video})
    if (!file.empty()) product::check_range_azimuth_name(file);
}

void check(const ReceivedFiles& files, radar::Polarization polarization) {
  if (files.snr.empty() && files.video.empty()) return;
  if (polarization == radar::Polarization::Sum) {
    throw Error("--snr and --video", "cannot give the sum of polarizations, which no receiver has",
                "choose with --polarization vv, hh, hv or vh");
  }
}

void write_received(const ReceivedFiles& files, const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                    radar::Polarization polarization, std::uint64_t seed, unsigned threads,
                    const Provenance& provenance) {
  if (files.snr.empty() && files.video.empty()) return;
  auto received = receiver::received_power(radar, image, polarization);
  product::RangeAzimuthLabel label{.quantity = "signal-to-noise ratio of one pulse, linear power",
                                   .radar_position = radar.position,
                                   .numbers = {{"noise_w", received.noise_w},
                                               {"frequency_hz", radar.frequency_hz},
                                               {"impedance_ohm", radar.receiver.impedance_ohm}},
                                   .words = provenance};
  label.words["radar"] = radar.name;
  label.words["polarization"] = product::polarization_name(polarization);
  label.words["software"] = product::software_name();
  if (!files.video.empty()) {
    const auto detected = receiver::detected_image(radar, received, seed, threads);
    product::RangeAzimuthLabel video = label;
    video.quantity = video_quantity(radar.receiver.detector);
    video.numbers["gain_db"] = db_from_linear(radar.receiver.gain);
    video.numbers["pulses_integrated"] = radar.receiver.pulses_integrated;
    video.numbers["saturated_samples"] = static_cast<double>(detected.saturated);
    video.numbers.merge(product::output_numbers(radar.receiver.sensitivity_time_control,
                                                radar.receiver.analog_to_digital, detected.saturated));
    product::write_range_azimuth(files.video, detected.grid, detected.video, video);
  }
  if (!files.snr.empty()) {
    for (float& bin : received.signal_w.values()) bin = static_cast<float>(static_cast<double>(bin) / received.noise_w);
    product::write_range_azimuth(files.snr, received.grid, received.signal_w, label);
  }
}

radar::PowerMap received_map(const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                             const terrain::HeightField& terrain, const radar::GroundGrid& grid,
                             const geo::LocalFrame& frame, const Provenance& provenance, unsigned threads) {
  return described_map(product::power_map(receiver::received_image(radar, image), terrain, grid, threads), radar, frame,
                       provenance);
}

void warn_of(const radar::Radar& radar, std::span<const std::string> warnings) {
  for (const std::string& warning : warnings) warn(fmt::format("{}: {}", radar::title_of(radar), warning));
}

}  // namespace sigmascape::cli
