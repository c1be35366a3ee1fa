#include "sigmascape/product/coco.h"

#include <nlohmann/json.hpp>

namespace sigmascape::product {

std::string coco_json(const CocoBoxes& boxes) {
  using Json = nlohmann::ordered_json;
  Json images = Json::array(), annotations = Json::array(), categories = Json::array();
  for (std::size_t i = 0; i < boxes.categories.size(); ++i)
    categories.push_back({{"id", i + 1}, {"name", boxes.categories[i]}, {"supercategory", "target"}});
  for (const CocoImage& image : boxes.images) {
    images.push_back(
        {{"id", image.id}, {"file_name", image.file_name}, {"width", image.columns}, {"height", image.rows}});
    for (const TargetBox& box : image.boxes) {
      annotations.push_back({{"id", annotations.size() + 1},
                             {"image_id", image.id},
                             {"category_id", box.category + 1},
                             {"bbox", {box.x, box.y, box.width, box.height}},
                             {"area", box.width * box.height},
                             {"iscrowd", 0}});
    }
  }
  return Json{{"images", images}, {"annotations", annotations}, {"categories", categories}}.dump(1) + "\n";
}

}  // namespace sigmascape::product
