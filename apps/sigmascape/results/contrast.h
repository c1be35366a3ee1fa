#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/plan.h"
#include "results/table.h"

namespace sigmascape::cli {

/// Two cases that differ in one thing alone.
struct Contrast {
  std::string name;
  std::string how;  ///< the case with it against the case without it, in words
  ResultsCase with, without;
};

/// The measurements of a contrast, at the cells that verdicts are about.
struct MeasuredContrast {
  const ResultsRow *with, *without;
  const ResultsCell *with_cell, *without_cell;
};

/// Nothing where one of the two was not measured.
[[nodiscard]] std::optional<MeasuredContrast> measured(const Contrast& contrast, const std::vector<ResultsRow>& rows);

/// The least difference in RMS of dB that is said to count: a change that takes less off pays little, and by medians
/// that are closer than this no way is told to be better than another.
inline constexpr double least_fall_db = 0.05;

/// What an error falls by from one case to another at one view; negative where it rises.
struct FallAtView {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
  double falls_by = 0.0;

  [[nodiscard]] bool is_at(double other_azimuth_deg, double other_elevation_deg) const {
    return azimuth_deg == other_azimuth_deg && elevation_deg == other_elevation_deg;
  }
};

/// At summary_cell_m and every view that both cases were measured at.
[[nodiscard]] std::vector<FallAtView> falls_at_views(const ResultsRow& from, const ResultsRow& to,
                                                     double product::CellComparison::*error);

/// What an error falls by from one case to another, view by view: a difference of medians may be of different views.
struct PairedFall {
  std::size_t views = 0;   ///< that both cases were measured at
  std::size_t better = 0;  ///< of these, at which the error falls
  double mean = 0.0;       ///< of each view's own fall; 0 without views
  double median = 0.0;     ///< the same, which no single view decides
};

[[nodiscard]] PairedFall paired(const std::vector<FallAtView>& falls);

/// At summary_cell_m.
[[nodiscard]] PairedFall fall_between(const ResultsRow& from, const ResultsRow& to,
                                      double product::CellComparison::*error);

/// "-0.48 | 6 of 24": the mean or the median of what the RMS of dB falls by, and at how many views; dashes without.
[[nodiscard]] std::string fall_text(const PairedFall& fall, double PairedFall::*middle);

/// The first line of a table of contrasts: what two traced maps of the views differ by, and cells that stay empty. No
/// line without such views.
[[nodiscard]] std::string truth_line(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                                     const char* empty_cells);

}  // namespace sigmascape::cli
