// What does a live frame cost, against the least that its parts can cost, and does it cost more when it shows 260 km
// instead of 2 km?

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <malloc.h>
#include <span>
#include <string>
#include <vector>

#include "figures.h"
#include "floors.h"
#include "frame_cost.h"
#include "hearing_cost.h"
#include "made_ground.h"
#include "paper_frame.h"
#include "turning_scan.h"

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/live/live_renderer.h"
#include "sigmascape/scene/paper_scene.h"

namespace {

using namespace sigmascape;         // NOLINT: a program of its own
using namespace sigmascape::bench;  // NOLINT
using live::FrameContent;
using live::LiveGround;
using live::LiveRenderer;
using live::LiveSettings;
using live::Pose;

constexpr std::size_t budget_bytes = std::size_t{512} << 20U;

/// 512 × 512 bins over a square of ground, two texels a side each on some level of the store: seen from the south.
struct View {
  double bin_m = 4.0;
  double first_ground_m = 19.5e3;  ///< from the radar's foot to the middle of the square's southern side
  double height_m = 6000.0;
  Vec2d south_middle{1024.0, 0.0};

  [[nodiscard]] double side_m() const { return 512.0 * bin_m; }
  [[nodiscard]] LiveSettings settings(FrameContent content) const {
    LiveSettings settings;
    settings.content = content;
    settings.beam_step_rad = bin_m / (first_ground_m + side_m() / 2.0);
    const double near_m = std::hypot(first_ground_m, height_m), far_m = std::hypot(first_ground_m + side_m(), height_m);
    settings.range_step_m = (far_m - near_m) / 512.0;
    settings.cells_per_bin = 1.8;
    return settings;
  }
  [[nodiscard]] Pose pose() const {
    const LiveSettings bins = settings(FrameContent::Powers);
    Pose pose;
    pose.position = {south_middle.x, south_middle.y - first_ground_m, height_m};
    pose.first_azimuth_rad = -256.0 * bins.beam_step_rad;
    pose.first_range_m = std::hypot(first_ground_m, height_m);
    return pose;
  }
};

/// Hands what a ground that is gone took back to the system, so that the most that is resident is that of one at a
/// time.
void give_back_memory() {
  malloc_trim(0);
}

double vv_power(const live::Frame& frame) {
  double sum = 0.0;
  for (std::size_t beam = 16; beam + 16 < frame.grid.azimuths; ++beam) {
    for (std::size_t range = 16; range + 16 < frame.grid.ranges; ++range) {
      const std::size_t bin = (beam * frame.grid.ranges + range) * 4;
      sum += frame.powers_m2.empty() ? static_cast<double>(std::norm(frame.amplitudes_m[bin]))
                                     : static_cast<double>(frame.powers_m2[bin]);
    }
  }
  return sum;
}

/// Of the same bins: γ sin ψ of level ground, near enough to the radar for a flat Earth.
double expected_power(const live::Frame& frame, double height_m) {
  double sum = 0.0;
  for (std::size_t range = 16; range + 16 < frame.grid.ranges; ++range) {
    const double middle_m = frame.grid.first_range_m + (static_cast<double>(range) + 0.5) * frame.grid.range_step_m;
    sum += gamma_vv * height_m / middle_m * middle_m * frame.grid.range_step_m * frame.grid.azimuth_step_rad;
  }
  return sum * static_cast<double>(frame.grid.azimuths - 32);
}

void prove_power(const std::shared_ptr<LiveGround>& ground, const View& view) {
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveSettings settings = view.settings(content);
    settings.refraction = 1e9;
    LiveRenderer renderer(ground, settings);
    const live::Frame& frame = settled(renderer, *ground, view.pose());
    prove(frame.report.dark == 0 && frame.report.coarse == 0, "a settled frame lacks nothing");
    const double error_db = db_from_linear(vv_power(frame) / expected_power(frame, view.height_m));
    prove(std::abs(error_db) < 0.05,
          fmt::format("the power of a frame is that of the radar equation ({:.3f} dB off)", error_db));
  }
}

