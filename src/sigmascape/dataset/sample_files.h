#pragma once

#include <string>
#include <vector>

#include "sigmascape/dataset/sample_maker.h"

namespace sigmascape::dataset {

struct SampleFile {
  std::string name;  ///< "map.npy", "shadow.npy", "metadata.json", "preview.png"
  std::string bytes;
};

/// What is written of a sample: the map as [polarization, row, column], every label as [row, column] (masks and classes
/// as bytes, angles in degrees), what it shows and how it was made as JSON, and a picture of it.
[[nodiscard]] std::vector<SampleFile> sample_files(const DatasetSpec& spec, const Sample& sample);

/// In which polarization samples are pictured: the first that is written, and where there are targets the first of
/// those in which they have a cross-section.
[[nodiscard]] radar::Polarization pictured_polarization(const DatasetSpec& spec);

/// "VV", "sum": as the spec's file calls it.
[[nodiscard]] std::string_view word_of(radar::Polarization polarization);

}  // namespace sigmascape::dataset
