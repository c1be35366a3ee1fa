#include "sigmascape/atlas/store.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

#include "sigmascape/atlas/error_texture.h"
#include "sigmascape/atlas/files_of_others.h"
#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/stac_description.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/is_absent.h"

namespace sigmascape::atlas {
namespace {

/// Two looks that the names of files cannot tell apart would overwrite each other.
void check_names(const AspectGrid& aspects) {
  std::set<std::string> names;
  for (LookIndex look = 0; look < aspects.look_count(); ++look) {
    const std::string name = look_name(aspects.look(look));
    if (names.insert(name).second) continue;
    throw Error("atlas, looks", fmt::format("two are called {}", name),
                "choose angles that differ in tenths of a degree and frequencies in MHz, both rounded");
  }
}

void check_extent(const AtlasDescription& description) {
  constexpr double farthest_m = 1e6;
  constexpr double most_patches = 1e6;
  const radar::Rectangle& extent = description.extent;
  for (const double edge_m : {extent.west_m, extent.south_m, extent.east_m, extent.north_m}) {
    if (std::abs(edge_m) <= farthest_m) continue;
    throw Error("atlas, extent", fmt::format("{:g} m is too far from the origin of the frame", edge_m),
                fmt::format("stay within {:g} m, or move the frame", farthest_m));
  }
  if (!(extent.width_m() > 0.0 && extent.height_m() > 0.0)) {
    throw Error("atlas, extent", "has no area", "give west < east and south < north, in metres");
  }
  const double side_m = description.patches.side_m();
  const double patches = (extent.width_m() / side_m + 1.0) * (extent.height_m() / side_m + 1.0);
  if (patches > most_patches) {
    throw Error("atlas, extent", fmt::format("would need {:.0f} patches", patches),
                "choose larger texels, larger patches or a smaller extent");
  }
}

void check_description(const AtlasDescription& description) {
  check(description.patches, "atlas");
  check(description.aspects, "atlas");
  check_names(description.aspects);
  if (description.name.empty()) throw Error("atlas, name", "is empty", "give the atlas a name");
  check_extent(description);
  if (description.mantissa_bits < 1 || description.mantissa_bits > 10) {
    throw Error("atlas, mantissa_bits", fmt::format("{} is out of range", description.mantissa_bits), "give 1 to 10");
  }
}

void check_texels(const Array2D<radar::Channels>& texels, std::size_t side, const std::filesystem::path& file) {
  if (texels.columns() != side || texels.rows() != side) {
    throw Error(file.string(), fmt::format("{} x {} texels were given", texels.columns(), texels.rows()),
                fmt::format("a patch of this atlas has {0} x {0}", side));
  }
  const auto is_finite = [](const radar::Channels& texel) {
    return std::isfinite(texel.vv) && std::isfinite(texel.hh) && std::isfinite(texel.hv) &&
           std::isfinite(texel.re_vvhh);
  };
  const auto fault = std::ranges::find_if_not(texels.values(), is_finite);
  if (fault == texels.values().end()) return;
  const auto index = static_cast<std::size_t>(fault - texels.values().begin());
  throw Error(fmt::format("{}, column {}, row {}", file.string(), index % side, index / side), "is not a finite number",
              "reflectivity must be finite; the bake that made it is at fault");
}

void check_same(const Store& store, const AtlasDescription& description) {
  const auto differs = difference(store.description(), description);
  if (!differs) return;
  throw Error(
      (store.folder() / collection_name).string(), fmt::format("holds another atlas: {}", *differs),
      fmt::format("choose another folder, or remove {} with all that it holds to bake anew", store.folder().string()));
}

}  // namespace

std::string AtlasDescription::physics_revision() const {
  const auto told = settings.find(physics_revision_setting);
  return told == settings.end() ? "1" : told->second;
}

HalfTexture encoded_as(const AtlasDescription& description, const MipChain& chain,
                       const Array2D<float>& relative_errors) {
  const double scale = fitting_scale(chain.front());
  if (description.digits == Digits::All || relative_errors.empty())
    return encoded(chain, scale, description.mantissa_bits);
  return encoded(chain, scale, worthwhile_bits(chain, relative_errors, description.mantissa_bits));
}

Store Store::create(const std::filesystem::path& folder, const AtlasDescription& description) {
  if (auto store = find(folder, description)) return *std::move(store);
  // Another process may have been faster, with another atlas: who comes second takes what is there or is refused.
  static_cast<void>(geo::write_if_absent(folder / collection_name, collection_text(description)));
  Store store = open(folder);
  check_same(store, description);
  return store;
}

std::optional<Store> Store::find(const std::filesystem::path& folder, const AtlasDescription& description) {
  check_description(description);
  const auto is_none_there = [&] { return is_nothing_there(text_of(folder / collection_name).error); };
  if (is_none_there()) {
    if (!geo::is_absent(folder / "dataset.json"))
      throw Error(folder.string(), "holds a dataset", "choose an empty folder");
    const auto others = file_of_others(folder, description);
    // Another process that began here meanwhile wrote its collection before all else.
    if (others && is_none_there()) {
      throw Error(folder.string(),
                  fmt::format("holds {}, which is of no atlas, and a bake would write over it", *others),
                  "choose an empty folder");
    }
    if (!others) return std::nullopt;
  }
  Store store = open(folder);
  check_same(store, description);
  return store;
}

Store Store::open(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / collection_name;
  const auto [text, error] = text_of(file);
  if (error && !is_nothing_there(error)) {
    throw Error(file.string(), cannot_be_read(error), "make it a file that may be read, or choose another folder");
  }
  if (!text) throw Error(file.string(), "is not there", "choose the folder of an atlas, or bake one first");
  AtlasDescription description = description_from(*text, file);
  try {
    check_description(description);
  } catch (const Error& fault) {
    throw Error(file.string(), fmt::format("describes no atlas that can be ({})", fault.what()),
                "take the file of the bake again, or bake anew into another folder");
  }
  return {folder, std::move(description)};
}

Store::Store(const std::filesystem::path& folder, AtlasDescription description) : description_(std::move(description)) {
  std::error_code is_gone;
  folder_ = std::filesystem::absolute(folder, is_gone);
  if (is_gone) folder_ = folder;
}

std::size_t Store::unit_count() const {
  return description_.patches.block_over(description_.extent).size() * description_.aspects.look_count();
}

std::vector<Unit> Store::units() const {
  std::vector<Unit> all;
  for (const PatchIndex& patch : description_.patches.covering(description_.extent)) {
    for (LookIndex look = 0; look < description_.aspects.look_count(); ++look) all.push_back({patch, look});
  }
  return all;
}

std::filesystem::path Store::texture_path(PatchIndex patch, LookIndex look) const {
  return std::filesystem::path(patch_name(patch)) / (look_name(description_.aspects.look(look)) + ".tif");
}

bool Store::is_done(PatchIndex patch, LookIndex look, Scrutiny scrutiny) const {
  return !texture_fault(*this, texture_path(patch, look), scrutiny);
}

void Store::write(PatchIndex patch, LookIndex look, const Array2D<radar::Channels>& texels, const BakeFacts& facts,
                  const Array2D<float>& relative_errors) const {
  const std::filesystem::path texture = texture_path(patch, look);
  check_texels(texels, description_.patches.texels_per_side, folder_ / texture);
  const HalfTexture halves = encoded_as(description_, mip_chain(texels, tile_side), relative_errors);
  const radar::GroundGrid grid = description_.patches.texels_of(patch);
  const std::string errors = relative_errors.empty()
                                 ? ""
                                 : error_texture_bytes(relative_errors, texels, grid, description_, folder_ / texture);
  write_texture(
      *this, {0, patch}, texture, halves, sigma0_bands,
      [&](const TextureRecord& record) {
        return item_text(description_, {patch, look}, texture, record, facts);
      },
      errors);
}

Array2D<float> Store::read_errors(PatchIndex patch, LookIndex look) const {
  const std::filesystem::path texture = texture_path(patch, look);
  if (const auto fault = texture_fault(*this, texture, Scrutiny::Content)) {
    throw Error((folder_ / fault->file).string(), fault->what, bake_again);
  }
  const auto record = texture_record(*this, texture);
  const std::filesystem::path file = folder_ / errors_path(texture);
  if (!record || !record->errors) {
    throw Error(file.string(), "was not baked: the texture came without standard errors", "bake the atlas anew");
  }
  Array2D<float> values = std::move(geo::read_geotiff(file).bands.front().values);
  for (float& value : values.values()) value = error_of(static_cast<std::uint8_t>(value));
  return values;
}

MipChain Store::read(PatchIndex patch, LookIndex look) const {
  const HalfTexture halves = read_halves(patch, look);
  return decoded(halves);
}

HalfTexture Store::read_halves(PatchIndex patch, LookIndex look) const {
  return read_texture(*this, texture_path(patch, look), description_.patches.texels_per_side,
                      description_.patches.stored_levels(), bake_again);
}

HalfTexture Store::read_halves(std::size_t level, PatchIndex patch, LookIndex look) const {
  const Pyramid pyramid(*this);
  if (level < 1 || level > pyramid.levels()) {
    throw Error(folder_.string(), fmt::format("has no level {} above its patches", level),
                fmt::format("there are {}, counted from 1", pyramid.levels()));
  }
  return pyramid.read_halves(pyramid.tile_over(patch, level), look);
}

std::vector<StoreFault> Store::verify(Scrutiny scrutiny, ProgressListener* progress) const {
  std::vector<StoreFault> faults;
  const PatchBlock patches = description_.patches.block_over(description_.extent);
  std::size_t done = 0;
  for (std::size_t number = 0; number < patches.size(); ++number) {
    for (LookIndex look = 0; look < description_.aspects.look_count(); ++look) {
      if (auto fault = texture_fault(*this, texture_path(patches[number], look), scrutiny))
        faults.push_back(std::move(*fault));
      ++done;
      if (progress != nullptr)
        progress->advanced("verify", static_cast<double>(done), static_cast<double>(unit_count()), "textures");
    }
  }
  return faults;
}

}  // namespace sigmascape::atlas
