#include "bake_options.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

#include "number_within.h"
#include "seed_option.h"
#include "threads_option.h"
#include "word_option.h"

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::cli {
namespace {

/// In ascending order. Throws Error, naming the option, when one is given twice.
std::vector<double> ascending(std::vector<double> values, const char* option, const char* unit) {
  std::ranges::sort(values);
  const auto twice = std::ranges::adjacent_find(values);
  if (twice == values.end()) return values;
  throw Error(option, fmt::format("{:g}{} is given twice", *twice, unit), "give each value once");
}

/// 256 and twice as many again and again, as patches are halved to whole tiles.
Validator patch_side() {
  return {[](const std::string& word) {
            for (std::size_t side = atlas::tile_side; side <= atlas::most_texels_per_side; side *= 2) {
              if (word == std::to_string(side)) return std::string();
            }
            return fmt::format("is {}; give {} times a power of two, up to {}", word, atlas::tile_side,
                               atlas::most_texels_per_side);
          },
          "256, 512, 1024, ..."};
}

/// Grazing angles at which level ground is lit and has a range.
Validator elevation_deg() {
  return {
      [](const std::string& word) {
        const std::string fault = number_within(bake::lowest_elevation_deg, bake::highest_elevation_deg).fault(word);
        return fault.empty() ? fault
                             : fmt::format("{}: a level plane is not lit at 0° and has no ground range at 90°", fault);
      },
      fmt::format("in [{:g} - {:g}]", bake::lowest_elevation_deg, bake::highest_elevation_deg)};
}

}  // namespace

void BakeOptions::add_to(Command command) {
  add_texels_and_looks(command);
  add_rays(command);
  add_what_stands(command);
  command.add_option("--mantissa-bits", mantissa_bits, "bits kept of each half float at most, 1 to 10")
      .capture_default_str()
      .check(count_within(1, 10));
  add_word_option(command, "--digits", digits, {{"to-noise", atlas::Digits::ToNoise}, {"all", atlas::Digits::All}},
                  "of texels: those that their standard errors do not drown, or all")
      .default_str("to-noise");
  add_threads_option(command, threads);
}

void BakeOptions::add_texels_and_looks(Command command) {
  command.add_option("--texel-m", texel_m, "side of a texel on the ground")
      .capture_default_str()
      .check(number_within(bake::smallest_texel_m, 1e6));
  command.add_option("--patch-texels", patch_texels, "texels along a patch: 256, 512, 1024, ...")
      .capture_default_str()
      .check(patch_side());
  command.add_option("--azimuths", azimuths, "number of azimuths, evenly spaced from north")
      .capture_default_str()
      .check(count_within(1U, atlas::most_azimuths));
  command.add_option("--elevations-deg", elevations_deg, "grazing angles, with commas between")
      .delimiter(',')
      .capture_default_str()
      .check(elevation_deg());
  command.add_option("--frequencies-ghz", frequencies_ghz, "frequencies, with commas between")
      .delimiter(',')
      .capture_default_str()
      .check(number_within(1e-3, 1e3));
}

void BakeOptions::add_rays(Command command) {
  const bake::Sampling usual;
  const auto target_option =
      command
          .add_option("--target-db", target_db,
                      "standard error aimed at in what the rays to one cell return, as far as "
                      "--most-samples goes; 'atlas info' tells what part of the power is in texels above")
          .check(number_within(bake::least_target_db, bake::most_target_db));
  const auto most_option =
      command.add_option("--most-samples", most_samples, "rays a texel at most, however noisy it is")
          .check(count_within(bake::pilot_samples, bake::most_samples_a_cell));
  const auto samples_option =
      command.add_option("--samples", samples, "rays a texel everywhere (N_r of the paper) instead of a target")
          .check(count_within<std::uint32_t>(2, bake::most_samples_a_cell))
          .excludes(target_option, most_option);
  // One of the two ways is usual, and help tells the defaults of that one.
  if (usual_samples > 0) {
    samples_option.default_str(std::to_string(usual_samples));
  } else {
    target_option.default_str(fmt::format("{:g}", usual.target_db));
    most_option.default_str(std::to_string(usual.most_samples));
  }
  const auto preset_option =
      command.add_option("--preset", preset, "paper: 100 rays a texel everywhere, 8 bounces").check(one_of({"paper"}));
  command.add_option("--bounces", bounces, "surfaces a path may meet (N_b of the paper)")
      .capture_default_str()
      .check(count_within(1, 64))
      .excludes(preset_option);
  preset_option.excludes(target_option, most_option, samples_option);
  add_word_option(command, "--noise", noise, {{"own", bake::Noise::Own}, {"shared", bake::Noise::Shared}},
                  "of what came over several surfaces: each texel keeps its own, or texels share what their rays "
                  "leave in doubt with those around them")
      .default_str("own");
  add_seed_option(command, seed, "names the random numbers");
}

void BakeOptions::add_what_stands(Command command) {
  add_word_option(command, "--shadows", shadows,
                  {{"run-time", bake::Shadows::RunTime}, {"baked", bake::Shadows::Baked}},
                  "of objects on the ground: made at run time from stored obstacles, or baked as on level ground")
      .default_str("run-time");
  add_word_option(command, "--footing", footing,
                  {{"terrain", trace::Footing::Terrain}, {"level", trace::Footing::LevelPlane}},
                  "what objects stand on while they are baked: their own terrain, or level ground; always level "
                  "with --shadows baked")
      .default_str("terrain");
  add_word_option(
      command, "--buildings", buildings,
      {{"baked", bake::Buildings::Baked}, {"apart", bake::Buildings::Apart}, {"both", bake::Buildings::Both}},
      "what they return directly: baked as all else; made at run time from walls and roofs, which are "
      "stored then, for maps closer between looks but no live frames; or both, for either")
      .default_str("baked");
}

bake::BakeSettings BakeOptions::settings() const {
  bake::BakeSettings settings;
  settings.aspects = {};
  settings.aspects.azimuths_rad = atlas::even_azimuths(azimuths);
  for (const double elevation : ascending(elevations_deg, "--elevations-deg", "°"))
    settings.aspects.elevations_rad.push_back(radians_from_deg(elevation));
  for (const double frequency : ascending(frequencies_ghz, "--frequencies-ghz", " GHz"))
    settings.aspects.frequencies_hz.push_back(frequency * 1e9);
  settings.patches = {.texel_m = texel_m, .texels_per_side = patch_texels};
  const bool aims_at_an_error = target_db || most_samples;
  settings.sampling.samples_per_texel = samples.value_or(aims_at_an_error ? 0 : usual_samples);
  settings.sampling.target_db = target_db.value_or(settings.sampling.target_db);
  settings.sampling.most_samples = most_samples.value_or(settings.sampling.most_samples);
  settings.max_bounces = bounces;
  if (preset == "paper") {
    settings.sampling.samples_per_texel = 100;
    settings.max_bounces = 8;
  }
  settings.seed = seed;
  settings.shadows = shadows;
  settings.footing = footing;
  settings.buildings = buildings;
  settings.noise = noise;
  settings.mantissa_bits = mantissa_bits;
  settings.digits = digits;
  settings.threads = threads;
  return settings;
}

}  // namespace sigmascape::cli
