#include "sigmascape/radar/pattern_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/csv_lines.h"
#include "sigmascape/radar/radar_bounds.h"

namespace sigmascape::radar {
namespace {

struct Row {
  double offset_deg = 0.0, gain_db = 0.0;
};

/// To either side of the axis; beyond is the other side.
constexpr double most_offset_deg = 180.0;
/// Far more than any antenna has, and little enough that half of the peak is another number than the peak.
constexpr double most_gain_db = 1000.0;

/// With a plus before it or not.
std::optional<double> number_of(std::string_view field) {
  return csv_number(field.substr(field.starts_with('+') ? 1 : 0));
}

std::vector<Row> rows_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    throw Error(file.string(), "cannot be read", "name a CSV file of offset_deg,gain_db");
  std::vector<Row> rows;
  bool may_be_names = true;
  for_each_csv_line(stream, [&](const std::string& line, std::size_t number) {
    const std::vector<std::string> fields = csv_fields(line);
    if (std::exchange(may_be_names, false) && fields.front() == "offset_deg") return;
    const std::string where = fmt::format("{}:{}", file.string(), number);
    const auto offset_deg = number_of(fields.front()), gain_db = number_of(fields.back());
    if (fields.size() != 2 || !offset_deg || !gain_db)
      throw Error(where, fmt::format("\"{}\" is not a pair of numbers", line), "give offset_deg,gain_db");
    if (!(std::abs(*offset_deg) <= most_offset_deg) || !(std::abs(*gain_db) <= most_gain_db))
      throw Error(
          where, fmt::format("\"{}\" is out of range", line),
          fmt::format("give offsets of at most {:g} degrees and gains within ±{:g} dB", most_offset_deg, most_gain_db));
    if (!rows.empty() && *offset_deg <= rows.back().offset_deg)
      throw Error(where, "does not lie beyond the line before it", "sort the lines by increasing offset_deg");
    rows.push_back({*offset_deg, *gain_db});
  });
  return rows;
}

/// The offset at which the gain, linear in decibels between rows, has fallen to `level_db`, from the peak on.
template <typename Iterator>
double crossing_deg(Iterator from, Iterator end, double level_db, const std::filesystem::path& file) {
  const auto below = std::find_if(from, end, [level_db](const Row& row) { return row.gain_db <= level_db; });
  if (below == end) {
    throw Error(file.string(), "does not fall to half of its peak on both sides",
                "give the cut out to where the gain is at least 3.02 dB below its peak");
  }
  const Row inner = *(below - 1), outer = *below;
  return std::lerp(inner.offset_deg, outer.offset_deg, (level_db - inner.gain_db) / (outer.gain_db - inner.gain_db));
}

}  // namespace

PatternTable read_pattern_table(const std::filesystem::path& file) {
  const std::vector<Row> rows = rows_of(file);
  if (rows.size() < 3)
    throw Error(file.string(), "holds fewer than three lines", "give offset_deg,gain_db over the beam");
  const auto peak = std::ranges::max_element(rows, {}, &Row::gain_db);
  const double half_db = peak->gain_db + db_from_linear(0.5);
  const double right_deg = crossing_deg(peak, rows.end(), half_db, file);
  const double left_deg = crossing_deg(std::make_reverse_iterator(peak + 1), rows.rend(), half_db, file);

  const double width_deg = right_deg - left_deg;
  const Interval& widths_deg = bounds::beam_widths_deg;
  if (!(width_deg >= widths_deg.lowest && width_deg <= widths_deg.highest)) {
    throw Error(file.string(), fmt::format("has a beam {:g} degrees wide between its half-power points", width_deg),
                fmt::format("give one of {:g} to {:g} degrees", widths_deg.lowest, widths_deg.highest));
  }
  PatternTable table{.beam = {}, .half_power_width_rad = radians_from_deg(width_deg)};
  for (const Row& row : rows)
    table.beam.samples.push_back({row.offset_deg / width_deg, linear_from_db(row.gain_db - peak->gain_db)});
  return table;
}

}  // namespace sigmascape::radar
