#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_parser.h"

#include "sigmascape/bake/bake.h"

namespace sigmascape::cli {

/// The command-line spelling of bake::BakeSettings.
struct BakeOptions {
  double texel_m = 2000.0 / 1024.0;
  std::size_t patch_texels = 512;
  unsigned azimuths = 8;
  std::vector<double> elevations_deg{5.0, 13.0, 21.0, 29.0, 37.0};
  std::vector<double> frequencies_ghz{10.0};
  std::optional<std::uint32_t> samples, most_samples;
  std::optional<double> target_db;
  std::uint32_t usual_samples = 0;  ///< a texel where no option says how many; 0 aims at a target instead
  std::string preset;
  int bounces = 8;
  std::uint64_t seed = 1;
  bake::Shadows shadows = bake::Shadows::RunTime;
  trace::Footing footing = trace::Footing::Terrain;
  bake::Buildings buildings = bake::Buildings::Baked;
  bake::Noise noise = bake::Noise::Own;
  int mantissa_bits = 10;
  atlas::Digits digits = atlas::Digits::ToNoise;
  unsigned threads = 0;

  void add_to(Command command);
  [[nodiscard]] bake::BakeSettings settings() const;

 private:
  void add_texels_and_looks(Command command);
  void add_rays(Command command);
  void add_what_stands(Command command);
};

}  // namespace sigmascape::cli
