#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "sigmascape/dataset/sample_maker.h"

namespace sigmascape::dataset {

/// So many samples are on the contact sheet, in pictures of this side.
inline constexpr std::size_t sheet_samples = 36, sheet_side = 64;

/// "000042": what files of that sample are called.
[[nodiscard]] std::string sample_name(std::size_t sample);
/// "shard-000003.tar".
[[nodiscard]] std::string tar_name(std::size_t lot);
/// Where it is written what a lot of samples holds, when it is whole.
[[nodiscard]] std::filesystem::path index_path(const std::filesystem::path& folder, std::size_t lot);

/// Writes what is told of all samples together, from the index of every lot: manifest.json, annotations.json and
/// contact_sheet.png. Goes through the indices lot by lot, with one of them at a time in memory. Throws Error when an
/// index cannot be read.
void write_summary(const SampleMaker& maker, const std::filesystem::path& folder, std::size_t lots);

/// Whether all three are there.
[[nodiscard]] bool has_summary(const std::filesystem::path& folder);

}  // namespace sigmascape::dataset
