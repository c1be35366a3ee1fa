#include <array>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <span>

#include "array_view.h"
#include "gil.h"
#include "given_number.h"
#include "loaded_atlas.h"
#include "long_call.h"
#include "origin_words.h"
#include "parts.h"
#include "python_warnings.h"
#include "whole_number.h"

#include "sigmascape/base/error.h"
#include "sigmascape/product/iq_file.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/coherent_warnings.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/receiver/receiver_output.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/map_warnings.h"
#include "sigmascape/simulate/mode_image.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/recording_interval.h"
#include "sigmascape/simulate/scatterer_spacing.h"
#include "sigmascape/simulate/targets_seen.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using Targets = std::vector<radar::TargetSource>;

/// A recording or an image with what its file says about where it comes from.
template <typename Signal>
struct Described {
  Signal signal;
  radar::Radar radar;
  Words words;
  std::map<std::string, double> numbers;

  [[nodiscard]] product::IqRecord record() const {
    product::IqRecord record = product::iq_record(signal, radar, words);
    // What the signal knows itself, as the interval of its pulses, is nearer to the truth than a plan.
    record.numbers.insert(numbers.begin(), numbers.end());
    return record;
  }
};

/// A radar in the mode that makes an image, and how that does it.
struct Planned {
  radar::Radar radar;
  radar::CoherentPlan plan;
};

/// Of an image of an area whose middle is `aim`; nothing for a recording.
using Plan = std::function<std::optional<Planned>(const radar::Radar&, Vec3d aim)>;

template <typename Signal>
using Maker = Signal (*)(const simulate::CoherentScene&, const radar::Radar&, const radar::Rectangle&,
                         const simulate::CoherentSettings&);

/// What is made of an atlas alone knows no leaves.
constexpr const char* still_leaves =
    "has wind, which moves leaves of a scene, and these are of an atlas alone: their leaves hang still; record them "
    "with the command line, or state no wind_mps";

/// The side of cells that is asked for, or the usual one where none is. Wider than a range cell they would leave many
/// without a scatterer.
double checked_spacing_m(double asked_m, double usual_m, const radar::Radar& radar) {
  if (asked_m == 0.0) return usual_m;
  if (!(asked_m > 0.0 && asked_m <= radar.range_resolution_m)) {
    throw Error("scatterer_spacing_m", fmt::format("is {:g}", asked_m),
                fmt::format("give at most {:g} m, the radar's range resolution, or 0 for {:.4g} m",
                            radar.range_resolution_m, usual_m));
  }
  return asked_m;
}

