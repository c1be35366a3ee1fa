#pragma once

#include <cstddef>
#include <filesystem>

#include "sigmascape/base/progress.h"
#include "sigmascape/dataset/sample_maker.h"

namespace sigmascape::dataset {

/// Which part of a dataset a process makes and how. Nothing of it shows in what is written.
struct DatasetShare {
  std::size_t index = 0, count = 1;  ///< one of several equal shares, counted from 0
  unsigned threads = 0;              ///< 0: one a hardware thread
};

struct DatasetReport {
  std::size_t samples = 0;   ///< of the share
  std::size_t already = 0;   ///< of them there before
  bool is_complete = false;  ///< whether the folder now holds all samples of all shares, and the files about them all
};

/// Makes the samples of a share into `folder`, and when no sample is lacking any more what is told of all of them:
/// manifest.json with sizes and SHA-256, annotations.json (COCO), contact_sheet.png. docs/datasets.md is the format.
///
/// Samples come in lots of `samples_per_shard`, of which a process makes one after the other; a lot is there when its
/// file in `index` is. A run that was broken off goes on with the lot it was at. Equal specs give equal bytes for any
/// threads, shares and interruptions. In memory are the samples that are being made, of tar files those that wait for
/// one before them, and of the lots that are being made what their indices tell.
///
/// Throws Error when another dataset is in the folder, or one begun with another radar file or atlas, when there is
/// none but something of others by a name under which it writes, when another run, in whatever process, is making some
/// of these samples there, or when a file cannot be written.
DatasetReport make_dataset(const SampleMaker& maker, const std::filesystem::path& folder, const DatasetShare& share,
                           ProgressListener& progress);

}  // namespace sigmascape::dataset
