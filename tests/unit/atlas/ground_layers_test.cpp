#include "sigmascape/atlas/ground_layers.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "unit/atlas/example_texels.h"

#include "sigmascape/atlas/stac_catalog.h"

namespace sigmascape::atlas {
namespace {

using testing::AllOf;
using testing::HasSubstr;

AtlasDescription with_ground_apart() {
  AtlasDescription description = example_description();
  description.settings[shadows_setting] = shadows_at_run_time;
  return description;
}

// Of one number over wide ground the rounding shifts all of it.
TEST(GroundStore, KeepsAllBitsHoweverFewTheLooksKeep) {
  const ScratchFolder folder;
  AtlasDescription description = with_ground_apart();
  description.mantissa_bits = 3;
  const Store atlas = Store::create(folder.path("atlas"), description);
  EXPECT_EQ(create_ground_store(atlas, {0.1, 0.5}).description().mantissa_bits, 10);
  EXPECT_EQ(open_ground_store(atlas).description().mantissa_bits, 10);
  EXPECT_FALSE(ground_collection_fault(atlas));
}

// As former programs wrote them.
TEST(GroundStore, MayKeepAsFewBitsAsTheLooks) {
  const ScratchFolder folder;
  AtlasDescription description = with_ground_apart();
  description.mantissa_bits = 3;
  const Store atlas = Store::create(folder.path("atlas"), description);
  static_cast<void>(create_ground_store(atlas, {0.1, 0.5}));
  const auto collection = ground_folder_of(atlas) / collection_name;
  const auto with_bits = [&](int bits) {
    AtlasDescription ground = open_ground_store(atlas).description();
    ground.mantissa_bits = bits;
    std::ofstream(collection) << collection_text(ground);
    return ground_collection_fault(atlas);
  };
  EXPECT_FALSE(with_bits(3));
  std::vector<StoreFault> mended;
  static_cast<void>(create_ground_store(atlas, {0.1, 0.5}, &mended));
  EXPECT_TRUE(mended.empty()) << "a bake goes on with it";
  EXPECT_TRUE(with_bits(4));
}

TEST(GroundStore, ThatIsMissingIsToldWithTheBakeThatMakesItAgain) {
  const ScratchFolder folder;
  const Store atlas = Store::create(folder.path("atlas"), with_ground_apart());
  static_cast<void>(create_ground_store(atlas, {0.1, 0.5}));
  std::filesystem::remove(ground_folder_of(atlas) / collection_name);
  EXPECT_THAT(message_of_error([&] { static_cast<void>(open_ground_store(atlas)); }),
              AllOf(HasSubstr("ground/collection.json: is missing"), HasSubstr("start the bake again")));
}

}  // namespace
}  // namespace sigmascape::atlas
