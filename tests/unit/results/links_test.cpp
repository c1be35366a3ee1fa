#include "results/links.h"

#include <gtest/gtest.h>

namespace sigmascape::cli {
namespace {

TEST(ResultsLinks, LeadFromThePageToOthers) {
  EXPECT_EQ(PageLinks("docs/results/itu/README.md").to("live frames", "docs/live.md"), "[live frames](../../live.md)");
  EXPECT_EQ(PageLinks("docs/results/README.md").to("Bilbao", "docs/results/bilbao/README.md"),
            "[Bilbao](bilbao/README.md)");
}

TEST(ResultsLinks, AreNamesOnAPageElsewhere) {
  for (const char* page : {"", "out/page.md"})
    EXPECT_EQ(PageLinks(page).to("live frames", "docs/live.md"), "live frames (docs/live.md)");
}

TEST(ResultsLinks, KnowTheirOwnPage) {
  EXPECT_TRUE(PageLinks("docs/results/README.md").is_own("docs/results/README.md"));
  EXPECT_FALSE(PageLinks("docs/results/README.md").is_own("docs/results/itu/README.md"));
  EXPECT_FALSE(PageLinks("").is_own("docs/results/README.md"));
}

}  // namespace
}  // namespace sigmascape::cli
