#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <system_error>
#include <vector>

#include "atlas_faults.h"
#include "atlas_info.h"
#include "atlas_terrain.h"
#include "command.h"
#include "terminal_progress.h"
#include "words.h"

#include "sigmascape/atlas/atlas_summary.h"
#include "sigmascape/atlas/levels_above.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/verify.h"
#include "sigmascape/terrain/pyramid_faults.h"

namespace sigmascape::cli {
namespace {

void verify(const std::string& folder, const Output& output) {
  const atlas::Store store = atlas::Store::open(folder);
  TerminalProgress progress;
  std::vector<atlas::StoreFault> faults = atlas::verify(store, atlas::Scrutiny::Content, &progress);
  const std::size_t texture_faults = faults.size();
  const auto verified = [&](const std::filesystem::path& tiles) {
    return terrain::verify_pyramid(tiles, store.description().frame);
  };
  std::ranges::move(tile_faults(store, verified), std::back_inserter(faults));
  std::string text;
  for (const atlas::StoreFault& fault : faults) text += fmt::format("{} {}\n", fault.file.string(), fault.what);
  const std::size_t looks = store.unit_count();
  const bool is_one = faults.size() == 1;
  text += faults.empty()
              ? fmt::format("{}, all whole and as recorded", counted(looks, "look", "looks"))
              : fmt::format(
                    "{} fault{} in {}; 'sigmascape bake … --verify' mends {}{}", faults.size(), is_one ? "" : "s",
                    folder, is_one ? "it" : "them",
                    faults.size() > texture_faults ? ", and 'sigmascape atlas terrain' the terrain that it made" : "");
  output.finish(text, {{"atlas", folder}, {"looks", looks}, {"faults", json_of(faults)}});
  if (!faults.empty()) end_with(1);
}

std::string written_text(const atlas::LevelsAbove::Written& written) {
  std::string text = fmt::format("{} above the patches written", counted(written.all(), "file", "files"));
  if (written.all() == written.looks) return text + (written.looks > 0 ? ", all of looks" : "");
  const std::string of_buildings =
      written.buildings > 0 ? fmt::format(", {} of buildings", written.buildings) : std::string();
  return text + fmt::format(": {} of looks{}, {} of obstacles and {} of ground", written.looks, of_buildings,
                            written.obstacles, written.ground);
}

/// What could not be made and why, to stand behind what was.
std::string left_out_text(const atlas::LevelsAbove& made) {
  if (made.left_out == 0) return "";
  const std::size_t files = made.hindrances.size();
  if (files == 0) return fmt::format("; {} left out; call it again", made.left_out);
  const atlas::StoreFault& first = made.hindrances.front();
  return fmt::format("; {} left out for want of {} file{} of patches ({} {}{}); {}", made.left_out, files,
                     files == 1 ? "" : "s", first.file.string(), first.what, files == 1 ? "" : ", …",
                     atlas::bake_again);
}

void make_pyramid(const std::string& folder, const Output& output) {
  const atlas::LevelsAbove made = atlas::make_levels_above(atlas::Store::open(folder));
  output.finish(written_text(made.written) + left_out_text(made), {{"atlas", folder},
                                                                   {"written", made.written.all()},
                                                                   {"looks", made.written.looks},
                                                                   {"obstacles", made.written.obstacles},
                                                                   {"ground", made.written.ground},
                                                                   {"buildings", made.written.buildings},
                                                                   {"left_out", made.left_out},
                                                                   {"because", json_of(made.hindrances)}});
  if (made.left_out > 0) end_with(1);
}

}  // namespace

void add_atlas_command(Command app, Output& output) {
  const auto command = app.add_subcommand("atlas", "Look after an atlas of baked textures");
  command.require_subcommand(1);
  auto folder = std::make_shared<std::string>();
  const auto subcommand = [&](const char* name, const char* description, const char* example) {
    const auto added = command.add_subcommand(name, description);
    added.add_option("FOLDER", *folder, "folder of the atlas").required();
    added.add_flag("--json", output.json, "print as JSON");
    added.footer(fmt::format("Example:\n  sigmascape atlas {}", example));
    return added;
  };
  subcommand("info", "Print axes, patches, which files are there, size, errors, settings and sources",
             "info out/bilbao_atlas")
      .callback([folder, &output] {
        const atlas::Store store = atlas::Store::open(*folder);
        const atlas::AtlasSummary summary = atlas::summary_of(store);
        output.finish(text_of(store, summary), json_of(store, summary));
      });
  subcommand(
      "verify",
      "Compare every file, the terrain's tiles included, with its recorded SHA-256; ends with 1 when one is missing or "
      "differs",
      "verify out/bilbao_atlas")
      .callback([folder, &output] { verify(*folder, output); });
  subcommand("pyramid",
             "Make what is missing of the levels above the patches, from the patches that are there; ends with 1 if "
             "not all can be",
             "pyramid out/bilbao_atlas")
      .callback([folder, &output] { make_pyramid(*folder, output); });
  add_terrain_command(subcommand("terrain",
                                 "Put terrain of any size beside the atlas, in tiles, for live frames that look beyond "
                                 "the scene; tiles that are there and whole are left",
                                 "terrain out/bilbao_atlas dem.tif --spacing 10"),
                      folder, output);
}

}  // namespace sigmascape::cli
