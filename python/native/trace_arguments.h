#pragma once

#include "sigmascape/base/error.h"

namespace sigmascape::python {

/// `lod` as it was given, unless there is no such level.
inline int checked_lod(int lod) {
  if (lod < 0) throw Error("lod", "is negative", "give 0 to trace the scene, 1 and up for what is coarser");
  return lod;
}

}  // namespace sigmascape::python