FrameCost frame_cost(const std::shared_ptr<LiveGround>& ground, const View& view, int repetitions) {
  LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes));
  return bench::frame_cost(renderer, *ground, view.pose(), repetitions);
}

/// Vehicles all over the square of a view.
std::vector<radar::Target> vehicles(const View& view, std::size_t count, Vec3d size_m) {
  std::vector<radar::Target> targets(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2d place{(static_cast<double>(unit_float(hashed(i, 1))) - 0.5) * view.side_m(),
                      static_cast<double>(unit_float(hashed(i, 2))) * view.side_m()};
    targets[i].track =
        radar::Track::straight(Vec3d{view.south_middle.x + place.x, view.south_middle.y + place.y, size_m.z / 2.0});
    targets[i].rcs_m2 = radar::Channels{10.0F, 10.0F, 1.0F, 10.0F};
    targets[i].heading_rad = 2.0 * pi * static_cast<double>(unit_float(hashed(i, 3)));
    targets[i].size_m = size_m;
  }
  return targets;
}

/// What targets add to a frame as points, and what their shadows add to that; processor time, the least of several
/// frames with and without in turn.
void measure_targets(const std::shared_ptr<LiveGround>& ground, const View& view, int repetitions, Figures& figures) {
  LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes));
  Pose pose = view.pose();
  (void)settled(renderer, *ground, pose);
  for (const std::size_t count : {std::size_t{100}, std::size_t{10'000}}) {
    const std::vector<radar::Target> points = vehicles(view, count, {}), boxes = vehicles(view, count, {5.0, 2.5, 2.5});
    const std::array<std::span<const radar::Target>, 3> kinds{std::span<const radar::Target>{}, points, boxes};
    std::array<double, 3> least{1e30, 1e30, 1e30};
    std::array<std::size_t, 3> lit{};
    for (int run = 0; run < repetitions; ++run) {
      for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        pose.targets = kinds[kind];
        const double start = processor_seconds();
        lit[kind] = renderer.render(pose).report.lit;
        least[kind] = std::min(least[kind], processor_seconds() - start);
      }
    }
    prove(lit[1] == lit[0] && lit[2] < lit[0], "boxes cast shadows and points do not");
    figures.add(fmt::format("render.targets_{}_ms", count), 1e3 * (least[1] - least[0]), "ms", "as points");
    figures.add(fmt::format("render.shadows_{}_ms", count), 1e3 * (least[2] - least[1]), "ms",
                fmt::format("of boxes of 5 by 2.5 by 2.5 m, on {} cells", lit[0] - lit[2]));
  }
}

/// The first frame after a jump eastward, with a cache that has nothing of what is there.
double jump_seconds(const atlas::Store& store, const View& view, double jump_m) {
  const auto ground = made_ground(store, budget_bytes);
  LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes));
  Pose elsewhere = view.pose();
  elsewhere.position.x += jump_m;
  (void)renderer.render(elsewhere);
  ground->wait_until_loaded();
  const double start = wall_seconds();
  const live::FrameReport report = renderer.render(view.pose()).report;
  const double seconds = wall_seconds() - start;
  prove(report.dark == 0 && 2 * report.lit > report.cells, "the frame after a jump shows the ground, if coarsely");
  prove(report.coarse > report.cells / 2, "the frame after a jump has no pages of its own");
  return seconds;
}

/// The median of so many jumps.
double cold_frame_seconds(const atlas::Store& store, const View& view, double jump_m, int jumps) {
  std::vector<double> seconds;
  for (int jump = 0; jump < jumps; ++jump) {
    seconds.push_back(jump_seconds(store, view, jump_m));
    give_back_memory();
  }
  std::ranges::sort(seconds);
  return seconds[seconds.size() / 2];
}

/// Seconds that an atlas takes to open, the least of several times; of them those that go into the lists of all its
/// files.
struct OpeningCost {
  double all = 1e30, lists = 1e30;

