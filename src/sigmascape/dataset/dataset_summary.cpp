#include "sigmascape/dataset/dataset_summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/dataset/sample_files.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/contact_sheet.h"
#include "sigmascape/product/json_text.h"
#include "sigmascape/product/png_file.h"

namespace sigmascape::dataset {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What an index tells of a lot, gone through to the end before anything of it is used.
struct LotTold {
  std::vector<product::CocoImage> images;
  std::vector<Array2D<std::uint8_t>> thumbnails;
  Json samples = Json::array();
  Json tar;  ///< null where samples are in folders
  std::size_t bytes = 0;
};

Array2D<std::uint8_t> pixels_of(const std::string& hex) {
  Array2D<std::uint8_t> pixels(sheet_side, sheet_side);
  for (std::size_t i = 0; i < pixels.size() && 2 * i + 1 < hex.size(); ++i)
    pixels.values()[i] = static_cast<std::uint8_t>(std::stoul(hex.substr(2 * i, 2), nullptr, 16));
  return pixels;
}

/// The picture that boxes are about: the preview, or the map itself when there is none.
std::string pictured_file(const DatasetSpec& spec, std::size_t sample) {
  const std::string file = spec.with_preview ? "preview.png" : "map.npy";
  return spec.arrangement == Arrangement::Folders ? "samples/" + sample_name(sample) + "/" + file
                                                  : sample_name(sample) + "." + file;
}

product::CocoImage image_of(const DatasetSpec& spec, const Json& entry) {
  const auto sample = entry.at("sample").get<std::size_t>();
  product::CocoImage image{.id = sample,
                           .file_name = pictured_file(spec, sample),
                           .columns = spec.cells,
                           .rows = spec.cells,
                           .boxes = {},
                           .video = sample / spec.sequence.frames,
                           .frame = sample % spec.sequence.frames};
  for (const Json& box : entry.at("boxes"))
    image.boxes.push_back(
        {box.at(0).get<std::size_t>(), box.at(1), box.at(2), box.at(3), box.at(4), box.at(5).get<std::size_t>()});
  return image;
}

LotTold told_by(const DatasetSpec& spec, const Json& index) {
  LotTold told;
  for (const Json& entry : index.at("samples")) {
    told.images.push_back(image_of(spec, entry));
    if (entry.contains("thumbnail")) told.thumbnails.push_back(pixels_of(entry.at("thumbnail")));
    for (const Json& file : entry.at("files")) told.bytes += file.at("bytes").get<std::size_t>();
    told.samples.push_back({{"sample", entry.at("sample")}, {"files", entry.at("files")}});
  }
  if (index.contains("tar")) told.tar = index.at("tar");
  return told;
}

LotTold told_of(const DatasetSpec& spec, const fs::path& folder, std::size_t lot) {
  const fs::path path = index_path(folder, lot);
  const Error damaged(path.string(), "is damaged",
                      "remove the file and run its share again, which makes its samples anew");
  std::ifstream stream(path);
  try {
    return told_by(spec, Json::parse(stream));
  } catch (const Json::exception&) {
    throw damaged;
  } catch (const std::invalid_argument&) {  // pixels that are no numbers
    throw damaged;
  }
}

}  // namespace

std::string sample_name(std::size_t sample) {
  return fmt::format("{:06}", sample);
}

std::string tar_name(std::size_t lot) {
  return fmt::format("shard-{:06}.tar", lot);
}

fs::path index_path(const fs::path& folder, std::size_t lot) {
  return folder / "index" / fmt::format("{:06}.json", lot);
}

void write_summary(const SampleMaker& maker, const fs::path& folder, std::size_t lots) {
  const DatasetSpec& spec = maker.spec();
  product::CocoBoxes boxes;
  boxes.has_videos = spec.sequence.frames > 1;
  boxes.description = fmt::format("radar images of {}", maker.scene().name);
  boxes.contributor = maker.scene().attribution;
  for (const TargetClass& target : spec.targets) boxes.categories.push_back(target.name);
  std::vector<Array2D<std::uint8_t>> thumbnails;
  Json samples = Json::array(), tars = Json::array();
  std::size_t bytes = 0;
  for (std::size_t lot = 0; lot < lots; ++lot) {
    LotTold told = told_of(spec, folder, lot);
    std::ranges::move(told.images, std::back_inserter(boxes.images));
    std::ranges::move(told.thumbnails, std::back_inserter(thumbnails));
    for (Json& sample : told.samples) samples.push_back(std::move(sample));
    if (!told.tar.is_null()) tars.push_back(std::move(told.tar));
    bytes += told.bytes;
  }
  std::size_t annotations = 0;
  for (const product::CocoImage& image : boxes.images) annotations += image.boxes.size();
  Json manifest{{"format", "sigmascape dataset 1"},
                {"scene", maker.scene().name},
                {"scene_hash", maker.scene_hash()},
                {"attribution", maker.scene().attribution},
                {"count", spec.count},
                {"seed", spec.seed},
                {"bytes", bytes},
                {"boxes", annotations},
                {"classes", simulate::class_names(maker.scene())}};
  if (!tars.empty()) manifest["tars"] = tars;
  manifest["samples"] = samples;
  // What runs that were killed while they wrote these may have left.
  geo::remove_leftovers(folder, "");
  geo::write_atomically(folder / "annotations.json", product::coco_json(boxes));
  geo::write_atomically(folder / "contact_sheet.png", product::png_bytes(product::contact_sheet(thumbnails)));
  geo::write_atomically(folder / "manifest.json", product::json_text(manifest, 1));
}

}  // namespace sigmascape::dataset
