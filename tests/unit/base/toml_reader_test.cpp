#include "sigmascape/base/toml_reader.h"

#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "scratch_folder.h"

namespace sigmascape {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class TomlReader : public ::testing::Test {
 protected:
  TomlSection section(const std::string& text) { return TomlSection::read_file(folder_.write("scene.toml", text)); }
  ScratchFolder folder_;
};

TEST_F(TomlReader, WhatIsNoTableIsToldAsOneThatStandsThere) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("t = 1").section("t")); }),
              EndsWith("scene.toml: t: is 1; write it as a table, [t]"));
  // [extent] would be another table, of which nobody knows.
  EXPECT_THAT(message_of_error(
                  [&] { static_cast<void>(section("[scene]\nextent = [1, 2]").section("scene")->section("extent")); }),
              EndsWith("scene.extent: is [ 1, 2 ]; write it as a table, extent = {…}"));
}

TEST_F(TomlReader, TellsTheFilesThatItNames) {
  folder_.write("dem.tif", "");
  folder_.write("town.json", "");
  const auto found = section(
                         "name = \"none\"\n[terrain]\nfile = \"dem.tif\"\n[[buildings]]\nfile = [\"town.json\"]\n"
                         "[[buildings]]\nfile = \"${NOT_SET_ANYWHERE}/a.json\"\n")
                         .named_files();
  EXPECT_THAT(found, testing::UnorderedElementsAre(folder_.path("scene.toml"), folder_.path("town.json"),
                                                   folder_.path("dem.tif")));
}

TEST_F(TomlReader, ReadsEveryKindOfValue) {
  const auto root = section(
      "name = \"a\"\nn = 3\nx = 2.5\non = true\nlist = [1, 2]\npairs = [[1, 2.5]]\nwords = [\"p\"]\n[t]\ny = "
      "1\n[[r]]\n[[r]]\nz = 2");
  EXPECT_EQ(root.text("name"), "a");
  EXPECT_EQ(root.whole_number_or("n", {0, 9, ""}, 1), 3);
  EXPECT_EQ(root.number("x", {0, 9, ""}), 2.5);
  EXPECT_TRUE(root.flag_or("on", false));
  EXPECT_EQ(root.numbers("list", {0, 9, ""}), (std::vector<double>{1, 2}));
  EXPECT_EQ(root.pairs("pairs")[0][1], 2.5);
  EXPECT_EQ(root.texts("words")[0], "p");
  EXPECT_EQ(root.section("t")->number("y", {0, 9, ""}), 1.0);
  ASSERT_EQ(root.sections("r").size(), 2U);
  EXPECT_EQ(root.sections("r")[1].number("z", {0, 9, ""}), 2.0);
  EXPECT_EQ(root.number_or("absent", {0, 9, ""}, 7.0), 7.0);
  EXPECT_NO_THROW(root.sections("r")[0].refuse_unknown_keys());
}

TEST_F(TomlReader, MissingKeyNamesFileAndKey) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("[t]\n").section("t")->text("file")); }),
              HasSubstr("scene.toml: t.file: is missing"));
}

TEST_F(TomlReader, NumbersThatAreNotWholeAreToldAsTheyAre) {
  for (const std::string written : {"8.0", "2.5"}) {
    EXPECT_THAT(message_of_error([&] {
                  static_cast<void>(section("n = " + written).whole_number_or("n", {0, 99, ""}, 1));
                }),
                HasSubstr("scene.toml: n: is " + written + "; give a whole number"));
  }
}

TEST_F(TomlReader, WholeNumbersThatNoDoubleHoldsAreNumbersAllTheSame) {
  const Interval narrow{0, 1000, ""}, wide{0, 1e19, ""};
  for (const std::string written : {"9007199254740993", "6148914691236517205", "9223372036854775807"}) {
    EXPECT_THAT(message_of_error([&] { static_cast<void>(section("n = " + written).number("n", narrow)); }),
                HasSubstr("give a number from 0 to 1000"));
    EXPECT_THAT(message_of_error([&] { static_cast<void>(section("n = " + written).whole_number_or("n", narrow, 1)); }),
                HasSubstr("give a number from 0 to 1000"));
    EXPECT_THAT(message_of_error([&] { static_cast<void>(section("n = [" + written + "]").numbers("n", narrow)); }),
                HasSubstr("give a number from 0 to 1000"));
    EXPECT_EQ(section("n = " + written).number("n", wide), std::stod(written));
    EXPECT_EQ(section("n = [[1, " + written + "]]").pairs("n").front()[1], std::stod(written));
  }
}

