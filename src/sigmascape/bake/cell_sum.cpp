#include "sigmascape/bake/cell_sum.h"

#include <algorithm>
#include <tuple>

namespace sigmascape::bake {
namespace {

/// The echoes of one cell in one texel, ordered by batch.
void add_texel(std::span<const Landed> echoes, const Batches& batches, receiver::GroundAccumulator& patch) {
  const double n = batches.samples;
  radar::Channels sum;
  double total = 0.0;
  for (const Landed& echo : echoes) {
    sum += echo.rcs_m2;
    total += static_cast<double>(echo.rcs_m2.power(radar::Polarization::Sum));
  }
  double squares = 0.0, shares = 0.0;
  auto echo = echoes.begin();
  for (std::uint32_t batch = 0; batch < batches.count; ++batch) {
    double of_batch = 0.0;
    for (; echo != echoes.end() && echo->batch == batch; ++echo) {
      of_batch += static_cast<double>(echo->rcs_m2.power(radar::Polarization::Sum));
    }
    const double share = batches.size(batch) / n;
    squares += (of_batch - total * share) * (of_batch - total * share);
    shares += share * share;
  }
  patch.add(echoes.front().texel, sum * static_cast<float>(1.0 / n), squares / (n * n * (1.0 - shares)));
}

}  // namespace

void add_cell(std::span<Landed> echoes, const Batches& batches, receiver::GroundAccumulator& patch) {
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
