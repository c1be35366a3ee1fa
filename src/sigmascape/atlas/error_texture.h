#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sigmascape/atlas/store.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// Relative standard errors as they are stored, one byte a texel: 0 where nothing returns, else code c for
///
///     10^((c − 1)/50) / 1000          steps of 0.2 dB from 0.001 (or less) to 120
///
/// Rounded to the nearest step.
[[nodiscard]] std::uint8_t error_code(float relative_error, bool is_lit);
/// 0 for code 0.
[[nodiscard]] float error_of(std::uint8_t code);

/// Such a file: of the errors of all texels of a patch, those that return nothing 0. Throws Error, naming `file`, when
/// one is not a finite number or they are not as many as the texels.
[[nodiscard]] std::string error_texture_bytes(const Array2D<float>& errors, const Array2D<radar::Channels>& texels,
                                              const radar::GroundGrid& grid, const AtlasDescription& description,
                                              const std::filesystem::path& file);

/// The file beside a texture that holds them: the same name with the ending _error.tif.
[[nodiscard]] std::filesystem::path errors_path(const std::filesystem::path& texture);

}  // namespace sigmascape::atlas