  OpeningCost(const std::filesystem::path& folder, int repetitions) {
    for (int run = 0; run < repetitions; ++run) {
      const double start = wall_seconds();
      const atlas::Store store = atlas::Store::open(folder);
      if (atlas::keeps_ground_apart(store)) (void)atlas::open_ground_store(store);
      lists = std::min(lists, wall_seconds() - start);
    }
    for (int run = 0; run < repetitions; ++run) {
      const double start = wall_seconds();
      const auto ground = made_ground(atlas::Store::open(folder), budget_bytes);
      all = std::min(all, wall_seconds() - start);
    }
  }
};

/// The first frame of all of a ground.
void prove_first_frame(const std::shared_ptr<LiveGround>& ground, const View& view) {
  LiveSettings settings = view.settings(FrameContent::Powers);
  settings.refraction = 1e9;
  LiveRenderer renderer(ground, settings);
  const live::Frame& frame = renderer.render(view.pose());
  prove(frame.report.dark == 0, "the first frame of an atlas of many looks is not dark");
  // Whatever stands on the ground hides some of it.
  if (ground->obstacles() != nullptr) return;
  const double error_db = db_from_linear(vv_power(frame) / expected_power(frame, view.height_m));
  prove(std::abs(error_db) < 0.05,
        fmt::format("and its power is that of the radar equation ({:.3f} dB off)", error_db));
}

/// Atlases whose coarsest level is more than the cache holds.
void measure_many_looks(const std::filesystem::path& folder, const Arguments& arguments, Figures& figures) {
  const View view{.south_middle = {0.0, -1024.0}};
  for (const GroundOf kind : {GroundOf::Textures, GroundOf::Layers}) {
    const bool apart = kind == GroundOf::Layers;
    const atlas::Store store = made_store_of_many_looks(folder / (apart ? "apart" : "whole"), kind);
    prove_first_frame(made_ground(store, budget_bytes), view);
    const std::string name = apart ? "apart_many_looks" : "many_looks";
    const int jumps = arguments.quick ? 3 : 9;
    figures.add(fmt::format("render.cold_{}_ms", name), 1e3 * cold_frame_seconds(store, view, 10e3, jumps), "ms",
                fmt::format("eight azimuths, five elevations about the origin; median of {} jumps", jumps));
    const OpeningCost open(store.folder(), 5);
    figures.add(fmt::format("render.open_{}_ms", name), 1e3 * open.all, "ms", "the least of five");
    give_back_memory();
  }
}

