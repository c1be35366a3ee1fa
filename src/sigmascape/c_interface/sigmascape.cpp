#include "sigmascape/c_interface/sigmascape.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/live/kept_ground.h"
#include "sigmascape/live/live_receiver.h"
#include "sigmascape/live/live_renderer.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/rcs_table.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/render/level_of_detail.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/live_flight.h"
#include "sigmascape/simulate/live_tracer.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/trace/scene_geometry.h"

using sigmascape::live::FrameContent;
using sigmascape::live::KeptGround;
using sigmascape::live::LiveGround;
using sigmascape::live::LiveReceiver;
using sigmascape::live::LiveRenderer;
using sigmascape::live::LiveSettings;
using sigmascape::radar::Polarization;
using sigmascape::radar::Target;
using sigmascape::radar::Track;
using sigmascape::simulate::LiveFlight;
using sigmascape::simulate::LiveTracer;
using sigmascape::simulate::LiveTraceSettings;

// Programs hold these by value and load the library as it runs: who changes one raises the minor version of the
// project, by which the library's name keeps programs from it that were built before.
static_assert(sizeof(sigmascape_rectangle) == 32 && sizeof(sigmascape_settings) == 72 &&
              sizeof(sigmascape_tracing) == 24 && sizeof(sigmascape_pose) == 88 && sizeof(sigmascape_way_point) == 32 &&
              sizeof(sigmascape_target) == 136 && sizeof(sigmascape_frame) == 120 && sizeof(sigmascape_heard) == 80);

struct sigmascape_ground {
  std::shared_ptr<LiveGround> ground;
};

namespace {

/// A scene made ready for rays where it lies.
struct TracedScene {
  explicit TracedScene(sigmascape::scene::Scene read)
      : scene(std::move(read)), geometry(scene, sigmascape::trace::Footing::Terrain) {}

  sigmascape::scene::Scene scene;
  sigmascape::trace::SceneGeometry geometry;
};

}  // namespace

struct sigmascape_scene {
  std::shared_ptr<TracedScene> scene;
};

/// From textures, traced, or the one or the other: one of the three is there.
struct sigmascape_renderer {
  std::unique_ptr<LiveRenderer> renderer = {};
  std::shared_ptr<TracedScene> scene = {};
  std::unique_ptr<LiveTracer> tracer = {};
  std::unique_ptr<LiveFlight> flight = {};
  std::vector<Target> targets = {};   ///< those of the scene, where there is one, then those that were set
  sigmascape::live::Frame last = {};  ///< that was drawn
};

struct sigmascape_receiver {
  LiveReceiver receiver;
};

