#include "atlas_terrain.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <system_error>

#include "command.h"
#include "number_within.h"
#include "standard_error.h"
#include "terminal_progress.h"
#include "word_option.h"
#include "words.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/terrain/extent_about.h"
#include "sigmascape/terrain/height_difference.h"
#include "sigmascape/terrain/height_field_file.h"
#include "sigmascape/terrain/pyramid_builder.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::cli {
namespace {

/// Where there can be terrain. Live frames look at the atlas' own ground first of all.
radar::Rectangle extent_of_terrain(const terrain::TerrainSource& source, const geo::Raster& heights,
                                   const geo::LocalFrame& frame, const radar::Rectangle& atlas) {
  if (const auto about = terrain::extent_about(heights, frame, atlas))
    return {about->west_m, about->south_m, about->east_m, about->north_m};
  const geo::Extent around = heights.outline_in(frame).extent_around();
  const std::string place = std::isfinite(around.east_m)
                                ? fmt::format(
                                      "{:.0f} to {:.0f} m east and {:.0f} to {:.0f} m north of the atlas' "
                                      "origin, and ",
                                      around.west_m, around.east_m, around.south_m, around.north_m)
                                : "";
  throw Error(source.raster.file.string(), fmt::format("lies {}nowhere over the atlas", place),
              fmt::format("give terrain over {:.0f} to {:.0f} m east and {:.0f} to {:.0f} m north", atlas.west_m,
                          atlas.east_m, atlas.south_m, atlas.north_m));
}

/// Before the work, which may be long.
void warn_of_guessed_unit(const terrain::TerrainSource& source, const geo::Raster& heights) {
  if (!heights.height_unit().is_guess) return;
  warn(fmt::format(
      "{}: states no unit of heights on a map in feet, taken to be in metres; --unit ft or us-ft says otherwise",
      source.raster.file.string()));
}

/// Live frames stand on the tiles, inside the scene as well. What was baked there belongs to the scene's own heights,
/// and where these are more than a texel away the ground has other slopes and shadows. At a few places they may be: no
/// raster has every edge of another.
void warn_of_other_heights(const atlas::Store& store, const std::string& raster, terrain::TerrainPyramid& tiles) {
  if (atlas::terrain_fault(store, atlas::Scrutiny::Content)) return;
  const auto baked = terrain::read_height_field(atlas::vouched_terrain(store, atlas::Scrutiny::Size));
  const auto apart = terrain::height_difference(tiles, baked, store.description().extent);
  if (!apart || apart->nearly_all_m <= store.description().patches.texel_m) return;
  warn(fmt::format(
      "{}: lies up to {:.1f} m above or below the heights that the atlas was baked on, {:.1f} m in the median; live "
      "frames stand on it inside the scene too: lay the scene's own elevation over it, and give --spacing {:.3g}",
      raster, apart->greatest_m, apart->median_m, baked.spacing_m));
}

/// Heights from a raster about the atlas, in tiles beside it.
void build_terrain(const std::string& folder, terrain::TerrainSource source, double no_data_height_m,
                   const Output& output) {
  const atlas::Store store = atlas::Store::open(folder);
  const geo::LocalFrame& frame = store.description().frame;
  const geo::Raster heights(source.raster);
  const radar::Rectangle reach = extent_of_terrain(source, heights, frame, store.description().extent);
  warn_of_guessed_unit(source, heights);
  // Cells of degrees are of other sizes at the far ends of what the raster reaches.
  if (!source.spacing_m) source.spacing_m = heights.cell_m(frame, store.description().extent.centre());
  const auto pyramid = std::filesystem::path(folder) / atlas::terrain_pyramid_name;
  // Two at once would take each other's unfinished files for those of other heights.
  const bake::Claims claims(folder);
  TerminalProgress progress;
  const bake::Claims::Claim claim = claims.take(bake::terrain_claim(store.description()), [&progress] {
    progress.waiting("terrain", "a bake that makes that of the atlas");
  });
  const terrain::PyramidBuild build = terrain::build_pyramid(pyramid, source, frame, reach, no_data_height_m);
  terrain::TerrainPyramid built = terrain::open_pyramid(pyramid, 0);
  warn_of_other_heights(store, source.raster.file.string(), built);
  const terrain::PyramidLayout& layout = built.layout();
  const radar::Rectangle extent = built.extent();
  std::string text = fmt::format("{}, {} x {} tiles of {} cells of {:g} m: {:.0f} m x {:.0f} m; {} written",
                                 counted(layout.levels(), "level", "levels"), layout.tiles_across, layout.tiles_down,
                                 terrain::HeightTile::cells, layout.spacing_m, extent.width_m(), extent.height_m(),
                                 counted(build.tiles_written, "tile", "tiles"));
  if (build.nodes_without_height > 0) {
    text += fmt::format("\n{} no height in {} and {} at {:g} m: --no-data-height, or fill them first",
                        counted(build.nodes_without_height, "node has", "nodes have"),
                        source.raster.file.filename().string(), build.nodes_without_height == 1 ? "lies" : "lie",
                        no_data_height_m);
  }
  output.finish(text, {{"atlas", folder},
                       {"written", build.tiles_written},
                       {"nodes_without_height", build.nodes_without_height},
                       {"levels", layout.levels()},
                       {"tiles", {layout.tiles_across, layout.tiles_down}},
                       {"spacing_m", layout.spacing_m},
                       {"extent_m", {extent.west_m, extent.south_m, extent.east_m, extent.north_m}}});
}

}  // namespace

void add_terrain_command(Command added, const std::shared_ptr<std::string>& folder, Output& output) {
  const auto source = std::make_shared<terrain::TerrainSource>();
  const auto spacing_m = std::make_shared<double>(0.0);
  const auto no_data_height_m = std::make_shared<double>(0.0);
  added.add_option("RASTER", source->raster.file, "elevation in any format that GDAL reads").required();
  added.add_option("--band", source->raster.band, "band of the raster").capture_default_str();
  added.add_option("--crs", source->raster.crs, "instead of the raster's own coordinate system");
  add_word_option(added, "--unit", source->raster.unit, {{"m", "m"}, {"cm", "cm"}, {"ft", "ft"}, {"us-ft", "us-ft"}},
                  "unit of heights, instead of the raster's own");
  added
      .add_option("--spacing", *spacing_m,
                  "metres between heights; the raster's own cell in the atlas' middle if not given")
      .check(number_within(0.01, 1e5));
  added.add_option("--no-data-height", *no_data_height_m, "height in metres where the raster has none")
      .capture_default_str()
      .check(number_within(-12'000.0, 10'000.0));
  added.callback([folder, source, spacing_m, no_data_height_m, &output] {
    if (*spacing_m > 0.0) source->spacing_m = *spacing_m;
    build_terrain(*folder, *source, *no_data_height_m, output);
  });
}

}  // namespace sigmascape::cli