/// Ground that is kept apart from what stands on it: the same 2 km of an atlas of 2 km and of one of 262 km, and all of
/// that.
void measure_ground_apart(const std::filesystem::path& folder, int repetitions, Figures& figures) {
  constexpr int patches_a_side = 128;
  constexpr double patch_m = 1024.0 * texel_m, middle_m = patch_m * patches_a_side / 2.0;
  const atlas::Store small = made_store(folder / "small", 1, GroundOf::Layers),
                     large = made_store(folder / "large", patches_a_side, GroundOf::Layers);
  const OpeningCost open_small(small.folder(), 5), open_large(large.folder(), 5);
  figures.add("render.open_small_ms", 1e3 * open_small.all, "ms",
              fmt::format("an atlas of 2 km; {:.1f} ms of it for collection.json", 1e3 * open_small.lists));
  figures.add("render.open_large_ms", 1e3 * open_large.all, "ms",
              fmt::format("one of 262 km; {:.1f} ms of it for collection.json", 1e3 * open_large.lists));

  // Within a patch, and within the same of the other atlas.
  constexpr double margin_m = 64.0;
  const View near{.bin_m = 3.75, .south_middle = {patch_m / 2.0, margin_m}},
      near_in_large{.bin_m = 3.75, .south_middle = {middle_m + patch_m / 2.0, middle_m + margin_m}},
      wide{.bin_m = 512.0, .first_ground_m = 20e3, .height_m = 12e3, .south_middle = {middle_m, 0.0}};
  // One ground at a time, each with its budget.
  const FrameCost of_small = frame_cost(made_ground(small, budget_bytes), near, repetitions);
  give_back_memory();
  const auto large_ground = made_ground(large, budget_bytes);
  const FrameCost of_large = frame_cost(large_ground, near_in_large, repetitions);
  const FrameCost of_all = frame_cost(large_ground, wide, repetitions);
  for (const FrameCost& cost : {of_small, of_large, of_all}) {
    prove(cost.report.coarse + cost.report.coarse_obstacles == 0, "a settled frame lacks nothing");
  }
  const auto obstacles = large_ground->obstacles()->cache().report();
  prove(obstacles.bytes <= large_ground->obstacles()->budget_bytes(), "obstacles keep within their budget");
  const auto a_cell = [](const FrameCost& cost) { return cost.processor / static_cast<double>(cost.report.cells); };
  figures.add("render.apart_frame_processor_ms", 1e3 * a_cell(of_small) * 1048576.0, "ms",
              "for 1,048,576 samples, all threads together");
  figures.add("render.apart_size_ratio", a_cell(of_large) / a_cell(of_small), "",
              "the same 2 km of an atlas of 262 km over one of 2 km, processor times a cell");
  figures.add("render.apart_scale_ratio", a_cell(of_all) / a_cell(of_small), "",
              "262 km over 2 km, processor times a cell");
  figures.add("render.obstacle_mib", static_cast<double>(obstacles.bytes) / 1048576.0, "MiB",
              fmt::format("that obstacles took for both frames, {} tiles", obstacles.pages));
}

/// Frames, targets and a scan over ground whose textures hold everything.
void measure_frames(const atlas::Store& store, const Arguments& arguments, int repetitions, Figures& figures) {
  const View near{.south_middle = {100e3 + 24.0, 100e3}};
  const View wide{.bin_m = 512.0, .first_ground_m = 20e3, .height_m = 12e3, .south_middle = {131e3, 0.0}};
  const int jumps = arguments.quick ? 3 : 9;
  figures.add("render.cold_frame_ms", 1e3 * cold_frame_seconds(store, near, 50e3, jumps), "ms",
              fmt::format("median of {} jumps", jumps));
  const auto ground = made_ground(store, budget_bytes);
  prove_power(ground, near);

  const Floors floors = measured_floors(repetitions);
  figures.add("render.floor.sweep_ms", 1e3 * floors.sweep, "ms", "processor time");
  figures.add("render.floor.look_up_ms", 1e3 * floors.look_up, "ms", "processor time");
  figures.add("render.floor.speckle_ms", 1e3 * floors.speckle, "ms", "processor time");
  figures.add("render.floor.histogram_ms", 1e3 * floors.histogram, "ms", "processor time");

  const FrameCost small = frame_cost(ground, near, repetitions);
  const double per_sample = 1048576.0 / static_cast<double>(small.report.cells);
  figures.add("render.cells", static_cast<double>(small.report.cells), "cells", "that the frame looked at");
  figures.add("render.frame_ms", 1e3 * small.wall * per_sample, "ms",
              fmt::format("for 1,048,576 samples, the least of {}; their median {:.1f}", repetitions,
                          1e3 * small.median_wall * per_sample));
  figures.add("render.frame_processor_ms", 1e3 * small.processor * per_sample, "ms", "all threads together");
  figures.add("render.floor_ratio", small.processor * per_sample / floors.sum(), "", "of processor times");

  measure_targets(ground, near, repetitions, figures);

  const FrameCost large = frame_cost(ground, wide, repetitions);
  figures.add("render.scale_ratio", large.processor / small.processor, "",
              fmt::format("262 km over 2 km, processor times; {} cells over {}; {:.2f} of times on the wall",
                          large.report.cells, small.report.cells, large.median_wall / small.median_wall));
}

