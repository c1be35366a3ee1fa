#include "sigmascape/dataset/dataset_run.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <unistd.h>
#include <utility>
#include <vector>

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/dataset/dataset_summary.h"
#include "sigmascape/dataset/lot_tar.h"
#include "sigmascape/dataset/sample_files.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/contact_sheet.h"
#include "sigmascape/trace/simd_setting.h"

namespace sigmascape::dataset {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string sha256_of(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes);
  return digest.hex_digest();
}

Json file_json(const std::string& name, std::string_view bytes) {
  return {{"name", name}, {"bytes", bytes.size()}, {"sha256", sha256_of(bytes)}};
}

/// The numbers as text: two digits a pixel.
std::string hex_of(const Array2D<std::uint8_t>& pixels) {
  std::string text;
  for (const std::uint8_t pixel : pixels.values()) text += fmt::format("{:02x}", pixel);
  return text;
}

/// By which revision of the program samples are made. To be raised by one with every change after which the same
/// specification, scene and atlas give other images or labels than before: datasets that were begun before are refused
/// then, rather than gone on with half and half.
constexpr int samples_revision = 4;

/// What a dataset is told apart by. Where samples are traced, they depend on the vector units.
Json identity_of(const SampleMaker& maker) {
  const bool is_traced = maker.spec().level_of_detail == 0;
  return {{"format", "sigmascape dataset 1"},
          {"revision", samples_revision},
          {"physics_revision", is_traced ? Json(bake::physics_revision) : Json()},
          {"simd", is_traced ? Json(trace::simd_setting()) : Json()},
          {"spec_sha256", sha256_of(maker.spec().text)},
          {"scene_hash", maker.scene_hash()},
          {"targets_sha256", maker.targets_hash()},
          {"radar_sha256", maker.spec().radar_hash},
          {"atlas_sha256", maker.atlas_hashes()},
          {"samples", maker.spec().count},
          {"spec", maker.spec().text}};
}

std::string digest_of_identity(const SampleMaker& maker) {
  return sha256_of(identity_of(maker).dump());
}

/// What a dataset was begun with that is another one now: "scene and atlas".
std::string difference(const Json& begun, const Json& mine) {
  constexpr std::array<std::pair<const char*, const char*>, 8> parts{{{"revision", "version of the program"},
                                                                      {"physics_revision", "version of the physics"},
                                                                      {"simd", "kind of vector unit"},
                                                                      {"spec_sha256", "specification"},
                                                                      {"scene_hash", "scene"},
                                                                      {"targets_sha256", "targets in the scene"},
                                                                      {"radar_sha256", "radar file"},
                                                                      {"atlas_sha256", "atlas"}}};
  std::vector<std::string> differing;
  for (const auto& [key, word] : parts) {
    // What an older version did not tell is not another one now.
    const bool is_told = begun.contains(key) || std::string_view(key) == "revision";
    if (is_told && begun.value(key, Json()) != mine.at(key)) differing.emplace_back(word);
  }
  return fmt::format("{}", fmt::join(differing, " and "));
}

/// Something in the folder by a name under which a dataset writes; nothing when there is none.
std::optional<std::string> name_in_use(const fs::path& folder) {
  for (const char* name : {"annotations.json", "manifest.json", "contact_sheet.png", "index", "samples"})
    if (fs::exists(folder / name)) return name;
  std::error_code is_not_there;
  for (const auto& entry : fs::directory_iterator(folder, is_not_there)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("shard-") && name.ends_with(".tar")) return name;
  }
  return std::nullopt;
}

/// That a dataset begun in the folder takes the place of nothing.
void check_free(const fs::path& folder) {
  const fs::path file = folder / "dataset.json";
  if (fs::exists(file)) return;
  if (fs::exists(folder / "collection.json")) throw Error(folder.string(), "holds an atlas", "choose an empty folder");
  const auto name = name_in_use(folder);
  // Another run that began here meanwhile wrote its own before all else.
  if (name && !fs::exists(file)) {
    throw Error(folder.string(), fmt::format("holds {}, which is of no dataset begun here, and would be lost", *name),
                "choose an empty folder");
  }
}

void claim_folder(const SampleMaker& maker, const fs::path& folder) {
  const fs::path file = folder / "dataset.json";
  const Json mine = identity_of(maker);
  check_free(folder);
  if (!fs::exists(file) && geo::write_if_absent(file, mine.dump(1) + "\n")) return;
  std::ifstream stream(file, std::ios::binary);
  const Json begun = Json::parse(stream, nullptr, false);
  if (!begun.is_object()) throw Error(file.string(), "cannot be read", "choose an empty folder");
  if (begun == mine) return;
  const std::string differs = difference(begun, mine);
  throw Error(folder.string(),
              differs.empty() ? "holds another dataset" : "holds another dataset: begun with another " + differs,
              "choose an empty folder, or what it was begun with");
}

