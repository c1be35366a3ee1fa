#pragma once

#include "sigmascape/live/ground_page.h"
#include "sigmascape/live/page_source.h"
#include "sigmascape/live/tile_cache.h"

namespace sigmascape::live {

/// Far more than any disk serves at once.
inline constexpr unsigned most_loaders = 256;

struct CacheOptions {
  std::size_t budget_bytes = std::size_t{512} << 20U;  ///< of all pages together
  unsigned loaders = 1;                                ///< threads that read and decode, most_loaders at most
  /// How closely a texture is looked at before its first tile is read. Content takes some milliseconds of a loader a
  /// texture, and finds what has been altered.
  atlas::Scrutiny scrutiny = atlas::Scrutiny::Content;
};

/// Pages of ground.
using PageCache = TileCache<PageSource>;

}  // namespace sigmascape::live
