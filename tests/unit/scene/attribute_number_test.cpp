#include "sigmascape/scene/attribute_number.h"

#include <gtest/gtest.h>

namespace sigmascape::scene {
namespace {

TEST(AttributeNumber, ReadsMetresAndFeetAsPeopleWriteThem) {
  EXPECT_DOUBLE_EQ(*metres_from_text("12"), 12.0);
  EXPECT_DOUBLE_EQ(*metres_from_text(" 12.5 m "), 12.5);
  EXPECT_DOUBLE_EQ(*metres_from_text("-3"), -3.0);
  EXPECT_DOUBLE_EQ(*metres_from_text("100 ft"), 30.48);
  EXPECT_DOUBLE_EQ(*metres_from_text("10'"), 3.048);
  EXPECT_NEAR(*metres_from_text("5'6\""), 1.6764, 1e-9);
}

TEST(AttributeNumber, RefusesWhatIsNoLength) {
  for (const char* text : {"", "tall", "12 storeys", "3;4", "nan", "5'x\"", "inf"})
    EXPECT_FALSE(metres_from_text(text)) << text;
}

}  // namespace
}  // namespace sigmascape::scene
