#include "sigmascape/render/published.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace sigmascape::render {
namespace {

// A lack of order between the threads shows under the thread sanitizer.
TEST(Published, IsTakenWholeWhileItIsReplaced) {
  constexpr int replacements = 20000;
  Published<std::vector<int>> published(std::make_shared<const std::vector<int>>(8, 0));
  const std::jthread writer([&published] {
    for (int i = 1; i <= replacements; ++i) published.store(std::make_shared<const std::vector<int>>(8, i));
  });
  int last = 0;
  while (last < replacements) {
    const auto taken = published.load();
    ASSERT_EQ(std::ranges::count(*taken, taken->front()), 8);
    ASSERT_GE(taken->front(), last);
    last = taken->front();
  }
}

}  // namespace
}  // namespace sigmascape::render
