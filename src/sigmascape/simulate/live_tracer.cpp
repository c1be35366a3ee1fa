#include "sigmascape/simulate/live_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/live/frame_reach.h"
#include "sigmascape/live/target_count.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/distance_of_range.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/render/level_of_detail.h"
#include "sigmascape/scene/mesh_counts.h"
#include "sigmascape/simulate/launch_for_map.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/traced_ground.h"
#include "sigmascape/simulate/traced_scatterers.h"
#include "sigmascape/trace/late_by.h"
#include "sigmascape/trace/multibounce_reach.h"

namespace sigmascape::simulate {
namespace {

constexpr const char* name = "live tracer";
constexpr int coarsest_lattice_level = 23;
/// Times as many cells as may be traced are rays aimed at, at most: what is kept of the list of them is no more than
/// what amplitudes keep of those that are traced, and up to three times that while it grows.
constexpr double most_aimed_per_traced = 4.0;
/// Of the ground of no bin.
bool is_empty(const radar::Rectangle& area) {
  return !(area.east_m > area.west_m && area.north_m > area.south_m);
}

/// From the edge of a beam echoes have a share in the next.
constexpr double half_a_beam = 0.5;

const live::LiveSettings& checked(const live::LiveSettings& settings) {
  live::check(settings, name);
  return settings;
}

const LiveTraceSettings& checked(const LiveTraceSettings& tracing, const trace::SceneGeometry& geometry) {
  if (geometry.footing() != trace::Footing::Terrain) {
    throw Error(name, "is to trace objects on a level plane, as bakes do", "make the geometry with Footing::Terrain");
  }
  constexpr std::uint32_t most_rays = 1U << 16U;  // a frame of a day
  if (tracing.rays_per_cell == 0 || tracing.rays_per_cell > most_rays) {
    throw Error(name, fmt::format("has {} rays a cell", tracing.rays_per_cell), fmt::format("give 1 to {}", most_rays));
  }
  trace::check_bounces(tracing.max_bounces, name);
  if (!(tracing.most_cells >= 1.0)) {
    throw Error(name, fmt::format("may trace {} cells at a time", tracing.most_cells), "allow one or more");
  }
  if (!(tracing.frequency_hz > 0.0)) {
    throw Error(name, fmt::format("has a frequency of {} Hz", tracing.frequency_hz), "give a positive one");
  }
  return tracing;
}

std::vector<radar::ShadowBox> boxes_of(const live::Pose& pose) {
  std::vector<radar::ShadowBox> boxes;
  for (const radar::Target& target : pose.targets) {
    if (const auto box = radar::ShadowBox::of(target, pose.moment.time_s)) boxes.push_back(*box);
  }
  return boxes;
}

}  // namespace

LiveTracer::LiveTracer(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                       const live::LiveSettings& settings, const LiveTraceSettings& tracing)
    : scene_(scene),
      geometry_(geometry),
      settings_(checked(settings)),
      tracing_(checked(tracing, geometry)),
      surfaces_(trace::surface_models(scene, tracing.frequency_hz)),
      lattice_({.seed = settings.seed, .cell_m = tracing.lattice_m, .levels = 1}),
      targets_({.frequency_hz = tracing.frequency_hz,
                .beams = settings.beams,
                .ranges = settings.ranges,
                .beam_step_rad = settings.beam_step_rad,
                .range_step_m = settings.range_step_m}),
      lowest_m_(static_cast<double>(scene.terrain.lowest_m())),
      highest_m_(static_cast<double>(scene.terrain.highest_m())),
      tallest_m_(scene::tallest_object_m(scene)),
      occupied_(scene::occupied_extent(scene)),
      triangles_per_m2_(scene::triangles_per_m2(scene)),
      drawn_(settings.beams),
      bins_(settings) {
  frame_.frequency_hz = tracing_.frequency_hz;
  frame_.earth = {.refraction = settings_.refraction};
  frame_.beams = drawn_.all();
  bins_.show_in(frame_);
}

LiveTracer::~LiveTracer() = default;

bool LiveTracer::can_trace(const live::Pose& pose) const {
  live::check(pose, name);
  const Look look = look_of(pose);
  if (is_empty(look.ground)) return true;
  const radar::Rectangle traced = ground_traced(look, pose, {0, settings_.beams});
  return stands_above(look.radar.z, geometry_.highest_m()) && cells_in(traced, look) <= tracing_.most_cells &&
         cells_aimed_at(traced, look) <= most_aimed_per_traced * tracing_.most_cells;
}

const live::Frame& LiveTracer::render(const live::Pose& pose) {
  return scan(pose, 0, settings_.beams);
}

const live::Frame& LiveTracer::scan(const live::Pose& pose, std::size_t first_beam, std::size_t count) {
  live::check(pose, name);
  live::check_step(first_beam, count, settings_.beams);
  const Beams beams{first_beam, std::min(count, settings_.beams - first_beam)};
  std::vector<radar::ShadowBox> boxes = boxes_of(pose);
  const bool goes_on = position_ == pose.position && grid_ == live::bins_of(settings_, pose) && boxes_ == boxes;
  // Of a call that is broken off nothing can be gone on with.
  position_.reset();
  if (!goes_on) begin(pose);
  TracedGround* const ground = ground_of(pose, beams);
  if (ground != nullptr)
    ground->add_passes((tracing_.rays_per_cell - 1) / rays_a_pass + 1, pose.targets, pose.moment.time_s);
  position_ = pose.position;
  boxes_ = std::move(boxes);
  drawn_.begin(beams.first, beams.count);
  frame_.grid = grid_;
  frame_.report = {};
  bins_.clear(beams.first, beams.count);
  if (ground != nullptr) show_ground(pose, *ground);
  add_targets(pose, beams);
  frame_.drawing = drawn_.end(pose.position, pose.velocity_mps);
  return frame_;
}

void LiveTracer::begin(const live::Pose& pose) {
  steps_.clear();
  grid_ = live::bins_of(settings_, pose);
  look_ = look_of(pose);
  lattice_level_ = lattice_level(look_);
  if (is_empty(look_.ground)) return;
  const radar::Rectangle traced = ground_traced(look_, pose, {0, settings_.beams});
  if (const double cells = cells_in(traced, look_); cells > tracing_.most_cells) {
    throw Error(name, fmt::format("is to trace {:.2g} cells of {:.3g} m", cells, lattice_cell_m(look_)),
                fmt::format("look at less ground or take wider bins, for at most {:.2g}; a wide area is for "
                            "live::LiveRenderer",
                            tracing_.most_cells));
  }
  if (!stands_above(look_.radar.z, geometry_.highest_m())) return;  // which is told where rays are to start
  if (const double cells = cells_aimed_at(traced, look_); cells > most_aimed_per_traced * tracing_.most_cells) {
    throw Error(
        name,
        fmt::format("is to aim rays at {:.2g} cells of {:.3g} m from {:.3g} m above the highest point of the "
                    "scene: they come down far behind the ground that the bins look at",
                    cells, lattice_cell_m(look_), look_.radar.z - geometry_.highest_m()),
        fmt::format("fly higher, look at less ground or take wider bins, for at most {:.2g}; so low a flight is "
                    "for live::LiveRenderer",
                    most_aimed_per_traced * tracing_.most_cells));
  }
}

TracedGround* LiveTracer::ground_of(const live::Pose& pose, Beams beams) {
  if (beams.count == 0 || is_empty(look_.ground)) return nullptr;
  if (const auto same = std::ranges::find(steps_, beams, &Step::beams); same != steps_.end()) return same->ground.get();
  std::erase_if(steps_, [&](const Step& step) { return step.beams.overlap(beams); });
  std::unique_ptr<TracedGround> ground = made_ground(pose, beams);
  const double cells = ground != nullptr ? cells_in(ground->view().area, look_) : 0.0;
  TracedGround* const made = steps_.emplace_back(Step{beams, std::move(ground), cells}).ground.get();
  const auto sum = [this] {
    return std::accumulate(steps_.begin(), steps_.end(), 0.0,
                           [](double cells_so_far, const Step& step) { return cells_so_far + step.cells; });
  };
  while (steps_.size() > 1 && sum() > tracing_.most_cells) steps_.erase(steps_.begin());
  return made;
}

std::unique_ptr<TracedGround> LiveTracer::made_ground(const live::Pose& pose, Beams beams) const {
  const radar::Rectangle area = ground_traced(look_, pose, beams);
  if (is_empty(area)) return nullptr;
  return std::make_unique<TracedGround>(TracedView{.scene = scene_,
                                                   .geometry = geometry_,
                                                   .surfaces = surfaces_,
                                                   .radar = look_.radar,
                                                   .bins = grid_,
                                                   .first_beam = beams.first,
                                                   .beams = beams.count,
                                                   .rim_beams = rim_beams(look_, pose),
                                                   .area = area,
                                                   .cell_m = lattice_cell_m(look_),
                                                   .max_bounces = tracing_.max_bounces,
                                                   .seed = settings_.seed,
                                                   .threads = settings_.threads,
                                                   .with_cells = keeps_cells()});
}

LiveTracer::Look LiveTracer::look_of(const live::Pose& pose) const {
  const Look straight_on = look_from(pose.position, pose);
  if (is_empty(straight_on.ground)) return straight_on;
  const radar::CurvedEarth earth{.refraction = settings_.refraction};
  return look_from(earth.bent(pose.position, straight_on.ground.centre()), pose);
}

LiveTracer::Look LiveTracer::look_from(Vec3d radar, const live::Pose& pose) const {
  live::Pose from = pose;
  from.position = radar;
  const double middle_m = 0.5 * (lowest_m_ + highest_m_);
  constexpr auto straight = radar::CurvedEarth::flat();
  const auto [near_m, far_m] = live::frame_reach(settings_, from, lowest_m_, highest_m_, straight);
  Look look{.radar = radar,
            .near_m = near_m,
            .far_m = far_m,
            .sharing = live::sharing_reach(settings_, from, lowest_m_, highest_m_, highest_m_, straight),
            .halfway_up = live::frame_reach(settings_, from, middle_m, middle_m, straight),
            .ground = {}};
  look.ground = ground_under(look, pose, {0, settings_.beams}, half_a_beam);
  return look;
}

radar::Rectangle LiveTracer::ground_under(const Look& look, const live::Pose& pose, Beams beams,
                                          double rim_beams) const {
  const auto first = static_cast<double>(beams.first), count = static_cast<double>(beams.count);
  // The Earth is flat here, with the radar where that is right in the middle.
  const double rim_m = 0.5 * settings_.range_step_m;
  const radar::Rectangle under_bins = live::ground_under(
      {look.radar.x, look.radar.y}, pose.first_azimuth_rad + (first - rim_beams) * settings_.beam_step_rad,
      std::min((count + 2.0 * rim_beams) * settings_.beam_step_rad, 2.0 * pi),
      {std::max(look.sharing.near_m - rim_m, 0.0), look.sharing.far_m + rim_m});
  return radar::common_part(under_bins, scene_.extent);
}

radar::Rectangle LiveTracer::ground_traced(const Look& look, const live::Pose& pose, Beams beams) const {
  return ground_under(look, pose, beams, rim_beams(look, pose));
}

bool LiveTracer::keeps_cells() const {
  return settings_.content == live::FrameContent::Amplitudes;
}

double LiveTracer::rim_beams(const Look& look, const live::Pose& pose) const {
  return half_a_beam + (keeps_cells() ? widest_cell_beams(look, pose) : 0.0);
}

double LiveTracer::lattice_cell_m(const Look& look) const {
  return lattice_.cell_m(lattice_level(look));
}

double LiveTracer::cells_in(const radar::Rectangle& area, const Look& look) const {
  const double cell_m = lattice_cell_m(look);
  return area.width_m() * area.height_m() / (cell_m * cell_m);
}

double LiveTracer::cells_aimed_at(const radar::Rectangle& area, const Look& look) const {
  const auto viewpoint = trace::Viewpoint::located(look.radar);
  const double late_m = trace::late_by_m(tallest_m_, viewpoint, area, scene_.terrain);
  return aimed_cells(scene_, geometry_, viewpoint, area, lattice_cell_m(look), trace::reach_of_late(late_m, occupied_),
                     most_aimed_per_traced * tracing_.most_cells);
}

double LiveTracer::widest_cell_beams(const Look& look, const live::Pose& pose) const {
  const double nearest_m = radar::distance_of_range_m(radar::CurvedEarth::flat(), look.radar.z, lowest_m_,
                                                      std::max(pose.first_range_m - 0.5 * settings_.range_step_m, 0.0));
  const double widest = std::numbers::sqrt2 * lattice_cell_m(look) / (nearest_m * settings_.beam_step_rad);
  // Below the radar a cell lies in all of them.
  return std::min(widest, static_cast<double>(settings_.beams));
}

int LiveTracer::lattice_level(const Look& look) const {
  const render::DetailQuestion bins = live::question_of_bins(settings_, look.halfway_up);
  const double sample_m = std::min(bins.range_resolution_m, bins.cross_range_m) / bins.samples_per_cell;
  // All scatterers change with the level, so that a finer one, of four times the cells, waits until it is right by a
  // quarter of a level.
  constexpr double sticks = 0.25;
  const double wanted = std::log2(sample_m / tracing_.lattice_m);
  const bool stays = lattice_level_ && wanted >= *lattice_level_ - sticks && wanted < *lattice_level_ + 1.0;
  return stays ? *lattice_level_
               : static_cast<int>(std::clamp(std::floor(wanted), 0.0, static_cast<double>(coarsest_lattice_level)));
}

render::DetailQuestion LiveTracer::question(const live::Pose& pose) const {
  live::check(pose, name);
  const Look look = look_of(pose);
  render::DetailQuestion question = live::question_of_bins(settings_, look.halfway_up);
  const double middle_m = 0.5 * (look.halfway_up.near_m + look.halfway_up.far_m);
  question.grazing_rad = std::atan2(look.radar.z - 0.5 * (lowest_m_ + highest_m_), middle_m);
  question.range_resolution_m *= std::cos(question.grazing_rad);
  question.tallest_object_m = tallest_m_;
  const double sector_m2 = 0.5 * (look.far_m * look.far_m - look.near_m * look.near_m) *
                           static_cast<double>(settings_.beams) * settings_.beam_step_rad;
  const radar::Rectangle& area = look.ground;
  question.area_m2 = is_empty(area) ? 0.0 : std::min(sector_m2, area.width_m() * area.height_m());
  question.terrain_spacing_m = scene_.terrain.spacing_m;
  question.triangles_per_m2 = triangles_per_m2_;
  return question;
}

void LiveTracer::show_ground(const live::Pose& pose, const TracedGround& ground) {
  const FramePasses& sums = ground.bins();
  frame_.report.cells = ground.squares();
  frame_.report.lit = ground.answering();
  frame_.report.rays_per_cell = sums.passes() * rays_a_pass;
  frame_.report.median_error_db = sums.median_error_db();
  if (keeps_cells()) {
    add_scatterers(ground,
                   {.lattice = lattice_,
                    .level = lattice_level(look_),
                    .radar = pose.position,
                    .earth = {.refraction = settings_.refraction},
                    .frequency_hz = tracing_.frequency_hz},
                   bins_.amplitudes());
    return;
  }
  const std::size_t first = ground.view().first_beam * settings_.ranges;
  for (std::size_t bin = 0; bin < ground.view().beams * settings_.ranges; ++bin) {
    const radar::Channels rcs_m2 = sums.mean(bin);
    std::ranges::copy(std::array{rcs_m2.vv, rcs_m2.hh, rcs_m2.hv, rcs_m2.re_vvhh},
                      bins_.numbers().subspan(4 * (first + bin), 4).begin());
  }
}

void LiveTracer::add_targets(const live::Pose& pose, Beams beams) {
  live::TargetCount count(settings_, beams.first, beams.count);
  targets_.look(pose.targets,
                {.position = pose.position,
                 .first_azimuth_rad = pose.first_azimuth_rad,
                 .first_range_m = pose.first_range_m,
                 .earth = {.refraction = settings_.refraction}},
                pose.moment, [&](const receiver::TargetFrame::Seen& target) {
                  const double part = part_seen(geometry_, surfaces_, look_.radar, target.position);
                  return count.counted(target.beam, static_cast<float>(part));
                });
  frame_.report.targets = count.seen_of(targets_.seen());
  targets_.tell_apart(beams.first, beams.count);
  frame_.targets = targets_.apart();
  bins_.add(targets_, beams.first, beams.count);
}

}  // namespace sigmascape::simulate
