#include "scope_files.h"

#include <algorithm>

#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/attribution_line.h"
#include "sigmascape/product/legend.h"
#include "sigmascape/product/png_file.h"
#include "sigmascape/product/scope_layout.h"
#include "sigmascape/product/software.h"

namespace sigmascape::cli {
namespace {

/// The bins of a narrow sector are a hundred times as many in range as in azimuth: each is drawn so wide that the
/// picture is half as wide as it is tall, and the other way round; but no wider than is looked at, or a picture of many
/// bins would be of many more pixels.
radar::GroundMap drawn_out(const radar::GroundMap& bins) {
  constexpr std::size_t widest = 2048;
  const auto times = [&](std::size_t count, std::size_t other) {
    return std::max<std::size_t>(1, std::min(other / 2, widest) / count);
  };
  const std::size_t across = times(bins.grid.columns, bins.grid.rows), down = times(bins.grid.rows, bins.grid.columns);
  radar::GroundMap wide = bins;
  wide.grid.columns *= across;
  wide.grid.rows *= down;
  wide.sigma0 = Array2D<radar::Channels>(wide.grid.columns, wide.grid.rows);
  for (std::size_t row = 0; row < wide.grid.rows; ++row) {
    for (std::size_t column = 0; column < wide.grid.columns; ++column)
      wide.sigma0(column, row) = bins.sigma0(column / across, row / down);
  }
  return wide;
}

/// Without a world file: in slant range pixels have no place on a map.
void write_scope(const std::string& file, radar::GroundMap bins, const product::PictureOptions& look,
                 const product::LegendParts& parts, const Provenance& provenance) {
  bins.metadata = provenance;
  const auto picture = product::with_legend(product::picture_of(bins, look), parts);
  geo::write_atomically(file, product::png_bytes(product::with_attribution(picture)));
}

}  // namespace

MannerOption add_scope_options(Command command, ScopeFiles& files) {
  command.add_option("--ppi", files.ppi, "picture of the sector as a plan position indicator shows it");
  command.add_option("--b-scope", files.b_scope, "picture of range over azimuth");
  const auto up =
      command.add_option("--up", files.up, "what is at the top of the plan position indicator: north or heading")
          .capture_default_str()
          .check(one_of({"north", "heading"}));
  return {up, "--up", "--ppi", [&files] { return !files.ppi.empty(); }};
}

void write_scopes(const ScopeFiles& files, const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                  const product::PictureOptions& look, const Provenance& provenance) {
  Provenance told = provenance;
  told["radar"] = radar.name;
  told["software"] = product::software_name();
  if (!files.ppi.empty()) {
    const double up_rad = files.up == "heading" ? radar.heading_rad : 0.0;
    write_scope(files.ppi, product::ppi(image, {.up_rad = up_rad}), look, {.north_arrow = files.up == "north"}, told);
  }
  if (!files.b_scope.empty()) {
    write_scope(files.b_scope, drawn_out(product::b_scope(image)), look, {.scale_bar = false, .north_arrow = false},
                told);
  }
}

}  // namespace sigmascape::cli
