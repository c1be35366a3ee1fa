#include "sigmascape/product/plot_file.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/png_file.h"

namespace sigmascape::product {

void check_plot_name(const std::filesystem::path& path) {
  const std::string ending = file_ending(path);
  if (ending == ".svg" || ending == ".png") return;
  throw Error(path.string(), "is no kind of file that plots are drawn into", "end the name in .svg or .png");
}

void write_plot(const std::filesystem::path& path, const Plot& plot) {
  check_plot_name(path);
  geo::write_atomically(path, file_ending(path) == ".svg" ? svg_of(plot) : png_bytes(picture_of(drawing_of(plot))));
}

}  // namespace sigmascape::product
