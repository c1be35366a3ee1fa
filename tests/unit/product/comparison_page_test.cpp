#include "sigmascape/product/comparison_page.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "unit/product/made_up_map.h"

#include "sigmascape/base/error.h"

namespace sigmascape::product {
namespace {

using testing::HasSubstr;
using testing::Not;

ComparisonPage page_with(PageSection section) {
  return {
      .title = "Baked & traced", .lead = "", .sections = {std::move(section)}, .attribution = "<b>terrain</b> office"};
}

TEST(ComparisonPage, TextIsPlainTextAndNothingRunsOrIsFetched) {
  const std::string html =
      comparison_page_html(page_with({.heading = "a < b", .paragraphs = {"<script>alert(1)</script>"}}));
  EXPECT_THAT(html, HasSubstr("<h1>Baked &amp; traced</h1>"));
  EXPECT_THAT(html, HasSubstr("a &lt; b"));
  EXPECT_THAT(html, HasSubstr("&lt;b&gt;terrain&lt;/b&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("http")));
}

TEST(ComparisonPage, PicturesAreInsideThePage) {
  const ScratchFolder folder;
  const auto png = folder.path("three_bytes.png");
  std::ofstream(png) << "radar";
  const std::string html = comparison_page_html(page_with({.figures = {{png, "Path traced \"truth\""}}}));
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,cmFkYXI=\""));  // RFC 4648 of "radar"
  EXPECT_THAT(html, HasSubstr("alt=\"Path traced &quot;truth&quot;\""));
}

TEST(ComparisonPage, APictureThatIsNotThereIsAnErrorAndNoPageIsWritten) {
  const ScratchFolder folder;
  EXPECT_THROW(
      write_comparison_page(folder.path("index.html"), page_with({.figures = {{folder.path("absent.png"), ""}}})),
      Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

TEST(ComparisonPage, NumbersStandBesideTheirNoiseFloor) {
  const auto truth = map_of(8, 8, [](auto c, auto r) { return static_cast<double>(1 + c + r); });
  const auto tested = map_of(8, 8, [](auto c, auto r) { return 2.0 * static_cast<double>(1 + c + r); });
  const PageSection section{.comparison = compare_maps(tested, truth),
                            .noise_floor = compare_maps(truth, truth),
                            .facts = {{"Rays", "41.9 million"}}};
  const ScratchFolder folder;
  const auto path = folder.path("index.html");
  write_comparison_page(path, page_with(section));
  std::ifstream file(path);
  const std::string html{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">8 m</th>"));
  EXPECT_THAT(html, HasSubstr("<td>+3.01<span class=\"floor\">0.00</span></td>"));
  EXPECT_THAT(html, HasSubstr("<td>–<span class=\"floor\">–</span></td>")) << "no cell is in shadow";
  EXPECT_THAT(html, HasSubstr("<dt>Rays</dt><dd>41.9 million</dd>"));
  EXPECT_THAT(html, HasSubstr("-45 dB"));
}

}  // namespace
}  // namespace sigmascape::product
