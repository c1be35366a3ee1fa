#include <memory>
#include <optional>

#include "command.h"
#include "number_within.h"
#include "polarization_option.h"

#include "sigmascape/base/error.h"
#include "sigmascape/geo/coordinate_reference_system.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/map_metrics.h"

namespace sigmascape::cli {
namespace {

/// The map in a file, whose cells are metres wide, as far as this polarization needs it.
radar::GroundMap metric_map(const std::string& file, radar::Polarization polarization) {
  radar::GroundMap map = product::read_ground_map(file, polarization);
  product::require_finite_cells(map, polarization, file);
  if (geo::is_in_degrees(map.crs)) {
    throw Error(file, "has cells of degrees, and cells are compared by their metres",
                "render it with a --crs that counts in metres, or without one");
  }
  return map;
}

}  // namespace

void add_compare_command(Command app, Output& output) {
  const auto command = app.add_subcommand("compare", "Say how close one ground map comes to another");
  struct Options {
    std::string tested, truth, repeated;
    product::CompareOptions compare;
  };
  auto options = std::make_shared<Options>();
  command
      .add_option("TESTED", options->tested,
                  "ground map (GeoTIFF from render, or those bands of it that --polarization needs)")
      .required();
  command.add_option("TRUTH", options->truth, "ground map held to be right").required();
  command.add_option("--noise-floor", options->repeated,
                     "the truth traced again with another seed: how close two of them come");
  command
      .add_option("--cells-m", options->compare.cells_m,
                  "cell sizes to average to before comparing, with commas between; when nothing is said 2, 4, 8, 16 "
                  "and 32 where the maps' cells go into them, else 1 to 16 times these")
      .delimiter(',');
  command.add_option("--floor-db", options->compare.floor_db, "darker cells count as this dark")
      .capture_default_str()
      .check(number_within(-1000.0, 1000.0));
  command.add_option("--shadow-db", options->compare.shadow_db, "darker cells are shadow")
      .capture_default_str()
      .check(number_within(-1000.0, 1000.0));
  add_polarization_option(command, options->compare.polarization);
  command.add_flag("--json", output.json, "print as JSON");
  command.footer("Example:\n  sigmascape compare baked.tif traced.tif --noise-floor traced_again.tif");
  command.callback([options, &output] {
    const auto map_in = [&](const std::string& file) { return metric_map(file, options->compare.polarization); };
    const auto truth = map_in(options->truth);
    const auto comparison = product::compare_maps(map_in(options->tested), truth, options->compare);
    std::optional<product::MapComparison> floor;
    if (!options->repeated.empty()) floor = product::compare_maps(map_in(options->repeated), truth, options->compare);
    std::string text = product::comparison_table(comparison, floor);
    if (!floor) text += "render the truth again with another --seed and name it as --noise-floor to measure it\n";
    output.finish(text, nlohmann::ordered_json::parse(product::comparison_json(comparison, floor)));
  });
}

}  // namespace sigmascape::cli
