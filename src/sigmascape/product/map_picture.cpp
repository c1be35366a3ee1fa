#include "sigmascape/product/map_picture.h"

#include "sigmascape/product/attribution_line.h"
#include "sigmascape/product/legend.h"
#include "sigmascape/product/png_file.h"

namespace sigmascape::product {

void write_map_picture(const std::filesystem::path& path, const MapView& map, const PictureOptions& options) {
  write_png(path, with_attribution(with_legend(picture_of(map, options))));
}

}  // namespace sigmascape::product
