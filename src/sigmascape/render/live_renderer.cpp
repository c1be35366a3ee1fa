#include "sigmascape/render/live_renderer.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/render/lattice_row.h"
#include "sigmascape/render/page_forecast.h"
#include "sigmascape/render/sector.h"

namespace sigmascape::render {
namespace {

/// Beams that are reckoned from one middle direction, and filled by one task unless a scan asks for fewer. Wide enough
/// that rows of texels are read in long stretches, narrow enough to find an azimuth by a short series.
std::size_t beams_together(double beam_step_rad) {
  return static_cast<std::size_t>(std::clamp(0.75 / beam_step_rad, 1.0, 64.0));
}

/// Missing pages that one task remembers; the next frame will see the rest.
constexpr std::size_t most_wanted = 4096;

std::size_t numbers_a_bin(FrameContent content) {
  return content == FrameContent::Amplitudes ? 8 : 4;
}

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

/// Fills some beams of a frame: goes over the lattice cells of their sector, row by row.
class LiveRenderer::SectorTask {
 public:
  struct Beams {
    std::size_t first = 0, count = 0;
  };

  explicit SectorTask(LiveRenderer& renderer) : renderer_(renderer) { wanted_.reserve(most_wanted); }

  void begin_frame(const PageCache::View& view) {
    view_ = view;
    report_ = {};
    wanted_.clear();
    last_page_ = nullptr;  // of an older view: its memory may hold another page by now
  }
  void end_frame() { view_ = {}; }
  [[nodiscard]] const FrameReport& report() const { return report_; }
  [[nodiscard]] std::span<const PageKey> wanted() const { return wanted_; }

  /// Clears the beams and adds one level of the ground, or two with their shares of the power.
  void fill(const Pose& pose, Beams beams, const DetailBlend& levels) {
    clear(beams);
    const auto level = static_cast<std::size_t>(levels.level - 1), next = static_cast<std::size_t>(levels.next - 1);
    const auto next_share = static_cast<float>(levels.next_share);
    if (level == next || next_share < 1.0F) add_level(pose, beams, level, level == next ? 1.0F : 1.0F - next_share);
    if (level != next && next_share > 0.0F) add_level(pose, beams, next, next_share);
  }

 private:
  void clear(Beams beams) {
    const LiveSettings& settings = renderer_.settings_;
    const std::size_t a_beam = settings.ranges * numbers_a_bin(settings.content);
    std::fill_n(renderer_.bins_.data() + beams.first * a_beam, beams.count * a_beam, 0.0F);
  }

  void add_level(const Pose& pose, Beams beams, std::size_t level, float share) {
    start(pose, beams, level);
    share_ = share;
    const double texel_m = atlas::texel_side_m(renderer_.ground_->description().patches, level);
    const double tile_m = texel_m * static_cast<double>(atlas::tile_side);
    const radar::Rectangle box = sector_.bounds();
    const auto tile_at = [tile_m](double position) { return static_cast<int>(std::floor(position / tile_m)); };
    for (int y = tile_at(pose.position.y + box.south_m); y <= tile_at(pose.position.y + box.north_m); ++y) {
      for (int x = tile_at(pose.position.x + box.west_m); x <= tile_at(pose.position.x + box.east_m); ++x) {
        fill_tile({level, x, y}, texel_m);
      }
    }
  }

  /// A row of the best page there is for a place: the page itself or, until that is there, one of its ancestors.
  struct PageRow {
    const GroundPage* page = nullptr;
    std::size_t row = 0, first_column = 0;  ///< within the page; of the ancestor's texels the first is cut in halves
    std::size_t levels_up = 0;

    /// Column in the page of texel `i` of the stretch.
    [[nodiscard]] std::size_t column_of(std::size_t i) const { return (first_column + i) >> levels_up; }
  };

