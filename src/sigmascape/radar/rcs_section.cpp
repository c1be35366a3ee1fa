#include "sigmascape/radar/rcs_section.h"

#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

constexpr Interval rcs_dbsm_range{-100.0, 100.0, "dBm²"};

}  // namespace

Channels rcs_of_section(const TomlSection& section) {
  double vv = 0.0, hh = 0.0, hv = 0.0;
  if (!section.is_table("rcs_dbsm")) {
    vv = hh = linear_from_db(section.number("rcs_dbsm", rcs_dbsm_range));
  } else {
    const auto table = section.section("rcs_dbsm");
    const auto power = [&table](std::string_view key) {
      const auto rcs_dbsm = table->optional_number(key, rcs_dbsm_range);
      return rcs_dbsm ? linear_from_db(*rcs_dbsm) : 0.0;
    };
    vv = power("vv");
    hh = power("hh");
    hv = power("hv");
    table->refuse_unknown_keys();
    if (vv + hh + hv == 0.0) throw section.fault("rcs_dbsm", "names no channel", "give at least one of vv, hh and hv");
  }
  const double sign = section.choice_or("bounces", {"odd", "even"}, "odd") == "odd" ? 1.0 : -1.0;
  return {static_cast<float>(vv), static_cast<float>(hh), static_cast<float>(hv),
          static_cast<float>(sign * std::sqrt(vv * hh))};
}

}  // namespace sigmascape::radar
