#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sigmascape/product/json_stream.h"

namespace sigmascape::product {

/// A box about a target, in cells of the map from its north-western corner: x to the east, y to the south.
struct TargetBox {
  std::size_t category = 0;  ///< place in CocoSubject::categories
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  std::size_t track = 0;  ///< number of the target within its video
};

struct CocoImage {
  std::size_t id = 0;
  std::string file_name;
  std::size_t columns = 0, rows = 0;
  std::size_t video = 0, frame = 0;  ///< when CocoSubject::has_videos
};

/// What boxes are about.
struct CocoSubject {
  std::vector<std::string> categories;
  bool has_videos = false;       ///< images follow one another in videos, and boxes belong to tracks
  std::string description = {};  ///< what the images show
  std::string contributor = {};  ///< whom the data are owed to; may be empty
};

/// Boxes as COCO object detection JSON: `info`, `licenses` (none are told; readers ask for both), `images`,
/// `annotations` (numbered from 1 in the order of images), boxes as [x, y, width, height], and `categories` (numbered
/// from 1). With videos also `videos`, of every image `video_id` and `frame_id`, and of every annotation `track_id`,
/// the same through all images of a video and numbered from 1.
///
/// Written as it comes, of any number of images in the same memory but for the numbers of videos: first all images,
/// those of a video one after another, then the boxes of each in the same order.
class CocoWriter {
 public:
  CocoWriter(CocoSubject subject, JsonStream::Sink write);

  void add_image(const CocoImage& image);
  void add_boxes(const CocoImage& image, const std::vector<TargetBox>& boxes);
  /// Nothing may be added afterwards.
  void end();

 private:
  void begin_boxes();
  std::size_t track_id(const CocoImage& image, const TargetBox& box);

  CocoSubject subject_;
  JsonStream json_;
  bool are_images_told_ = false;
  std::vector<std::size_t> videos_;
  std::size_t boxes_ = 0, tracks_ = 0;
  std::size_t tracked_video_ = 0;
  std::map<std::size_t, std::size_t> track_ids_;  // by number within the video that is gone through
};

}  // namespace sigmascape::product
