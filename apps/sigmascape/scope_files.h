#pragma once

#include <string>

#include "command_parser.h"
#include "idle_options.h"
#include "map_files.h"

#include "sigmascape/product/picture.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::cli {

/// Pictures of the bins as a scope shows them, before any terrain comes in.
struct ScopeFiles {
  std::string ppi, b_scope, up = "north";
};

/// Returns that which is of --ppi alone.
[[nodiscard]] MannerOption add_scope_options(Command command, ScopeFiles& files);

/// Writes the pictures that were asked for, painted as `look` says, with what `provenance` tells of the image.
void write_scopes(const ScopeFiles& files, const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                  const product::PictureOptions& look, const Provenance& provenance);

}  // namespace sigmascape::cli
