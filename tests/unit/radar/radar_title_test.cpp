#include "sigmascape/radar/radar_title.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/radar/coherent_plan.h"

namespace sigmascape::radar {
namespace {

using ::testing::StartsWith;

TEST(RadarTitle, IsRadarAndItsNameOrRadarAlone) {
  EXPECT_EQ(title_of({.name = "X-band scout"}), "radar X-band scout");
  EXPECT_EQ(title_of({}), "radar");
  EXPECT_EQ(title_of({.name = ""}), "radar");
}

TEST(RadarTitle, BeginsWhatErrorsSay) {
  const auto refusal_of = [](const Radar& radar) {
    return message_of_error([&] { static_cast<void>(coherent_plan(radar, {})); });
  };
  EXPECT_THAT(refusal_of({}), StartsWith("radar: stands still"));
  EXPECT_THAT(refusal_of({.name = "scout"}), StartsWith("radar scout: stands still"));
}

}  // namespace
}  // namespace sigmascape::radar
