#include "sigmascape/bake/bake.h"

#include <algorithm>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "given_number.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "parts.h"
#include "python_progress.h"
#include "whole_number.h"

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

using Azimuths = Whole<"azimuths", unsigned, 1, atlas::most_azimuths>;
using PatchTexels = Whole<"patch_texels", std::size_t, atlas::tile_side, atlas::most_texels_per_side>;
using RaysATexel = Whole<"samples", std::uint32_t, 2, bake::most_samples_a_cell>;
using MostSamples = Whole<"most_samples", std::uint32_t, bake::pilot_samples, bake::most_samples_a_cell>;
using BakeBounces = Whole<"bounces", int, 1, 64>;
using MantissaBits = Whole<"mantissa_bits", int, 1, 10>;

struct BakeArguments {
  unsigned azimuths = 8;
  std::vector<double> elevations_deg, frequencies_ghz;
};

/// Whether a word that has the choice of two is the second; Error when it is neither.
bool is_second(const char* name, const std::string& word, const char* first, const char* second) {
  if (word != first && word != second)
    throw Error(name, "is '" + word + "'", std::string("give '") + first + "' or '" + second + "'");
  return word == second;
}

bake::Buildings buildings_from(const std::string& word) {
  if (word == "both") return bake::Buildings::Both;
  if (word == "apart") return bake::Buildings::Apart;
  if (word == "baked") return bake::Buildings::Baked;
  throw Error("buildings", "is '" + word + "'", "give 'baked', 'apart' or 'both'");
}

/// Rays by number, or by the standard error that they are to bring: one of the two, as on the command line.
bake::Sampling sampling_from(std::optional<RaysATexel> samples, std::optional<double> target_db,
                             std::optional<MostSamples> most_samples) {
  bake::Sampling sampling;
  for (const auto& [name, is_given] :
       {std::pair("target_db", target_db.has_value()), std::pair("most_samples", most_samples.has_value())}) {
    if (samples && is_given)
      throw Error(name, "is given, and samples says how many rays a texel gets", "leave out one of them");
  }
  if (target_db) within("target_db", *target_db, bake::least_target_db, bake::most_target_db);
  sampling.samples_per_texel = samples ? *samples : 0;
  sampling.target_db = target_db.value_or(sampling.target_db);
  if (most_samples) sampling.most_samples = *most_samples;
  return sampling;
}

bake::BakeSettings with_axes(bake::BakeSettings settings, const BakeArguments& arguments) {
  settings.aspects = {};
  settings.aspects.azimuths_rad = atlas::even_azimuths(arguments.azimuths);
  for (const double elevation : arguments.elevations_deg)
    settings.aspects.elevations_rad.push_back(radians_from_deg(elevation));
  for (const double frequency : arguments.frequencies_ghz) settings.aspects.frequencies_hz.push_back(frequency * 1e9);
  std::ranges::sort(settings.aspects.elevations_rad);
  std::ranges::sort(settings.aspects.frequencies_hz);
  return settings;
}

bake::BakeReport baked(const LoadedScene& scene, const std::filesystem::path& folder, Azimuths azimuths,
                       const std::vector<double>& elevations_deg, const std::vector<double>& frequencies_ghz,
                       double texel_m, PatchTexels patch_texels, std::optional<RaysATexel> samples,
                       std::optional<double> target_db, std::optional<MostSamples> most_samples, BakeBounces bounces,
                       Seed seed, const std::string& shadows, const std::string& buildings, const std::string& noise,
                       MantissaBits mantissa_bits, const std::string& digits, const std::string& shard, Threads threads,
                       const py::object& progress) {
  bake::BakeSettings settings;
  settings.patches = {.texel_m = texel_m, .texels_per_side = patch_texels};
  settings.sampling = sampling_from(samples, target_db, most_samples);
  settings.max_bounces = bounces;
  settings.seed = seed;
  settings.shadows = is_second("shadows", shadows, "run-time", "baked") ? bake::Shadows::Baked : bake::Shadows::RunTime;
  settings.buildings = buildings_from(buildings);
  settings.noise = is_second("noise", noise, "own", "shared") ? bake::Noise::Shared : bake::Noise::Own;
  settings.mantissa_bits = mantissa_bits;
  settings.digits = is_second("digits", digits, "to-noise", "all") ? atlas::Digits::All : atlas::Digits::ToNoise;
  settings.threads = threads;
  settings = with_axes(settings, {azimuths, elevations_deg, frequencies_ghz});
  const bake::BakeShare share{bake::shard_from(shard)};
  PythonProgress listener(progress);
  return long_call([&] { return bake::bake(scene.scene(), settings, folder, listener, share); });
}

}  // namespace

