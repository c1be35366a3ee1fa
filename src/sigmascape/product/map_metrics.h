#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// How two maps are held against one another.
struct CompareOptions {
  /// Cell sizes, in metres, to which both maps are averaged in linear power; each a multiple of the maps' cell. Empty
  /// stands for those of 2, 4, 8, 16, 32 that are such multiples, or where none is for 1, 2, 4, 8, 16 times the maps'
  /// cell, and of these for those that leave a cell to compare.
  std::vector<double> cells_m = {};
  radar::Polarization polarization = radar::Polarization::Sum;
  double floor_db = -45.0;   ///< σ0 below this counts as this in correlation_db and rms_db; finite
  double shadow_db = -35.0;  ///< σ0 below this is shadow; finite
};

/// How close the tested map a comes to the truth b at one cell size, over the cells that both maps saw wholly. With
/// A = max(10 lg a, floor), B = max(10 lg b, floor):
///
///     correlation_db = Pearson's correlation of A and B
///     rms_db         = √⟨(A − B)²⟩
///     bias_db        = 10 lg (Σa / Σb)
///     l1             = Σ|a − b| / Σb
///     shadow_iou     = |S_a ∩ S_b| / |S_a ∪ S_b|,   S the cells in shadow
///
/// The correlation is NaN where one of the maps is constant. The bias is of total power, so that bright cells decide,
/// and positive when the tested map is brighter. The overlap of shadows is 1 where neither map has any; of few cells it
/// says little.
struct CellComparison {
  double cell_m = 0.0;
  std::size_t cells = 0;
  double correlation_db = 0.0;
  double rms_db = 0.0;
  double bias_db = 0.0;
  double l1 = 0.0;
  double shadow_iou = 0.0;
  std::size_t shadow_cells = 0;  ///< |S_a ∪ S_b|
};

/// Of fewer cells in shadow than these, texts say no overlap: one cell would decide it.
inline constexpr std::size_t least_shadow_cells = 10;

/// A comparison and what it was made with.
struct MapComparison {
  CompareOptions options;
  std::vector<CellComparison> at;  ///< by cell size, in the order asked for

  /// The comparison at that cell size, or nullptr when it was not made.
  [[nodiscard]] const CellComparison* at_cell(double cell_m) const;
};

/// Compares two maps of the same cells. Throws Error for a frame that counts in something else than metres, when grid
/// or frame differ (saying how), when a cell is infinitely bright, when a cell size is no multiple of the maps' cell,
/// and when no cell is left that both maps saw.
[[nodiscard]] MapComparison compare_maps(const radar::GroundMap& tested, const radar::GroundMap& truth,
                                         const CompareOptions& options = {});

/// Throws Error when a cell of a map is infinitely bright in a polarization, naming the cell and the map as `name`
/// does.
void require_finite_cells(const radar::GroundMap& map, radar::Polarization polarization, const std::string& name);

/// The comparison as lines of text for a terminal, with the definitions' options stated. A noise floor (the truth
/// compared with itself traced from another seed) stands in brackets behind every number;
/// where none is given, the text says that it was not measured.
[[nodiscard]] std::string comparison_table(const MapComparison& comparison,
                                           const std::optional<MapComparison>& noise_floor = std::nullopt);

/// The comparison as JSON text:
///
///     {"polarization": "VV+HH+2HV", "floor_db": -45.0, "shadow_db": -35.0,
///      "cells": [{"cell_m": …, "correlation_db": …, "rms_db": …, "bias_db": …, "l1": …, "shadow_iou": …}, …],
///      "noise_floor": [the same rows, where one is given]}
///
/// A number that is not defined is null, and the overlap of fewer than `least_shadow_cells`.
[[nodiscard]] std::string comparison_json(const MapComparison& comparison,
                                          const std::optional<MapComparison>& noise_floor = std::nullopt);

/// "VV", "HH", "HV", "VH", or "VV+HH+2HV" for the sum.
[[nodiscard]] std::string polarization_name(radar::Polarization polarization);

}  // namespace sigmascape::product
