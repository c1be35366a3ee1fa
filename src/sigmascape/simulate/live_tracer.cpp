#include "sigmascape/simulate/live_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/render/frame_reach.h"
#include "sigmascape/render/level_of_detail.h"
#include "sigmascape/scene/mesh_counts.h"
#include "sigmascape/simulate/launch_for_map.h"
#include "sigmascape/simulate/target_sight.h"
#include "sigmascape/simulate/traced_ground.h"
#include "sigmascape/simulate/traced_scatterers.h"
#include "sigmascape/trace/late_by.h"

namespace sigmascape::simulate {
namespace {

constexpr const char* name = "live tracer";
/// Of ground in a frame: with what is kept of each, close to a gigabyte.
constexpr double most_cells = 0x1p24;
constexpr int coarsest_lattice_level = 23;

const render::LiveSettings& checked(const render::LiveSettings& settings) {
  render::check(settings, name);
  return settings;
}

const LiveTraceSettings& checked(const LiveTraceSettings& tracing, const trace::SceneGeometry& geometry) {
  if (geometry.footing() != trace::Footing::Terrain) {
    throw Error(name, "is to trace objects on a level plane, as bakes do", "make the geometry with Footing::Terrain");
  }
  if (tracing.rays_per_cell == 0 || tracing.max_bounces < 1) {
    throw Error(name, fmt::format("has {} rays a cell and {} bounces", tracing.rays_per_cell, tracing.max_bounces),
                "give at least one of each");
  }
  if (!(tracing.frequency_hz > 0.0)) {
    throw Error(name, fmt::format("has a frequency of {} Hz", tracing.frequency_hz), "give a positive one");
  }
  return tracing;
}

std::vector<radar::ShadowBox> boxes_of(const render::Pose& pose) {
  std::vector<radar::ShadowBox> boxes;
  for (const radar::Target& target : pose.targets) {
    if (const auto box = radar::ShadowBox::of(target, pose.moment.time_s)) boxes.push_back(*box);
  }
  return boxes;
}

radar::RangeAzimuthGrid grid_of(const render::LiveSettings& settings, const render::Pose& pose) {
  return {pose.first_range_m,     settings.range_step_m,  settings.ranges,
          pose.first_azimuth_rad, settings.beam_step_rad, settings.beams};
}

}  // namespace

LiveTracer::LiveTracer(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                       const render::LiveSettings& settings, const LiveTraceSettings& tracing)
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
      triangles_per_m2_(scene::triangles_per_m2(scene)),
      bins_(settings.beams * settings.ranges * render::numbers_a_bin(settings.content)) {}

LiveTracer::~LiveTracer() = default;

const render::Frame& LiveTracer::render(const render::Pose& pose) {
  render::check(pose, name);
  std::vector<radar::ShadowBox> boxes = boxes_of(pose);
  const bool goes_on = position_ == pose.position && frame_.grid == grid_of(settings_, pose) && boxes_ == boxes;
  // Of a call that is broken off nothing can be gone on with.
  position_.reset();
  if (!goes_on) begin(pose);
  if (ground_) {
    ground_->add_passes((tracing_.rays_per_cell - 1) / rays_a_pass + 1, pose.targets, pose.moment.time_s);
  }
  position_ = pose.position;
  boxes_ = std::move(boxes);
  std::ranges::fill(bins_, 0.0F);
  if (ground_) show_ground(pose);
  add_targets(pose);
  return frame_;
}

void LiveTracer::begin(const render::Pose& pose) {
  ground_.reset();
  frame_.grid = grid_of(settings_, pose);
  frame_.report = {};
  if (settings_.content == render::FrameContent::Amplitudes) {
    frame_.amplitudes_m = {reinterpret_cast<const std::complex<float>*>(bins_.data()), bins_.size() / 2};
  } else {
    frame_.powers_m2 = bins_;
  }
  look_ = look_of(pose);
  if (look_.sees_nothing()) return;
  const double cell_m = lattice_.cell_m(lattice_level(look_));
  if (const double cells = look_.area.width_m() * look_.area.height_m() / (cell_m * cell_m); cells > most_cells) {
    throw Error(name, fmt::format("is to trace {:.2g} cells of {:.3g} m", cells, cell_m),
                fmt::format("look at less ground or take wider bins, for at most {:.2g}; a wide area is for "
                            "render::LiveRenderer",
                            most_cells));
  }
  ground_ =
      std::make_unique<TracedGround>(TracedView{.scene = scene_,
                                                .geometry = geometry_,
                                                .surfaces = surfaces_,
                                                .radar = look_.radar,
                                                .bins = frame_.grid,
                                                .area = look_.area,
                                                .landing = look_.landing,
                                                .cell_m = cell_m,
                                                .max_bounces = tracing_.max_bounces,
                                                .seed = settings_.seed,
                                                .threads = settings_.threads,
                                                .with_cells = settings_.content == render::FrameContent::Amplitudes});
}

LiveTracer::Look LiveTracer::look_of(const render::Pose& pose) const {
  const double width_rad = static_cast<double>(settings_.beams) * settings_.beam_step_rad;
  const auto look_from = [&](Vec3d position) {
    render::Pose from = pose;
    from.position = position;
    const auto [near_m, far_m] =
        render::frame_reach(settings_, from, lowest_m_, highest_m_, radar::CurvedEarth::flat());
    // Echoes are shared with bins half a bin away.
    const double rim_m = settings_.range_step_m;
    const radar::Rectangle under_bins = render::ground_under(
        {position.x, position.y}, pose.first_azimuth_rad - 0.5 * settings_.beam_step_rad,
        std::min(width_rad + settings_.beam_step_rad, 2.0 * pi), {std::max(near_m - rim_m, 0.0), far_m + rim_m});
    const double layover_m =
        (geometry_.highest_m() - lowest_m_) * std::max(position.z - lowest_m_, 0.0) / std::max(near_m, rim_m);
    const radar::Rectangle area = radar::common_part(under_bins, scene_.extent);
    const double late_m = trace::late_by_m(tallest_m_, trace::Viewpoint::located(position), area);
    return Look{.radar = position,
                .area = area,
                .landing = radar::common_part(under_bins, radar::widened(scene_.extent, late_m + layover_m)),
                .near_m = near_m,
                .far_m = far_m};
  };
  const Look straight_on = look_from(pose.position);
  if (straight_on.sees_nothing()) return straight_on;
  return look_from(
      radar::CurvedEarth{.refraction = settings_.refraction}.bent(pose.position, straight_on.area.centre()));
}

int LiveTracer::lattice_level(const Look& look) const {
  const render::DetailQuestion bins = render::question_of_bins(settings_, look.near_m, look.far_m - look.near_m);
  const double sample_m = std::min(bins.range_resolution_m, bins.cross_range_m) / bins.samples_per_cell;
  return static_cast<int>(std::clamp(std::floor(std::log2(sample_m / tracing_.lattice_m)), 0.0,
                                     static_cast<double>(coarsest_lattice_level)));
}

render::DetailQuestion LiveTracer::question(const render::Pose& pose) const {
  render::check(pose, name);
  const Look look = look_of(pose);
  render::DetailQuestion question = render::question_of_bins(settings_, look.near_m, look.far_m - look.near_m);
  const double middle_m = 0.5 * (look.near_m + look.far_m);
  question.grazing_rad = std::atan2(look.radar.z - 0.5 * (lowest_m_ + highest_m_), middle_m);
  question.range_resolution_m *= std::cos(question.grazing_rad);
  question.tallest_object_m = tallest_m_;
  const double sector_m2 = 0.5 * (look.far_m * look.far_m - look.near_m * look.near_m) *
                           static_cast<double>(settings_.beams) * settings_.beam_step_rad;
  question.area_m2 = look.sees_nothing() ? 0.0 : std::min(sector_m2, look.area.width_m() * look.area.height_m());
  question.terrain_spacing_m = scene_.terrain.spacing_m;
  question.triangles_per_m2 = triangles_per_m2_;
  return question;
}

void LiveTracer::show_ground(const render::Pose& pose) {
  const FramePasses& sums = ground_->bins();
  frame_.report.cells = ground_->squares();
  frame_.report.lit = ground_->answering();
  frame_.report.rays_per_cell = sums.passes() * rays_a_pass;
  frame_.report.median_error_db = sums.median_error_db();
  if (settings_.content == render::FrameContent::Amplitudes) {
    add_scatterers(*ground_,
                   {.lattice = lattice_,
                    .level = lattice_level(look_),
                    .radar = pose.position,
                    .earth = {.refraction = settings_.refraction},
                    .frequency_hz = tracing_.frequency_hz},
                   {reinterpret_cast<std::complex<float>*>(bins_.data()), bins_.size() / 2});
    return;
  }
  for (std::size_t bin = 0; bin < settings_.beams * settings_.ranges; ++bin) {
    const radar::Channels rcs_m2 = sums.mean(bin);
    std::ranges::copy(std::array{rcs_m2.vv, rcs_m2.hh, rcs_m2.hv, rcs_m2.re_vvhh},
                      bins_.begin() + static_cast<std::ptrdiff_t>(4 * bin));
  }
}

void LiveTracer::add_targets(const render::Pose& pose) {
  targets_.look(pose.targets,
                {.position = pose.position,
                 .first_azimuth_rad = pose.first_azimuth_rad,
                 .first_range_m = pose.first_range_m,
                 .earth = {.refraction = settings_.refraction}},
                pose.moment, [&](const receiver::TargetFrame::Seen& target) {
                  return static_cast<float>(part_seen(geometry_, surfaces_, look_.radar, target.position));
                });
  frame_.report.targets = targets_.seen();
  if (settings_.content == render::FrameContent::Powers) {
    targets_.add_powers(0, settings_.beams, bins_);
  } else {
    targets_.add_amplitudes(0, settings_.beams,
                            {reinterpret_cast<std::complex<float>*>(bins_.data()), bins_.size() / 2});
  }
}

}  // namespace sigmascape::simulate
