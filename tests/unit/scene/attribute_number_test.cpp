#include "sigmascape/scene/attribute_number.h"

#include <gtest/gtest.h>
#include <utility>

namespace sigmascape::scene {
namespace {

TEST(AttributeNumber, ReadsMetresAndFeetAsPeopleWriteThem) {
  EXPECT_DOUBLE_EQ(*metres_from_text("12"), 12.0);
  EXPECT_DOUBLE_EQ(*metres_from_text(" 12.5 m "), 12.5);
  EXPECT_DOUBLE_EQ(*metres_from_text("-3"), -3.0);
  EXPECT_DOUBLE_EQ(*metres_from_text("100 ft"), 30.48);
  EXPECT_DOUBLE_EQ(*metres_from_text("10'"), 3.048);
  EXPECT_NEAR(*metres_from_text("5'6\""), 1.6764, 1e-9);
  EXPECT_NEAR(metres_from_text("5'-6\"").value_or(0.0), 1.6764, 1e-9);
}

TEST(AttributeNumber, CountsPlainNumbersAloneInTheStatedUnit) {
  EXPECT_DOUBLE_EQ(*metres_from_text("100", 0.3048), 30.48);
  EXPECT_DOUBLE_EQ(*metres_from_text(" 1250 ", 0.01), 12.5);
  EXPECT_DOUBLE_EQ(*metres_from_text("12.5 m", 0.3048), 12.5);
  EXPECT_DOUBLE_EQ(*metres_from_text("10'", 0.01), 3.048);
  EXPECT_NEAR(*metres_from_text("5'6\"", 0.01), 1.6764, 1e-9);
}

TEST(AttributeNumber, KnowsTheUnitsOfRasters) {
  EXPECT_DOUBLE_EQ(*metres_from_text("1250 cm"), 12.5);
  EXPECT_DOUBLE_EQ(*metres_from_text("100 Feet"), 30.48);
  EXPECT_DOUBLE_EQ(*metres_from_text("3937 us-ft"), 1200.0);
}

TEST(AttributeNumber, ReadsDecimalCommas) {
  EXPECT_DOUBLE_EQ(*metres_from_text("3,5"), 3.5);
  EXPECT_DOUBLE_EQ(*metres_from_text("-12,25 m"), -12.25);
  EXPECT_DOUBLE_EQ(*metres_from_text("40,5 ft"), 12.3444);
  EXPECT_DOUBLE_EQ(*metres_from_text("12,3456"), 12.3456);
  for (const auto& [text, metres] : {std::pair{"0,125", 0.125}, {"1234,567", 1234.567}}) {
    EXPECT_DOUBLE_EQ(*metres_from_text(text), metres);
    EXPECT_FALSE(has_doubtful_comma(text)) << text;
  }
}

TEST(AttributeNumber, DoesNotGuessWhatACommaParts) {
  for (const char* text : {"1,234", " 12,345 m", "-123,456", "1,250'"}) {
    EXPECT_FALSE(metres_from_text(text)) << text;
    EXPECT_TRUE(has_doubtful_comma(text)) << text;
  }
  for (const char* text : {"1,234,567", "1,234.5", "3,", ",5", "3, 5", "3,5,7", "3,5;4"}) {
    EXPECT_FALSE(metres_from_text(text)) << text;
    EXPECT_FALSE(has_doubtful_comma(text)) << text;
  }
}

TEST(AttributeNumber, RefusesWhatIsNoLength) {
  EXPECT_FALSE(metres_from_text("5'12\"")) << "a foot has twelve inches";
  for (const char* text : {"", "tall", "12 storeys", "3;4", "nan", "5'x\"", "inf"})
    EXPECT_FALSE(metres_from_text(text)) << text;
}

}  // namespace
}  // namespace sigmascape::scene