  void start(const Pose& pose, Beams beams, std::size_t level) {
    const LiveSettings& settings = renderer_.settings_;
    pose_ = &pose;
    level_ = level;
    const double step = settings.beam_step_rad;
    // Reckoned from the whole group of beams, so that a scan in pieces gives the bytes of a frame.
    const std::size_t group = beams_together(step);
    first_beam_ = beams.first / group * group;
    const double first_azimuth = pose.first_azimuth_rad + static_cast<double>(first_beam_) * step;
    const double middle = first_azimuth + static_cast<double>(group) * step / 2.0;
    const HorizonGrid& horizon = renderer_.horizon_.grid();
    // A scatterer is shared with bins half a beam away, and stands up to half a texel's diagonal from its middle.
    const double texel_m = atlas::texel_side_m(renderer_.ground_->description().patches, level);
    const double margin = std::min(0.5 * settings.beam_step_rad + 0.75 * texel_m / std::max(horizon.near_m, texel_m),
                                   1.5 * settings.beam_step_rad);
    sector_ = Sector(pose.first_azimuth_rad + static_cast<double>(beams.first) * step - margin,
                     static_cast<double>(beams.count) * step + 2.0 * margin, horizon.near_m,
                     horizon.near_m + horizon.step_m * static_cast<double>(horizon.distances));
    geometry_ = {.radar_height_m = pose.position.z,
                 .drop_per_square_m = horizon.drop_per_square_m,
                 .sin_middle = std::sin(middle),
                 .cos_middle = std::cos(middle),
                 .middle_beam = static_cast<double>(group) / 2.0,
                 .beams_per_rad = 1.0 / settings.beam_step_rad,
                 .first_range_m = pose.first_range_m,
                 .ranges_per_m = 1.0 / settings.range_step_m};
    const std::size_t numbers = numbers_a_bin(settings.content);
    bins_ = {renderer_.bins_.data() + first_beam_ * settings.ranges * numbers, beams.first - first_beam_,
             beams.first - first_beam_ + beams.count, settings.ranges};
    first_azimuth_rad_ = first_azimuth;
  }

  void fill_tile(const atlas::TileAddress& tile, double texel_m) {
    const radar::GroundGrid texels = atlas::texels_of(renderer_.ground_->description().patches, tile);
    const double west = texels.west_m - pose_->position.x;
    for (std::size_t row = 0; row < atlas::tile_side; ++row) {
      const double north = texels.centre_of(0, row).y - pose_->position.y;
      const Sector::Stretches stretches = sector_.along_row(north);
      for (std::size_t s = 0; s < stretches.count; ++s) {
        const double from = std::ceil((stretches.of[s].west_m - west) / texel_m - 0.5);
        const double to = std::floor((stretches.of[s].east_m - west) / texel_m - 0.5) + 1.0;
        const auto first = static_cast<std::size_t>(std::max(from, 0.0));
        const double end = std::min(to, static_cast<double>(atlas::tile_side));
        if (end > static_cast<double>(first)) {
          fill_stretch(tile, row, first, static_cast<std::size_t>(end) - first, texel_m);
        }
      }
    }
  }

  /// A stretch of texels of one row of a tile.
  void fill_stretch(const atlas::TileAddress& tile, std::size_t tile_row, std::size_t first_column, std::size_t count,
                    double texel_m) {
    row_.count = count;
    report_.cells += count;
    place(tile, tile_row, first_column);
    const bool apart = ground_aspects() != nullptr;
    const PageRow ground = row_of(
        apart ? PageKey::bare_ground(tile, ground_page_near()) : PageKey{tile, aspects_near()}, tile_row, first_column);
    if (ground.page == nullptr) {
      report_.dark += count;
      return;
    }
    stand_on(row_, heights_of(ground));
    locate(row_, geometry_);
    light();
    if (apart) light_apart_from(ground);
    for (auto& channel : row_.returned) std::fill_n(channel.begin(), count, 0.0F);
    blend_by_aspect(tile, tile_row, first_column);
    const auto area_m2 = static_cast<float>(texel_m * texel_m) * share_;
    weigh(row_, area_m2);
    if (apart) add_bare_ground(tile, tile_row, first_column, area_m2);
    if (renderer_.settings_.content == FrameContent::Powers) {
      deposit_powers(row_, bins_);
    } else {
      draw();
      scatter(row_, gaussians_, 2.0 * renderer_.ground_->frequency_hz() / speed_of_light_mps);
      deposit_amplitudes(row_, bins_);
    }
  }