namespace {

thread_local std::string last_error;

/// Why a call failed, as far as memory goes.
void remember(const char* reason) noexcept {
  try {
    last_error = reason;
  } catch (...) {
    last_error.clear();
  }
}

/// What `action` returns, or `otherwise` when it throws.
template <typename Result, typename Action>
Result guarded(Result otherwise, Action action) noexcept {
  try {
    return action();
  } catch (const std::bad_alloc&) {
    remember("memory: is not enough for this; ask for fewer bins or cells, or for a smaller cache");
  } catch (const std::exception& failure) {
    remember(failure.what());
  } catch (...) {
    remember("something failed that does not say why");
  }
  return otherwise;
}

template <typename T>
const T& given(const T* pointer, const char* name) {
  if (pointer == nullptr) throw sigmascape::Error(name, "is null", "give what it points to");
  return *pointer;
}

sigmascape::Vec3d vector_from(const double (&numbers)[3]) {
  return {numbers[0], numbers[1], numbers[2]};
}

sigmascape::live::Pose pose_from(const sigmascape_pose& pose, const sigmascape_renderer& renderer) {
  return {.position = vector_from(pose.position_m),
          .first_azimuth_rad = pose.first_azimuth_rad,
          .first_range_m = pose.first_range_m,
          .velocity_mps = vector_from(pose.velocity_mps),
          .targets = renderer.targets,
          .moment = {pose.time_s, pose.dwell, pose.pulse}};
}

/// What renderers of one kind alone have. `name`: of the argument; `maker`: of such renderers.
template <typename T>
const T& of_its_kind(const std::unique_ptr<T>& drawer, const char* name, const char* maker) {
  if (!drawer) throw sigmascape::Error(name, "is a renderer of another kind", std::string("give one of ") + maker);
  return *drawer;
}

Track track_from(const sigmascape_target& target, const std::string& where) {
  if (target.way_points == nullptr) {
    return Track::straight(vector_from(target.position_m), vector_from(target.velocity_mps));
  }
  std::vector<sigmascape::radar::WayPoint> way_points;
  for (const sigmascape_way_point& point : std::span(target.way_points, target.way_point_count)) {
    way_points.push_back({point.time_s, vector_from(point.position_m)});
  }
  return Track::through(std::move(way_points), where);
}

template <typename Number, std::size_t Count>
bool all_finite(const Number (&numbers)[Count]) {
  return std::ranges::all_of(numbers, [](Number number) { return std::isfinite(number); });
}

void check(const sigmascape_target& target, const std::string& where) {
  if (target.swerling < 0 || target.swerling > 4) {
    throw sigmascape::Error(where, "has a Swerling case of " + std::to_string(target.swerling), "give 0 to 4");
  }
  if (target.way_points == nullptr && target.way_point_count > 0) {
    throw sigmascape::Error(where, "has " + std::to_string(target.way_point_count) + " way-points at null",
                            "give what way_points points to, or a count of 0");
  }
  const auto way_points =
      std::span(target.way_points, target.way_points == nullptr ? std::size_t{0} : target.way_point_count);
  const bool places = std::ranges::all_of(way_points, [](const sigmascape_way_point& point) {
    return std::isfinite(point.time_s) && all_finite(point.position_m);
  });
  if (!places || !all_finite(target.position_m) || !all_finite(target.velocity_mps) ||
      !std::isfinite(target.heading_rad)) {
    throw sigmascape::Error(where, "moves in a way that is not a number", "give finite places, velocities and times");
  }
  if (!all_finite(target.rcs_m2) || std::ranges::min(std::span(target.rcs_m2).first<3>()) < 0.0F) {
    throw sigmascape::Error(where, "has a cross-section that no target has", "give VV, HH and HV of 0 m2 or more");
  }
  // Beyond rounding, no two channels have more in common than either has power.
  const double most_common_m2 = 1.001 * std::sqrt(double{target.rcs_m2[0]} * double{target.rcs_m2[1]});
  if (!(std::abs(double{target.rcs_m2[3]}) <= most_common_m2)) {
    throw sigmascape::Error(where, "has a Re VV HH* that is larger than the square root of VV times HH",
                            "give the four of rcs_m2 as VV, HH, HV and Re VV HH*, all in m2");
  }
  if (!all_finite(target.size_m) || std::ranges::min(target.size_m) < 0.0) {
    throw sigmascape::Error(where, "has a size that no box has", "give lengths of 0 m or more");
  }
}

/// Tables by their files, each of which is read once however many targets name it.
using RcsTables = std::map<std::string, sigmascape::radar::RcsTable>;

Target target_from(const sigmascape_target& from, std::size_t number, RcsTables& tables) {
  const std::string where = "target " + std::to_string(number);
  check(from, where);
  Target target;
  target.track = track_from(from, where);
  if (from.rcs_table != nullptr) {
    auto known = tables.find(from.rcs_table);
    if (known == tables.end())
      known = tables.emplace(from.rcs_table, sigmascape::radar::read_rcs_table(from.rcs_table)).first;
    target.rcs_m2 = known->second;
  } else {
    target.rcs_m2 = sigmascape::radar::Channels{from.rcs_m2[0], from.rcs_m2[1], from.rcs_m2[2], from.rcs_m2[3]};
  }
  target.fluctuation = static_cast<sigmascape::radar::Swerling>(from.swerling);
  target.heading_rad = from.heading_rad;
  target.seed = from.seed;
  target.size_m = vector_from(from.size_m);
  return target;
}

void copy(const sigmascape::live::Frame& from, sigmascape_frame& to) {
  to.beams = from.grid.azimuths;
  to.ranges = from.grid.ranges;
  to.amplitudes_m = from.amplitudes_m.empty() ? nullptr : reinterpret_cast<const float*>(from.amplitudes_m.data());
  to.powers_m2 = from.powers_m2.empty() ? nullptr : from.powers_m2.data();
  to.cells = from.report.cells;
  to.lit = from.report.lit;
  to.coarse = from.report.coarse;
  to.dark = from.report.dark;
  to.level = from.report.level;
  to.terrain_error_m = from.report.terrain_error_m;
  to.coarse_obstacles = from.report.coarse_obstacles;
  to.targets = from.report.targets;
  to.rays_per_cell = from.report.rays_per_cell;
  to.median_error_db = from.report.median_error_db;
  to.below_ground_m = from.report.below_ground_m;
}

/// What both kinds of settings call by one name, for taking it over from either.
template <typename Settings>
auto shared_with_cpp(Settings& settings) {
  return std::tie(settings.beams, settings.ranges, settings.beam_step_rad, settings.range_step_m,
                  settings.cells_per_bin, settings.seed, settings.threads, settings.refraction);
}
template <typename Tracing>
auto tracing_shared_with_cpp(Tracing& tracing) {
  return std::tie(tracing.frequency_hz, tracing.rays_per_cell, tracing.max_bounces, tracing.lattice_m);
}

/// C lets an enumeration hold any number, C++ does not let it be read as one.
FrameContent content_from(const sigmascape_content& wanted) {
  std::underlying_type_t<sigmascape_content> content{};
  std::memcpy(&content, &wanted, sizeof content);
  switch (content) {
    case SIGMASCAPE_AMPLITUDES:
      return FrameContent::Amplitudes;
    case SIGMASCAPE_POWERS:
      return FrameContent::Powers;
  }
  throw sigmascape::Error("settings", "ask for content " + std::to_string(content),
                          "take SIGMASCAPE_AMPLITUDES or SIGMASCAPE_POWERS");
}

LiveSettings settings_from(const sigmascape_settings& wanted) {
  LiveSettings settings;
  settings.content = content_from(wanted.content);
  shared_with_cpp(settings) = shared_with_cpp(wanted);
  return settings;
}

Polarization polarization_from(const sigmascape_polarization& wanted) {
  std::underlying_type_t<sigmascape_polarization> polarization{};
  std::memcpy(&polarization, &wanted, sizeof polarization);
  switch (polarization) {
    case SIGMASCAPE_VV:
      return Polarization::VV;
    case SIGMASCAPE_HH:
      return Polarization::HH;
    case SIGMASCAPE_HV:
      return Polarization::HV;
    case SIGMASCAPE_VH:
      return Polarization::VH;
  }
  throw sigmascape::Error("polarization", "is number " + std::to_string(polarization),
                          "take SIGMASCAPE_VV, SIGMASCAPE_HH, SIGMASCAPE_HV or SIGMASCAPE_VH");
}

/// That of an atlas, of a scene, or none.
KeptGround ground_from(const sigmascape_ground* ground, const sigmascape_scene* scene) {
  if (ground != nullptr) return ground->ground;
  if (scene == nullptr) return {};
  return sigmascape::live::GroundHeight(
      [traced = scene->scene](sigmascape::Vec2d place) { return traced->scene.terrain.height_at(place); });
}

sigmascape_receiver* receiver_of(const sigmascape::radar::Radar& radar, const sigmascape_polarization& polarization,
                                 const sigmascape_ground* ground, const sigmascape_scene* scene, unsigned threads) {
  return new sigmascape_receiver{
      .receiver = {radar, polarization_from(polarization), ground_from(ground, scene), threads}};
}

/// Draws with whichever drawer the renderer has.
template <typename Draw>
const sigmascape::live::Frame& drawn(sigmascape_renderer& renderer, Draw draw) {
  renderer.last = renderer.flight   ? draw(*renderer.flight)
                  : renderer.tracer ? draw(*renderer.tracer)
                                    : draw(*renderer.renderer);
  return renderer.last;
}

void copy(const sigmascape::live::HeardPower& from, sigmascape_heard& to) {
  to.beams = from.grid.azimuths;
  to.ranges = from.grid.ranges;
  to.signal_w = from.signal_w.data();
  to.noise_w = from.noise_w;
  to.first_changed = from.first_changed;
  to.changed = from.changed;
  to.first_azimuth_rad = from.grid.first_azimuth_rad;
  to.beam_step_rad = from.grid.azimuth_step_rad;
  to.first_range_m = from.grid.first_range_m;
  to.range_step_m = from.grid.range_step_m;
}

LiveTraceSettings tracing_from(const sigmascape_tracing& wanted) {
  LiveTraceSettings tracing;
  tracing_shared_with_cpp(tracing) = tracing_shared_with_cpp(wanted);
  return tracing;
}

}  // namespace

