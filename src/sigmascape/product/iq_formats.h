#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sigmascape/product/iq_record.h"

namespace sigmascape::product {

/// One function a format; `write_iq` has checked the record.
void write_iq_npy(const std::filesystem::path& path, const IqRecord& record);
void write_iq_npz(const std::filesystem::path& path, const IqRecord& record);
void write_iq_hdf5(const std::filesystem::path& path, const IqRecord& record);
void write_iq_sigmf(const std::filesystem::path& path, const IqRecord& record);

/// Name and unit, as keys of metadata have them: "slant_range_m".
[[nodiscard]] std::string axis_name(const IqAxis& axis);

/// x, y, z of the platform's positions, or of its velocities, one after another.
[[nodiscard]] std::vector<double> platform_numbers(const IqRecord& record, Vec3d radar::Motion::*member);

}  // namespace sigmascape::product
