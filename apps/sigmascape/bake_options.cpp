#include "bake_options.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

#include "number_within.h"
#include "word_option.h"

#include "sigmascape/base/units.h"

namespace sigmascape::cli {

void BakeOptions::add_to(CLI::App& command) {
  add_texels_and_looks(command);
  add_rays(command);
  add_what_stands(command);
  command.add_option("--mantissa-bits", mantissa_bits, "bits kept of each half float, 1 to 10")
      ->capture_default_str()
      ->check(CLI::Range(1, 10));
  command.add_option("--threads", threads, "0: one a processor")->capture_default_str();
}

void BakeOptions::add_texels_and_looks(CLI::App& command) {
  command.add_option("--texel-m", texel_m, "side of a texel on the ground")->capture_default_str();
  command.add_option("--patch-texels", patch_texels, "texels along a patch: 256, 512, 1024, ...")
      ->capture_default_str();
  command.add_option("--azimuths", azimuths, "number of azimuths, evenly spaced from north")
      ->capture_default_str()
      ->check(CLI::Range(1, 3600));
  command.add_option("--elevations-deg", elevations_deg, "grazing angles")->delimiter(',')->capture_default_str();
  command.add_option("--frequencies-ghz", frequencies_ghz, "frequencies")->delimiter(',')->capture_default_str();
}

void BakeOptions::add_rays(CLI::App& command) {
  const bake::Sampling usual;
  auto* target_option = command
                            .add_option("--target-db", target_db,
                                        "standard error aimed at in what the rays to one cell return, as far as "
                                        "--most-samples goes; 'atlas info' tells what part of the texels is above")
                            ->default_str(fmt::format("{:g}", usual.target_db));
  auto* most_option = command.add_option("--most-samples", most_samples, "rays a texel at most, however noisy it is")
                          ->default_str(std::to_string(usual.most_samples))
                          ->check(count_within(bake::pilot_samples, bake::most_samples_a_cell));
  auto* samples_option =
      command.add_option("--samples", samples, "rays a texel everywhere (N_r of the paper) instead of a target")
          ->check(count_within(2, bake::most_samples_a_cell))
          ->excludes(target_option, most_option);
  if (usual_samples > 0) samples_option->default_str(std::to_string(usual_samples));
  auto* preset_option = command.add_option("--preset", preset, "paper: 100 rays a texel everywhere, 8 bounces")
                            ->check(CLI::IsMember({"paper"}));
  command.add_option("--bounces", bounces, "surfaces a path may meet (N_b of the paper)")
      ->capture_default_str()
      ->check(CLI::Range(1, 64))
      ->excludes(preset_option);
  preset_option->excludes(target_option, most_option, samples_option);
  command.add_option("--seed", seed, "names the random numbers")->capture_default_str();
}

void BakeOptions::add_what_stands(CLI::App& command) {
  takes_words<bake::Shadows>(
      command.add_option(
          "--shadows", shadows,
          "of objects on the ground: made at run time from stored obstacles, or baked as on level ground"),
      {{"run-time", bake::Shadows::RunTime}, {"baked", bake::Shadows::Baked}})
      ->default_str("run-time");
  takes_words<trace::Footing>(
      command.add_option("--footing", footing,
                         "what objects stand on while they are baked: their own terrain, or level ground; always level "
                         "with --shadows baked"),
      {{"terrain", trace::Footing::Terrain}, {"level", trace::Footing::LevelPlane}})
      ->default_str("terrain");
}

bake::BakeSettings BakeOptions::settings() const {
  bake::BakeSettings settings;
  settings.aspects = {};
  for (unsigned i = 0; i < azimuths; ++i)
    settings.aspects.azimuths_rad.push_back(radians_from_deg(360.0 * i / azimuths));
  for (const double elevation : elevations_deg) settings.aspects.elevations_rad.push_back(radians_from_deg(elevation));
  for (const double frequency : frequencies_ghz) settings.aspects.frequencies_hz.push_back(frequency * 1e9);
  std::ranges::sort(settings.aspects.elevations_rad);
  std::ranges::sort(settings.aspects.frequencies_hz);
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
  settings.mantissa_bits = mantissa_bits;
  settings.threads = threads;
  return settings;
}

}  // namespace sigmascape::cli
