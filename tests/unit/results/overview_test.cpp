#include "results/overview.h"

#include <gmock/gmock.h>

#include "made_report.h"
#include "results/measured.h"
#include "scratch_folder.h"

namespace sigmascape::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Of a place where ours comes closer at three of four views from the paper's grid, with buildings apart closer still,
/// and nothing is known of the next.
std::vector<ResultsRow> rows_of_a_place() {
  ResultsPlan plan = made_plan();
  plan.scene_file = "harbour.toml";
  plan.baked_samples = 32;
  std::vector<ResultsRow> rows{made_row(made_case(plan, Method::Paper, ViewKind::HeldOut), 6.3, 0.5),
                               made_row(made_case(plan, Method::OwnGround, ViewKind::HeldOut), 5.09, 0.5),
                               made_row(made_case(plan, Method::Apart, ViewKind::HeldOut), 3.45, 0.5)};
  rows[1].at_views.back().tested.rms_db = 7.0;
  return rows;
}

TEST(ResultsOverview, HasThisSceneAndItsNeighboursWhateverTheirRays) {
  ResultsReport report = made_report(false);
  report.links = PageLinks("docs/results/README.md");
  report.neighbours = {{results_pages[1], {}}, {results_pages[2], rows_of_a_place()}};
  EXPECT_THAT(
      overview_section(report),
      AllOf(HasSubstr("| scene | 8 × 5 looks: paper | ours | closer | apart | 16 × 6 looks: paper | ours | closer | "
                      "apart | truth |\n"),
            HasSubstr("\n| the paper's scene | 8.00 | 5.00 | 4 of 4 | – | – | – | – | – | 2.00 |\n"),
            HasSubstr("\n| [the same of real materials](itu/README.md) | – | – | – | – | – | – | – | – | – |\n"),
            HasSubstr("\n| [Bilbao](bilbao/README.md) | 6.30 | 5.09 | 3 of 4 | 3.45 | – | – | – | – | 2.00 |\n")));
}

TEST(ResultsOverview, IsNoneWithoutNeighbours) {
  EXPECT_EQ(overview_section(made_report(false)), "");
}

class ResultsNeighbours : public testing::Test {
 protected:
  /// As a run that wrote its page there leaves it.
  void measure(const std::string& page) const {
    MeasuredViews kept{folder_.write(page + "/measured.json", "{}"), settings_of_views(plan_, "digest")};
    const PlannedView& view = plan_.views.back();
    ViewResult result;
    result.of = made_case(plan_, Method::Paper, view.kind);
    result.view = view;
    kept.add({.scene = plan_.scene_name(), .view = view, .machines = {"a machine"}, .results = {result}});
  }

  ScratchFolder folder_;
  ResultsPlan plan_ = made_plan();
};

TEST_F(ResultsNeighbours, AreReadFromTheFoldersBesideThePage) {
  EXPECT_TRUE(neighbours_of(folder_.path("README.md"), plan_).empty());
  measure("bilbao");
  const auto neighbours = neighbours_of(folder_.path("README.md"), plan_);
  ASSERT_EQ(neighbours.size(), 3U);
  for (const Neighbour& neighbour : neighbours)
    EXPECT_EQ(neighbour.rows.size(), std::string(neighbour.page.words) == "Bilbao" ? 1U : 0U) << neighbour.page.words;
}

TEST_F(ResultsNeighbours, AreOfThePageOfThePapersSceneAlone) {
  measure("bilbao");
  EXPECT_TRUE(neighbours_of("", plan_).empty());
  ResultsPlan other = plan_;
  other.materials = scene::PaperMaterials::Itu;
  EXPECT_TRUE(neighbours_of(folder_.path("README.md"), other).empty());
  other = plan_;
  other.scene_file = "harbour.toml";
  EXPECT_TRUE(neighbours_of(folder_.path("README.md"), other).empty());
}

}  // namespace
}  // namespace sigmascape::cli
