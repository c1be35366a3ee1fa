#include "results/columns.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

#include "sigmascape/product/number_text.h"

namespace sigmascape::cli {
namespace {

/// "0.834 (0.791)".
template <typename Write>
std::string with_worst(double median, double worst, int decimals, Write write) {
  return fmt::format("{} ({})", write(median, decimals), write(worst, decimals));
}

}  // namespace

std::string number_text(double value, int decimals) {
  return product::number_text(value, decimals, "–");
}

std::string signed_text(double value, int decimals) {
  return product::signed_text(value, decimals, "–");
}

int decimals_that_tell(double value, double aim, int at_least) {
  constexpr int most = 6;
  const auto seems_reached = [&](int decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) >= std::round(aim * scale);
  };
  int decimals = at_least;
  while (decimals < most && seems_reached(decimals) != (value >= aim)) ++decimals;
  return decimals;
}

std::string two_digits(double value) {
  const double size = std::abs(value);
  if (!(size > 0.0)) return number_text(value, 0);
  // 0.0996 rounds to 0.10, with one decimal less than its own leading digit asks for.
  const double rounded = std::stod(fmt::format("{:.1e}", size));
  return number_text(value, std::max(0, 1 - static_cast<int>(std::floor(std::log10(rounded)))));
}

std::string rms_text(const ResultsRow& row) {
  return number_text(summary_cell(&row)->median.rms_db, 2) + " dB";
}

std::string megabytes(std::uintmax_t bytes) {
  return number_text(static_cast<double>(bytes) / 1e6, 2);
}

std::string metrics_text(const product::CellComparison& cell) {
  return fmt::format("{} | {} | {} | {} | {}", number_text(cell.correlation_db, 3), number_text(cell.rms_db, 2),
                     signed_text(cell.bias_db, 2), number_text(cell.l1, 3), number_text(cell.shadow_iou, 2));
}

std::string metrics_text(const product::CellComparison& median, const product::CellComparison& worst, std::size_t views,
                         std::size_t shadow_views) {
  if (views == 1) return metrics_text(median);
  const std::string of_fewer = shadow_views > 0 && shadow_views < views ? fmt::format(" of {}", shadow_views) : "";
  return fmt::format(
      "{} | {} | {} | {} | {}{}", with_worst(median.correlation_db, worst.correlation_db, 3, number_text),
      with_worst(median.rms_db, worst.rms_db, 2, number_text),
      with_worst(median.bias_db, worst.bias_db, 2, signed_text), with_worst(median.l1, worst.l1, 3, number_text),
      with_worst(median.shadow_iou, worst.shadow_iou, 2, number_text), of_fewer);
}

std::string metrics_text(const ResultsRow& row, const ResultsCell& cell) {
  return metrics_text(cell.median, cell.worst, row.views, cell.shadow_views);
}

std::string floor_text(const ResultsRow& row, const ResultsCell& cell) {
  return metrics_text(cell.floor_median, cell.floor_worst, row.views, cell.shadow_views);
}

std::string error_text(const product::CellComparison& cell) {
  return fmt::format("{} | {} | {} | {}", number_text(cell.correlation_db, 3), number_text(cell.rms_db, 2),
                     number_text(cell.l1, 3), number_text(cell.shadow_iou, 2));
}

}  // namespace sigmascape::cli
