#pragma once

#include <vector>

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/shard.h"

namespace sigmascape::bake {

/// Looks of the share that were baked before but are not whole and as recorded: a bake with this scrutiny bakes them
/// again. Those that were never finished are not among them.
[[nodiscard]] std::vector<atlas::StoreFault> damaged_looks(const atlas::Store& store, const Shard& shard,
                                                           atlas::Scrutiny scrutiny);

}  // namespace sigmascape::bake
