#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sigmascape/product/json_text.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/product/metric_text.h"

namespace sigmascape::product {
namespace {

constexpr int column_width = 16;

std::string cell_text(const MetricColumn& column, const CellComparison& row, const CellComparison* floor) {
  std::string text = metric_text(column, row, "-");
  if (floor != nullptr) text += " (" + metric_text(column, *floor, "-") + ")";
  return text;
}

nlohmann::ordered_json rows_json(const MapComparison& comparison) {
  auto rows = nlohmann::ordered_json::array();
  for (const CellComparison& row : comparison.at) {
    nlohmann::ordered_json object{{"cell_m", row.cell_m}};
    for (const MetricColumn& column : metric_columns) object[column.key] = metric_of(column, row);
    rows.push_back(std::move(object));
  }
  return rows;
}

}  // namespace

std::string comparison_table(const MapComparison& comparison, const std::optional<MapComparison>& noise_floor) {
  std::string text = fmt::format("{:>6} {:>9}", "cell_m", "cells");
  for (const MetricColumn& column : metric_columns) text += fmt::format(" {:>{}}", column.key, column_width);
  text += '\n';
  for (const CellComparison& row : comparison.at) {
    const CellComparison* floor = noise_floor ? noise_floor->at_cell(row.cell_m) : nullptr;
    text += fmt::format("{:>6} {:>9}", row.cell_m, row.cells);
    for (const MetricColumn& column : metric_columns)
      text += fmt::format(" {:>{}}", cell_text(column, row, floor), column_width);
    text += '\n';
  }
  text += fmt::format(
      "{}; dB no lower than {} dB; shadow below {} dB, no overlap said of fewer than {} cells; bias of total power, "
      "tested over truth\n",
      polarization_name(comparison.options.polarization), comparison.options.floor_db, comparison.options.shadow_db,
      least_shadow_cells);
  return text + (noise_floor ? "in brackets the noise floor: the truth compared with itself from another seed\n"
                             : "noise floor not measured\n");
}

std::string comparison_json(const MapComparison& comparison, const std::optional<MapComparison>& noise_floor) {
  nlohmann::ordered_json json{{"polarization", polarization_name(comparison.options.polarization)},
                              {"floor_db", comparison.options.floor_db},
                              {"shadow_db", comparison.options.shadow_db},
                              {"cells", rows_json(comparison)}};
  if (noise_floor) json["noise_floor"] = rows_json(*noise_floor);
  return json_text(json, 2);
}

}  // namespace sigmascape::product
