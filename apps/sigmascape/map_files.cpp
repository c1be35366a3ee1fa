#include "map_files.h"

#include "sigmascape/product/attribution_line.h"
#include "sigmascape/product/legend.h"
#include "sigmascape/product/png_file.h"

namespace sigmascape::cli {

void write_map_picture(const std::filesystem::path& path, const radar::GroundMap& map,
                       const product::PictureOptions& options) {
  product::write_png(path, product::with_attribution(product::with_legend(product::picture_of(map, options))));
}

}  // namespace sigmascape::cli