  /// Puts the scatterers of the stretch in their places.
  void place(const atlas::TileAddress& tile, std::size_t tile_row, std::size_t first_column) {
    const auto side = static_cast<int>(atlas::tile_side);
    first_cell_ = {tile.x * side + static_cast<int>(first_column),
                   (tile.y + 1) * side - 1 - static_cast<int>(tile_row)};
    renderer_.lattice_.positions_of(first_cell_, static_cast<int>(level_), {row_.east_m.data(), row_.count},
                                    {row_.north_m.data(), row_.count});
    for (std::size_t i = 0; i < row_.count; ++i) {
      row_.east_m[i] -= pose_->position.x;
      row_.north_m[i] -= pose_->position.y;
    }
  }

  [[nodiscard]] PageHeights heights_of(const PageRow& ground) const {
    const GroundPage& page = *ground.page;
    const radar::GroundGrid texels = atlas::texels_of(renderer_.ground_->description().patches, page.key.tile);
    return {.row = page.row_heights(ground.row),
            .north_row = page.row_heights(ground.row > 0 ? ground.row - 1 : 0),
            .south_row = page.row_heights(std::min(ground.row + 1, atlas::tile_side - 1)),
            .texel_m = texels.cell_m,
            .west_m = texels.west_m - pose_->position.x,
            .north_m = texels.centre_of(0, ground.row).y - pose_->position.y,
            .first_column = ground.first_column,
            .levels_up = ground.levels_up};
  }

  [[nodiscard]] Horizon horizon() const {
    const HorizonMap& horizon = renderer_.horizon_;
    return {.slopes = horizon.slopes(0),
            .solid_slopes = horizon.solid_slopes(0),
            .through = horizon.through(0),
            .azimuths = horizon.grid().azimuths,
            .distances = horizon.grid().distances,
            .first_beam = static_cast<float>(first_beam_),
            .near_m = static_cast<float>(horizon.grid().near_m),
            .per_step = static_cast<float>(1.0 / horizon.grid().step_m)};
  }

  void light() { report_.lit += render::light(row_, horizon()); }

  /// Tells what is seen of the ground from what is seen of the things on it.
  void light_apart_from(const PageRow& ground) {
    constexpr float per_step = 1.0F / terrain::PackedSlope::steps_per_unit;
    const std::size_t row = ground.row * atlas::tile_side;
    for (std::size_t i = 0; i < row_.count; ++i) {
      const std::size_t texel = row + ground.column_of(i);
      row_.slope_east[i] = static_cast<float>(ground.page->slope[texel].east) * per_step;
      row_.slope_north[i] = static_cast<float>(ground.page->slope[texel].north) * per_step;
      row_.top_m[i] = ground.page->top_m[texel];
    }
    light_apart(row_, horizon());
  }

  /// Adds the bare ground of the stretch: each texel by the elevations about its own local grazing angle.
  void add_bare_ground(const atlas::TileAddress& tile, std::size_t tile_row, std::size_t first_column, float area_m2) {
    const Extremes cotangent = face(row_, geometry_, area_m2);
    if (cotangent.least <= cotangent.greatest) {
      const atlas::AspectCells& elevations = *ground_aspects();
      const auto& cotangents = elevations.cotangents();
      const std::uint32_t first = elevations.elevation_cell(cotangent.greatest);
      const std::uint32_t last = elevations.elevation_cell(cotangent.least) + (ground_elevations() > 1 ? 1U : 0U);
      PageRow source;
      for (std::uint32_t e = first; e <= last; ++e) {
        const std::uint32_t number = e / GroundPage::elevations;
        if (e == first || e % GroundPage::elevations == 0) {
          source = row_of(PageKey::bare_ground(tile, number), tile_row, first_column);
          if (source.page == nullptr) report_.dark += row_.count;
          if (source.levels_up > 0) report_.coarse += row_.count;
        }
        if (source.page == nullptr) continue;
        const std::size_t frequencies = source.page->looks / GroundPage::elevations;
        const atlas::Half* const planes = planes_of(source, row_.count);
        for (std::size_t f = 0; f < frequencies; ++f) {
          const std::size_t look = e % GroundPage::elevations * frequencies + f;
          add_ground(row_, {.planes = planes + look * GroundPage::channels * atlas::tile_side,
                            .factor = source.page->scale[look] * elevations.frequency_part(f),
                            .below = cotangents[e > 0 ? e - 1 : 0],
                            .own = cotangents[e],
                            .above = cotangents[std::min<std::size_t>(e + 1, ground_elevations() - 1)],
                            .sine = elevations.sine(e),
                            .highest_sine = elevations.sine(ground_elevations() - 1)});
        }
      }
    }
    join_lights(row_);
  }