/// Of a recording `recorded_s` is how long it is to be, which follows from the radar's mode where it is left out.
template <typename Signal>
Described<Signal> made(Maker<Signal> make, const Plan& plan_of, const LoadedAtlas& atlas,
                       const radar::RadarFile& radar_file, const Targets& given, double time_s,
                       simulate::CoherentSettings settings, std::optional<double> recorded_s = {}) {
  constexpr bool has_cells = !std::is_same_v<Signal, radar::PhaseHistory>;
  within("time_s", time_s, radar::bounds::moments_s);
  settings.moment_s = time_s;
  const radar::RadarFile asked = radar_file;
  return long_call([&]() -> Described<Signal> {
    const atlas::AtlasDescription& description = atlas.description();
    auto radar = simulate::placed_radar(asked, description.frame, atlas.terrain(), description.extent, time_s);
    const auto area = simulate::map_grid(asked.map, description.extent).extent();
    warn_of(radar, (has_cells ? simulate::map_warnings : simulate::area_warnings)(radar, asked.map, atlas.terrain(),
                                                                                  description.extent));
    if (radar.wind_mps > 0.0) warn_of(radar, std::array<std::string, 1>{still_leaves});
    const auto targets =
        simulate::all_targets(nullptr, given, description.frame, atlas.terrain(), settings.seed, time_s);
    if constexpr (!has_cells) {
      settings.interval_s = simulate::recording_interval_s(recorded_s, radar, area, atlas.terrain());
      warn_of(radar, simulate::pulse_warnings(radar, area, atlas.terrain(), targets, recorded_s, settings));
    }
    const Vec2d centre = area.centre();
    const Vec3d aim{centre.x, centre.y, atlas.terrain().height_at(centre)};
    radar::Rectangle answering = area;
    std::map<std::string, double> numbers;
    double usual_spacing_m = 0.0;
    if (const auto planned = plan_of(radar, aim)) {
      const radar::CoherentPlan& plan = planned->plan;
      warn_of(radar, radar::plan_warnings(planned->radar, plan, area, aim.z));
      settings.interval_s = plan.interval_s;
      settings.along_resolution_m = plan.along_resolution_m / plan.looks;
      settings.mapped = area;
      answering = simulate::answering_area(planned->radar, plan, area, aim.z);
      numbers = simulate::numbers_of_one_look(plan);
      usual_spacing_m = simulate::scatterer_spacing_m(radar, settings.along_resolution_m);
      radar.mode = planned->radar.mode;
    } else {
      usual_spacing_m = simulate::pulse_scatterer_spacing_m(radar, area, atlas.terrain(), settings.interval_s);
    }
    settings.scatterer_spacing_m = checked_spacing_m(settings.scatterer_spacing_m, usual_spacing_m, radar);
    const simulate::CoherentScene scene{
        &atlas.terrain(), render::reflectivity_of(atlas.textures(), radar.frequency_hz, settings.scatterer_spacing_m),
        targets};
    Words words = origin_words("scatterers from terrain and atlas", description.frame, description.name,
                               description.scene_hash, description.attribution, settings.seed);
    words["time_s"] = fmt::format("{}", time_s);
    words["dwell"] = std::to_string(settings.dwell);
    words["wind_mps"] = "0";
    words["look_side"] = simulate::look_side(radar, area);
    if constexpr (!has_cells) simulate::tell_of_mode(radar, area, atlas.terrain(), words);
    const auto seen = (has_cells ? simulate::targets_in_map : simulate::targets_in_pulses)(
        targets, radar, area, atlas.terrain(), simulate::obstacles_of(atlas.textures()));
    warn_of(radar, seen.warnings);
    words["targets"] = std::to_string(targets.size());
    words["targets_seen"] = std::to_string(seen.count);
    return {make(scene, radar, answering, settings), radar, std::move(words), std::move(numbers)};
  });
}

Described<radar::PhaseHistory> phase_history(const LoadedAtlas& atlas, const radar::RadarFile& radar,
                                             std::optional<double> interval_s, const Targets& targets, bool calibrated,
                                             double scatterer_spacing_m, Seed seed, double time_s, Dwell dwell,
                                             Threads threads) {
  const auto unplanned = [](const radar::Radar&, Vec3d) { return std::optional<Planned>(); };
  auto pulses = made(&simulate::phase_history, unplanned, atlas, radar, targets, time_s,
                     {.scatterer_spacing_m = scatterer_spacing_m,
                      .seed = seed,
                      .dwell = dwell,
                      .calibrated = calibrated,
                      .threads = threads},
                     interval_s);
  warn_of(pulses.radar, receiver::output_warnings(pulses.signal));
  return pulses;
}

std::optional<Planned> planned(const radar::Radar& radar, Vec3d aim) {
  return Planned{radar, radar::coherent_plan(radar, aim)};
}

/// The radar in a mode of which one number is asked, for one look.
radar::Radar asked_for(radar::Radar radar, radar::Mode mode, std::optional<double> radar::Processing::*number,
                       double value) {
  radar.mode = mode;
  radar.processing = {};
  radar.processing.*number = value;
  return radar;
}

Described<radar::RangeDopplerImage> range_doppler(const LoadedAtlas& atlas, const radar::RadarFile& radar,
                                                  std::optional<double> interval_s, const Targets& targets,
                                                  double scatterer_spacing_m, Seed seed, double time_s, Dwell dwell,
                                                  Threads threads) {
  if (interval_s) within("interval_s", *interval_s, radar::bounds::intervals_s);
  const Plan plan = [interval_s](const radar::Radar& placed, Vec3d aim) {
    const bool has_mode = placed.mode == radar::Mode::DopplerBeamSharpening || placed.mode == radar::Mode::Spotlight;
    if (has_mode && !interval_s) return planned(placed, aim);
    return planned(asked_for(placed, has_mode ? placed.mode : radar::Mode::Spotlight, &radar::Processing::interval_s,
                             interval_s.value_or(simulate::usual_interval_s)),
                   aim);
  };
  return made(&simulate::range_doppler_image, plan, atlas, radar, targets, time_s,
              {.scatterer_spacing_m = scatterer_spacing_m, .seed = seed, .dwell = dwell, .threads = threads});
}

