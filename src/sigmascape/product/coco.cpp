#include "sigmascape/product/coco.h"

#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "sigmascape/product/json_text.h"

namespace sigmascape::product {

std::string coco_json(const CocoBoxes& boxes) {
  using Json = nlohmann::ordered_json;
  Json images = Json::array(), annotations = Json::array(), categories = Json::array();
  for (std::size_t i = 0; i < boxes.categories.size(); ++i)
    categories.push_back({{"id", i + 1}, {"name", boxes.categories[i]}, {"supercategory", "target"}});
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> tracks;
  std::set<std::size_t> known_videos;
  Json videos = Json::array();
  for (const CocoImage& image : boxes.images) {
    images.push_back(
        {{"id", image.id}, {"file_name", image.file_name}, {"width", image.columns}, {"height", image.rows}});
    if (boxes.has_videos) {
      images.back()["video_id"] = image.video;
      images.back()["frame_id"] = image.frame;
      if (known_videos.insert(image.video).second)
        videos.push_back({{"id", image.video}, {"name", fmt::format("{:06}", image.video)}});
    }
    for (const TargetBox& box : image.boxes) {
      annotations.push_back({{"id", annotations.size() + 1},
                             {"image_id", image.id},
                             {"category_id", box.category + 1},
                             {"bbox", {box.x, box.y, box.width, box.height}},
                             {"area", box.width * box.height},
                             {"iscrowd", 0}});
      if (boxes.has_videos)
        annotations.back()["track_id"] = tracks.try_emplace({image.video, box.track}, tracks.size() + 1).first->second;
    }
  }
  Json info{{"description", boxes.description}};
  if (!boxes.contributor.empty()) info["contributor"] = boxes.contributor;
  Json json{{"info", info},
            {"licenses", Json::array()},
            {"images", images},
            {"annotations", annotations},
            {"categories", categories}};
  if (boxes.has_videos) json["videos"] = videos;
  return json_text(json, 1);
}

}  // namespace sigmascape::product