TEST_F(TomlReader, PlacesWithinListsNameTheWholeWay) {
  const auto inner = section("[[r]]\n[[r]]\n[[r.s]]\n[[r.s]]\nx = 1").sections("r")[1].sections("s")[1];
  EXPECT_THAT(inner.where("x"), EndsWith("scene.toml: r[2].s[2].x"));
}

TEST_F(TomlReader, FoldersAndEmptyNamesAreNoFiles) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(TomlSection::read_file(folder_.path("."))); }),
              HasSubstr("is a folder; give the path of a TOML file"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(TomlSection::read_file("")); }),
              HasSubstr("name of a TOML file: is empty"));
}

// Root may read everything, so that it is somebody else who asks.
TEST_F(TomlReader, FilesThatMayNotBeReadAreNotToldOfAsWrittenWrongly) {
  const auto file = folder_.write("locked.toml", "x = 1\n");
  std::filesystem::permissions(file, std::filesystem::perms::none);
  const uid_t own = ::geteuid();
  constexpr uid_t nobody = 65534;
  if (own == 0) {
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  const std::string message = message_of_error([&] { static_cast<void>(TomlSection::read_file(file)); });
  if (own == 0) {
    ASSERT_EQ(::seteuid(own), 0);
  }
  EXPECT_THAT(message, HasSubstr("locked.toml: cannot be read (Permission denied); allow it to be read"));
}

TEST_F(TomlReader, PathsThatMayNotBeLookedAtAreToldWithTheirKey) {
  // Longer than any file system takes.
  const std::string name = std::string(300, 'n') + ".toml";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(TomlSection::read_file(folder_.path(name))); }),
              HasSubstr(name + ": cannot be looked at (File name too long); give the path of a TOML file"));
  EXPECT_THAT(
      message_of_error([&] { static_cast<void>(section(fmt::format("file = \"{}\"", name)).optional_file("file")); }),
      AllOf(HasSubstr("scene.toml: file: the file "), HasSubstr("cannot be looked at (File name too long)")));
}

// Of which the parser, and whatever goes through the tables, would go down a level each.
TEST_F(TomlReader, KeysOfVeryManyPartsAreRefused) {
  std::string parts = "a";
  for (int i = 0; i < 100'000; ++i) parts += ".a";
  for (const std::string& text : {"x = 1\n" + parts + " = 1\n", "x = 1\n[" + parts + "]\n"})
    EXPECT_THAT(message_of_error([&] { static_cast<void>(section(text)); }), HasSubstr("scene.toml:2: holds a key of"));
  std::string numbers = "x = [0.5";
  for (int i = 0; i < 1000; ++i) numbers += ", 0.5";
  EXPECT_EQ(section(numbers + "]").numbers("x", {0.0, 1.0, ""}).size(), 1001U);
}

TEST_F(TomlReader, WrongTypeSaysWhatIsThere) {
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(section("x = \"five\"").number("x", {0, 9, "m"}));
              }),
              HasSubstr("x: is 'five'; give a number from 0 to 9 m"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("x = 5").text("x")); }),
              HasSubstr("x: is 5; give text in quotes"));
}

TEST_F(TomlReader, OutOfRangeAndNaNSayTheRange) {
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(section("spacing_m = -5").number("spacing_m", {0.1, 1000, "m"}));
              }),
              EndsWith("spacing_m: is -5; give a number from 0.1 to 1000 m"));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(section("x = nan").number("x", {0, 1, ""}));
              }),
              HasSubstr("is nan"));
}

TEST_F(TomlReader, PairsAreOfFiniteNumbers) {
  EXPECT_THAT(section("at = [[1, 2.5]]").pairs("at"), ::testing::ElementsAre(std::array{1.0, 2.5}));
  for (const char* wrong : {"[[nan, 0]]", "[[0, inf]]", "[[0, 1, 2]]", "[[0, 'a']]", "[0, 1]"}) {
    EXPECT_THAT(message_of_error([&] { static_cast<void>(section(fmt::format("at = {}", wrong)).pairs("at")); }),
                HasSubstr("give a list of pairs of numbers"))
        << wrong;
  }
}