std::size_t count_of_lot(const DatasetSpec& spec, std::size_t number) {
  return std::min(spec.samples_per_shard, spec.count - number * spec.samples_per_shard);
}

/// Whether the files that an index lists are there in their length.
bool are_whole(const Json& files, const fs::path& folder) {
  return std::ranges::all_of(files, [&](const Json& file) {
    std::error_code absent;
    return fs::file_size(folder / file.at("name").get<std::string>(), absent) == file.at("bytes").get<std::size_t>() &&
           !absent;
  });
}

/// Whether a lot stands in the folder with all its files. What an index no longer tells counts as lost.
bool is_made(const SampleMaker& maker, const std::string& identity, const fs::path& folder, std::size_t number) {
  std::ifstream stream(index_path(folder, number), std::ios::binary);
  const Json index = Json::parse(stream, nullptr, false);
  try {
    if (index.value("dataset_sha256", "") != identity) return false;
    const Json& samples = index.at("samples");
    if (samples.size() != count_of_lot(maker.spec(), number)) return false;
    if (!std::ranges::all_of(samples, [](const Json& sample) { return sample.at("boxes").is_array(); })) return false;
    if (maker.spec().arrangement == Arrangement::WebDataset) return are_whole(Json::array({index.at("tar")}), folder);
    return std::ranges::all_of(samples, [&](const Json& sample) {
      return are_whole(sample.at("files"), folder / "samples" / sample_name(sample.at("sample").get<std::size_t>()));
    });
  } catch (const Json::exception&) {
    return false;
  }
}

/// One lot of samples on its way into files.
class Lot {
 public:
  Lot(const SampleMaker& maker, const fs::path& folder, std::size_t number)
      : maker_(maker),
        folder_(folder),
        number_(number),
        first_(number * maker.spec().samples_per_shard),
        count_(count_of_lot(maker.spec(), number)),
        entries_(count_) {
    if (maker.spec().arrangement == Arrangement::WebDataset) tar_.emplace(folder / tar_name(number), first_);
  }

  /// Makes one of its samples. True for the last that was lacking: the lot is to be written then.
  bool make_one(std::size_t k) {
    make_sample(k);
    return made_.fetch_add(1) + 1 == count_;
  }

  void write() {
    Json index{{"dataset_sha256", digest_of_identity(maker_)}, {"samples", entries_}};
    if (tar_) {
      const LotTar::Written tar = tar_->put_in_place();
      index["tar"] = {{"name", tar_name(number_)}, {"bytes", tar.bytes}, {"sha256", tar.sha256}};
    }
    geo::write_atomically(index_path(folder_, number_), index.dump(1) + "\n");
  }

 private:
  void make_sample(std::size_t k) {
    const std::size_t sample_number = first_ + k;
    const Sample sample = maker_.make(sample_number);
    std::vector<SampleFile> files = sample_files(maker_.spec(), sample);
    Json listed = Json::array(), boxes = Json::array();
    for (const SampleFile& file : files) listed.push_back(file_json(file.name, file.bytes));
    for (const SampleTarget& target : sample.targets) {
      if (!target.is_seen) continue;
      const product::TargetBox& box = target.box;
      boxes.push_back({box.category, box.x, box.y, box.width, box.height, box.track});
    }
    entries_[k] = {{"sample", sample_number}, {"files", listed}, {"boxes", boxes}};
    if (sample_number < sheet_samples) {
      const auto picture = product::picture_of(sample.map, {.polarization = pictured_polarization(maker_.spec())});
      entries_[k]["thumbnail"] = hex_of(product::thumbnail(picture, sheet_side));
    }
    if (tar_) {
      tar_->add(sample_number, std::move(files));
    } else {
      write_folder(sample_number, files);
    }
  }

  void write_folder(std::size_t sample_number, const std::vector<SampleFile>& files) const {
    const fs::path folder = folder_ / "samples" / sample_name(sample_number);
    // What a killed run may have left.
    if (fs::exists(folder)) geo::remove_leftovers(folder, "");
    for (const SampleFile& file : files) geo::write_atomically(folder / file.name, file.bytes);
  }

  const SampleMaker& maker_;
  const fs::path& folder_;
  std::size_t number_, first_, count_;
  std::vector<Json> entries_;
  std::optional<LotTar> tar_;  // of samples that go into one
  std::atomic<std::size_t> made_{0};
};

/// The lots that are lacking, whose samples threads take one by one: while some still make the last of a lot, others
/// begin with the next. Only lots that have been begun are in memory.
class LackingLots {
 public:
  LackingLots(const SampleMaker& maker, const fs::path& folder, std::vector<std::size_t> numbers)
      : maker_(maker), folder_(folder), numbers_(std::move(numbers)) {
    for (const std::size_t number : numbers_) samples_ += count_of_lot(maker.spec(), number);
  }

