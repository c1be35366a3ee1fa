#include "sigmascape/dataset/dataset_spec.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <variant>

#include "sigmascape/base/sha256.h"
#include "sigmascape/base/toml_reader.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/bounce_labels.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/scene/partner_key.h"

namespace sigmascape::dataset {
namespace {

constexpr Interval anywhere_m{-1e7, 1e7, "m"};
/// Room for ranges across north from either side of it.
constexpr Interval bearings_deg{-360.0, 720.0, "degrees clockwise from north"};
constexpr double farthest_km = 1000.0;

/// How a range is to be written whose first end is the greater: of bearings one across north may be meant, or all.
std::string remedy_of_turned_ends(double first, double last, Interval allowed) {
  const std::string turned = "put the smaller number first";
  if (allowed.unit != bearings_deg.unit) return turned;
  const double turns = std::ceil((first - last) / 360.0), next_last = last + 360.0 * turns;
  if (next_last == first) {
    const double from = last + 360.0 > allowed.highest ? last - 360.0 : last;
    return fmt::format("write [{:g}, {:g}] for all bearings", from, from + 360.0);
  }
  const double back = next_last > allowed.highest ? 360.0 : 0.0;
  return fmt::format("write [{:g}, {:g}] for what leads across north, or else {}", first - back, next_last - back,
                     turned);
}

Range range_of(const TomlSection& section, std::string_view key, Interval allowed) {
  constexpr const char* remedy = "give its least and its greatest number, as in [10, 20]";
  if (!section.has(key)) throw section.fault(key, "is missing", remedy);
  const auto ends = section.is_list(key) ? section.numbers(key, allowed) : std::vector<double>();
  if (ends.size() != 2) throw section.fault(key, "is not a range", remedy);
  if (ends[0] > ends[1])
    throw section.fault(key, fmt::format("begins at {} and ends before that, at {}", ends[0], ends[1]),
                        remedy_of_turned_ends(ends[0], ends[1], allowed));
  return {ends[0], ends[1]};
}

Range scaled(Range range, double factor) {
  return {range.lowest * factor, range.highest * factor};
}

radar::Polarization polarization_of(const TomlSection& section, const std::string& word) {
  using enum radar::Polarization;
  for (const auto& [name, value] : {std::pair{"VV", VV}, {"HH", HH}, {"HV", HV}, {"sum", Sum}}) {
    if (word == name) return value;
  }
  throw section.fault("polarizations", "names \"" + word + "\"", "choose among VV, HH, HV and sum");
}

/// Each word makes a file or a row of one, which none can be twice.
std::vector<std::string> different_words(const TomlSection& section, std::string_view key) {
  auto words = section.texts(key);
  for (auto word = words.begin(); word != words.end(); ++word) {
    if (std::find(words.begin(), word, *word) == word) continue;
    throw section.fault(key, fmt::format("names \"{}\" twice", *word), "leave out one of them");
  }
  return words;
}

void read_products(const TomlSection& section, DatasetSpec& spec) {
  spec.cells = static_cast<std::size_t>(section.whole_number_or("cells", {8, 8192, "cells"}, 256));
  spec.cell_m = section.number_or("cell_m", radar::bounds::cells_m, 2.0);
  auto words = different_words(section, "polarizations");
  if (!section.has("polarizations")) words = {"VV"};
  if (words.empty()) throw section.fault("polarizations", "names none", "choose among VV, HH, HV and sum");
  for (const std::string& word : words) spec.polarizations.push_back(polarization_of(section, word));
  spec.is_half = section.choice_or("numbers", {"float32", "float16"}, "float32") == "float16";
  spec.in_decibels = section.choice_or("scale", {"linear", "db"}, "linear") == "db";
  spec.with_preview = section.flag_or("preview", true);
  for (const std::string& name : different_words(section, "layers")) {
    if (tells_bounces(name)) {
      spec.bounce_layers.push_back(name);
      continue;
    }
    try {
      spec.layers.push_back(simulate::layer_kind(name));
    } catch (const Error& unknown) {
      throw Error(section.where("layers"), unknown.what(), "of bounces there are bounce1 to bounce9 and multibounce");
    }
  }
  spec.arrangement = section.choice_or("files", {"folders", "webdataset"}, "folders") == "folders"
                         ? Arrangement::Folders
                         : Arrangement::WebDataset;
  spec.samples_per_shard =
      static_cast<std::size_t>(section.whole_number_or("samples_per_shard", {1, 100'000, "samples"}, 50));
}

void read_view(const TomlSection& section, DatasetSpec& spec) {
  spec.azimuth_rad = scaled(range_of(section, "azimuth_deg", bearings_deg), radians_from_deg(1.0));
  spec.elevation_rad = scaled(range_of(section, "elevation_deg", {0.5, 89.0, "degrees"}), radians_from_deg(1.0));
  spec.slant_range_m = scaled(range_of(section, "slant_range_km", {0.1, farthest_km, "km"}), 1e3);
  if (section.has("target_east_m")) spec.target_east_m = range_of(section, "target_east_m", anywhere_m);
  if (section.has("target_north_m")) spec.target_north_m = range_of(section, "target_north_m", anywhere_m);
  section.refuse_unknown_keys();
}

std::optional<Range> optional_range(const TomlSection& section, std::string_view key, Interval allowed) {
  if (!section.has(key)) return std::nullopt;
  return range_of(section, key, allowed);
}

void read_sequence(const TomlSection& section, DatasetSpec& spec) {
  Sequence& sequence = spec.sequence;
  scene::refuse_without(section, "interval_s", "frames", section.has("frames"));
  scene::refuse_without(section, "speed_mps", "frames", section.has("frames"));
  scene::refuse_without(section, "course_deg", "speed_mps", section.has("speed_mps"));
  sequence.frames = static_cast<std::size_t>(section.whole_number_or("frames", {1.0, 10'000.0, "frames"}, 1));
  sequence.interval_s = section.number_or("interval_s", {1e-3, 1e4, "s"}, 1.0);
  sequence.speed_mps = optional_range(section, "speed_mps", {0.0, 20'000.0, "m/s"}).value_or(Range{});
  sequence.course_rad =
      scaled(optional_range(section, "course_deg", bearings_deg).value_or(Range{}), radians_from_deg(1.0));
  const double furthest_m = spec.slant_range_m.highest +
                            sequence.speed_mps.highest * sequence.interval_s * static_cast<double>(sequence.frames - 1);
  if (furthest_m > farthest_km * 1e3) {
    throw section.fault(
        "speed_mps", fmt::format("takes the radar as far as {:.0f} km away", furthest_m / 1e3),
        fmt::format("stay within {:g} km by fewer frames, a shorter interval or less speed", farthest_km));
  }
  if (spec.count % sequence.frames != 0) {
    throw section.fault("frames",
                        fmt::format("is {}, of which {} samples are no multiple", sequence.frames, spec.count),
                        "change dataset.count or the number of frames");
  }
  section.refuse_unknown_keys();
}

/// The finest pulse may be drawn with the lowest carrier, which must have room for its band.
void check_room_for_band(const TomlSection& section, const DatasetSpec& spec) {
  const auto &frequency_hz = spec.radar_ranges.frequency_hz, &range_resolution_m = spec.radar_ranges.range_resolution_m;
  radar::Radar radar = spec.radar.radar;
  if (frequency_hz) radar.frequency_hz = frequency_hz->lowest;
  if (range_resolution_m) radar.range_resolution_m = range_resolution_m->lowest;
  const double finest_m = radar::finest_range_resolution_m(radar);
  if (radar.range_resolution_m > finest_m) return;
  throw section.fault(range_resolution_m ? "range_resolution_m" : "frequency_ghz",
                      fmt::format("lets a pulse of {:g} m be drawn, whose band about {:g} GHz reaches down to no "
                                  "frequency at all",
                                  radar.range_resolution_m, radar.frequency_hz / 1e9),
                      fmt::format("stay above {:.6g} m there, or draw higher frequencies", finest_m));
}

void read_radar_ranges(const TomlSection& section, DatasetSpec& spec) {
  const auto range = [&](std::string_view key, Interval allowed, double factor) -> std::optional<Range> {
    if (const auto found = optional_range(section, key, allowed)) return scaled(*found, factor);
    return std::nullopt;
  };
  spec.radar_ranges = {
      .frequency_hz = range("frequency_ghz", radar::bounds::frequencies_ghz, 1e9),
      .range_resolution_m = range("range_resolution_m", radar::bounds::range_resolutions_m, 1.0),
      .beam_width_rad = range("beam_width_deg", radar::bounds::beam_widths_deg, radians_from_deg(1.0))};
  if (spec.radar_ranges.beam_width_rad &&
      std::holds_alternative<radar::TabulatedBeam>(spec.radar.radar.antenna.azimuth)) {
    throw section.fault("beam_width_deg", "and the radar file's antenna.azimuth_csv both give the beam its width",
                        "leave out one of them");
  }
  const double coarsest_m = radar::coarsest_range_resolution_m(spec.radar);
  if (spec.radar_ranges.range_resolution_m && spec.radar_ranges.range_resolution_m->highest > coarsest_m) {
    const double reached_m = spec.radar_ranges.range_resolution_m->highest;
    if (spec.radar.has_shortest_pulse)
      throw section.fault("range_resolution_m",
                          fmt::format("reaches {:g} m, too long a pulse for the radar file's "
                                      "waveform.pulse_repetition_hz",
                                      reached_m),
                          fmt::format("stay within {:.6g} m, or send fewer pulses a second", coarsest_m));
    throw section.fault(
        "range_resolution_m",
        fmt::format("reaches {:g} m, coarser than the radar file's waveform.pulse_length_us can be", reached_m),
        fmt::format("stay within {:.6g} m, or leave the length of the pulse out", coarsest_m));
  }
  check_room_for_band(section, spec);
  section.refuse_unknown_keys();
}

void read_noise(const TomlSection& section, DatasetSpec& spec) {
  spec.snr_db = optional_range(section, "snr_db", {-60.0, 120.0, "dB"});
  spec.noise_sigma0_db = optional_range(section, "noise_sigma0_db", {-120.0, 40.0, "dB"});
  if (spec.snr_db.has_value() == spec.noise_sigma0_db.has_value()) {
    throw section.fault("snr_db", spec.snr_db ? "and noise_sigma0_db both say how strong the noise is" : "is missing",
                        "give one of snr_db and noise_sigma0_db, or leave the section out");
  }
  section.refuse_unknown_keys();
}

TargetClass target_class(const TomlSection& section) {
  TargetClass target{
      .name = section.text("name"),
      .number = range_of(section, "number", {0.0, 10'000.0, "targets"}),
      .rcs_db = range_of(section, "rcs_dbsm", {-60.0, 100.0, "dB over 1 m²"}),
      .size_m = section.number_or("size_m", {0.0, 1000.0, "m"}, 0.0),
      .height_m = section.number_or("height_m", {0.0, 1000.0, "m"}, 1.0),
      .speed_mps = optional_range(section, "speed_mps", {0.0, 20'000.0, "m/s"}).value_or(Range{}),
      .heading_rad = scaled(optional_range(section, "heading_deg", bearings_deg).value_or(Range{0.0, 360.0}),
                            radians_from_deg(1.0)),
      .east_m = optional_range(section, "east_m", anywhere_m),
      .north_m = optional_range(section, "north_m", anywhere_m)};
  scene::refuse_without(section, "heading_deg", "speed_mps", section.has("speed_mps"));
  if (target.name.empty()) throw section.fault("name", "is empty", "give the class a name");
  if (target.number.lowest != std::floor(target.number.lowest) ||
      target.number.highest != std::floor(target.number.highest)) {
    throw section.fault("number", "is not in whole targets", "give two whole numbers");
  }
  section.refuse_unknown_keys();
  return target;
}

/// Targets that the map could not show.
void check_shows(const TomlSection& section, const TargetClass& target, const DatasetSpec& spec) {
  const auto is_hv = [](radar::Polarization of) { return of == radar::Polarization::HV; };
  if (std::ranges::all_of(spec.polarizations, is_hv))
    throw section.fault("rcs_dbsm", "is in VV and HH, and images of HV alone show nothing of it",
                        "add one of the others to dataset.polarizations, or leave the targets out");
  const double half_m = static_cast<double>(spec.cells) * spec.cell_m / 2.0;
  for (const auto& [key, range] : {std::pair{"east_m", target.east_m}, {"north_m", target.north_m}}) {
    if (range && (range->lowest < -half_m || range->highest > half_m))
      throw section.fault(key, "leads out of the map", fmt::format("stay within {:g} and {:g}", -half_m, half_m));
  }
}

void read_bounce_atlases(const TomlSection& section, DatasetSpec& spec) {
  spec.bounce_atlases_key = section.has("first_bounce_atlas") ? "first_bounce_atlas" : "bounce_atlases";
  if (const auto first = section.optional_file("first_bounce_atlas")) spec.bounce_atlases.push_back(*first);
  const auto folders = section.texts("bounce_atlases");
  if (!folders.empty() && !spec.bounce_atlases.empty())
    throw section.fault("bounce_atlases", "stands beside first_bounce_atlas", "leave one of the two out");
  for (const std::string& folder : folders) {
    const auto path = expanded_path(folder, spec.file.parent_path(), section.where("bounce_atlases"));
    std::error_code ignored;
    if (!std::filesystem::is_directory(path, ignored))
      throw section.fault("bounce_atlases", fmt::format("the folder {} does not exist", path.string()),
                          "correct the path, which is relative to the TOML file");
    spec.bounce_atlases.push_back(path);
  }
}

void check_bounces(const TomlSection& section, const DatasetSpec& spec) {
  const std::string partner = spec.level_of_detail == 0 ? "atlas" : "a layer of bounces";
  for (const char* key : {"first_bounce_atlas", "bounce_atlases"})
    scene::refuse_without(section, key, partner, spec.level_of_detail > 0 && !spec.bounce_layers.empty());
  if (spec.level_of_detail == 0) return;
  std::size_t most_needed = 0;
  for (const std::string& name : spec.bounce_layers) {
    const std::size_t needed = bounces_to_know(name);
    most_needed = std::max(most_needed, needed);
    if (needed <= spec.bounce_atlases.size()) continue;
    throw section.fault(
        "layers", fmt::format("asks for {}, and an atlas by itself does not tell bounces apart", name),
        needed == 1 ? "name as first_bounce_atlas the same bake with --bounces 1, or trace with level_of_detail = 0"
                    : fmt::format("give as bounce_atlases the same bake with --bounces 1 to --bounces {}, in that "
                                  "order, or trace with level_of_detail = 0",
                                  needed));
  }
  if (const std::size_t given = spec.bounce_atlases.size(); given > most_needed)
    throw section.fault(spec.bounce_atlases_key,
                        fmt::format("names {}, of which the layers take the first {}", given, most_needed),
                        "leave out the others, or ask for layers of more bounces");
}

/// Each has a file in the index, and a run looks through all of them before it begins.
void check_lots(const TomlSection& section, const DatasetSpec& spec) {
  // Each is a lock while it is lacking, and the time that these take goes with their square.
  constexpr std::size_t most_lots = 50'000;
  const std::size_t fewest_samples = (spec.count + most_lots - 1) / most_lots;
  if (spec.samples_per_shard >= fewest_samples) return;
  throw section.fault("samples_per_shard",
                      fmt::format("is {}, which makes more than {} pieces of {} samples", spec.samples_per_shard,
                                  most_lots, spec.count),
                      fmt::format("give {} or more, or ask for fewer samples in count", fewest_samples));
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What would do nothing: datasets are of real-beam maps, over a flat Earth.
void check_earth(const std::filesystem::path& file, const radar::Radar& radar) {
  if (radar.earth_refraction) {
    throw Error(file.string() + ": radar.earth_refraction", "is given, and real-beam maps are made over a flat Earth",
                "leave it out, or name another radar file");
  }
}

/// The beam of a sample points to the middle of its map, wherever that is seen from.
void check_scan(const std::filesystem::path& file, const radar::Scan& scan) {
  if (scan.kind == radar::ScanKind::Rotating || !scan.azimuth_rad) return;
  throw Error(file.string() + ": scan.azimuth_deg", "is given, and a dataset's radar looks from many sides",
              "leave it out, so that the beam points to the middle of each map, or name another radar file");
}

/// Of a radar file and of the tables that it names.
std::string radar_hash(const std::filesystem::path& path) {
  Sha256 digest;
  digest.add(sha256_of_file(path));
  if (const auto antenna = TomlSection::read_file(path).section("antenna")) {
    for (const char* table : {"azimuth_csv", "elevation_csv"}) {
      if (const auto csv = antenna->optional_file(table)) digest.add(table + sha256_of_file(*csv));
    }
  }
  return digest.hex_digest();
}

/// A TOML file that a key names.
std::filesystem::path toml_file(const TomlSection& section, std::string_view key) {
  const std::filesystem::path path = section.file(key);
  if (std::filesystem::is_directory(path))
    throw section.fault(key, fmt::format("{} is a folder", path.string()), "give the path of a TOML file");
  return path;
}

void read_radar(const std::filesystem::path& path, DatasetSpec& spec) {
  radar::require_real_beam(path, "datasets are made of real-beam maps");
  spec.radar = radar::read_radar_file(path, radar::PlaceOfRadar::Optional);
  spec.radar_hash = radar_hash(path);
  check_earth(path, spec.radar.radar);
  check_scan(path, spec.radar.radar.scan);
}

}  // namespace

DatasetSpec read_dataset_spec(const std::filesystem::path& path) {
  const TomlSection file = TomlSection::read_file(path);
  const TomlSection section = file.required_section("dataset");
  DatasetSpec spec;
  spec.file = path;
  spec.text = text_of(path);
  spec.scene = toml_file(section, "scene");
  spec.atlas = section.optional_file("atlas");
  read_radar(toml_file(section, "radar"), spec);
  constexpr Interval counts{1.0, 1e8, "samples"};
  static_cast<void>(section.number("count", counts));
  spec.count = static_cast<std::size_t>(section.whole_number_or("count", counts, 1));
  spec.seed = static_cast<std::uint64_t>(section.whole_number_or("seed", {0.0, 1e15, ""}, 1));
  spec.level_of_detail =
      static_cast<int>(section.whole_number_or("level_of_detail", {0.0, 16.0, ""}, spec.atlas ? 1 : 0));
  if ((spec.level_of_detail == 0) == spec.atlas.has_value()) {
    throw spec.atlas ? section.fault("level_of_detail", "is 0, which reads no atlas", "leave out one of the two")
                     : section.fault("atlas", "is missing for a level of detail of 1 or more",
                                     "name the atlas that `sigmascape bake` made, or trace with level_of_detail = 0");
  }
  read_bounce_atlases(section, spec);
  spec.samples_per_cell =
      static_cast<std::uint32_t>(section.whole_number_or("samples_per_cell", {1.0, 65536.0, "rays"}, 16));
  if (spec.atlas && section.has("samples_per_cell"))
    throw section.fault("samples_per_cell", "stands beside atlas, with which no rays are traced",
                        "leave one of the two out");
  read_products(section, spec);
  check_bounces(section, spec);
  check_lots(section, spec);
  section.refuse_unknown_keys();
  read_view(file.required_section("view"), spec);
  if (const auto speckle = file.section("speckle")) {
    spec.looks = static_cast<std::size_t>(speckle->whole_number_or("looks", {0.0, 1000.0, "looks"}, 1));
    speckle->refuse_unknown_keys();
  }
  if (const auto noise = file.section("noise")) {
    read_noise(*noise, spec);
  }
  if (const auto radar = file.section("radar")) read_radar_ranges(*radar, spec);
  if (const auto sequence = file.section("sequence")) read_sequence(*sequence, spec);
  for (const TomlSection& target : file.sections("targets")) {
    spec.targets.push_back(target_class(target));
    const std::string& name = spec.targets.back().name;
    if (std::ranges::count(spec.targets, name, &TargetClass::name) > 1)
      throw target.fault("name", "'" + name + "' is that of another class of targets", "give each class its own");
    check_shows(target, spec.targets.back(), spec);
  }
  file.refuse_unknown_keys();
  return spec;
}

}  // namespace sigmascape::dataset