  [[nodiscard]] const atlas::AspectCells* ground_aspects() const {
    return renderer_.ground_->pages().source().ground_aspects();
  }
  [[nodiscard]] std::size_t ground_elevations() const { return ground_aspects()->elevation_count(); }
  /// The page of bare ground that answers for level ground at a stretch's first texel, before it is located.
  [[nodiscard]] std::uint32_t ground_page_near() const {
    const double below = pose_->position.z - 0.5 * (renderer_.ground_->lowest_m() + renderer_.ground_->highest_m());
    const auto cotangent = static_cast<float>(std::hypot(row_.east_m[0], row_.north_m[0]) / std::max(below, 1.0));
    return ground_aspects()->elevation_cell(cotangent) / GroundPage::elevations;
  }

  [[nodiscard]] std::uint32_t azimuth_cell_at(float beam) const {
    return aspects().azimuth_cell(first_azimuth_rad_ + static_cast<double>(beam) * renderer_.settings_.beam_step_rad +
                                  pi);
  }

  /// The aspect cell of a stretch's first texel, before it is located: good enough to find heights.
  [[nodiscard]] atlas::AspectCell aspects_near() const {
    const double x = row_.east_m[0], y = row_.north_m[0];
    const double below = pose_->position.z - 0.5 * (renderer_.ground_->lowest_m() + renderer_.ground_->highest_m());
    return {aspects().azimuth_cell(std::atan2(x, y) + pi),
            aspects().elevation_cell(static_cast<float>(std::hypot(x, y) / std::max(below, 1.0)))};
  }

  /// Cuts the stretch where the aspect passes from one cell to the next, and blends each piece from its own page.
  void blend_by_aspect(const atlas::TileAddress& tile, std::size_t tile_row, std::size_t first_column) {
    const Extremes cotangent = cotangent_extremes(row_);
    const bool one_elevation =
        aspects().elevation_cell(cotangent.least) == aspects().elevation_cell(cotangent.greatest);
    std::size_t begin = 0;
    while (begin < row_.count) {
      const atlas::AspectCell cell{azimuth_cell_at(row_.beam[begin]), aspects().elevation_cell(row_.cotangent[begin])};
      const double start = aspects().azimuth_start(cell.azimuth), width = aspects().azimuth_width(cell.azimuth);
      const double offset = wrapped_azimuth(first_azimuth_rad_ + pi - start + pi) - pi;
      const auto per_beam = static_cast<float>(renderer_.settings_.beam_step_rad / width);
      const auto at_zero = static_cast<float>(offset / width);
      const auto& cotangents = aspects().cotangents();
      std::size_t end = row_.count;
      const auto within = [&](std::size_t i) {
        const float part = at_zero + per_beam * row_.beam[i];
        return part >= 0.0F && part < 1.0F && aspects().elevation_cell(row_.cotangent[i]) == cell.elevation;
      };
      // Azimuth goes one way along a row. Most rows lie in one cell from end to end.
      if (!one_elevation || !within(row_.count - 1)) {
        end = begin + 1;
        while (end < row_.count && within(end)) ++end;
      }
      const PageRow source = row_of({tile, cell}, tile_row, first_column + begin);
      if (source.page != nullptr) {
        blend(row_, begin, end - begin,
              {.planes = planes_of(source, end - begin),
               .scale = source.page->scale.data(),
               .looks = source.page->looks,
               .azimuth_offset = at_zero,
               .azimuth_per_beam = per_beam,
               .cotangent = {cotangents[cell.elevation], cotangents[cell.elevation + 1U]},
               .sine = {aspects().sine(cell.elevation), aspects().sine(cell.elevation + 1U)},
               .frequency_part = {aspects().frequency_part(0), aspects().frequency_part(1)}});
      }
      if (source.page == nullptr) report_.dark += end - begin;
      if (source.levels_up > 0) report_.coarse += end - begin;
      begin = end;
    }
  }

