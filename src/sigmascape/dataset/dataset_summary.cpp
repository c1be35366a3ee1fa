#include "sigmascape/dataset/dataset_summary.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/dataset/sample_files.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/coco.h"
#include "sigmascape/product/contact_sheet.h"
#include "sigmascape/product/json_stream.h"
#include "sigmascape/product/png_file.h"

namespace sigmascape::dataset {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What an index tells of a lot, gone through to the end before anything of it is used.
struct LotTold {
  struct SampleBoxes {
    std::size_t sample = 0;
    std::vector<product::TargetBox> boxes;
  };
  std::vector<SampleBoxes> boxes;
  std::vector<Array2D<std::uint8_t>> thumbnails;
  Json samples = Json::array();
  Json tar;  ///< null where samples are in folders
  std::size_t bytes = 0;
};

/// Of all lots together.
struct Totals {
  std::size_t bytes = 0, boxes = 0;
  std::vector<Array2D<std::uint8_t>> thumbnails;
  Json tars = Json::array();
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

product::CocoImage image_of(const DatasetSpec& spec, std::size_t sample) {
  return {.id = sample,
          .file_name = pictured_file(spec, sample),
          .columns = spec.cells,
          .rows = spec.cells,
          .video = sample / spec.sequence.frames,
          .frame = sample % spec.sequence.frames};
}

std::vector<product::TargetBox> boxes_of(const Json& entry) {
  std::vector<product::TargetBox> boxes;
  for (const Json& box : entry.at("boxes"))
    boxes.push_back(
        {box.at(0).get<std::size_t>(), box.at(1), box.at(2), box.at(3), box.at(4), box.at(5).get<std::size_t>()});
  return boxes;
}

LotTold told_by(const Json& index) {
  LotTold told;
  for (const Json& entry : index.at("samples")) {
    told.boxes.push_back({entry.at("sample").get<std::size_t>(), boxes_of(entry)});
    if (entry.contains("thumbnail")) told.thumbnails.push_back(pixels_of(entry.at("thumbnail")));
    for (const Json& file : entry.at("files")) told.bytes += file.at("bytes").get<std::size_t>();
    told.samples.push_back({{"sample", entry.at("sample")}, {"files", entry.at("files")}});
  }
  if (index.contains("tar")) told.tar = index.at("tar");
  return told;
}

LotTold told_of(const fs::path& folder, std::size_t lot) {
  Interruption::heed();
  const fs::path path = index_path(folder, lot);
  const Error damaged(path.string(), "is damaged",
                      "remove the file and run its share again, which makes its samples anew");
  std::ifstream stream(path);
  try {
    return told_by(Json::parse(stream));
  } catch (const Json::exception&) {
    throw damaged;
  } catch (const std::invalid_argument&) {  // pixels that are no numbers
    throw damaged;
  }
}

product::CocoSubject subject_of(const SampleMaker& maker) {
  product::CocoSubject subject{.categories = {},
                               .has_videos = maker.spec().sequence.frames > 1,
                               .description = fmt::format("radar images of {}", maker.scene().name),
                               .contributor = maker.scene().attribution};
  for (const TargetClass& target : maker.spec().targets) subject.categories.push_back(target.name);
  return subject;
}

Totals write_annotations(const SampleMaker& maker, const fs::path& folder, std::size_t lots) {
  const DatasetSpec& spec = maker.spec();
  geo::GrowingFile file(folder / "annotations.json");
  product::CocoWriter coco(subject_of(maker), [&](std::string_view piece) { file.append(piece); });
  for (std::size_t sample = 0; sample < spec.count; ++sample) {
    Interruption::heed();
    coco.add_image(image_of(spec, sample));
  }
  Totals totals;
  for (std::size_t lot = 0; lot < lots; ++lot) {
    LotTold told = told_of(folder, lot);
    for (const auto& [sample, boxes] : told.boxes) {
      coco.add_boxes(image_of(spec, sample), boxes);
      totals.boxes += boxes.size();
    }
    std::ranges::move(told.thumbnails, std::back_inserter(totals.thumbnails));
    if (!told.tar.is_null()) totals.tars.push_back(told.tar);
    totals.bytes += told.bytes;
  }
  coco.end();
  file.put_in_place();
  return totals;
}

void write_manifest(const SampleMaker& maker, const fs::path& folder, std::size_t lots, const Totals& totals) {
  const DatasetSpec& spec = maker.spec();
  geo::GrowingFile file(folder / "manifest.json");
  product::JsonStream json([&](std::string_view piece) { file.append(piece); });
  json.member("format", "sigmascape dataset 1");
  json.member("scene", maker.scene().name);
  json.member("scene_hash", maker.scene_hash());
  json.member("attribution", maker.scene().attribution);
  json.member("count", spec.count);
  json.member("seed", spec.seed);
  json.member("bytes", totals.bytes);
  json.member("boxes", totals.boxes);
  json.member("classes", simulate::class_names(maker.scene()));
  if (!totals.tars.empty()) json.member("tars", totals.tars);
  json.begin_list("samples");
  for (std::size_t lot = 0; lot < lots; ++lot) {
    const LotTold told = told_of(folder, lot);
    for (const Json& sample : told.samples) json.element(sample);
  }
  json.end_list();
  json.end();
  file.put_in_place();
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

bool has_summary(const fs::path& folder) {
  return std::ranges::all_of(std::array{"annotations.json", "contact_sheet.png", "manifest.json"},
                             [&](const char* name) { return fs::exists(folder / name); });
}

void write_summary(const SampleMaker& maker, const fs::path& folder, std::size_t lots) {
  // What runs that were killed while they wrote these may have left.
  geo::remove_leftovers(folder, "");
  const Totals totals = write_annotations(maker, folder, lots);
  geo::write_atomically(folder / "contact_sheet.png", product::png_bytes(product::contact_sheet(totals.thumbnails)));
  write_manifest(maker, folder, lots, totals);
}

}  // namespace sigmascape::dataset
