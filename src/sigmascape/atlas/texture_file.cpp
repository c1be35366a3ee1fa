#include "sigmascape/atlas/texture_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/error_texture.h"
#include "sigmascape/atlas/half_cog.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/half_pyramid.h"

namespace sigmascape::atlas {

std::string texture_bytes(const HalfTexture& texture, const BandNames& bands, const radar::GroundGrid& grid,
                          const AtlasDescription& description) {
  geo::HalfPyramid pyramid;
  pyramid.placement = {grid.west_m, grid.north_m, grid.cell_m, description.frame.proj()};
  pyramid.band_names.assign(bands.begin(), bands.end());
  pyramid.scale = texture.scale;
  pyramid.columns = pyramid.rows = texture.side;
  pyramid.metadata = {{"SIGMASCAPE_SCENE_HASH", description.scene_hash}};
  for (const std::vector<Half>& level : texture.levels) {
    std::ranges::transform(level, std::back_inserter(pyramid.levels.emplace_back()), float_from_half);
  }
  return geo::half_cog_bytes(pyramid);
}

namespace {

/// Nothing when the file cannot be read.
std::optional<std::string> digest_of(const std::filesystem::path& file) {
  try {
    return sha256_of_file(file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// What is wrong with a file that an item records, if anything.
std::optional<StoreFault> file_fault(const std::filesystem::path& folder, const std::filesystem::path& file,
                                     std::uint64_t recorded_size, const std::string& sha256, Scrutiny scrutiny) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(folder / file, error);
  if (is_nothing_there(error)) return StoreFault{file, "is missing, though its item is there"};
  if (error) return StoreFault{file, cannot_be_read(error)};
  if (size < recorded_size) {
    return StoreFault{file, fmt::format("is truncated: {} of {} bytes", size, recorded_size)};
  }
  if (size > recorded_size) {
    return StoreFault{file, fmt::format("was altered: {} bytes instead of {}", size, recorded_size)};
  }
  if (scrutiny == Scrutiny::Size) return std::nullopt;
  const auto digest = digest_of(folder / file);
  if (!digest) return StoreFault{file, "cannot be read"};
  if (*digest != sha256) return StoreFault{file, "was altered: its SHA-256 is not the recorded one"};
  return std::nullopt;
}

/// Whether a file was written so lately that its item may be on its way.
bool is_just_written(const std::filesystem::path& file) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  return !error && std::filesystem::file_time_type::clock::now() - written < std::chrono::minutes(1);
}

/// Whatever its standard errors are like.
FoundTexture found_alone(const Store& store, const std::filesystem::path& texture, Scrutiny scrutiny) {
  const auto item = found_item(store, texture);
  if (!item) {
    std::error_code error;
    static_cast<void>(std::filesystem::file_size(store.folder() / texture, error));
    if (is_nothing_there(error)) return {{}, StoreFault{texture, "is missing", true}};
    return {{},
            StoreFault{item_path(texture),
                       "is missing, so the file that it vouches for does not count: unfinished, or it was removed",
                       is_just_written(store.folder() / texture)}};
  }
  if (!item->record) return {{}, StoreFault{item_path(texture), item->fault}};
  const TextureRecord& record = *item->record;
  return {record, file_fault(store.folder(), texture, record.size_bytes, record.sha256, scrutiny)};
}

}  // namespace

FileText text_of(const std::filesystem::path& file) {
  const auto told_by_system = [] { return std::error_code(errno, std::generic_category()); };
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {{}, told_by_system()};
  std::string text;
  std::array<char, 1 << 16> part{};
  while (stream.read(part.data(), part.size()) || stream.gcount() > 0)
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return {{}, told_by_system()};
  return {std::move(text), {}};
}

bool is_nothing_there(const std::error_code& error) {
  return error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
}

std::string cannot_be_read(const std::error_code& error) {
  return fmt::format("cannot be read ({})", error.message());
}

std::filesystem::path item_path(std::filesystem::path texture) {
  return texture.replace_extension(".json");
}

FoundTexture found_texture(const Store& store, const std::filesystem::path& texture, Scrutiny scrutiny) {
  FoundTexture found = found_alone(store, texture, scrutiny);
  if (found.fault || !found.record->errors) return found;
  const ErrorsRecord& recorded = *found.record->errors;
  found.fault = file_fault(store.folder(), errors_path(texture), recorded.size_bytes, recorded.sha256, scrutiny);
  return found;
}

std::optional<FoundItem> found_item(const Store& store, const std::filesystem::path& texture) {
  const auto [text, error] = text_of(store.folder() / item_path(texture));
  if (text) return item_from(*text, store.description(), texture);
  if (is_nothing_there(error)) return std::nullopt;
  return FoundItem{{}, cannot_be_read(error)};
}

std::optional<StoreFault> texture_fault(const Store& store, const std::filesystem::path& texture, Scrutiny scrutiny) {
  return found_texture(store, texture, scrutiny).fault;
}

bool is_as_recorded(const std::filesystem::path& folder, const std::filesystem::path& texture,
                    const TextureRecord& record, Scrutiny scrutiny) {
  return !file_fault(folder, texture, record.size_bytes, record.sha256, scrutiny);
}

std::optional<TextureRecord> texture_record(const Store& store, const std::filesystem::path& texture) {
  const auto item = found_item(store, texture);
  return item ? item->record : std::nullopt;
}

void write_texture(const Store& store, const PyramidTile& tile, const std::filesystem::path& texture,
                   const HalfTexture& halves, const BandNames& bands,
                   const std::function<std::string(const TextureRecord&)>& item_for, const std::string& errors) {
  const std::filesystem::path& folder = store.folder();
  const AtlasDescription& description = store.description();
  const std::string bytes = texture_bytes(halves, bands, texels_of(description.patches, tile), description);
  TextureRecord record{bytes.size(), sha256_of(bytes), halves.scale};
  if (!errors.empty()) record.errors = {errors.size(), sha256_of(errors)};

  make_catalogs_over(folder, description, tile);
  // An item of an earlier texture must not vouch for the new one, not even for the moment between two renames.
  std::error_code ignored;
  std::filesystem::remove(folder / item_path(texture), ignored);
  geo::write_atomically(folder / texture, bytes);
  if (!errors.empty()) geo::write_atomically(folder / errors_path(texture), errors);
  geo::write_atomically(folder / item_path(texture), item_for(record));
}

HalfTexture read_texture(const Store& store, const std::filesystem::path& texture, std::size_t side, std::size_t levels,
                         const std::string& remedy) {
  const auto [record, fault] = found_alone(store, texture, Scrutiny::Content);
  if (fault) throw Error((store.folder() / fault->file).string(), fault->what, remedy);
  return {side, record->scale, read_half_cog(store.folder() / texture, side, levels)};
}

}  // namespace sigmascape::atlas