void add_bake(py::module_& module) {
  using bake::BakeReport;
  py::class_<BakeReport>(module, "BakeReport", "What a bake did.")
      .def_readonly("looks", &BakeReport::looks, "(patch, look) pairs of the share.")
      .def_readonly("already", &BakeReport::already, "Of them those that were there before.")
      .def_readonly("elsewhere", &BakeReport::elsewhere, "Of them those that another process baked meanwhile.")
      .def_property_readonly("rays", [](const BakeReport& r) { return r.counts.rays; })
      .def_property_readonly("paths", [](const BakeReport& r) { return r.counts.paths; })
      .def_property_readonly(
          "relative_standard_error", [](const BakeReport& r) { return r.errors.relative(); },
          "Of what this call baked: standard errors of a look's texels, summed up, over their power; mean over looks.\n"
          "None when nothing returned.")
      .def_property_readonly(
          "above_target", [](const BakeReport& r) { return r.errors.part_above_target(); },
          "Part of that power in texels whose error is above target_db; None as well when there was no target.")
      .def_property_readonly(
          "part_of_all", [](const BakeReport& r) { return r.errors.part_of_all(); },
          "Part which that power is of all that returns; the rest is bare ground, which is kept apart and has no "
          "noise.")
      .def("__repr__", [](const BakeReport& r) {
        return py::str("<sigmascape.BakeReport looks={} already={} rays={}>").format(r.looks, r.already, r.counts.rays);
      });

  const bake::BakeSettings settings;
  module.def(
      "bake", &baked, py::arg("scene"), py::arg("folder"), py::kw_only(), py::arg("azimuths") = 8,
      py::arg("elevations_deg") = std::vector<double>{5.0, 13.0, 21.0, 29.0, 37.0},
      py::arg("frequencies_ghz") = std::vector<double>{10.0}, py::arg("texel_m") = settings.patches.texel_m,
      py::arg("patch_texels") = settings.patches.texels_per_side, py::arg("samples") = py::none(),
      py::arg("target_db") = py::none(), py::arg("most_samples") = py::none(),
      py::arg("bounces") = settings.max_bounces, py::arg("seed") = settings.seed, py::arg("shadows") = "run-time",
      py::arg("buildings") = "baked", py::arg("noise") = "own", py::arg("mantissa_bits") = settings.mantissa_bits,
      py::arg("digits") = "to-noise", py::arg("shard") = "0/1", py::arg("threads") = 0,
      py::arg("progress") = py::none(),
      "Path-traces a scene into the atlas at `folder`. A bake that was broken off (Ctrl-C does so within a second) "
      "goes\n"
      "on where it stopped.\n\n"
      "azimuths: how many, evenly spaced from north. texel_m: side of a texel. patch_texels: 256, 512, 1024, ...\n"
      "samples: rays a texel everywhere; None: as many as bring its standard error to target_db (0.4 when None),\n"
      "most_samples (128 when None) at most.\n"
      "bounces: surfaces a path may meet. shadows: of objects on the ground, made at 'run-time' or 'baked'.\n"
      "buildings: what they return directly, 'baked' as all else; made at run time from walls and roofs, 'apart', for "
      "maps closer\nbetween looks but no live frames; or 'both', for either.\n"
      "noise: of what came over several surfaces, 'own', or 'shared' where texels share what their rays leave in "
      "doubt.\n"
      "digits: of texels, those that their standard errors do not drown, 'to-noise', or 'all', mantissa_bits at most.\n"
      "shard: '2/8' bakes the third of eight equal shares. threads: 0 for one a processor.\n"
      "progress: None for a bar by tqdm where that is installed, False for silence, or a callable\n"
      "(task, done, total, unit).");
}

}  // namespace sigmascape::python
