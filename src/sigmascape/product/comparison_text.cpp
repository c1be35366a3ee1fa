#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sigmascape/product/map_metrics.h"

namespace sigmascape::product {
namespace {

std::string number_text(double value, int decimals, bool with_sign) {
  if (std::isnan(value)) return "-";
  // What rounds to nothing has no sign.
  const double shown = std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
  return with_sign && shown != 0.0 ? fmt::format("{:+.{}f}", shown, decimals) : fmt::format("{:.{}f}", shown, decimals);
}

/// A column of the table: a metric, how it is written, and how wide.
struct Column {
  const char* name;
  double CellComparison::*value;
  int decimals;
  bool with_sign;
};

constexpr Column columns[] = {
    {"correlation_db", &CellComparison::correlation_db, 3, false},
    {"rms_db", &CellComparison::rms_db, 2, false},
    {"bias_db", &CellComparison::bias_db, 2, true},
    {"l1", &CellComparison::l1, 3, false},
    {"shadow_iou", &CellComparison::shadow_iou, 3, false},
};
constexpr int column_width = 16;

std::string value_text(const Column& column, const CellComparison& row) {
  const bool says_little = column.value == &CellComparison::shadow_iou && row.shadow_cells < least_shadow_cells;
  return says_little ? "-" : number_text(row.*column.value, column.decimals, column.with_sign);
}

std::string cell_text(const Column& column, const CellComparison& row, const CellComparison* floor) {
  std::string text = value_text(column, row);
  if (floor != nullptr) text += " (" + value_text(column, *floor) + ")";
  return text;
}

nlohmann::ordered_json rows_json(const MapComparison& comparison) {
  auto rows = nlohmann::ordered_json::array();
  for (const CellComparison& row : comparison.at) {
    nlohmann::ordered_json object{{"cell_m", row.cell_m}};
    for (const Column& column : columns) object[column.name] = row.*column.value;
    rows.push_back(std::move(object));
  }
  return rows;
}

}  // namespace

std::string comparison_table(const MapComparison& comparison, const std::optional<MapComparison>& noise_floor) {
  std::string text = fmt::format("{:>6} {:>9}", "cell_m", "cells");
  for (const Column& column : columns) text += fmt::format(" {:>{}}", column.name, column_width);
  text += '\n';
  for (const CellComparison& row : comparison.at) {
    const CellComparison* floor = noise_floor ? noise_floor->at_cell(row.cell_m) : nullptr;
    text += fmt::format("{:>6} {:>9}", row.cell_m, row.cells);
    for (const Column& column : columns) text += fmt::format(" {:>{}}", cell_text(column, row, floor), column_width);
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
  return json.dump(2) + "\n";
}

}  // namespace sigmascape::product
