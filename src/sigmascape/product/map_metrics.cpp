#include "sigmascape/product/map_metrics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/product/block_mean.h"
#include "sigmascape/product/same_cells.h"

namespace sigmascape::product {
namespace {

constexpr double usual_cells_m[] = {2.0, 4.0, 8.0, 16.0, 32.0};
constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();

/// Sums over cell pairs from which all metrics follow.
class PairSums {
 public:
  PairSums(double floor_db, double shadow_db) : floor_(linear_from_db(floor_db)), shadow_(linear_from_db(shadow_db)) {}

  void add(double a, double b) {
    ++cells_;
    total_a_ += a;
    total_b_ += b;
    total_error_ += std::abs(a - b);
    both_shadow_ += a < shadow_ && b < shadow_ ? 1U : 0U;
    any_shadow_ += a < shadow_ || b < shadow_ ? 1U : 0U;

    // Welford's update: dB of a nearly constant map would lose its variance in a difference of sums of squares.
    const double a_db = db_from_linear(std::max(a, floor_));
    const double b_db = db_from_linear(std::max(b, floor_));
    const double n = static_cast<double>(cells_);
    const double step_a = a_db - mean_a_;
    const double step_b = b_db - mean_b_;
    mean_a_ += step_a / n;
    mean_b_ += step_b / n;
    variance_a_ += step_a * (a_db - mean_a_);
    variance_b_ += step_b * (b_db - mean_b_);
    covariance_ += step_a * (b_db - mean_b_);
    squared_error_ += (a_db - b_db) * (a_db - b_db);
  }

  [[nodiscard]] CellComparison metrics(double cell_m) const {
    const double spread = std::sqrt(variance_a_ * variance_b_);
    return {.cell_m = cell_m,
            .cells = cells_,
            .correlation_db = spread > 0.0 ? std::clamp(covariance_ / spread, -1.0, 1.0) : not_defined,
            .rms_db = std::sqrt(squared_error_ / static_cast<double>(cells_)),
            .bias_db = total_a_ > 0.0 && total_b_ > 0.0 ? db_from_linear(total_a_ / total_b_) : not_defined,
            .l1 = total_b_ > 0.0 ? total_error_ / total_b_ : not_defined,
            .shadow_iou = any_shadow_ > 0 ? static_cast<double>(both_shadow_) / static_cast<double>(any_shadow_) : 1.0,
            .shadow_cells = any_shadow_};
  }

  [[nodiscard]] std::size_t cells() const { return cells_; }

 private:
  double floor_, shadow_;
  std::size_t cells_ = 0, both_shadow_ = 0, any_shadow_ = 0;
  double total_a_ = 0.0, total_b_ = 0.0, total_error_ = 0.0;
  double mean_a_ = 0.0, mean_b_ = 0.0, variance_a_ = 0.0, variance_b_ = 0.0, covariance_ = 0.0, squared_error_ = 0.0;
};

PairSums sums_over_blocks(const radar::GroundMap& tested, const radar::GroundMap& truth, const CompareOptions& options,
                          std::size_t factor) {
  const Array2D<double> a = block_mean(tested, options.polarization, factor);
  const Array2D<double> b = block_mean(truth, options.polarization, factor);
  PairSums sums(options.floor_db, options.shadow_db);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isnan(a.values()[i]) && !std::isnan(b.values()[i])) sums.add(a.values()[i], b.values()[i]);
  }
  return sums;
}

/// The sizes where none are named: the usual ones, or where the maps' cells go into none of those, as 5 m do not, some
/// of their own.
std::vector<double> sizes_to_compare_at(const radar::GroundGrid& grid) {
  std::vector<double> sizes_m;
  for (const double size_m : usual_cells_m)
    if (block_factor(size_m, grid) != 0) sizes_m.push_back(size_m);
  if (!sizes_m.empty()) return sizes_m;
  for (const double cells : {1.0, 2.0, 4.0, 8.0, 16.0}) sizes_m.push_back(cells * grid.cell_m);
  return sizes_m;
}

void require_metres(const radar::GroundMap& map, const char* which) {
  const std::string unit = geo::axis_unit(map.crs);
  if (unit == "m") return;
  throw Error("maps to compare",
              fmt::format("{} counts its places in {}, and cells are compared by their metres", which, unit),
              "render it in a system that counts in metres, or in the scene's own");
}

void require_finite(double level_db, const char* which) {
  if (!std::isfinite(level_db)) throw Error(which, fmt::format("is {:g}", level_db), "give a finite number of dB");
}

}  // namespace

const CellComparison* MapComparison::at_cell(double cell_m) const {
  const auto found = std::find_if(at.begin(), at.end(), [&](const CellComparison& c) { return c.cell_m == cell_m; });
  return found == at.end() ? nullptr : &*found;
}

void require_finite_cells(const radar::GroundMap& map, radar::Polarization polarization, const std::string& name) {
  const auto is_infinite = [&](const radar::Channels& cell) { return std::isinf(cell.power(polarization)); };
  const auto fault = std::ranges::find_if(map.sigma0.values(), is_infinite);
  if (fault == map.sigma0.values().end()) return;
  const auto index = static_cast<std::size_t>(fault - map.sigma0.values().begin());
  throw Error(fmt::format("{}, column {}, row {}", name, index % map.grid.columns, index / map.grid.columns),
              "is infinite", "give maps whose cells are numbers, or NaN where nothing was seen");
}

MapComparison compare_maps(const radar::GroundMap& tested, const radar::GroundMap& truth,
                           const CompareOptions& options) {
  require_metres(tested, "the tested map");
  require_metres(truth, "the truth");
  require_same_cells(tested, truth);
  require_finite(options.floor_db, "floor_db");
  require_finite(options.shadow_db, "shadow_db");
  require_finite_cells(tested, options.polarization, "the tested map");
  require_finite_cells(truth, options.polarization, "the truth");
  const bool usual = options.cells_m.empty();
  MapComparison comparison{options, {}};
  if (usual) comparison.options.cells_m = sizes_to_compare_at(truth.grid);

  for (const double cell_m : comparison.options.cells_m) {
    const std::size_t factor = required_block_factor(cell_m, truth.grid);
    const PairSums sums = sums_over_blocks(tested, truth, options, factor);
    if (sums.cells() > 0) {
      comparison.at.push_back(sums.metrics(cell_m));
    } else if (!usual) {
      throw Error("maps to compare", fmt::format("no cell of {} m was seen wholly by both", cell_m),
                  "compare maps of the same ground, or at smaller cells");
    }
  }
  if (comparison.at.empty()) {
    throw Error("maps to compare",
                fmt::format("no cell of {:g} m was seen wholly by both", comparison.options.cells_m.front()),
                "compare maps of the same ground, or name smaller cells");
  }
  comparison.options.cells_m.clear();
  for (const CellComparison& row : comparison.at) comparison.options.cells_m.push_back(row.cell_m);
  return comparison;
}

std::string polarization_name(radar::Polarization polarization) {
  switch (polarization) {
    case radar::Polarization::VV:
      return "VV";
    case radar::Polarization::HH:
      return "HH";
    case radar::Polarization::HV:
      return "HV";
    case radar::Polarization::VH:
      return "VH";
    case radar::Polarization::Sum:
      return "VV+HH+2HV";
  }
  return "";
}

}  // namespace sigmascape::product