const char* sigmascape_last_error(void) {
  return last_error.c_str();
}

sigmascape_ground* sigmascape_open_ground(const char* atlas_folder, double frequency_hz, size_t cache_bytes) {
  return guarded<sigmascape_ground*>(nullptr, [&] {
    sigmascape::live::CacheOptions options;
    if (cache_bytes != 0) options.budget_bytes = cache_bytes;
    (void)given(atlas_folder, "atlas_folder");
    return new sigmascape_ground{LiveGround::open(atlas_folder, frequency_hz, options)};
  });
}

void sigmascape_close_ground(sigmascape_ground* ground) {
  delete ground;
}

int sigmascape_place_in_frame(const sigmascape_ground* ground, double latitude_deg, double longitude_deg,
                              double height_m, double position_m[3]) {
  return guarded(1, [&] {
    (void)given(position_m, "position_m");
    const auto place = given(ground, "ground").ground->place_in_frame({latitude_deg, longitude_deg});
    position_m[0] = place.x;
    position_m[1] = place.y;
    position_m[2] = height_m;
    return 0;
  });
}

int sigmascape_place_on_globe(const sigmascape_ground* ground, const double position_m[3], double* latitude_deg,
                              double* longitude_deg, double* height_m) {
  return guarded(1, [&] {
    (void)given(position_m, "position_m");
    const auto place = given(ground, "ground").ground->place_on_globe({position_m[0], position_m[1]});
    if (latitude_deg != nullptr) *latitude_deg = place.latitude_deg;
    if (longitude_deg != nullptr) *longitude_deg = place.longitude_deg;
    if (height_m != nullptr) *height_m = position_m[2];
    return 0;
  });
}