/// What a radar that tells every other bin from the next hears of a frame over hills.
void measure_hearing(const atlas::Store& store, int repetitions, Figures& figures) {
  const View near{.south_middle = {100e3 + 24.0, 100e3}};
  const LiveSettings settings = near.settings(FrameContent::Powers);
  radar::Radar radar;
  radar.frequency_hz = frequency_hz;
  radar.range_resolution_m = 2.0 * settings.range_step_m;
  radar.beam_width_rad = 2.0 * settings.beam_step_rad;
  radar.waveform.pulse_length_s = 1e-6;
  radar::Radar narrow = radar;
  narrow.antenna.elevation = radar::GaussianBeam{};
  narrow.antenna.elevation_width_rad = radians_from_deg(6.0);
  narrow.antenna.tilt_rad = radians_from_deg(-16.0);
  const auto ground = rolling_ground(store, budget_bytes);
  for (const bool is_even : {true, false}) {
    const HearingCost cost = hearing_cost(ground, is_even ? radar : narrow, settings, near.pose(), repetitions);
    const std::string kind = is_even ? "even" : "narrow";
    figures.add(fmt::format("render.hear_{}_step_ms", kind), 1e3 * cost.moved_step, "ms",
                fmt::format("8 of 512 beams after a metre of way; {:.3f} without", 1e3 * cost.step));
    figures.add(fmt::format("render.hear_{}_frame_ms", kind), 1e3 * cost.moved_frame, "ms",
                fmt::format("all beams after a metre of way; {:.2f} without, {:.0f} the first time", 1e3 * cost.frame,
                            1e3 * cost.first));
    figures.add(fmt::format("render.hear_{}_image_ms", kind), 1e3 * cost.image, "ms",
                "the same by image_of and received_power");
  }
}

/// An antenna that goes round over hills, from an empty cache.
void measure_scan(const atlas::Store& store, bool quick, Figures& figures) {
  const TurningScan scan = turning_scan(rolling_ground(store, budget_bytes), quick ? 5.0 : 60.0);
  prove(scan.terrain_error_m == 0.0, "a turning antenna has the terrain that it asks for");
  prove(quick || scan.pages > 0, "a minute of flight reads pages");
  figures.add("render.scan_p99_ms", 1e3 * scan.p99, "ms", "4 of 512 beams of a rotating antenna");
  figures.add("render.scan_processor_ms", 1e3 * scan.processor, "ms", "mean of a step, decoding of pages included");
  figures.add("render.scan_pages", static_cast<double>(scan.pages), "pages",
              fmt::format("read after the first turn, in which {} were", scan.pages_first_turn));
  figures.add(
      "render.scan_coarse", scan.coarse_part, "",
      fmt::format("part of the cells shown more coarsely than wanted after the first turn; {:.3f} in that, which "
                  "begins with an empty cache",
                  scan.coarse_first_turn));
}

void measure(const Arguments& arguments, Figures& figures) {
  const int repetitions = arguments.quick ? 5 : 40;
  const ScratchStore scratch;
  // Patches of 2 km: 262 km a side, of which the store holds one patch and one tile of each coarser level.
  const atlas::Store store = made_store(scratch.folder() / "whole", 128);
  measure_frames(store, arguments, repetitions, figures);
  give_back_memory();
  measure_hearing(store, repetitions, figures);
  give_back_memory();
  measure_scan(store, arguments.quick, figures);
  give_back_memory();
  measure_ground_apart(scratch.folder() / "apart", repetitions, figures);
  measure_many_looks(scratch.folder() / "looks", arguments, figures);
  figures.add("render.memory_mib", peak_memory_mib(), "MiB",
              "the most that was resident in all of the above, 512 MiB for pages");
}

/// The same against tracing, on the scene of the paper.
void measure_against_tracing(const Arguments& arguments, Figures& figures) {
  const scene::Scene scene = scene::paper_scene();
  measure_traced_map(scene, figures);
  measure_paper_frame(scene, arguments.quick, figures);
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parsed(argc, argv);
  Figures figures(arguments.out);
  measure(arguments, figures);
  measure_against_tracing(arguments, figures);
  return 0;
}
