#pragma once

#include "given_number.h"

#include "sigmascape/base/error.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::python {

/// `samples` and `bounces` as they were given. Throws Error for numbers with which nothing can be traced.
inline void check_rays(const simulate::TraceSettings& settings) {
  within("samples", settings.samples_per_cell, 1, 1U << 24U);
  within("bounces", settings.max_bounces, 1, 255);
}

/// `lod` as it was given, unless there is no such level.
inline int checked_lod(int lod) {
  if (lod < 0) throw Error("lod", "is negative", "give 0 to trace the scene, 1 and up for what is coarser");
  return lod;
}

}  // namespace sigmascape::python