int sigmascape_extent(const sigmascape_ground* ground, sigmascape_rectangle* extent) {
  return guarded(1, [&] {
    (void)given(extent, "extent");
    const sigmascape::radar::Rectangle& covered = given(ground, "ground").ground->description().extent;
    *extent = {covered.west_m, covered.south_m, covered.east_m, covered.north_m};
    return 0;
  });
}

int sigmascape_ground_height(const sigmascape_ground* ground, double x_m, double y_m, double* height_m) {
  return guarded(1, [&] {
    (void)given(height_m, "height_m");
    const sigmascape::live::LiveTerrain& terrain = std::as_const(*given(ground, "ground").ground).terrain();
    if (!terrain.pyramid().extent().contains({x_m, y_m})) {
      throw sigmascape::Error("place", "at (" + std::to_string(x_m) + ", " + std::to_string(y_m) + ") m has no terrain",
                              "give one within the terrain beside the atlas");
    }
    *height_m = terrain.height_at({x_m, y_m});
    return 0;
  });
}

int sigmascape_report(const sigmascape_ground* ground, sigmascape_ground_report* report) {
  return guarded(1, [&] {
    (void)given(report, "report");
    const sigmascape::live::GroundReport told = std::as_const(*given(ground, "ground").ground).report();
    *report = {.pages = told.pages.pages,
               .page_bytes = told.pages.bytes,
               .loaded = told.pages.loaded,
               .evicted = told.pages.evicted,
               .renewed = told.pages.renewed,
               .refused = told.pages.refused,
               .absent = told.pages.absent,
               .damaged = told.pages.damaged,
               .obstacle_bytes = told.obstacles.bytes,
               .damaged_obstacles = told.obstacles.damaged,
               .terrain_bytes = told.terrain_bytes,
               .terrain_faults = told.terrain_faults};
    return 0;
  });
}

