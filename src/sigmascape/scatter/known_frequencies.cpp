#include <algorithm>

#include "sigmascape/scatter/billingsley.h"
#include "sigmascape/scatter/git_sea.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/nrl_sea.h"
#include "sigmascape/scatter/ulaby_dobson.h"

namespace sigmascape::scatter {
namespace {

struct ModelFrequencies {
  using Ranges = std::vector<FrequencyRange>;
  Ranges operator()(const LambertParameters&) const { return {FrequencyRange{}}; }
  Ranges operator()(const ConstantGammaParameters&) const { return {FrequencyRange{}}; }
  Ranges operator()(const CookTorranceParameters& p) const { return {p.permittivity.valid_frequencies()}; }
  Ranges operator()(const UlabyDobsonParameters& p) const { return ulaby_dobson_bands(p); }
  Ranges operator()(const BillingsleyParameters& p) const { return {billingsley_frequencies(p.terrain)}; }
  Ranges operator()(const NrlSeaParameters&) const { return {nrl_sea_frequencies}; }
  Ranges operator()(const GitSeaParameters&) const { return {git_sea_frequencies}; }
  Ranges operator()(const CrownParameters& p) const {
    return {p.leaf ? p.leaf->valid_frequencies() : FrequencyRange{}};
  }
};

}  // namespace

std::vector<FrequencyRange> known_frequencies(const Material& material) {
  std::vector<FrequencyRange> known;
  for (const FrequencyRange& range : std::visit(ModelFrequencies{}, material.model)) {
    const FrequencyRange both{std::max(range.lowest_hz, material.lowest_frequency_hz),
                              std::min(range.highest_hz, material.highest_frequency_hz)};
    if (both.lowest_hz > both.highest_hz) continue;
    if (!known.empty() && known.back().highest_hz == both.lowest_hz)
      known.back().highest_hz = both.highest_hz;
    else
      known.push_back(both);
  }
  return known;
}

}  // namespace sigmascape::scatter
