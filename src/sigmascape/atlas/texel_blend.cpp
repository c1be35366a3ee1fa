#include "sigmascape/atlas/texel_blend.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sigmascape/atlas/texel_blend.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sigmascape::atlas::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

radar::Channels blend(const TexelParts& parts, const AspectWeights& weights) {
  const hn::CappedTag<float, radar::Channels::count> floats;
  const hn::Rebind<hwy::float16_t, decltype(floats)> halves;
  std::array<float, radar::Channels::count> all;
  for (std::size_t channel = 0; channel < all.size(); channel += hn::Lanes(floats)) {
    auto sums = hn::Zero(floats);
    for (std::size_t texel = 0; texel < parts.count; ++texel) {
      const TexelPart& from = parts.texels[texel];
      const auto* const looks = reinterpret_cast<const hwy::float16_t*>(from.looks) + channel;
      for (std::size_t i = 0; i < weights.count; ++i) {
        const auto stored = hn::LoadU(halves, looks + weights.look[i] * radar::Channels::count);
        const auto weight = hn::Set(floats, from.part * from.weight[i]);
        // Not fused: every machine is to give the same numbers.
        sums = hn::Add(sums, hn::Mul(weight, hn::PromoteTo(floats, stored)));
      }
    }
    hn::StoreU(sums, floats, all.data() + channel);
  }
  return {all[0], all[1], all[2], all[3]};
}

}  // namespace sigmascape::atlas::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sigmascape::atlas {

HWY_EXPORT(blend);

radar::Channels blended(const TexelParts& parts, const AspectWeights& weights) {
  return HWY_DYNAMIC_DISPATCH(blend)(parts, weights);
}

}  // namespace sigmascape::atlas
#endif
