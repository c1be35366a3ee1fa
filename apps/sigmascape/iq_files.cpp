#include "iq_files.h"

#include <algorithm>
#include <fmt/format.h>

#include "number_within.h"
#include "received_files.h"
#include "stopwatch.h"
#include "terminal_progress.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/product/iq_file.h"
#include "sigmascape/receiver/receiver_output.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/map_provenance.h"
#include "sigmascape/simulate/map_warnings.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/recording_interval.h"
#include "sigmascape/simulate/scatterer_spacing.h"
#include "sigmascape/simulate/targets_seen.h"

namespace sigmascape::cli {
namespace {

/// What is in the pulses and where they come from. The map that is made beside them may have come about in another way,
/// and what is said of that is not said here.
Provenance words_of_pulses(const IqFiles& files, const IqRequest& request, double frequency_hz) {
  const bool calibrated = files.unit == "V";
  Provenance words = request.origin;
  words["processing"] = "scatterers from terrain and atlas";
  words["look_side"] = simulate::look_side(request.radar, request.area);
  words["antenna_pattern"] = calibrated ? "left in" : "none";
  words["thermal_noise"] = calibrated ? "in it" : "none";
  words["wind_mps"] = fmt::format("{:g}", request.radar.wind_mps);
  words["targets"] = std::to_string(request.targets.size());
  words["crs"] = request.scene.frame.proj();
  words["seed"] = std::to_string(request.seed);
  words["dwell"] = std::to_string(request.dwell);
  simulate::tell_of_mode(request.radar, request.area, request.scene.terrain, words);
  simulate::tell_of_textures(request.atlas->description(), request.radar, frequency_hz, words);
  return words;
}

simulate::CoherentSettings settings_of(const IqFiles& files, const IqRequest& request) {
  return {.interval_s =
              simulate::recording_interval_s(files.interval_s, request.radar, request.area, request.scene.terrain),
          .seed = request.seed,
          .dwell = request.dwell,
          .moment_s = request.moment_s,
          .calibrated = files.unit == "V",
          .threads = request.threads};
}

RecordedPulses told(const radar::PhaseHistory& history, double pulse_repetition_hz, double seconds) {
  const std::size_t pulses = history.samples.rows(), samples = history.samples.columns();
  const double first_m = history.first_range_m,
               last_m = first_m + history.range_step_m * static_cast<double>(samples - 1),
               interval_s = static_cast<double>(pulses) / pulse_repetition_hz;
  return {.words = fmt::format("{} pulses x {} samples, from {:.6g} to {:.6g} km over {:.4g} s, in {:.3f} s", pulses,
                               samples, first_m / 1e3, last_m / 1e3, interval_s, seconds),
          .numbers = {{"pulses", pulses},
                      {"pulse_samples", samples},
                      {"pulse_first_range_m", first_m},
                      {"pulse_last_range_m", last_m},
                      {"pulse_interval_s", interval_s},
                      {"pulse_seconds", seconds}}};
}

}  // namespace

std::vector<MannerOption> add_iq_options(Command command, IqFiles& files) {
  command.add_option("--iq", files.file,
                     "pulses as complex numbers to write, from the atlas (.npy, .npz, .h5 or .sigmf-meta)");
  const auto interval = command
                            .add_option("--interval-s", files.interval_s,
                                        "time over which --iq records pulses; when nothing is said that of the "
                                        "radar's mode, of a strip until all of it is passed, of a real beam 0.1")
                            .check(number_within(1e-6, 1e4));
  command.add_option("--slant-image", files.slant_image,
                     "complex image of a coherent mode in slant geometry to write (endings as for --iq)");
  const auto unit =
      command
          .add_option("--iq-unit", files.unit,
                      "of --iq: V, behind the antenna and with the receiver's thermal noise, or m, the root of "
                      "cross-sections without")
          .capture_default_str()
          .check(one_of({"m", "V"}));
  const auto has_pulses = [&files] { return !files.file.empty(); };
  return {{interval, "--interval-s", "--iq", has_pulses}, {unit, "--iq-unit", "--iq", has_pulses}};
}

double texture_frequency_hz(const atlas::AspectGrid& aspects, const radar::Radar& radar, bool extrapolate) {
  const auto& baked_hz = aspects.frequencies_hz;
  return extrapolate ? std::clamp(radar.frequency_hz, baked_hz.front(), baked_hz.back()) : radar.frequency_hz;
}

void check(const IqFiles& files, bool has_atlas) {
  if (files.file.empty()) return;
  product::check_iq_name(files.file);
  if (!has_atlas) throw Error("--iq", "needs an atlas", "name with --atlas the one that `sigmascape bake` made");
}

void check(const IqFiles& files, const IqRequest& request) {
  if (files.file.empty()) return;
  const atlas::AspectGrid& aspects = request.atlas->description().aspects;
  atlas::check_frequency(aspects, texture_frequency_hz(aspects, request.radar, request.extrapolate));
  const simulate::CoherentSettings settings = settings_of(files, request);
  const std::size_t samples = simulate::check_recording(request.radar, request.area, request.scene.terrain, settings);
  constexpr std::size_t polarizations = 3;
  product::check_iq_size(files.file, samples * polarizations, machine_memory_bytes());
  warn_of(request.radar, simulate::pulse_warnings(request.radar, request.area, request.scene.terrain, request.targets,
                                                  files.interval_s, settings));
}

std::optional<RecordedPulses> write_iq_files(const IqFiles& files, const IqRequest& request) {
  if (files.file.empty()) return std::nullopt;
  const atlas::Atlas textures = atlas::load_atlas(*request.atlas, {.reading = atlas::Reading::AsAsked});
  const double frequency_hz = texture_frequency_hz(textures.aspects(), request.radar, request.extrapolate);
  TerminalProgress progress;
  simulate::CoherentSettings settings = settings_of(files, request);
  settings.progress = &progress;
  settings.scatterer_spacing_m =
      simulate::pulse_scatterer_spacing_m(request.radar, request.area, request.scene.terrain, settings.interval_s);
  const double level = std::max(request.level_of_detail - 1.0, textures.level_for(settings.scatterer_spacing_m));
  const simulate::CoherentScene scene{
      &request.scene.terrain, render::AtlasReflectivity{&textures, frequency_hz, level}, request.targets,
      request.radar.wind_mps > 0.0 ? simulate::windblown_of(request.scene) : simulate::Windblown{}};
  const auto seen = simulate::targets_in_pulses(request.targets, request.radar, request.area, request.scene.terrain,
                                                simulate::obstacles_of(textures));
  warn_of(request.radar, seen.warnings);
  Provenance words = words_of_pulses(files, request, frequency_hz);
  words["targets_seen"] = std::to_string(seen.count);
  const Stopwatch watch;
  const auto history = simulate::phase_history(scene, request.radar, request.area, settings);
  const double seconds = watch.seconds();
  warn_of(request.radar, receiver::output_warnings(history));
  product::write_iq(files.file, product::iq_record(history, request.radar, words));
  return told(history, request.radar.waveform.pulse_repetition_hz, seconds);
}

}  // namespace sigmascape::cli
