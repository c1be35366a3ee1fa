#include "sigmascape/scene/buildings_within.h"

#include "sigmascape/base/interruption.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::scene {

std::vector<std::uint32_t> buildings_within(const Buildings& buildings, const radar::Rectangle& place) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = 0; number < buildings.items.size(); ++number) {
    Interruption::heed();
    if (radar::meet(extent_of(buildings, buildings.items[number]), place)) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace sigmascape::scene
