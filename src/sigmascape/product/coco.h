#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sigmascape::product {

/// A box about a target, in cells of the map from its north-western corner: x to the east, y to the south.
struct TargetBox {
  std::size_t category = 0;  ///< place in CocoBoxes::categories
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  std::size_t track = 0;  ///< number of the target within its video
};

struct CocoImage {
  std::size_t id = 0;
  std::string file_name;
  std::size_t columns = 0, rows = 0;
  std::vector<TargetBox> boxes;
  std::size_t video = 0, frame = 0;  ///< when CocoBoxes::has_videos
};

struct CocoBoxes {
  std::vector<std::string> categories;
  std::vector<CocoImage> images;
  bool has_videos = false;       ///< images follow one another in videos, and boxes belong to tracks
  std::string description = {};  ///< what the images show
  std::string contributor = {};  ///< whom the data are owed to; may be empty
};

/// Boxes as COCO object detection JSON: `info`, `licenses` (none are told; readers ask for both), `images`,
/// `categories` (numbered from 1) and `annotations` (numbered from 1 in the order of images), boxes as [x, y, width,
/// height]. With videos also `videos`, of every image `video_id` and `frame_id`, and of every annotation `track_id`,
/// the same through all images of a video and numbered from 1.
[[nodiscard]] std::string coco_json(const CocoBoxes& boxes);

}  // namespace sigmascape::product