Described<radar::StripmapImage> stripmap(const LoadedAtlas& atlas, const radar::RadarFile& radar,
                                         std::optional<double> along_resolution_m, const Targets& targets,
                                         double scatterer_spacing_m, Seed seed, double time_s, Dwell dwell,
                                         Threads threads) {
  if (along_resolution_m) within("along_resolution_m", *along_resolution_m, radar::bounds::along_resolutions_m);
  const Plan plan = [along_resolution_m](const radar::Radar& placed, Vec3d aim) {
    if (along_resolution_m)
      return planned(
          asked_for(placed, radar::Mode::Stripmap, &radar::Processing::along_resolution_m, *along_resolution_m), aim);
    radar::Radar strip = placed;
    strip.mode = radar::Mode::Stripmap;
    if (placed.mode != radar::Mode::Stripmap) strip.processing = {};
    return planned(strip, aim);
  };
  return made(&simulate::stripmap_image, plan, atlas, radar, targets, time_s,
              {.scatterer_spacing_m = scatterer_spacing_m, .seed = seed, .dwell = dwell, .threads = threads});
}

/// [place, xyz] of the motions on the slow axis: one of each pulse, or one of an image.
py::array_t<double> vectors_of(const std::vector<radar::Motion>& platform, Vec3d radar::Motion::*member) {
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(platform.size()), 3};
  py::array_t<double> array(shape, strides_of(shape, sizeof(double)));
  double* number = array.mutable_data();
  for (const radar::Motion& motion : platform)
    for (const double component : {(motion.*member).x, (motion.*member).y, (motion.*member).z}) *number++ = component;
  return array;
}

/// What all kinds have in common; `samples` finds the array in the signal.
template <typename Signal>
void add_signal(py::module_& module, const char* name, const char* doc, const char* samples_doc,
                Array2D<radar::ComplexChannels> Signal::*samples) {
  using Held = Described<Signal>;
  py::class_<Held, std::shared_ptr<Held>>(module, name, doc)
      .def_property_readonly(
          "samples",
          [samples](const py::object& self) {
            return layers_view<std::complex<float>>(self.cast<const Held&>().signal.*samples, self, Access::ReadWrite);
          },
          samples_doc)
      .def_property_readonly(
          "axes",
          [](const Held& held) {
            const auto record = held.record();
            py::dict axes;
            for (const product::IqAxis& axis : {record.slow, record.fast})
              axes[py::str(axis.name + "_" + axis.unit)] = copied_array(axis.values);
            return axes;
          },
          "Where the samples stand along the first two axes: float64 arrays by name and unit, in order.")
      .def_property_readonly(
          "platform_position_m",
          [](const Held& held) { return vectors_of(held.record().platform, &radar::Motion::position); },
          "Where the antenna was at each pulse, or of an image in the middle of its interval: float64 [place, xyz] in\n"
          "the local frame, over the k-Earth in its straight space.")
      .def_property_readonly(
          "platform_velocity_mps",
          [](const Held& held) { return vectors_of(held.record().platform, &radar::Motion::velocity_mps); },
          "How fast it went there: float64 [place, xyz].")
      .def_property_readonly(
          "beam_azimuth_rad",
          [](const Held& held) -> py::object {
            const auto azimuths_rad = held.record().beam_azimuth_rad;
            if (azimuths_rad.empty()) return py::none();
            return copied_array(azimuths_rad);
          },
          "Where the beam's axis then pointed, clockwise from the frame's north: float64 [place]. None where the\n"
          "samples have no pattern of the antenna in them, or the axis passes over every place.")
      .def_property_readonly(
          "cuts",
          [](const Held& held) {
            py::dict cuts;
            for (const product::IqAxis& column : held.record().cuts)
              cuts[py::str(column.name + "_" + column.unit)] = copied_array(column.values);
            return cuts;
          },
          "Of a measured antenna whose pattern is in the samples the columns of its table: float64 arrays by name.")
      .def_property_readonly(
          "metadata",
          [](const Held& held) {
            const auto record = held.record();
            py::dict metadata = py::cast(record.words);
            for (const auto& [key, number] : record.numbers) metadata[py::str(key)] = number;
            return metadata;
          },
          "What the file says beside samples and axes, as a dict.")
      .def(
          "save", [](const Held& held, const std::filesystem::path& path) { product::write_iq(path, held.record()); },
          py::arg("path"), py::call_guard<WithoutGil>(),
          "Writes .npy (with .json), .npz, .h5 or .sigmf-meta (with .sigmf-data); docs/iq_files.md.");
}

}  // namespace