int sigmascape_wait_for_pages(sigmascape_ground* ground) {
  return guarded(1, [&] {
    given(ground, "ground").ground->wait_until_loaded();
    return 0;
  });
}

sigmascape_settings sigmascape_default_settings(void) {
  const LiveSettings defaults;
  sigmascape_settings settings{};
  shared_with_cpp(settings) = shared_with_cpp(defaults);
  return settings;
}

sigmascape_renderer* sigmascape_make_renderer(sigmascape_ground* ground, const sigmascape_settings* settings) {
  return guarded<sigmascape_renderer*>(nullptr, [&] {
    const LiveSettings live = settings_from(given(settings, "settings"));
    return new sigmascape_renderer{.renderer = std::make_unique<LiveRenderer>(given(ground, "ground").ground, live)};
  });
}

sigmascape_scene* sigmascape_open_scene(const char* scene_file) {
  return guarded<sigmascape_scene*>(nullptr, [&] {
    (void)given(scene_file, "scene_file");
    return new sigmascape_scene{std::make_shared<TracedScene>(sigmascape::scene::read_scene(scene_file))};
  });
}

void sigmascape_close_scene(sigmascape_scene* scene) {
  delete scene;
}

sigmascape_tracing sigmascape_default_tracing(void) {
  const LiveTraceSettings defaults;
  sigmascape_tracing tracing{};
  tracing_shared_with_cpp(tracing) = tracing_shared_with_cpp(defaults);
  return tracing;
}

sigmascape_renderer* sigmascape_make_tracer(sigmascape_scene* scene, const sigmascape_settings* settings,
                                            const sigmascape_tracing* tracing) {
  return guarded<sigmascape_renderer*>(nullptr, [&] {
    const auto& traced = given(scene, "scene").scene;
    const LiveSettings live = settings_from(given(settings, "settings"));
    return new sigmascape_renderer{.scene = traced,
                                   .tracer = std::make_unique<LiveTracer>(traced->scene, traced->geometry, live,
                                                                          tracing_from(given(tracing, "tracing"))),
                                   .targets = sigmascape::simulate::targets_of(traced->scene)};
  });
}

sigmascape_renderer* sigmascape_make_flight(sigmascape_scene* scene, sigmascape_ground* ground,
                                            const sigmascape_settings* settings, const sigmascape_tracing* tracing) {
  return guarded<sigmascape_renderer*>(nullptr, [&] {
    const auto& traced = given(scene, "scene").scene;
    const LiveSettings live = settings_from(given(settings, "settings"));
    return new sigmascape_renderer{
        .scene = traced,
        .flight = std::make_unique<LiveFlight>(
            traced->scene, traced->geometry, given(ground, "ground").ground, live,
            sigmascape::simulate::LiveFlightSettings{.tracing = tracing_from(given(tracing, "tracing"))}),
        .targets = sigmascape::simulate::targets_of(traced->scene)};
  });
}

