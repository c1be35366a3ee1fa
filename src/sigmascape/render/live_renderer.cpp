#include "sigmascape/render/live_renderer.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/render/page_forecast.h"
#include "sigmascape/render/sector.h"
#include "sigmascape/render/sector_task.h"

namespace sigmascape::render {
namespace {

const LiveSettings& checked(const LiveSettings& settings) {
  const std::string where = "live renderer";
  constexpr std::size_t most_bins = 1U << 26U;
  if (settings.beams == 0 || settings.ranges == 0 || settings.beams * settings.ranges > most_bins) {
    throw Error(where, fmt::format("has {} beams of {} ranges", settings.beams, settings.ranges),
                fmt::format("give at least one of each and no more than {} bins", most_bins));
  }
  if (!(settings.beam_step_rad > 0.0 && static_cast<double>(settings.beams) * settings.beam_step_rad <= 2.0 * pi)) {
    throw Error(where, fmt::format("has beams {} rad apart", settings.beam_step_rad),
                "give a positive step; all beams together go round once at most");
  }
  if (!(settings.range_step_m > 0.0)) {
    throw Error(where, fmt::format("has ranges {} m apart", settings.range_step_m), "give a positive step");
  }
  if (!(settings.cells_per_bin >= 0.25 && settings.cells_per_bin <= 64.0)) {
    throw Error(where, fmt::format("has {} lattice cells a bin", settings.cells_per_bin), "give 0.25 to 64");
  }
  if (!(settings.refraction > 0.0)) {
    throw Error(where, fmt::format("has a refraction of {}", settings.refraction),
                "give 4/3, or more for a flatter Earth");
  }
  return settings;
}

/// How far ahead pages are asked for, and how many steps of a scan that is.
constexpr double seconds_ahead = 1.0;
constexpr std::size_t steps_ahead = 60;

/// Distance over the ground to something at `below_m` under the radar whose slant range is known.
double ground_distance(double range_m, double below_m) {
  return std::sqrt(std::max(range_m * range_m - below_m * below_m, 0.0));
}

}  // namespace

LiveRenderer::LiveRenderer(std::shared_ptr<LiveGround> ground, const LiveSettings& settings)
    : ground_(std::move(ground)),
      settings_(checked(settings)),
      lattice_({.seed = settings.seed, .cell_m = ground_->description().patches.texel_m, .levels = 1}),
      team_(settings.threads),
      horizon_(HorizonGrid{}, team_.size()) {
  bins_.resize(settings.beams * settings.ranges * numbers_a_bin(settings.content));
  for (unsigned worker = 0; worker < team_.size(); ++worker)
    tasks_.push_back(std::make_unique<SectorTask>(FrameParts{*ground_, settings_, lattice_, horizon_, bins_}));
  // The tasks' and, after them, what lies ahead.
  wanted_.reserve(PageRows::most_wanted * (team_.size() + 1));
}

LiveRenderer::~LiveRenderer() = default;

const Frame& LiveRenderer::render(const Pose& pose) {
  return scan(pose, 0, settings_.beams);
}

const Frame& LiveRenderer::scan(const Pose& pose, std::size_t first_beam, std::size_t count) {
  prepare(pose);
  const std::size_t last_beam = std::min(first_beam + count, settings_.beams);
  const PageCache::View view = ground_->pages().view();
  for (const auto& task : tasks_) task->begin_frame(view);

  // Tasks look half a beam beyond their own.
  const std::size_t first_edge = first_beam - std::min<std::size_t>(first_beam, 1);
  const std::size_t last_edge = std::min(last_beam + 1, settings_.beams);
  const Occluders occluders = occluders_for(horizon_.grid());
  team_.run(last_edge - first_edge + 1, [&](std::size_t index, unsigned worker) {
    horizon_.sweep(first_edge + index, pose.position, occluders, worker);
  });
  const DetailBlend levels = next_levels();
  const std::size_t group = beams_together(settings_.beam_step_rad), first_group = first_beam / group;
  const std::size_t tasks = last_beam > first_beam ? (last_beam - 1) / group + 1 - first_group : 0;
  team_.run(tasks, [&](std::size_t index, unsigned worker) {
    const std::size_t first = std::max(first_beam, (first_group + index) * group);
    const std::size_t end = std::min(last_beam, (first_group + index + 1) * group);
    tasks_[worker]->fill(pose, {first, end - first}, levels);
  });

  frame_.report = {.level = static_cast<std::size_t>((levels.next_share > 0.5 ? levels.next : levels.level) - 1)};
  wanted_.clear();
  for (const auto& task : tasks_) {
    frame_.report.cells += task->report().cells;
    frame_.report.lit += task->report().lit;
    frame_.report.coarse += task->report().coarse;
    frame_.report.dark += task->report().dark;
    const std::size_t room = wanted_.capacity() - wanted_.size();
    const auto wanted = task->wanted().first(std::min(task->wanted().size(), room));
    wanted_.insert(wanted_.end(), wanted.begin(), wanted.end());
    task->end_frame();
  }
  look_ahead(view, pose, {first_beam, last_beam}, static_cast<std::size_t>(levels.next - 1));
  if (!wanted_.empty()) ground_->pages().request(wanted_);
  return frame_;
}

void LiveRenderer::prepare(const Pose& pose) {
  const double far_range_m = pose.first_range_m + static_cast<double>(settings_.ranges) * settings_.range_step_m;
  const double highest_below = pose.position.z - ground_->highest_m(),
               lowest_below = pose.position.z - ground_->lowest_m();
  const double near_m = ground_distance(pose.first_range_m, lowest_below);
  const double far_m = ground_distance(far_range_m, std::max(highest_below, 0.0));
  HorizonGrid grid;
  grid.first_azimuth_rad = pose.first_azimuth_rad;
  grid.azimuth_step_rad = settings_.beam_step_rad;
  grid.azimuths = settings_.beams + 1;
  grid.near_m = near_m;
  grid.distances = 2 * settings_.ranges;
  grid.step_m = (far_m - near_m) / static_cast<double>(grid.distances);
  grid.drop_per_square_m = 0.5 * radar::CurvedEarth{.refraction = settings_.refraction}.curvature_per_m();
  horizon_.reset(grid, !ground_->obstacles().empty());

  frame_.grid = {pose.first_range_m,     settings_.range_step_m,  settings_.ranges,
                 pose.first_azimuth_rad, settings_.beam_step_rad, settings_.beams};
  if (settings_.content == FrameContent::Amplitudes) {
    frame_.amplitudes_m = {reinterpret_cast<const std::complex<float>*>(bins_.data()), bins_.size() / 2};
  } else {
    frame_.powers_m2 = bins_;
  }
}

Occluders LiveRenderer::occluders_for(const HorizonGrid& grid) const {
  const ObstacleLevels& obstacles = ground_->obstacles();
  const terrain::HeightField& field = ground_->terrain();
  return {.terrain = {.west_m = field.west_m,
                      .north_m = field.north_m,
                      .spacing_m = field.spacing_m,
                      .columns = field.height_m.columns(),
                      .rows = field.height_m.rows(),
                      .height_m = field.height_m.values(),
                      .lowest_m = ground_->lowest_m(),
                      .highest_m = ground_->highest_m()},
          .obstacles = obstacles.empty() ? nullptr : &obstacles.level_for(grid.step_m),
          .tallest_m = obstacles.tallest_m()};
}

void LiveRenderer::look_ahead(const PageCache::View& view, const Pose& pose, Beams beams, std::size_t level) {
  const std::size_t count = beams.end - beams.first;
  if (count == 0) return;
  const bool scans = count < settings_.beams;
  const std::size_t group = beams_together(settings_.beam_step_rad);
  // A scan goes on at the pace of this step; a whole frame looks at all beams again.
  const std::size_t first = scans ? beams.end : beams.first;
  const std::size_t ahead = scans ? std::min(count * steps_ahead, settings_.beams) : count;
  const HorizonGrid& grid = horizon_.grid();
  const Vec3d radar = pose.position + pose.velocity_mps * seconds_ahead;
  const double ground_m = 0.5 * static_cast<double>(ground_->lowest_m() + ground_->highest_m());
  for (std::size_t done = 0; done < ahead; done += group) {
    const std::size_t here = std::min(group, ahead - done);
    const double azimuth =
        pose.first_azimuth_rad + static_cast<double>((first + done) % settings_.beams) * settings_.beam_step_rad;
    const Sector sector(azimuth, static_cast<double>(here) * settings_.beam_step_rad, grid.near_m,
                        grid.near_m + grid.step_m * static_cast<double>(grid.distances));
    add_forecast(view, ground_->pages().source(), {radar, sector, level, ground_m}, wanted_);
  }
}

DetailBlend LiveRenderer::next_levels() {
  const HorizonGrid& grid = horizon_.grid();
  const double reach_m = grid.step_m * static_cast<double>(grid.distances), middle_m = grid.near_m + reach_m / 2.0;
  DetailQuestion question;
  // Bins lie along the slant range; what they are on the ground follows from where they begin and end.
  question.range_resolution_m = reach_m / static_cast<double>(settings_.ranges);
  question.grazing_rad = 0.0;
  question.cross_range_m = middle_m * settings_.beam_step_rad;
  question.samples_per_cell = settings_.cells_per_bin;
  question.texel_m = ground_->description().patches.texel_m;
  question.mips = static_cast<int>(ground_->coarsest_level()) + 1;
  // Live frames come from the atlas however small they are.
  question.tallest_object_m = 0.0;
  question.area_m2 = std::numeric_limits<double>::infinity();
  const DetailChoice choice = choose_detail(question);
  // To blend over a leap would mean to draw a wide view in fine texels.
  if (std::abs(choice.level - last_level_) > 1) transition_ = DetailTransition();
  const DetailBlend blend = transition_.advance(choice);
  last_level_ = blend.next;
  return blend;
}

}  // namespace sigmascape::render
