#include "sigmascape/live/live_renderer.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/live/detail_of_ground.h"
#include "sigmascape/live/frame_reach.h"
#include "sigmascape/live/horizon_lead.h"
#include "sigmascape/live/page_forecast.h"
#include "sigmascape/live/row_widths.h"
#include "sigmascape/live/sector.h"
#include "sigmascape/live/sector_task.h"
#include "sigmascape/live/target_count.h"
#include "sigmascape/live/target_sight.h"
#include "sigmascape/radar/curved_earth.h"

namespace sigmascape::live {
namespace {

const LiveSettings& checked(const LiveSettings& settings) {
  check(settings, "live renderer");
  return settings;
}

/// How far ahead pages are asked for, and how many steps of a scan that is.
constexpr double seconds_ahead = 1.0;
constexpr std::size_t steps_ahead = 60;

/// Pieces of terrain that a frame may wish for: nearer ground and that in view, of two levels, and what lies ahead.
constexpr std::size_t most_wanted_terrain = 5 * TerrainSectors::most;

/// How far back a sweep begins follows from these, and with that where obstacles before the bins are laid out: for all
/// sectors at once.
void make_bounds_alike(std::span<Occluders> sectors) {
  Occluders widest = sectors.front();
  for (const Occluders& sector : sectors) {
    widest.lowered_m = std::max(widest.lowered_m, sector.lowered_m);
    for (const auto view : {&Occluders::terrain, &Occluders::before_near}) {
      (widest.*view).lowest_m = std::min((widest.*view).lowest_m, (sector.*view).lowest_m);
      (widest.*view).highest_m = std::max((widest.*view).highest_m, (sector.*view).highest_m);
    }
  }
  for (Occluders& sector : sectors) {
    sector.lowered_m = widest.lowered_m;
    for (const auto view : {&Occluders::terrain, &Occluders::before_near}) {
      (sector.*view).lowest_m = (widest.*view).lowest_m;
      (sector.*view).highest_m = (widest.*view).highest_m;
    }
  }
}

/// Of terrain that is summed up tile by tile, so that nothing is read for it.
void check_above_ground(const terrain::TerrainPyramid& terrain, Vec3d radar) {
  const Vec2d foot{radar.x, radar.y};
  if (!terrain.extent().contains(foot)) return;
  const float lowest_m = terrain.bounds_over({foot.x, foot.y, foot.x, foot.y}).lowest_m;
  if (radar.z < static_cast<double>(lowest_m)) {
    throw Error("live renderer",
                fmt::format("stands at {:g} m, below all ground there, which begins at {:g} m", radar.z, lowest_m),
                "fly higher");
  }
}

/// By how much a radar beyond the terrain lies below any ground that may be there; 0 of one that is over it.
double depth_beyond(const terrain::TerrainPyramid& terrain, Vec3d radar) {
  const radar::Rectangle& extent = terrain.extent();
  if (extent.contains({radar.x, radar.y})) return 0.0;
  constexpr double sea_m = 0.0;
  return std::max(std::min(static_cast<double>(terrain.bounds_over(extent).lowest_m), sea_m) - radar.z, 0.0);
}

}  // namespace

LiveRenderer::LiveRenderer(std::shared_ptr<LiveGround> ground, const LiveSettings& settings)
    : ground_(std::move(ground)),
      settings_(checked(settings)),
      lattice_({.seed = settings.seed, .cell_m = ground_->description().patches.texel_m, .levels = 1}),
      team_(settings.threads),
      visible_{VisibleGround(settings.visibility, team_.size()), VisibleGround(settings.visibility, team_.size())},
      sectors_(settings.visibility.method == VisibilityMethod::Rasterization
                   ? TerrainSectors::undivided(settings.beams)
                   : TerrainSectors(settings.beams, settings.beam_step_rad, beams_together(settings.beam_step_rad))),
      horizon_of_{&visible_[0].horizon(), &visible_[0].horizon()},
      occluders_of_{occluders_[0], occluders_[0]},
      targets_({.frequency_hz = ground_->frequency_hz(),
                .beams = settings.beams,
                .ranges = settings.ranges,
                .beam_step_rad = settings.beam_step_rad,
                .range_step_m = settings.range_step_m}),
      beams_(settings.beams),
      bins_(settings) {
  if (settings.visibility.method == VisibilityMethod::Rasterization && ground_->obstacles() != nullptr) {
    throw Error("live renderer", "is to draw terrain, but the atlas keeps apart what stands on it",
                "take the horizon sweep, which knows obstacles, or bake with --shadows baked");
  }
  frame_.frequency_hz = ground_->frequency_hz();
  frame_.earth = {.refraction = settings.refraction};
  frame_.beams = beams_.all();
  bins_.show_in(frame_);
  for (unsigned worker = 0; worker < team_.size(); ++worker)
    tasks_.push_back(std::make_unique<SectorTask>(FrameParts{*ground_, settings_, lattice_, horizon_of_, occluders_of_,
                                                             sectors_, shadows_, bounds_, bins_.numbers()}));
  // The tasks' and, after them, what lies ahead.
  wanted_.reserve(PageRows::most_wanted * (team_.size() + 1));
  wanted_terrain_.reserve(most_wanted_terrain);
  pages_ = ground_->pages().asker(wanted_.capacity());
  terrain_ = ground_->terrain().windows().asker(wanted_terrain_.capacity());
  if (ground_->obstacles() != nullptr) {
    wanted_obstacles_.reserve(2 * ground_->obstacles()->cache().most_pages());
    obstacle_tiles_ = ground_->obstacles()->cache().asker(wanted_obstacles_.capacity());
  }
}

LiveRenderer::~LiveRenderer() = default;

void LiveRenderer::request() {
  // A list that was empty and stays so wakes nobody.
  if (!wanted_.empty() || has_asked_) pages_.request(wanted_);
  if (!wanted_terrain_.empty() || has_asked_) terrain_.request(wanted_terrain_);
  if (!wanted_obstacles_.empty() || (has_asked_ && ground_->obstacles() != nullptr)) {
    // What is coarser covers more ground and comes first.
    std::ranges::sort(wanted_obstacles_, std::greater());
    obstacle_tiles_.request(wanted_obstacles_);
  }
  has_asked_ = !wanted_.empty() || !wanted_terrain_.empty() || !wanted_obstacles_.empty();
}

double LiveRenderer::beams_a_cell(std::size_t level) const {
  const double cell_m = atlas::texel_side_m(ground_->description().patches, level);
  return std::max(width_from(halfway_up_.near_m, cell_m) / settings_.beam_step_rad, 1.0);
}

const Frame& LiveRenderer::render(const Pose& pose) {
  return scan(pose, 0, settings_.beams);
}

const Frame& LiveRenderer::scan(const Pose& pose, std::size_t first_beam, std::size_t count) {
  check(pose, "live renderer");
  check_step(first_beam, count, settings_.beams);
  prepare(pose);
  fill(pose, {first_beam, first_beam + std::min(count, settings_.beams - first_beam)});
  // Now that its views are gone: a page that is still looked at makes no room for one that is asked for.
  request();
  return frame_;
}

void LiveRenderer::fill(const Pose& pose, Beams beams) {
  LiveObstacles* const obstacles = ground_->obstacles();
  const FrameViews there{ground_->pages().view(), ground_->terrain().windows().view(),
                         obstacles != nullptr ? obstacles->cache().view() : LiveObstacles::Cache::View()};
  for (const auto& task : tasks_) task->begin_frame(there.pages, pose.targets.size());
  const render::DetailBlend levels = next_levels();
  const auto level = static_cast<std::size_t>((levels.next_share > 0.5 ? levels.next : levels.level) - 1);
  frame_.report = {.level = level,
                   .below_ground_m = depth_beyond(ground_->terrain().pyramid(), pose.position),
                   .beams_a_cell = beams_a_cell(level)};
  wanted_terrain_.clear();
  wanted_obstacles_.clear();
  find_visible_ground(there, pose, beams, levels);
  look_at_targets(pose, beams, levels);
  find_shadows_of_targets(pose);
  beams_.begin(beams.first, beams.end - beams.first);
  frame_.grid = bins_of(settings_, pose);
  targets_.tell_apart(beams.first, beams.end - beams.first);
  frame_.targets = targets_.apart();
  const std::size_t group = beams_together(settings_.beam_step_rad), first_group = beams.first / group;
  const std::size_t tasks = beams.end > beams.first ? (beams.end - 1) / group + 1 - first_group : 0;
  team_.run(tasks, [&](std::size_t index, unsigned worker) {
    const std::size_t first = std::max(beams.first, (first_group + index) * group);
    const std::size_t end = std::min(beams.end, (first_group + index + 1) * group);
    tasks_[worker]->fill(pose, {first, end - first}, levels);
    bins_.add(targets_, first, end - first);
  });
  frame_.drawing = beams_.end(pose.position, pose.velocity_mps);

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
  look_ahead(there, pose, beams, static_cast<std::size_t>(levels.next - 1));
}

void LiveRenderer::prepare(const Pose& pose) {
  check_above_ground(ground_->terrain().pyramid(), pose.position);
  const double far_range_m = pose.first_range_m + static_cast<double>(settings_.ranges) * settings_.range_step_m;
  const auto bounds_within = [&](double range_m) {
    return ground_->terrain().bounds_over(ground_under({pose.position.x, pose.position.y}, pose.first_azimuth_rad,
                                                       settings_.beam_step_rad * static_cast<double>(settings_.beams),
                                                       {0.0, range_m}));
  };
  bounds_ = bounds_within(far_range_m);
  const auto lowest_m = static_cast<double>(bounds_.lowest_m), highest_m = static_cast<double>(bounds_.highest_m);
  if (settings_.visibility.method == VisibilityMethod::Rasterization && !(pose.position.z > highest_m)) {
    throw Error(
        "live renderer",
        fmt::format("stands at {:g} m and is to draw terrain of up to {:g} m from above", pose.position.z, highest_m),
        "fly higher, or take the horizon sweep");
  }
  const radar::CurvedEarth& earth = frame_.earth;
  const double middle_m = 0.5 * (lowest_m + highest_m);
  halfway_up_ = frame_reach(settings_, pose, middle_m, middle_m, earth);
  const double highest_near_m =
      highest_m > pose.position.z ? static_cast<double>(bounds_within(pose.first_range_m).highest_m) : highest_m;
  const FrameReach reach = sharing_reach(settings_, pose, lowest_m, highest_m, highest_near_m, earth);
  const std::size_t a_beam = azimuths_a_beam(settings_, reach, ground_->terrain().pyramid().layout().spacing_m);
  HorizonGrid grid;
  grid.first_azimuth_rad = pose.first_azimuth_rad;
  grid.azimuth_step_rad = settings_.beam_step_rad / static_cast<double>(a_beam);
  grid.azimuths = settings_.beams * a_beam + 1;
  grid.near_m = reach.near_m;
  grid.distances = horizon_distances(settings_);
  grid.step_m = (reach.far_m - reach.near_m) / static_cast<double>(grid.distances);
  grid.drop_per_square_m = 0.5 * earth.curvature_per_m();
  for (VisibleGround& ground : visible_) ground.reset(grid, ground_->obstacles() != nullptr);
}

radar::Rectangle LiveRenderer::under(Beams beams, Vec3d radar, double near_m, double far_m) const {
  const double step_rad = settings_.beam_step_rad;
  return ground_under({radar.x, radar.y}, grid().first_azimuth_rad + step_rad * static_cast<double>(beams.first),
                      step_rad * static_cast<double>(beams.end - beams.first), {near_m, far_m});
}

GroundSector LiveRenderer::sector_of(Vec3d radar, double near_m, double far_m) const {
  return {{radar.x, radar.y},
          grid().first_azimuth_rad,
          settings_.beam_step_rad * static_cast<double>(settings_.beams),
          near_m,
          far_m};
}

terrain::HeightBounds LiveRenderer::bounds_with_obstacles() const {
  const LiveObstacles* const obstacles = ground_->obstacles();
  return {bounds_.lowest_m, bounds_.highest_m + (obstacles != nullptr ? obstacles->tallest_m() : 0.0F)};
}

int LiveRenderer::terrain_level(std::size_t level) const {
  return ground_->terrain().level_for(atlas::texel_side_m(ground_->description().patches, level));
}

Occluders LiveRenderer::terrain_of(std::size_t sector, const TerrainWindows::View& there, Vec3d radar,
                                   std::size_t level) {
  const LiveTerrain& terrain = ground_->terrain();
  const int level_within = terrain_level(level);
  // A picture is drawn of one lattice, whatever the sector; the sweep takes nearer ground from another.
  const bool in_one = settings_.visibility.method == VisibilityMethod::Rasterization;
  const Beams beams = beams_of(sector);
  const double from_m = in_one ? 0.0 : swept_from_m();
  const LiveTerrain::Surface within =
      terrain.surface(there, level_within, under(beams, radar, from_m, far_m()), wanted_terrain_);
  Occluders occluders{.terrain = within.view, .lowered_m = within.above_pages_m};
  float error_m = within.error_m;
  double& below_ground_m = frame_.report.below_ground_m;
  if (from_m == 0.0) below_ground_m = std::max(below_ground_m, terrain.depth_below(within, level_within, radar));
  const LeadSteps lead = lead_of(grid(), radar, bounds_with_obstacles());
  if (!in_one && lead.count > 0) {
    // Nearer ground is walked over in longer steps; nodes half as far apart keep its ridges.
    const int level_before = std::max(level_within, terrain.level_for(lead.step_m / 4.0));
    const double before_from_m = std::max(lead.from_m - lead.step_m, 0.0);
    const LiveTerrain::Surface before =
        terrain.surface(there, level_before, under(beams, radar, before_from_m, grid().near_m), wanted_terrain_);
    occluders.before_near = before.view;
    occluders.lowered_m = std::max(occluders.lowered_m, before.above_pages_m);
    error_m = std::max(error_m, before.error_m);
    below_ground_m = std::max(below_ground_m, terrain.depth_below(before, level_before, radar));
  }
  frame_.report.terrain_error_m = std::max(frame_.report.terrain_error_m, static_cast<double>(error_m));
  return occluders;
}

void LiveRenderer::find_terrain(const TerrainWindows::View& there, Vec3d radar, std::size_t level,
                                SectorOccluders& occluders) {
  const auto sectors = std::span(occluders).first(sectors_.count());
  for (std::size_t sector = 0; sector < sectors.size(); ++sector)
    sectors[sector] = terrain_of(sector, there, radar, level);
  make_bounds_alike(sectors);
}

void LiveRenderer::find_obstacles(const LiveObstacles::Cache::View& there, Vec3d radar,
                                  std::span<SectorOccluders> occluders) {
  const LiveObstacles* const obstacles = ground_->obstacles();
  if (obstacles == nullptr) return;
  using Part = LiveObstacles::Part;
  std::size_t& coarse = frame_.report.coarse_obstacles;
  const double step_m = grid().step_m;
  coarse += obstacles->lay_out(there, {obstacles->level_for(step_m), sector_of(radar, grid().near_m - step_m, far_m())},
                               Part::UnderBins, obstacles_, wanted_obstacles_);
  for (std::size_t which = 0; which < occluders.size(); ++which) {
    for (Occluders& here : occluders[which]) {
      here.obstacles = &obstacles_;
      here.tallest_m = obstacles->tallest_m();
    }
    const LeadSteps lead = lead_of(grid(), radar, occluders[which].front());
    if (lead.count == 0) continue;
    coarse += obstacles->lay_out(
        there, {obstacles->level_for(lead.step_m), sector_of(radar, lead.from_m - lead.step_m, grid().near_m)},
        Part::BeforeBins, obstacles_before_[which], wanted_obstacles_);
    for (Occluders& here : occluders[which]) here.obstacles_before_near = &obstacles_before_[which];
  }
}

void LiveRenderer::find_visible_ground(const FrameViews& there, const Pose& pose, Beams beams,
                                       const render::DetailBlend& levels) {
  const auto level = static_cast<std::size_t>(levels.level - 1), next = static_cast<std::size_t>(levels.next - 1);
  const bool alike = terrain_level(level) == terrain_level(next);
  horizon_of_ = {&visible_[0].horizon(), &visible_[alike ? 0 : 1].horizon()};
  occluders_of_ = {occluders_[0], occluders_[alike ? 0 : 1]};
  // Tasks look half a beam beyond their own, and farther where cells are wider than beams.
  const double cell_m = atlas::texel_side_m(ground_->description().patches, std::max(level, next));
  beams_beside_ = beams_beside(grid().near_m, cell_m, 1.0 / settings_.beam_step_rad);
  const std::size_t first_edge = beams.first - std::min(beams.first, beams_beside_);
  const std::size_t end = std::min(beams.end + beams_beside_, settings_.beams) + 1;
  const std::size_t surfaces = alike ? 1 : 2;
  for (std::size_t which = 0; which < surfaces; ++which)
    find_terrain(there.terrain, pose.position, which == 0 ? level : next, occluders_[which]);
  find_obstacles(there.obstacles, pose.position, std::span(occluders_).first(surfaces));
  for (std::size_t which = 0; which < surfaces; ++which) {
    find_along_edges(pose, which, {first_edge, end});
    // Where beams go round, those beside the first are the last, and the other way round.
    if (!radar::goes_round(settings_.beams, settings_.beam_step_rad) || beams.first == beams.end) continue;
    const std::size_t last = settings_.beams;
    if (beams.first < beams_beside_ && end <= last) {
      const std::size_t before_first = std::min(beams_beside_ - beams.first, last);
      find_along_edges(pose, which, {std::max(last - before_first, end - 1), last + 1});
    }
    if (beams.end + beams_beside_ > last && first_edge > 0) {
      const std::size_t after_last = beams.end + beams_beside_ - last;
      find_along_edges(pose, which, {0, std::min(after_last, first_edge) + 1});
    }
  }
}

void LiveRenderer::find_along_edges(const Pose& pose, std::size_t which, Beams edges) {
  const std::size_t a_beam = visible_[which].horizon().azimuths_a_beam(settings_.beams);
  for (std::size_t sector = 0; sector < sectors_.count(); ++sector) {
    const bool is_last = sector + 1 == sectors_.count();
    const std::size_t from = a_beam * std::max(edges.first, sectors_.first_edge(sector));
    const std::size_t to =
        std::min(a_beam * (edges.end - 1) + 1, a_beam * sectors_.first_edge(sector + 1) + (is_last ? 1 : 0));
    if (from < to) visible_[which].find(from, to - from, pose.position, occluders_[which][sector], team_);
  }
}

void LiveRenderer::look_at_targets(const Pose& pose, Beams beams, const render::DetailBlend& levels) {
  const bool alike = horizon_of_[0] == horizon_of_[1];
  const auto next_share = alike ? 0.0F : static_cast<float>(levels.next_share);
  const TargetSight sight{.levels = {{{horizon_of_[0], occluders_of_[0], 1.0F - next_share},
                                      {horizon_of_[1], occluders_of_[1], next_share}}},
                          .sectors = sectors_,
                          .azimuths_a_beam = horizon_of_[0]->azimuths_a_beam(settings_.beams),
                          .radar = pose.position};
  TargetCount count(settings_, beams.first, beams.end - beams.first);
  targets_.look(
      pose.targets,
      {.position = pose.position,
       .first_azimuth_rad = pose.first_azimuth_rad,
       .first_range_m = pose.first_range_m,
       .earth = frame_.earth},
      pose.moment,
      [&](const receiver::TargetFrame::Seen& target) { return count.counted(target.beam, sight.part_seen(target)); },
      &team_);
  frame_.report.targets = count.seen_of(targets_.seen());
}

void LiveRenderer::find_shadows_of_targets(const Pose& pose) {
  shadows_.look(pose.targets, pose.moment.time_s,
                {.radar_position = pose.position,
                 .first_azimuth_rad = pose.first_azimuth_rad,
                 .beam_step_rad = settings_.beam_step_rad,
                 .beams = settings_.beams,
                 .group = beams_together(settings_.beam_step_rad),
                 .beams_beside = static_cast<double>(beams_beside_),
                 .far_m = far_m(),
                 .drop_per_square_m = grid().drop_per_square_m,
                 .lowest_m = static_cast<double>(bounds_.lowest_m)},
                team_);
}

void LiveRenderer::look_ahead(const FrameViews& there, const Pose& pose, Beams beams, std::size_t level) {
  look_ahead_at_pages(there.pages, pose, beams, level);
  const Vec3d radar = pose.position + pose.velocity_mps * seconds_ahead;
  // Only wished for: what comes back is looked at by the frames to come.
  for (std::size_t sector = 0; sector < sectors_.count(); ++sector) {
    const radar::Rectangle area = under(beams_of(sector), radar, swept_from_m(), far_m());
    (void)ground_->terrain().surface(there.terrain, terrain_level(level), area, wanted_terrain_);
  }
  if (const LiveObstacles* const obstacles = ground_->obstacles()) {
    obstacles->look_ahead(there.obstacles,
                          {obstacles->level_for(grid().step_m), sector_of(radar, grid().near_m, far_m())},
                          wanted_obstacles_);
  }
}

void LiveRenderer::look_ahead_at_pages(const PageCache::View& there, const Pose& pose, Beams beams, std::size_t level) {
  const std::size_t count = beams.end - beams.first;
  if (count == 0) return;
  const bool scans = count < settings_.beams;
  const std::size_t group = beams_together(settings_.beam_step_rad);
  // A scan goes on at the pace of this step; a whole frame looks at all beams again.
  const std::size_t first = scans ? beams.end : beams.first;
  const std::size_t ahead = scans ? std::min(count * steps_ahead, settings_.beams) : count;
  const HorizonGrid& grid = this->grid();
  const Vec3d radar = pose.position + pose.velocity_mps * seconds_ahead;
  const double ground_m = 0.5 * static_cast<double>(bounds_.lowest_m + bounds_.highest_m);
  for (std::size_t done = 0, here = 0; done < ahead; done += here) {
    const std::size_t beam = (first + done) % settings_.beams;
    // Beyond the last beam lies what no beam looks at, unless they go all round.
    here = std::min({group, ahead - done, settings_.beams - beam});
    const double azimuth = pose.first_azimuth_rad + static_cast<double>(beam) * settings_.beam_step_rad;
    const Sector sector(azimuth, static_cast<double>(here) * settings_.beam_step_rad, grid.near_m, far_m());
    add_forecast({there, ground_->stand_in()}, ground_->pages().source(), {radar, sector, level, ground_m}, wanted_);
  }
}

render::DetailBlend LiveRenderer::next_levels() {
  render::DetailQuestion question = with_ground(question_of_bins(settings_, halfway_up_), *ground_);
  // Live frames come from the atlas however small they are.
  question.tallest_object_m = 0.0;
  question.area_m2 = std::numeric_limits<double>::infinity();
  const render::DetailChoice choice = render::choose_detail(question);
  // To blend over a leap would mean to draw a wide view in fine texels.
  if (std::abs(choice.level - last_level_) > 1) transition_ = render::DetailTransition();
  const render::DetailBlend blend = transition_.advance(choice);
  last_level_ = blend.next;
  return blend;
}

}  // namespace sigmascape::live
