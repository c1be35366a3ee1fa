#include "sigmascape/receiver/targets_by_beam.h"

#include <algorithm>

namespace sigmascape::receiver {
namespace {

/// Where the part begins and ends whose numbers lie from `first` to before `end`.
struct Part {
  std::size_t begin, end;
};
template <typename Of>
Part part_of(std::span<const Of> all, std::uint32_t Of::*number, std::size_t first, std::size_t end) {
  // Within a beam bins have no order: only beams' edges may be asked for.
  const auto place = [&](std::size_t edge) {
    const auto found = std::ranges::partition_point(all, [&](const Of& one) { return one.*number < edge; });
    return static_cast<std::size_t>(found - all.begin());
  };
  return {place(first), place(end)};
}

/// Makes a part `count` long; what is new there is like `last`, so that all stay in order until they are filled.
template <typename Of>
std::span<Of> resized(std::vector<Of>& all, Part part, std::size_t count, const Of& last) {
  const std::size_t there = part.end - part.begin;
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(part.begin);
  const auto common_end = begin + static_cast<std::ptrdiff_t>(std::min(there, count));
  if (count > there) {
    all.insert(common_end, count - there, last);
  } else {
    all.erase(common_end, begin + static_cast<std::ptrdiff_t>(there));
  }
  return std::span(all).subspan(part.begin, count);
}

}  // namespace

void TargetsByBeam::reserve(std::size_t echoes, std::size_t bins) {
  echoes_.reserve(echoes);
  bins_.reserve(bins);
}

TargetsByBeam::Room TargetsByBeam::renewed(std::size_t first_beam, std::size_t count, std::size_t echoes,
                                           std::size_t bins) {
  const std::size_t end = first_beam + count;
  const Part of_echoes = part_of(std::span<const EchoInBeam>(echoes_), &EchoInBeam::beam, first_beam, end);
  const Part of_bins = part_of(std::span<const BinBefore>(bins_), &BinBefore::bin, first_beam * ranges_, end * ranges_);
  const auto last_beam = static_cast<std::uint32_t>(std::max<std::size_t>(end, 1) - 1);
  const auto last_bin = static_cast<std::uint32_t>(std::max<std::size_t>(end * ranges_, 1) - 1);
  return {resized(echoes_, of_echoes, echoes, {.beam = last_beam, .echo = {}}),
          resized(bins_, of_bins, bins, {.bin = last_bin, .rcs_m2 = {}})};
}

TargetsApart of_beams(const TargetsApart& targets, std::size_t first_beam, std::size_t count, std::size_t ranges) {
  const std::size_t end = first_beam + count;
  const Part echoes = part_of(targets.echoes, &EchoInBeam::beam, first_beam, end);
  const Part bins = part_of(targets.bins, &BinBefore::bin, first_beam * ranges, end * ranges);
  return {targets.echoes.subspan(echoes.begin, echoes.end - echoes.begin),
          targets.bins.subspan(bins.begin, bins.end - bins.begin)};
}

}  // namespace sigmascape::receiver
