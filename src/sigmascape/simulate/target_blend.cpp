#include "sigmascape/simulate/target_blend.h"

#include <algorithm>
#include <span>

#include "sigmascape/live/frame_power.h"

namespace sigmascape::simulate {
namespace {

/// Calls `visit(bin, of_first, of_second)` for every bin of either list, in order; null where a list lacks it.
template <typename Visit>
void visit_both(std::span<const receiver::BinBefore> first, std::span<const receiver::BinBefore> second, Visit visit) {
  auto one = first.begin(), other = second.begin();
  while (one != first.end() || other != second.end()) {
    const bool is_of_first = one != first.end() && (other == second.end() || one->bin <= other->bin);
    const bool is_of_second = other != second.end() && (one == first.end() || other->bin <= one->bin);
    visit(is_of_first ? one->bin : other->bin, is_of_first ? &one->rcs_m2 : nullptr,
          is_of_second ? &other->rcs_m2 : nullptr);
    if (is_of_first) ++one;
    if (is_of_second) ++other;
  }
}

/// Beam by beam, those of the first before those of the second, each with its share of the power.
void blend_echoes(std::span<const receiver::EchoInBeam> first, std::span<const receiver::EchoInBeam> second,
                  float second_share, std::span<receiver::EchoInBeam> blended) {
  auto one = first.begin(), other = second.begin();
  for (receiver::EchoInBeam& echo : blended) {
    const bool is_of_first = one != first.end() && (other == second.end() || one->beam <= other->beam);
    echo = is_of_first ? *one++ : *other++;
    echo.echo.rcs_m2 = echo.echo.rcs_m2 * (is_of_first ? 1.0F - second_share : second_share);
  }
}

}  // namespace

void TargetBlend::put_in_order(const receiver::TargetsApart& targets, Bins& bins) {
  order_.clear();
  for (std::size_t i = 0; i < targets.bins.size(); ++i) order_.push_back(std::uint64_t{targets.bins[i].bin} << 32U | i);
  std::ranges::sort(order_);
  bins.clear();
  for (const std::uint64_t bin_and_place : order_) {
    const receiver::BinBefore& bin = targets.bins[bin_and_place & 0xFFFFFFFFU];
    if (bins.empty() || bins.back().bin != bin.bin) bins.push_back(bin);
  }
}

void TargetBlend::blend(const live::Frame& first, const live::Frame& second, double second_share,
                        std::size_t first_beam, std::size_t count, receiver::TargetsByBeam& blended) {
  const auto of_step = [&](const live::Frame& frame) {
    return receiver::of_beams(frame.targets, first_beam, count, frame.grid.ranges);
  };
  const receiver::TargetsApart of_first = of_step(first), of_second = of_step(second);
  put_in_order(of_first, first_);
  put_in_order(of_second, second_);
  std::size_t bins = 0;
  visit_both(first_, second_, [&](auto&&...) { ++bins; });
  const auto room = blended.renewed(first_beam, count, of_first.echoes.size() + of_second.echoes.size(), bins);
  const auto share = static_cast<float>(second_share);
  blend_echoes(of_first.echoes, of_second.echoes, share, room.echoes);
  auto to = room.bins.begin();
  visit_both(first_, second_, [&](std::uint32_t bin, const radar::Channels* one, const radar::Channels* other) {
    const radar::Channels of_one = one != nullptr ? *one : live::power_of_bin(first, bin);
    const radar::Channels of_other = other != nullptr ? *other : live::power_of_bin(second, bin);
    *to++ = {.bin = bin, .rcs_m2 = of_one * (1.0F - share) + of_other * share};
  });
}

}  // namespace sigmascape::simulate