void add_iq(py::module_& module) {
  add_signal(module, "PhaseHistory",
             "What a pulse radar records: compressed pulses before any processing, the carrier's phase kept.",
             "complex64 [pulse, range, 3]: VV, HH, HV (= VH); shares the recording's memory.",
             &radar::PhaseHistory::samples);
  add_signal(module, "RangeDopplerImage",
             "A focused image in slant range and Doppler; |a|^2 is a cross-section in m^2.",
             "complex64 [range, Doppler, 3]: VV, HH, HV (= VH); shares the image's memory.",
             &radar::RangeDopplerImage::amplitude_m);
  add_signal(module, "StripmapImage",
             "A focused image in closest slant range and place along the track; |a|^2 is a cross-section in m^2.",
             "complex64 [closest range, along track, 3]: VV, HH, HV (= VH); shares the image's memory.",
             &radar::StripmapImage::amplitude_m);
  module.def(
      "phase_history", &phase_history, py::arg("atlas"), py::arg("radar"), py::kw_only(),
      py::arg("interval_s") = py::none(), py::arg("targets") = Targets{}, py::arg("calibrated") = false,
      py::arg("scatterer_spacing_m") = 0.0, py::arg("seed") = 1, py::arg("time_s") = 0.0, py::arg("dwell") = 0,
      py::arg("threads") = 0,
      "The pulses of one interval over the radar's area: a PhaseHistory. A strip needs a radar that moves.\n\n"
      "interval_s: about time zero, when the radar is at its position; None for that of the radar's mode, of a strip\n"
      "until the beam has passed over all of the area, and for 0.1 with a real beam. targets: of Target. calibrated:\n"
      "volts at the receiver's output with thermal noise, and through time control and converter where the radar file\n"
      "has them, instead of metres. scatterer_spacing_m: side of the cells that hold a scatterer each, at most the\n"
      "radar's range resolution; 0 for half of what the pulses tell apart at the finest, in range or across it, and\n"
      "for the cells of its map where radar.mode makes one. seed: of speckle, targets and noise.\n"
      "time_s: moment, s; radar and targets have moved so long since time zero. dwell: which look at the same ground\n"
      "this is; each has noise and fluctuating targets of its own, and all the same speckle.\n\n"
      "Of an atlas alone: leaves hang still whatever radar.wind_mps, with a UserWarning, and point targets of the "
      "scene\n"
      "are there where they are handed over.");
  module.def(
      "range_doppler", &range_doppler, py::arg("atlas"), py::arg("radar"), py::kw_only(),
      py::arg("interval_s") = py::none(), py::arg("targets") = Targets{}, py::arg("scatterer_spacing_m") = 0.0,
      py::arg("seed") = 1, py::arg("time_s") = 0.0, py::arg("dwell") = 0, py::arg("threads") = 0,
      "Doppler beam sharpening or spotlight SAR of the radar's area: a RangeDopplerImage.\n\n"
      "interval_s: over which pulses are added up; None for that of the radar's mode, all its looks together, as\n"
      "render() lays them onto the ground, and for 0.1 where it makes no such images. Other arguments as for\n"
      "phase_history().");
  module.def(
      "stripmap", &stripmap, py::arg("atlas"), py::arg("radar"), py::kw_only(),
      py::arg("along_resolution_m") = py::none(), py::arg("targets") = Targets{}, py::arg("scatterer_spacing_m") = 0.0,
      py::arg("seed") = 1, py::arg("time_s") = 0.0, py::arg("dwell") = 0, py::arg("threads") = 0,
      "Stripmap SAR of the radar's area: a StripmapImage.\n\n"
      "along_resolution_m: half-power width along the flight; None for that of the radar's mode, of all its\n"
      "looks together, or else the coarser of what the beam gives and range_resolution_m. Other arguments as for\n"
      "phase_history().");
}

}  // namespace sigmascape::python
