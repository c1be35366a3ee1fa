#pragma once

#include <filesystem>
#include <string>

#include "sigmascape/product/iq_record.h"

namespace sigmascape::product {

/// Writes an I/Q recording as the kind of file that its name asks for, atomically; docs/iq_files.md says what each
/// holds. Equal records give equal bytes; no clock goes in.
///
///     .npy         complex64 [slow, fast, polarization], and beside it .json with axes and metadata
///     .npz         the same with axes and platform as arrays of their own
///     .h5          HDF5: a dataset a polarization as compound {r, i}, axes as dimension scales, units as attributes
///     .sigmf-meta  SigMF, with the samples in .sigmf-data: cf32_le, a channel a polarization, a capture a pulse
///
/// Throws Error for another ending, when the record's axes do not fit its samples, when it says a key twice, and when a
/// file cannot be written.
void write_iq(const std::filesystem::path& path, const IqRecord& record);

/// Throws Error when `write_iq` would not know what to write under this name: for asking before the work.
void check_iq_name(const std::filesystem::path& path);

/// Throws Error when that many samples, all polarizations counted, are more than a file of this name holds, or than
/// memory does while they are written: before the work, too.
void check_iq_size(const std::filesystem::path& path, std::size_t samples, double memory_bytes);

/// Everything that the record says besides its samples and the places on its axes, as JSON.
[[nodiscard]] std::string iq_description(const IqRecord& record);

}  // namespace sigmascape::product
