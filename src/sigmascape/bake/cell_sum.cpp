#include "sigmascape/bake/cell_sum.h"

#include <algorithm>
#include <tuple>

namespace sigmascape::bake {
namespace {

/// The part of a texel that one cell returned, and the variance of its total power.
struct Part {
  radar::Channels rcs_m2;
  double variance_m4 = 0.0;
};

/// Of the echoes of one cell in one texel, ordered by batch, those that `counts` says.
template <typename Counts>
Part part_of(std::span<const Landed> echoes, const Batches& batches, const Counts& counts) {
  const double n = batches.samples;
  Part part;
  double total = 0.0;
  for (const Landed& echo : echoes) {
    if (!counts(echo)) continue;
    part.rcs_m2 += echo.rcs_m2;
    total += static_cast<double>(echo.rcs_m2.power(radar::Polarization::Sum));
  }
  double squares = 0.0, shares = 0.0;
  auto echo = echoes.begin();
  for (std::uint32_t batch = 0; batch < batches.count; ++batch) {
    double of_batch = 0.0;
    for (; echo != echoes.end() && echo->batch == batch; ++echo) {
      if (counts(*echo)) of_batch += static_cast<double>(echo->rcs_m2.power(radar::Polarization::Sum));
    }
    const double share = batches.size(batch) / n;
    squares += (of_batch - total * share) * (of_batch - total * share);
    shares += share * share;
  }
  part.rcs_m2 = part.rcs_m2 * static_cast<float>(1.0 / n);
  part.variance_m4 = squares / (n * n * (1.0 - shares));
  return part;
}

/// The echoes of one cell in one texel, ordered by batch.
void add_texel(std::span<const Landed> echoes, const Batches& batches, PatchSums& patch) {
  const std::uint32_t texel = echoes.front().texel;
  const Part all = part_of(echoes, batches, [](const Landed&) { return true; });
  patch.all.add(texel, all.rcs_m2, all.variance_m4);
  const auto over_several = [](const Landed& echo) { return echo.several; };
  if (!patch.several || std::ranges::none_of(echoes, over_several)) return;
  const Part several = std::ranges::all_of(echoes, over_several) ? all : part_of(echoes, batches, over_several);
  patch.several->add(texel, several.rcs_m2, several.variance_m4);
}

}  // namespace

void add_cell(std::span<Landed> echoes, const Batches& batches, PatchSums& patch) {
  const auto place = [](const Landed& echo) { return std::tuple(echo.texel, echo.batch); };
  // On open ground they mostly are in order.
  if (!std::ranges::is_sorted(echoes, {}, place)) std::ranges::stable_sort(echoes, {}, place);
  for (auto first = echoes.begin(); first != echoes.end();) {
    const auto end = std::find_if(first, echoes.end(), [&](const Landed& echo) { return echo.texel != first->texel; });
    add_texel({first, end}, batches, patch);
    first = end;
  }
}

}  // namespace sigmascape::bake
