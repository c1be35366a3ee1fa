#include "sigmascape/product/attribution_line.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace sigmascape::product {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Picture picture_with(const std::string& attribution, std::size_t columns) {
  Picture picture;
  picture.pixels = Array2D<Rgba>(columns, 20, Rgba{1, 2, 3});
  picture.metadata["attribution"] = attribution;
  return picture;
}

std::size_t bright_pixels_below(const Picture& picture, std::size_t first_row) {
  std::size_t count = 0;
  for (std::size_t row = first_row; row < picture.pixels.rows(); ++row) {
    for (std::size_t column = 0; column < picture.pixels.columns(); ++column)
      count += picture.pixels(column, row).red > 200 ? 1 : 0;
  }
  return count;
}

TEST(AttributionLine, StandsBelowThePictureAndChangesNoneOfIt) {
  const Picture plain = picture_with("Survey of Places, CC BY 4.0", 200);
  const Picture attributed = with_attribution(plain);
  EXPECT_EQ(attributed.pixels.columns(), 200U);
  EXPECT_GT(attributed.pixels.rows(), 30U);
  EXPECT_EQ(attributed.grid, plain.grid);
  for (std::size_t i = 0; i < plain.pixels.size(); ++i)
    ASSERT_EQ(attributed.pixels.values()[i], plain.pixels.values()[i]);
  EXPECT_GT(bright_pixels_below(attributed, 20), 200U);
}

TEST(AttributionLine, IsAsManyLinesAsTheWidthAsksFor) {
  const std::string text = "Survey of Places, CC BY 4.0, and others";
  const std::size_t wide = with_attribution(picture_with(text, 400)).pixels.rows(),
                    narrow = with_attribution(picture_with(text, 120)).pixels.rows();
  EXPECT_GT(narrow, wide);
  EXPECT_EQ(bright_pixels_below(with_attribution(picture_with(text, 400)), 20),
            bright_pixels_below(with_attribution(picture_with(text, 120)), 20))
      << "letters are lost";
}

TEST(AttributionLine, HasALetterForEachLetter) {
  const auto is_equal = [](const char* one, const char* other) {
    const Picture first = with_attribution(picture_with(one, 400)), second = with_attribution(picture_with(other, 400));
    return std::ranges::equal(first.pixels.values(), second.pixels.values());
  };
  EXPECT_TRUE(is_equal("Instituto Geográfico Nacional, élève, Łódź", "Instituto Geografico Nacional, eleve, Lodz"));
  EXPECT_TRUE(is_equal("日本", "??"));
  EXPECT_FALSE(is_equal("a & b; \"c\"!", "a   b   c  "));
}

// Who must be credited is credited in pictures of any width, to the last letter.
TEST(AttributionLine, FitsNarrowPicturesToo) {
  const std::string text = "© OpenStreetMap contributors, https://www.openstreetmap.org/copyright";
  const std::size_t letters = bright_pixels_below(with_attribution(picture_with(text, 800)), 20);
  for (const std::size_t columns : {300U, 150U, 80U, 56U, 30U, 1U}) {
    const Picture plain = picture_with(text, columns), attributed = with_attribution(plain);
    EXPECT_EQ(bright_pixels_below(attributed, 20), letters) << columns;
    EXPECT_EQ(attributed.pixels.columns(), std::max<std::size_t>(columns, 56)) << "eight letters of six, and margins";
    EXPECT_EQ(attributed.grid, plain.grid);
    for (std::size_t row = 0; row < 20; ++row) {
      const auto ground = attributed.pixels.row(row).first(columns);
      ASSERT_TRUE(std::ranges::equal(ground, plain.pixels.row(row))) << columns;
    }
  }
}

TEST(AttributionLine, IsLeftOutWhereThereIsNone) {
  EXPECT_EQ(with_attribution(picture_with("", 200)).pixels.rows(), 20U);
  Picture unnamed = picture_with("Survey", 200);
  unnamed.metadata.clear();
  EXPECT_EQ(with_attribution(unnamed).pixels.rows(), 20U);
}

TEST(AttributionLine, BreaksBetweenWords) {
  EXPECT_THAT(broken_into_lines("one two three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(broken_into_lines("one two three", 6), ElementsAre("one", "two", "three"));
  EXPECT_THAT(broken_into_lines("a longest b", 3), ElementsAre("a", "lon", "ges", "t b"));
  EXPECT_THAT(broken_into_lines("Łódź élève", 4), ElementsAre("Łódź", "élèv", "e")) << "letters, not bytes";
  EXPECT_THAT(broken_into_lines("", 5), IsEmpty());
}

}  // namespace
}  // namespace sigmascape::product