  [[nodiscard]] std::size_t samples() const { return samples_; }

  /// Sample number `index` of those that are lacking; with the last of a lot, writes the lot.
  void make(std::size_t index) {
    const std::size_t size = maker_.spec().samples_per_shard, number = numbers_[index / size];
    const std::shared_ptr<Lot> lot = begun(number);
    if (!lot->make_one(index % size)) return;
    lot->write();
    const std::lock_guard lock(guard_);
    begun_.erase(number);
  }

 private:
  std::shared_ptr<Lot> begun(std::size_t number) {
    const std::lock_guard lock(guard_);
    std::shared_ptr<Lot>& lot = begun_[number];
    if (!lot) lot = std::make_shared<Lot>(maker_, folder_, number);
    return lot;
  }

  const SampleMaker& maker_;
  const fs::path& folder_;
  std::vector<std::size_t> numbers_;
  std::size_t samples_ = 0;
  std::mutex guard_;
  std::map<std::size_t, std::shared_ptr<Lot>> begun_;
};

/// The lots of a share as they were found, and the right to make those that are lacking.
struct FoundShare {
  std::size_t samples = 0, already = 0;
  std::vector<std::size_t> lacking;
  std::vector<bake::Claims::Claim> claims;  ///< each on a lot
};

/// Two runs that make the same lot come to the same bytes, in the time of two: whoever finds a lot that he lacks in
/// another's hands stops. Where a file system cannot lock, nobody does.
FoundShare claimed_share(const SampleMaker& maker, const std::string& identity, const fs::path& folder,
                         const DatasetShare& share, std::size_t lots, const bake::Claims& claims) {
  FoundShare found;
  for (std::size_t number = share.index; number < lots; number += share.count) {
    Interruption::heed();
    const std::size_t count = count_of_lot(maker.spec(), number);
    found.samples += count;
    auto claim = claims.take_if_free(number);
    if (is_made(maker, identity, folder, number)) {
      found.already += count;
      continue;
    }
    if (!claim) {
      throw Error(folder.string(), "is being filled with the same samples by another run",
                  "wait until that has ended, or give each run a --shard of its own");
    }
    found.claims.push_back(std::move(*claim));
    found.lacking.push_back(number);
  }
  return found;
}

/// Of runs that were killed while they wrote tar files and indices. Once for all lots, for a folder of many takes long
/// to be listed.
void remove_leftovers(const fs::path& folder) {
  geo::remove_leftovers(folder, "");
  if (const fs::path indices = index_path(folder, 0).parent_path(); fs::exists(indices))
    geo::remove_leftovers(indices, "");
}

/// A published dataset may lie where nothing can be written, and be asked whether it is whole.
bool may_be_written(const fs::path& folder) {
  return ::access(folder.c_str(), W_OK) == 0;
}

void check(const DatasetShare& share) {
  if (share.index < share.count) return;
  throw Error(fmt::format("shard {}/{}", share.index, share.count), "is not one of the shards",
              "count them from 0: the last of eight is 7/8");
}

}  // namespace

DatasetReport make_dataset(const SampleMaker& maker, const fs::path& folder, const DatasetShare& share,
                           ProgressListener& progress) {
  check(share);
  claim_folder(maker, folder);
  const std::size_t size = maker.spec().samples_per_shard, lots = (maker.spec().count + size - 1) / size;
  const bake::Claims claims(folder);
  const std::string identity = digest_of_identity(maker);
  const FoundShare found = claimed_share(maker, identity, folder, share, lots, claims);
  if (!found.lacking.empty()) remove_leftovers(folder);
  DatasetReport report{.samples = found.samples, .already = found.already};
  const auto tell = [&](std::size_t made) {
    progress.advanced("dataset", static_cast<double>(report.already + made), static_cast<double>(report.samples),
                      "samples");
  };
  LackingLots wanted(maker, folder, found.lacking);
  std::atomic<std::size_t> made{0};
  parallel_for(wanted.samples(), share.threads, [&](std::size_t index, unsigned worker) {
    wanted.make(index);
    const std::size_t now = made.fetch_add(1) + 1;
    if (worker == 0) tell(now);
  });
  tell(wanted.samples());
  report.is_complete = true;
  for (std::size_t number = 0; number < lots; ++number) {
    Interruption::heed();
    report.is_complete = report.is_complete && is_made(maker, identity, folder, number);
  }
  const bool may_stay = found.lacking.empty() && has_summary(folder) && !may_be_written(folder);
  if (report.is_complete && !may_stay) write_summary(maker, folder, lots);
  return report;
}

}  // namespace sigmascape::dataset
