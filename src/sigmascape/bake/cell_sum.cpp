#include "sigmascape/bake/cell_sum.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace sigmascape::bake {
namespace {

double total_m2(const Landed& echo) {
  return static_cast<double>(echo.rcs_m2.power(radar::Polarization::Sum));
}

}  // namespace

void CellSum::add(std::span<Landed> echoes, const SamplePairs& pairs, PatchSums& patch) {
  if (power_m2_.size() < pairs.samples()) power_m2_.resize(pairs.samples());
  if (patch.buildings) {
    const auto apart =
        std::stable_partition(echoes.begin(), echoes.end(), [](const Landed& echo) { return !echo.apart; });
    const auto kept = static_cast<std::size_t>(apart - echoes.begin());
    add_to(*patch.buildings, nullptr, echoes.subspan(kept), pairs);
    echoes = echoes.first(kept);
  }
  add_to(patch.all, patch.several ? &*patch.several : nullptr, echoes, pairs);
}

void CellSum::add_to(Sums& all, Sums* several, std::span<Landed> echoes, const SamplePairs& pairs) {
  const auto place = [](const Landed& echo) { return std::tuple(echo.texel, echo.sample); };
  // On open ground they mostly are in order.
  if (!std::ranges::is_sorted(echoes, {}, place)) std::ranges::stable_sort(echoes, {}, place);
  for (auto first = echoes.begin(); first != echoes.end();) {
    const auto end = std::find_if(first, echoes.end(), [&](const Landed& echo) { return echo.texel != first->texel; });
    add_texel(all, several, {first, end}, pairs);
    first = end;
  }
}

void CellSum::add_texel(Sums& all, Sums* several, std::span<const Landed> echoes, const SamplePairs& pairs) {
  const std::uint32_t texel = echoes.front().texel;
  const Part whole = part_of(echoes, pairs, [](const Landed&) { return true; });
  all.add(texel, whole.rcs_m2, whole.variance_m4);
  const auto over_several = [](const Landed& echo) { return echo.several; };
  if (several == nullptr || std::ranges::none_of(echoes, over_several)) return;
  const Part part = std::ranges::all_of(echoes, over_several) ? whole : part_of(echoes, pairs, over_several);
  several->add(texel, part.rcs_m2, part.variance_m4);
}

/// Of the echoes of one cell in one texel those that `counts` says.
template <typename Counts>
CellSum::Part CellSum::part_of(std::span<const Landed> echoes, const SamplePairs& pairs, const Counts& counts) {
  const double n = pairs.samples();
  // A million equal echoes, one after another, are more than single precision can add up.
  std::array<double, radar::Channels::count> sum_m2{};
  for (const Landed& echo : echoes) {
    if (!counts(echo)) continue;
    const radar::Channels& m2 = echo.rcs_m2;
    sum_m2 = {sum_m2[0] + static_cast<double>(m2.vv), sum_m2[1] + static_cast<double>(m2.hh),
              sum_m2[2] + static_cast<double>(m2.hv), sum_m2[3] + static_cast<double>(m2.re_vvhh)};
    power_m2_[echo.sample] += total_m2(echo);
  }
  const auto mean = [&](std::size_t channel) { return static_cast<float>(sum_m2[channel] / n); };
  Part part{.rcs_m2 = {mean(0), mean(1), mean(2), mean(3)}};
  part.variance_m4 = squared_differences(echoes, pairs) / (n * n);
  for (const Landed& echo : echoes) power_m2_[echo.sample] = 0.0;
  return part;
}

double CellSum::squared_differences(std::span<const Landed> echoes, const SamplePairs& pairs) const {
  double sum = 0.0;
  auto echo = echoes.begin();
  while (echo != echoes.end()) {
    const std::uint32_t sample = echo->sample;
    echo = std::find_if(echo, echoes.end(), [&](const Landed& other) { return other.sample != sample; });
    if (pairs.is_alone(sample) || !(power_m2_[sample] > 0.0)) continue;
    const double other = power_m2_[pairs.beside(sample)], difference = power_m2_[sample] - other;
    // A pair is met twice where both bring something.
    sum += (other > 0.0 ? 0.5 : 1.0) * difference * difference;
  }
  const std::uint32_t last = pairs.samples() - 1;
  if (!pairs.is_alone(last)) return sum;
  // One that has none beside it is as far from the first as from any: twice its variance in the mean of squares.
  const double difference = power_m2_[last] - power_m2_.front();
  return sum + 0.5 * difference * difference;
}

}  // namespace sigmascape::bake