double sigmascape_textured_share(const sigmascape_renderer* flight) {
  return guarded(-1.0, [&] {
    return of_its_kind(given(flight, "flight").flight, "flight", "sigmascape_make_flight").textured_share();
  });
}

int sigmascape_advised_detail(sigmascape_renderer* tracer, const sigmascape_pose* pose) {
  return guarded(-1, [&] {
    const auto& traced = of_its_kind(given(tracer, "tracer").tracer, "tracer", "sigmascape_make_tracer");
    return sigmascape::render::choose_detail(traced.question(pose_from(given(pose, "pose"), *tracer))).level;
  });
}

void sigmascape_free_renderer(sigmascape_renderer* renderer) {
  delete renderer;
}

int sigmascape_set_targets(sigmascape_renderer* renderer, const sigmascape_target* targets, size_t count) {
  return guarded(1, [&] {
    (void)given(renderer, "renderer");
    if (count > 0) (void)given(targets, "targets");
    std::vector<Target> made;
    if (renderer->scene) made = sigmascape::simulate::targets_of(renderer->scene->scene);
    RcsTables tables;
    for (std::size_t i = 0; i < count; ++i) made.push_back(target_from(targets[i], i, tables));
    renderer->targets = std::move(made);
    return 0;
  });
}

int sigmascape_render(sigmascape_renderer* renderer, const sigmascape_pose* pose, sigmascape_frame* frame) {
  return guarded(1, [&] {
    (void)given(renderer, "renderer");
    (void)given(frame, "frame");
    const auto wanted = pose_from(given(pose, "pose"), *renderer);
    copy(drawn(*renderer, [&](auto& drawer) -> const sigmascape::live::Frame& { return drawer.render(wanted); }),
         *frame);
    return 0;
  });
}

int sigmascape_scan(sigmascape_renderer* renderer, const sigmascape_pose* pose, size_t first_beam, size_t count,
                    sigmascape_frame* frame) {
  return guarded(1, [&] {
    (void)given(renderer, "renderer");
    (void)given(frame, "frame");
    const auto wanted = pose_from(given(pose, "pose"), *renderer);
    copy(drawn(*renderer,
               [&](auto& drawer) -> const sigmascape::live::Frame& { return drawer.scan(wanted, first_beam, count); }),
         *frame);
    return 0;
  });
}

sigmascape_receiver* sigmascape_make_receiver(const char* radar_file, enum sigmascape_polarization polarization,
                                              sigmascape_ground* ground, sigmascape_scene* scene, unsigned threads) {
  return guarded<sigmascape_receiver*>(nullptr, [&] {
    (void)given(radar_file, "radar_file");
    const auto read = sigmascape::radar::read_radar_file(radar_file, sigmascape::radar::PlaceOfRadar::Optional);
    return receiver_of(read.radar, polarization, ground, scene, threads);
  });
}

sigmascape_receiver* sigmascape_make_receiver_of_text(const char* radar_text, const char* folder,
                                                      enum sigmascape_polarization polarization,
                                                      sigmascape_ground* ground, sigmascape_scene* scene,
                                                      unsigned threads) {
  return guarded<sigmascape_receiver*>(nullptr, [&] {
    (void)given(radar_text, "radar_text");
    const std::filesystem::path there = folder != nullptr ? folder : "";
    const auto read =
        sigmascape::radar::read_radar_text(radar_text, there / "radar_text", sigmascape::radar::PlaceOfRadar::Optional);
    return receiver_of(read.radar, polarization, ground, scene, threads);
  });
}

void sigmascape_free_receiver(sigmascape_receiver* receiver) {
  delete receiver;
}

int sigmascape_hear(sigmascape_receiver* receiver, const sigmascape_renderer* renderer, sigmascape_heard* heard) {
  return guarded(1, [&] {
    (void)given(receiver, "receiver");
    (void)given(heard, "heard");
    copy(receiver->receiver.hear(given(renderer, "renderer").last), *heard);
    return 0;
  });
}
