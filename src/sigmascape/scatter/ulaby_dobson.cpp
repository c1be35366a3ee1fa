#include "sigmascape/scatter/ulaby_dobson.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/scatter/ulaby_dobson_table.h"

namespace sigmascape::scatter {
namespace {

struct BandLimits {
  UlabyDobsonBand band;
  FrequencyRange range;
};

/// The letters as IEEE 521 defines them.
constexpr std::array<BandLimits, 6> band_limits{{{UlabyDobsonBand::L, {1e9, 2e9}},
                                                 {UlabyDobsonBand::S, {2e9, 4e9}},
                                                 {UlabyDobsonBand::C, {4e9, 8e9}},
                                                 {UlabyDobsonBand::X, {8e9, 12e9}},
                                                 {UlabyDobsonBand::Ku, {12e9, 18e9}},
                                                 {UlabyDobsonBand::Ka, {27e9, 40e9}}}};

const UlabyDobsonRow* find_row(const UlabyDobsonParameters& parameters, UlabyDobsonBand band,
                               UlabyDobsonChannel channel) {
  for (const UlabyDobsonRow& row : ulaby_dobson_table()) {
    const bool admitted = row.verified || parameters.unverified_rows;
    if (admitted && row.terrain == parameters.terrain && row.band == band && row.channel == channel) return &row;
  }
  return nullptr;
}

struct Rows {
  const UlabyDobsonRow* vv;
  const UlabyDobsonRow* hh;
  const UlabyDobsonRow* hv;  // none in some bands
  double cross_ratio;

  [[nodiscard]] Sigma0 at(double incidence_rad) const {
    const double co_vv = vv->sigma0(incidence_rad);
    const double co_hh = hh->sigma0(incidence_rad);
    return {co_vv, co_hh, hv != nullptr ? hv->sigma0(incidence_rad) : cross_ratio * std::sqrt(co_vv * co_hh)};
  }
};

std::optional<Rows> rows_of(const UlabyDobsonParameters& parameters, UlabyDobsonBand band) {
  const Rows rows{find_row(parameters, band, UlabyDobsonChannel::VV),
                  find_row(parameters, band, UlabyDobsonChannel::HH),
                  find_row(parameters, band, UlabyDobsonChannel::HV), parameters.depolarization.cross_ratio};
  if (rows.vv == nullptr || rows.hh == nullptr) return std::nullopt;
  return rows;
}

Rows rows_at(const UlabyDobsonParameters& parameters, double frequency_hz) {
  for (const BandLimits& limits : band_limits) {
    if (frequency_hz < limits.range.lowest_hz || frequency_hz > limits.range.highest_hz) continue;
    if (const auto rows = rows_of(parameters, limits.band)) return *rows;
  }
  std::vector<std::string> known;
  for (const FrequencyRange& range : ulaby_dobson_bands(parameters))
    known.push_back(fmt::format("{:g} to {:g} GHz", range.lowest_hz / 1e9, range.highest_hz / 1e9));
  throw Error("model ulaby_dobson", fmt::format("it has no row for this class at {:g} GHz", frequency_hz / 1e9),
              fmt::format("use {} or another material", fmt::join(known, ", ")));
}

}  // namespace

std::vector<FrequencyRange> ulaby_dobson_bands(const UlabyDobsonParameters& parameters) {
  std::vector<FrequencyRange> bands;
  for (const BandLimits& limits : band_limits)
    if (rows_of(parameters, limits.band)) bands.push_back(limits.range);
  return bands;
}

Sigma0 ulaby_dobson_sigma0(const UlabyDobsonParameters& parameters, double frequency_hz, double incidence_rad) {
  return rows_at(parameters, frequency_hz).at(incidence_rad);
}

ReciprocalBackscatter ulaby_dobson(const UlabyDobsonParameters& parameters, double frequency_hz) {
  const Rows rows = rows_at(parameters, frequency_hz);
  return {[&](double cos_incidence) { return rows.at(std::acos(cos_incidence)); }, parameters.depolarization};
}

}  // namespace sigmascape::scatter
