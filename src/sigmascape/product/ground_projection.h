#pragma once

#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/power_map.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/received_image.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::product {

/// Lays a radar image back onto the ground: every cell takes the bins at its own slant range and azimuth, as seen where
/// the terrain puts it.
///
///     σ0 = σ_bin / (r Δr Δφ)                                        docs/physics/receiver.md, Eq. (2)
///
/// r Δr Δφ is the horizontal area of a bin over level ground. Cells outside the bins become NaN. What stands above the
/// terrain appears where its range puts it: laid over towards the radar. `threads` is 0 for one a hardware thread.
/// `earth`: the one over which the bins hold their ranges, flat as real-beam images have it, or of a live frame the
/// frame's (live::Frame::earth).
[[nodiscard]] radar::GroundMap ground_map(const radar::RangeAzimuthImage& image, const terrain::HeightField& terrain,
                                          const radar::GroundGrid& grid, unsigned threads = 1,
                                          const radar::CurvedEarth& earth = radar::CurvedEarth::flat());

/// The same for power: every cell takes the power of the bins at its place as it is, for a receiver's bin is one sample
/// however much ground lies in it.
[[nodiscard]] radar::PowerMap power_map(const radar::ReceivedImage& image, const terrain::HeightField& terrain,
                                        const radar::GroundGrid& grid, unsigned threads = 1,
                                        const radar::CurvedEarth& earth = radar::CurvedEarth::flat());

}  // namespace sigmascape::product