TEST_F(TomlReader, OfLongListsOnlyWhatIsWrongIsQuoted) {
  std::string list = "at = [";
  for (int i = 0; i < 1000; ++i) list += "[1, 2], ";
  const std::string message = message_of_error([&] { static_cast<void>(section(list + "[3, 4, 5]]").pairs("at")); });
  EXPECT_THAT(message, HasSubstr("at: holds [ 3, 4, 5 ]; give a list of pairs"));
  EXPECT_LT(message.size(), 300U);
  EXPECT_LT(message_of_error([&] { static_cast<void>(section(list + "]").number("at", {0, 1, ""})); }).size(), 400U);
}

TEST_F(TomlReader, UnknownKeySuggestsTheNearest) {
  const auto root = section("spacng_m = 5");
  static_cast<void>(root.optional_number("spacing_m", {0, 9, "m"}));
  EXPECT_THAT(message_of_error([&] { root.refuse_unknown_keys(); }),
              EndsWith("spacng_m: is not a known key; did you mean spacing_m?"));
}

TEST_F(TomlReader, MisspeltRequiredKeyIsNamedRatherThanMissed) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("fille = \"a\"").text("file")); }),
              EndsWith("fille: is not a known key; did you mean file?"));
  EXPECT_THAT(message_of_error([&] {
                static_cast<void>(section("azimuth_degr = 5").number("azimuth_deg", {0, 9, "°"}));
              }),
              EndsWith("azimuth_degr: is not a known key; did you mean azimuth_deg?"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("[raddar]").required_section("radar")); }),
              EndsWith("raddar: is not a known key; did you mean radar?"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("[map]").required_section("radar")); }),
              EndsWith("radar: is missing; add a [radar] section"));
}

TEST_F(TomlReader, SyntaxErrorNamesTheLine) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("a = 1\nb = = 2")); }),
              HasSubstr("scene.toml:2: is not TOML"));
}

TEST_F(TomlReader, MissingFileIsAnError) {
  EXPECT_THAT(message_of_error([&] { static_cast<void>(TomlSection::read_file(folder_.path("none.toml"))); }),
              HasSubstr("does not exist"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(section("file = \"none.tif\"").file("file")); }),
              HasSubstr("file: the file " + folder_.path("none.tif").string() + " does not exist"));
}

TEST_F(TomlReader, PathsAreRelativeToTheTomlFile) {
  const auto data = folder_.write("data.csv", "x");
  EXPECT_EQ(section("file = \"data.csv\"").file("file"), data);
}

TEST_F(TomlReader, WhatOnlyGdalFindsIsLeftToIt) {
  const TomlSection read = section("inner = \"/vsizip//data/heights.zip/heights.tif\"\n");
  EXPECT_EQ(read.file("inner"), "/vsizip//data/heights.zip/heights.tif") << "with its two slashes";
}

TEST(ExpandedPath, FillsInEnvironmentVariables) {
  setenv("SIGMASCAPE_TEST_FOLDER", "/data", 1);
  unsetenv("SIGMASCAPE_TEST_UNSET");
  EXPECT_EQ(expanded_path("${SIGMASCAPE_TEST_FOLDER}/a.tif", "/scenes", "w"), "/data/a.tif");
  EXPECT_EQ(expanded_path("${SIGMASCAPE_TEST_UNSET:-../other}/a.tif", "/scenes", "w"), "/other/a.tif");
  EXPECT_EQ(expanded_path("a.tif", "/scenes", "w"), "/scenes/a.tif");
  EXPECT_THAT(
      message_of_error([] { static_cast<void>(expanded_path("${SIGMASCAPE_TEST_UNSET}/a", "/", "s.toml: t.file")); }),
      HasSubstr("s.toml: t.file: the environment variable SIGMASCAPE_TEST_UNSET is not set"));
}

TEST(NearestWord, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest_word("hieght", {"width", "height"}), "height");
  EXPECT_FALSE(nearest_word("colour", {"width", "height"}).has_value());
  EXPECT_FALSE(nearest_word("a", {}).has_value());
}

}  // namespace
}  // namespace sigmascape