  void draw() {
    for (std::size_t i = 0; i < row_.count; ++i) {
      columns_[i] = first_cell_.column + static_cast<int>(i);
      rows_[i] = first_cell_.row;
    }
    using radar::Draw;
    std::size_t k = 0;
    for (const Draw which : {Draw::First, Draw::Second, Draw::Third}) {
      renderer_.lattice_.values_of({columns_.data(), row_.count}, {rows_.data(), row_.count}, static_cast<int>(level_),
                                   which, {gaussians_[k].data(), row_.count}, {gaussians_[k + 1].data(), row_.count});
      k += 2;
    }
  }

  PageRow row_of(const PageKey& key, std::size_t row, std::size_t column) {
    if (last_page_ != nullptr && last_page_->key == key) return {last_page_, row, column, 0};
    if (const GroundPage* page = view_.find(key)) {
      last_page_ = page;
      return {page, row, column, 0};
    }
    PageRow found;
    PageKey above = key;
    for (std::size_t up = 1; above.tile.level < renderer_.ground_->coarsest_level() && found.page == nullptr; ++up) {
      // Which quarter of its parent the tile is: rows count from the north, tiles from the south.
      const bool east = (above.tile.x & 1) != 0, south = (above.tile.y & 1) == 0;
      column += east ? atlas::tile_side << (up - 1) : 0;
      row += south ? atlas::tile_side << (up - 1) : 0;
      above.tile = above.tile.parent();
      found = {view_.find(above), row >> up, column, up};
    }
    // A coarse page covers much ground: where there is nothing yet it comes first.
    if (found.page == nullptr) miss(above);
    miss(key);
    return found;
  }

  void miss(const PageKey& key) {
    if (!wanted_.empty() && wanted_.back() == key) return;
    const auto same = [&key](const PageKey& other) { return other == key; };
    if (wanted_.size() < wanted_.capacity() && std::ranges::none_of(wanted_, same)) wanted_.push_back(key);
  }

  /// The planes of a stretch; those of an ancestor are drawn out, each of its texels over those that it stands for.
  const atlas::Half* planes_of(const PageRow& source, std::size_t count) {
    const atlas::Half* const planes = source.page->row_planes(source.row);
    if (source.levels_up == 0) return planes + source.first_column;
    for (std::size_t plane = 0; plane < source.page->looks * GroundPage::channels; ++plane) {
      for (std::size_t i = 0; i < count; ++i) {
        drawn_out_[plane * atlas::tile_side + i] = planes[plane * atlas::tile_side + source.column_of(i)];
      }
    }
    return drawn_out_.data();
  }

  [[nodiscard]] const atlas::AspectCells& aspects() const { return renderer_.ground_->aspects(); }

  LiveRenderer& renderer_;
  PageCache::View view_;
  FrameReport report_;
  std::vector<PageKey> wanted_;

  const Pose* pose_ = nullptr;
  std::size_t level_ = 0, first_beam_ = 0;
  double first_azimuth_rad_ = 0.0;
  float share_ = 1.0F;  // of the level's power
  Sector sector_;
  RowGeometry geometry_;
  SectorBins bins_;
  const GroundPage* last_page_ = nullptr;

  radar::LatticeCell first_cell_;
  LatticeRow row_;
  std::array<LatticeRow::Of<float>, 6> gaussians_;
  std::array<std::int32_t, LatticeRow::most> columns_, rows_;
  std::array<atlas::Half, atlas::AspectCells::most_looks * GroundPage::channels * atlas::tile_side> drawn_out_;
};

LiveRenderer::LiveRenderer(std::shared_ptr<LiveGround> ground, const LiveSettings& settings)
    : ground_(std::move(ground)),
      settings_(checked(settings)),
      lattice_({.seed = settings.seed, .cell_m = ground_->description().patches.texel_m, .levels = 1}),
      team_(settings.threads),
      horizon_(HorizonGrid{}, team_.size()) {
  bins_.resize(settings.beams * settings.ranges * numbers_a_bin(settings.content));
  for (unsigned worker = 0; worker < team_.size(); ++worker) tasks_.push_back(std::make_unique<SectorTask>(*this));
  // The tasks' and, after them, what lies ahead.
  wanted_.reserve(most_wanted * (team_.size() + 1));
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
