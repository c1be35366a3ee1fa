#include "sigmascape/trace/ground_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "unit/trace/plain_scene.h"

#include "sigmascape/trace/surroundings.h"

namespace sigmascape::trace {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string fault_of(const scene::Scene& scene, const radar::Rectangle& part, double memory_bytes) {
  return message_of_error([&] { require_room(scene, part, memory_bytes); });
}

TEST(GroundRoom, GroundThatDoesNotFitWithWhatRaysNeedIsAnErrorThatSaysWhatWouldDo) {
  const scene::Scene scene = plain_scene();
  const auto everything = Surroundings::everything().place;
  const auto heights = static_cast<double>(scene.terrain.height_m.size());
  EXPECT_EQ(fault_of(scene, everything, 41.0 * heights), "");
  const std::string fault = fault_of(scene, everything, 10.0 * heights);
  EXPECT_THAT(fault, AllOf(StartsWith("plain: its 21 × 21 heights every 10 m"), HasSubstr("or a smaller extent"),
                           HasSubstr("level of detail 1 and up")));
  const std::string proposal = "choose a spacing_m of ";
  ASSERT_THAT(fault, HasSubstr(proposal));
  EXPECT_NEAR(std::stod(fault.substr(fault.find(proposal) + proposal.size())), 20.5, 0.6) << "twice the 10 m, about";
}

// Coarser heights would not help: those of half as many do not take less than the cells of the land cover alone.
TEST(GroundRoom, LandCoverThatIsTooFineIsToldByItsOwnKey) {
  scene::Scene scene = plain_scene();
  scene.ground.grid = {-100.0, 100.0, 0.2, 1000, 1000};
  scene.ground.material = Array2D<scene::MaterialIndex>(1000, 1000, 0);
  const double of_cells = 1e6 * static_cast<double>(sizeof(scene::MaterialIndex));
  const auto heights = static_cast<double>(scene.terrain.height_m.size());
  EXPECT_EQ(fault_of(scene, Surroundings::everything().place, of_cells + 41.0 * heights), "");
  EXPECT_THAT(fault_of(scene, Surroundings::everything().place, 0.5 * of_cells),
              AllOf(HasSubstr("its 1000 × 1000 cells of land cover of 0.2 m take"),
                    HasSubstr("choose a cell_m of 0.4 or more in [land_cover]")));
}

TEST(GroundRoom, IsThatOfThePartThatRaysAreTracedOver) {
  const scene::Scene scene = plain_scene();
  const auto heights = static_cast<double>(scene.terrain.height_m.size());
  EXPECT_EQ(fault_of(scene, {-20.0, -20.0, 20.0, 20.0}, 10.0 * heights), "");
  EXPECT_NE(fault_of(scene, {-100.0, -100.0, 100.0, 60.0}, 10.0 * heights), "");
}

}  // namespace
}  // namespace sigmascape::trace
