#pragma once

#include "sigmascape/product/described_map.h"
#include "sigmascape/product/map_picture.h"

namespace sigmascape::cli {

using product::described_map;
using product::Provenance;
using product::write_map_picture;

}  // namespace sigmascape::cli
