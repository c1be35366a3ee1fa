#include "sigmascape/product/coco.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace sigmascape::product {
namespace {

/// Two videos of two frames and one; a target of the first leaves, and another stays.
nlohmann::json example(CocoSubject subject) {
  subject.categories = {"car", "ship"};
  const CocoImage first{.id = 0, .file_name = "a", .columns = 8, .rows = 8, .video = 0, .frame = 0},
      second{.id = 1, .file_name = "b", .columns = 8, .rows = 8, .video = 0, .frame = 1},
      third{.id = 2, .file_name = "c", .columns = 8, .rows = 8, .video = 1, .frame = 0};
  std::string text;
  CocoWriter coco(subject, [&](std::string_view piece) { text += piece; });
  for (const CocoImage& image : {first, second, third}) coco.add_image(image);
  coco.add_boxes(first, {{0, 1, 2, 3, 4, 0}, {1, 0, 0, 2, 2, 1}});
  coco.add_boxes(second, {{1, 1, 0, 2, 2, 1}});
  coco.add_boxes(third, {{0, 5, 5, 1, 1, 0}});
  coco.end();
  return nlohmann::json::parse(text);
}

TEST(Coco, TracksAreOneNumberThroughAVideoAndAnotherInTheNext) {
  const auto json = example({.categories = {}, .has_videos = true});
  ASSERT_EQ(json.at("videos").size(), 2U);
  EXPECT_EQ(json.at("images")[1].at("video_id"), 0);
  EXPECT_EQ(json.at("images")[1].at("frame_id"), 1);
  const auto& boxes = json.at("annotations");
  ASSERT_EQ(boxes.size(), 4U);
  EXPECT_EQ(boxes[1].at("track_id"), boxes[2].at("track_id"));
  EXPECT_NE(boxes[0].at("track_id"), boxes[1].at("track_id"));
  EXPECT_NE(boxes[0].at("track_id"), boxes[3].at("track_id")) << "the same number in another video is another target";
  EXPECT_EQ(boxes[2].at("category_id"), 2);
  EXPECT_EQ(boxes[0].at("area"), 12.0);
}

// COCO's own reader, pycocotools, copies `info` when it loads results, and some of its releases fail without.
TEST(Coco, HasAllThatReadersAskFor) {
  const auto json = example({.categories = {},
                             .has_videos = true,
                             .description = "radar images of a town",
                             .contributor = "© OpenStreetMap contributors"});
  EXPECT_EQ(json.at("info").at("description"), "radar images of a town");
  EXPECT_EQ(json.at("info").at("contributor"), "© OpenStreetMap contributors");
  EXPECT_TRUE(json.at("licenses").is_array());
  for (const char* list : {"images", "annotations", "categories"}) EXPECT_FALSE(json.at(list).empty()) << list;
}

// A scene without a name of its own is called after its file, whose name may be in Latin-1.
TEST(Coco, WordsThatAreNotUtf8AreWrittenAllTheSame) {
  const auto json = example({.categories = {},
                             .has_videos = true,
                             .description = "radar images of caf\xe9",
                             .contributor = "Oficina de Catastro de C\xe1"
                                            "diz"});
  EXPECT_EQ(json.at("info").at("description"), "radar images of caf\ufffd");
  EXPECT_EQ(json.at("info").at("contributor"), "Oficina de Catastro de C\ufffddiz");
  EXPECT_EQ(json.at("annotations").size(), 4U);
}

TEST(Coco, WithoutVideosThereAreNoTracks) {
  const auto json = example({.categories = {}, .has_videos = false});
  EXPECT_FALSE(json.contains("videos"));
  EXPECT_FALSE(json.at("annotations")[0].contains("track_id"));
}

// Readers ask for the lists, whether anything is in them or not.
TEST(Coco, OfNoImagesHasEmptyLists) {
  std::string text;
  CocoWriter coco({}, [&](std::string_view piece) { text += piece; });
  coco.end();
  const auto json = nlohmann::json::parse(text);
  for (const char* list : {"images", "annotations", "categories"}) EXPECT_EQ(json.at(list), nlohmann::json::array());
}

}  // namespace
}  // namespace sigmascape::product
