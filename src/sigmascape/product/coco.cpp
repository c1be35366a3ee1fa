#include "sigmascape/product/coco.h"

#include <fmt/format.h>
#include <utility>

namespace sigmascape::product {

using Json = JsonStream::Json;

CocoWriter::CocoWriter(CocoSubject subject, JsonStream::Sink write)
    : subject_(std::move(subject)), json_(std::move(write)) {
  Json info{{"description", subject_.description}};
  if (!subject_.contributor.empty()) info["contributor"] = subject_.contributor;
  json_.member("info", info);
  json_.member("licenses", Json::array());
  json_.begin_list("images");
}

void CocoWriter::add_image(const CocoImage& image) {
  Json told{{"id", image.id}, {"file_name", image.file_name}, {"width", image.columns}, {"height", image.rows}};
  if (subject_.has_videos) {
    told["video_id"] = image.video;
    told["frame_id"] = image.frame;
    if (videos_.empty() || videos_.back() != image.video) videos_.push_back(image.video);
  }
  json_.element(told);
}

void CocoWriter::begin_boxes() {
  if (std::exchange(are_images_told_, true)) return;
  json_.end_list();
  json_.begin_list("annotations");
}

void CocoWriter::add_boxes(const CocoImage& image, const std::vector<TargetBox>& boxes) {
  begin_boxes();
  for (const TargetBox& box : boxes) {
    Json told{{"id", ++boxes_},
              {"image_id", image.id},
              {"category_id", box.category + 1},
              {"bbox", {box.x, box.y, box.width, box.height}},
              {"area", box.width * box.height},
              {"iscrowd", 0}};
    if (subject_.has_videos) told["track_id"] = track_id(image, box);
    json_.element(told);
  }
}

std::size_t CocoWriter::track_id(const CocoImage& image, const TargetBox& box) {
  if (std::exchange(tracked_video_, image.video) != image.video) track_ids_.clear();
  const auto [found, is_new] = track_ids_.try_emplace(box.track, tracks_ + 1);
  if (is_new) ++tracks_;
  return found->second;
}

void CocoWriter::end() {
  begin_boxes();
  json_.end_list();
  json_.begin_list("categories");
  for (std::size_t i = 0; i < subject_.categories.size(); ++i)
    json_.element({{"id", i + 1}, {"name", subject_.categories[i]}, {"supercategory", "target"}});
  json_.end_list();
  if (subject_.has_videos) {
    json_.begin_list("videos");
    for (const std::size_t video : videos_) json_.element({{"id", video}, {"name", fmt::format("{:06}", video)}});
    json_.end_list();
  }
  json_.end();
}

}  // namespace sigmascape::product
