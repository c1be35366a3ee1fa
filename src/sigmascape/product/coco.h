#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sigmascape::product {

/// A box about a target, in cells of the map from its north-western corner: x to the east, y to the south.
struct TargetBox {
  std::size_t category = 0;  ///< place in CocoBoxes::categories
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

struct CocoImage {
  std::size_t id = 0;
  std::string file_name;
  std::size_t columns = 0, rows = 0;
  std::vector<TargetBox> boxes;
};

struct CocoBoxes {
  std::vector<std::string> categories;
  std::vector<CocoImage> images;
};

/// Boxes as COCO object detection JSON: `images`, `categories` (numbered from 1) and `annotations` (numbered from 1 in
/// the order of images), boxes as [x, y, width, height].
[[nodiscard]] std::string coco_json(const CocoBoxes& boxes);

}  // namespace sigmascape::product
