#include "sigmascape/live/sector_task.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/atlas/tile_block.h"
#include "sigmascape/base/units.h"
#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/row_scatterers.h"
#include "sigmascape/live/row_widths.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {

std::size_t beams_together(double beam_step_rad) {
  return static_cast<std::size_t>(std::clamp(0.75 / beam_step_rad, 1.0, 64.0));
}

void SectorTask::begin_frame(const PageCache::View& view, std::size_t targets) {
  pages_.begin_frame(view);
  shadows_.make_room(targets);
  report_ = {};
}

void SectorTask::fill(const Pose& pose, Beams beams, const render::DetailBlend& levels) {
  const auto level = static_cast<std::size_t>(levels.level - 1), next = static_cast<std::size_t>(levels.next - 1);
  const auto next_share = static_cast<float>(levels.next_share);
  if (level == next || next_share < 1.0F) {
    add_level(pose, beams, level, 0, level == next ? 1.0F : 1.0F - next_share);
  }
  if (level != next && next_share > 0.0F) add_level(pose, beams, next, 1, next_share);
  hand_over(beams);
}

namespace {

/// Bins that the ranges of a beam take: whole lines of 64 bytes, an odd number of them.
std::size_t odd_lines(const LiveSettings& settings) {
  const std::size_t a_line = 16 / numbers_a_bin(settings.content);
  return ((settings.ranges + a_line - 1) / a_line | 1U) * a_line;
}

/// Counts places from the radar.
SIGMASCAPE_VECTOR_TARGETS
void move(LatticeRow& row, double radar_east_m, double radar_north_m) {
  const std::size_t count = row.whole_vectors();
  for (std::size_t i = 0; i < count; ++i) {
    row.east_m[i] -= radar_east_m;
    row.north_m[i] -= radar_north_m;
  }
}

/// Clears numbers for the next frame, a line at a time, while they are in the nearest cache.
SIGMASCAPE_VECTOR_TARGETS
void hand_over_beam(float* __restrict own, std::size_t count, float* __restrict of_frame) {
  constexpr std::size_t line = 16;
  const std::size_t whole = count / line * line;
  for (std::size_t first = 0; first < whole; first += line) {
    std::copy_n(own + first, line, of_frame + first);
    std::fill_n(own + first, line, 0.0F);
  }
  std::copy(own + whole, own + count, of_frame + whole);
  std::fill(own + whole, own + count, 0.0F);
}

}  // namespace

SectorTask::SectorTask(const FrameParts& parts)
    : parts_(parts),
      pages_(parts.ground.stand_in()),
      stride_(odd_lines(parts.settings)),
      own_bins_(std::min(beams_together(parts.settings.beam_step_rad), parts.settings.beams) * stride_ *
                numbers_a_bin(parts.settings.content) / 16) {}

void SectorTask::hand_over(Beams beams) {
  const std::size_t group = beams_together(parts_.settings.beam_step_rad);
  const std::size_t numbers = numbers_a_bin(parts_.settings.content);
  for (std::size_t beam = beams.first; beam < beams.first + beams.count; ++beam) {
    hand_over_beam(own_bins() + beam % group * stride_ * numbers, parts_.settings.ranges * numbers,
                   parts_.bins.data() + beam * parts_.settings.ranges * numbers);
  }
}

void SectorTask::add_level(const Pose& pose, Beams beams, std::size_t level, std::size_t which, float share) {
  horizon_ = parts_.horizons[which];
  terrain_ = &parts_.occluders[which][parts_.sectors.of_edge(beams.first)].terrain;
  start(pose, beams, level);
  share_ = share;
  const radar::Rectangle ground = radar::moved(sector_.bounds(), {pose.position.x, pose.position.y});
  const radar::Rectangle within = radar::common_part(ground, parts_.ground.description().extent);
  const atlas::TileBlock tiles = atlas::tiles_over(patches(), within, level);
  for (std::size_t number = 0; number < tiles.size(); ++number) fill_tile(tiles.at(number));
  if (within != ground) count_outside(ground);
}

void SectorTask::count_outside(const radar::Rectangle& ground) {
  constexpr double most_rows = 2048.0;
  const double first = std::floor(ground.south_m / texel_m_), end = std::ceil(ground.north_m / texel_m_);
  const double every = std::ceil((end - first) / most_rows);
  double cells = 0.0;
  for (double row = first; row < end; row += every) {
    const Sector::Stretches stretches = sector_.along_row((row + 0.5) * texel_m_ - pose_->position.y);
    for (std::size_t s = 0; s < stretches.count; ++s) {
      const double from = std::ceil((stretches.of[s].west_m + pose_->position.x) / texel_m_ - 0.5);
      const double to = std::floor((stretches.of[s].east_m + pose_->position.x) / texel_m_ - 0.5) + 1.0;
      if (to > from) cells += (to - from - of_extent_.cells_of_row(row, from, to)) * every;
    }
  }
  report_.cells += static_cast<std::size_t>(cells);
  report_.dark += static_cast<std::size_t>(cells);
}

void SectorTask::start(const Pose& pose, Beams beams, std::size_t level) {
  const LiveSettings& settings = parts_.settings;
  pose_ = &pose;
  level_ = level;
  texel_m_ = atlas::texel_side_m(patches(), level);
  of_extent_ = ExtentCells(parts_.ground.description().extent, texel_m_);
  const double step = settings.beam_step_rad;
  // Reckoned from the whole group of beams, so that a scan in pieces gives the bytes of a frame.
  const std::size_t group = beams_together(step);
  first_beam_ = beams.first / group * group;
  first_azimuth_rad_ = pose.first_azimuth_rad + static_cast<double>(first_beam_) * step;
  const double middle = first_azimuth_rad_ + static_cast<double>(group) * step / 2.0;
  const HorizonGrid& horizon = horizon_->grid();
  // A scatterer is shared with bins half a beam away, and stands up to half a texel's diagonal from its middle.
  sector_ = Sector(pose.first_azimuth_rad + (static_cast<double>(beams.first) - 0.5) * step,
                   static_cast<double>(beams.count + 1) * step, horizon.near_m,
                   horizon.near_m + horizon.step_m * static_cast<double>(horizon.distances), 0.75 * texel_m_);
  geometry_ = {.radar_height_m = pose.position.z,
               .drop_per_square_m = horizon.drop_per_square_m,
               .sin_middle = std::sin(middle),
               .cos_middle = std::cos(middle),
               .middle_beam = static_cast<double>(group) / 2.0,
               .beams_per_rad = 1.0 / step,
               .first_range_m = pose.first_range_m,
               .ranges_per_m = 1.0 / settings.range_step_m,
               .cell_m = texel_m_};
  bins_ = {own_bins(), beams.first - first_beam_, beams.first - first_beam_ + beams.count, settings.ranges, stride_};
}

void SectorTask::fill_tile(const atlas::TileAddress& tile) {
  const radar::GroundGrid texels = atlas::texels_of(patches(), tile);
  const double west = texels.west_m - pose_->position.x;
  constexpr auto side = static_cast<double>(atlas::tile_side);
  const double first_column = tile.x * side, northernmost = (tile.y + 1) * side - 1.0;
  const double least = std::max(of_extent_.columns.first() - first_column, 0.0);
  const double most = std::min(of_extent_.columns.end() - first_column, side);
  const auto first_row = static_cast<std::size_t>(std::max(northernmost + 1.0 - of_extent_.rows.end(), 0.0));
  const auto end_row = static_cast<std::size_t>(std::min(northernmost + 1.0 - of_extent_.rows.first(), side));
  shadows_.begin(parts_.shadows.of_group(first_beam_ / beams_together(parts_.settings.beam_step_rad)),
                 {west, texels.north_m - pose_->position.y, texel_m_, atlas::tile_side, atlas::tile_side});
  for (std::size_t row = first_row; row < end_row; ++row) {
    shadows_.go_to_row(row);
    const double north = texels.centre_of(0, row).y - pose_->position.y;
    const Sector::Stretches stretches = sector_.along_row(north);
    for (std::size_t s = 0; s < stretches.count; ++s) {
      const double from = std::ceil((stretches.of[s].west_m - west) / texel_m_ - 0.5);
      const double to = std::floor((stretches.of[s].east_m - west) / texel_m_ - 0.5) + 1.0;
      const auto first = static_cast<std::size_t>(std::max(from, least));
      const double end = std::min(to, most);
      if (end > static_cast<double>(first)) fill_stretch({tile, row, first}, static_cast<std::size_t>(end) - first);
    }
  }
}

void SectorTask::fill_stretch(const Place& place, std::size_t count) {
  row_.count = count;
  report_.cells += count;
  place_scatterers(place);
  const bool apart = ground_aspects() != nullptr;
  const PageRow ground =
      pages_.row_of(apart ? PageKey::bare_ground(place.tile, ground_page_near()) : PageKey{place.tile, aspects_near()},
                    place.row, place.first_column);
  if (ground.page == nullptr) {
    report_.dark += count;
    return;
  }
  if ((ground.levels_up > 0 || ground.page->stands_on_coarser_terrain) && hides_as_finely_as(ground)) {
    stand_on(row_, *terrain_, {pose_->position.x, pose_->position.y});
  } else {
    stand_on(row_, heights_of(ground));
  }
  locate(row_, geometry_);
  report_.lit += light(row_, horizon());
  report_.lit -= shadows_.shade(row_, place.first_column);
  if (apart) light_apart_from(ground);
  keep_within_extent(apart ? row_.ground_lit : row_.lit);
  const auto area_m2 = static_cast<float>(texel_m_ * texel_m_) * share_;
  Shortfall shortfall = blend_by_aspect(place, area_m2);
  if (apart) shortfall.join(add_bare_ground(place, area_m2), count);
  report_.coarse += shortfall.coarse;
  report_.dark += shortfall.dark;
  find_widths(row_, geometry_);
  if (parts_.settings.content == FrameContent::Powers) {
    deposit_powers(row_, bins_);
  } else {
    draw();
    scatter(row_, gaussians_, 2.0 * parts_.ground.frequency_hz() / speed_of_light_mps);
    deposit_amplitudes(row_, bins_);
  }
}

void SectorTask::place_scatterers(const Place& place) {
  const auto side = static_cast<int>(atlas::tile_side);
  first_cell_ = {place.tile.x * side + static_cast<int>(place.first_column),
                 (place.tile.y + 1) * side - 1 - static_cast<int>(place.row)};
  const std::size_t reckoned = row_.whole_vectors();
  parts_.lattice.positions_of(first_cell_, static_cast<int>(level_), {row_.east_m.data(), reckoned},
                              {row_.north_m.data(), reckoned});
  move(row_, pose_->position.x, pose_->position.y);
  row_.first_middle_east_m = (first_cell_.column + 0.5) * texel_m_ - pose_->position.x;
  row_.middle_north_m = (first_cell_.row + 0.5) * texel_m_ - pose_->position.y;
}

bool SectorTask::hides_as_finely_as(const PageRow& ground) const {
  const LiveTerrain& terrain = parts_.ground.terrain();
  const int level = terrain.level_for(std::ldexp(texel_m_, static_cast<int>(ground.levels_up)));
  return terrain_->spacing_m <= terrain.pyramid().layout().spacing_at(level);
}

PageHeights SectorTask::heights_of(const PageRow& ground) const {
  const GroundPage& page = *ground.page;
  const radar::GroundGrid texels = page.texels(patches());
  return {.row = page.row_heights(ground.row),
          .north_row = page.row_heights(ground.row > 0 ? ground.row - 1 : 0),
          .south_row = page.row_heights(std::min(ground.row + 1, page.side - 1)),
          .texel_m = texels.cell_m,
          .west_m = texels.west_m - pose_->position.x,
          .north_m = texels.centre_of(0, ground.row).y - pose_->position.y,
          .first_column = ground.first_column,
          .last_column = page.side - 1,
          .levels_up = ground.levels_up};
}

Horizon SectorTask::horizon() const {
  const HorizonGrid& grid = horizon_->grid();
  const bool goes_round = radar::goes_round(parts_.settings.beams, parts_.settings.beam_step_rad);
  return {.slopes = horizon_->slopes(0),
          .solid_slopes = horizon_->solid_slopes(0),
          .through = horizon_->through(0),
          .azimuths = grid.azimuths,
          .distances = grid.distances,
          .stride = horizon_->stride(),
          .first_beam = static_cast<float>(first_beam_),
          .per_beam = static_cast<float>(horizon_->azimuths_a_beam(parts_.settings.beams)),
          .turn = goes_round ? static_cast<float>(grid.azimuths - 1) : 0.0F,
          .near_m = static_cast<float>(grid.near_m),
          .per_step = static_cast<float>(1.0 / grid.step_m)};
}

void SectorTask::light_apart_from(const PageRow& ground) {
  constexpr float per_step = 1.0F / terrain::PackedSlope::steps_per_unit;
  const std::size_t row = ground.row * ground.page->side;
  for (std::size_t i = 0; i < row_.count; ++i) {
    const std::size_t texel = row + ground.column_of(i);
    row_.slope_east[i] = static_cast<float>(ground.page->slope[texel].east) * per_step;
    row_.slope_north[i] = static_cast<float>(ground.page->slope[texel].north) * per_step;
    row_.top_m[i] = ground.page->top_m[texel];
  }
  light_apart(row_, horizon());
}

void SectorTask::keep_within_extent(LatticeRow::Of<float>& seen) const {
  if (const double of_row = of_extent_.rows.part_of(first_cell_.row); of_row < 1.0) {
    for (std::size_t i = 0; i < row_.count; ++i) seen[i] *= static_cast<float>(of_row);
  }
  const std::size_t last = row_.count - 1;
  seen[0] *= static_cast<float>(of_extent_.columns.part_of(first_cell_.column));
  if (last > 0)
    seen[last] *= static_cast<float>(of_extent_.columns.part_of(first_cell_.column + static_cast<double>(last)));
}

SectorTask::Shortfall SectorTask::of(const PageRow& source, std::size_t count) {
  if (source.page == nullptr) return {.coarse = 0, .dark = count};
  return {.coarse = source.levels_up > 0 ? count : 0, .dark = 0};
}

void SectorTask::Shortfall::join(const Shortfall& other, std::size_t count) {
  dark = std::max(dark, other.dark);
  coarse = std::min(std::max(coarse, other.coarse), count - dark);
}

SectorTask::Shortfall SectorTask::add_bare_ground(const Place& place, float area_m2) {
  const Extremes cotangent = face(row_, geometry_, area_m2);
  Shortfall shortfall;
  if (cotangent.least <= cotangent.greatest) {
    const atlas::AspectCells& elevations = *ground_aspects();
    shortfall =
        add_bare_elevations(place, elevations.elevation_cell(cotangent.greatest),
                            elevations.elevation_cell(cotangent.least) + (elevations.elevation_count() > 1 ? 1U : 0U));
  }
  join_lights(row_);
  return shortfall;
}

SectorTask::Shortfall SectorTask::add_bare_elevations(const Place& place, std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t a_page = GroundPage::elevations;
  Shortfall shortfall;
  for (std::uint32_t number = first / a_page; number <= last / a_page; ++number) {
    const PageRow source = pages_.row_of(PageKey::bare_ground(place.tile, number), place.row, place.first_column);
    shortfall.join(of(source, row_.count), row_.count);
    if (source.page == nullptr) continue;
    const std::uint32_t lowest = number * a_page;
    add_ground(row_, ground_looks(source, std::max(first, lowest), std::min(last + 1, lowest + a_page)));
  }
  return shortfall;
}

GroundLooks SectorTask::ground_looks(const PageRow& source, std::uint32_t first, std::uint32_t end) {
  const atlas::AspectCells& elevations = *ground_aspects();
  const auto& cotangents = elevations.cotangents();
  constexpr std::uint32_t a_page = GroundPage::elevations;
  const std::uint32_t lowest = first / a_page * a_page;
  const std::size_t highest = elevations.elevation_count() - 1;
  GroundLooks looks{.blocks = pages_.blocks_of(source, row_.count),
                    .next_blocks = source.next_blocks(),
                    .frequencies = source.page->looks / GroundPage::elevations,
                    .first = first - lowest,
                    .end = end - lowest,
                    .elevations = {},
                    .highest_sine = elevations.sine(highest)};
  for (std::uint32_t e = first; e < end; ++e) {
    GroundElevation& own = looks.elevations[e - lowest];
    own = {.below = cotangents[e > 0 ? e - 1 : 0],
           .own = cotangents[e],
           .above = cotangents[std::min<std::size_t>(e + 1, highest)],
           .sine = elevations.sine(e)};
    for (std::size_t f = 0; f < looks.frequencies; ++f) {
      own.factor[f] = source.page->scale[(e - lowest) * looks.frequencies + f] * elevations.frequency_part(f);
    }
  }
  return looks;
}

const atlas::AspectCells* SectorTask::ground_aspects() const {
  return parts_.ground.pages().source().ground_aspects();
}

float SectorTask::cotangent_near() const {
  const double below = pose_->position.z - 0.5 * static_cast<double>(parts_.bounds.lowest_m + parts_.bounds.highest_m);
  return static_cast<float>(std::hypot(row_.east_m[0], row_.north_m[0]) / std::max(below, 1.0));
}

std::uint32_t SectorTask::ground_page_near() const {
  return static_cast<std::uint32_t>(ground_aspects()->elevation_cell(cotangent_near()) / GroundPage::elevations);
}

atlas::AspectCell SectorTask::aspects_near() const {
  return {aspects().azimuth_cell(std::atan2(row_.east_m[0], row_.north_m[0]) + pi),
          aspects().elevation_cell(cotangent_near())};
}

std::uint32_t SectorTask::azimuth_cell_at(float beam) const {
  return aspects().azimuth_cell(first_azimuth_rad_ + static_cast<double>(beam) * parts_.settings.beam_step_rad + pi);
}

SectorTask::Shortfall SectorTask::blend_by_aspect(const Place& place, float area_m2) {
  Shortfall shortfall;
  const Extremes cotangent = cotangent_extremes(row_);
  const float lowest_cotangent = aspects().cotangents().front();
  if (ground_aspects() != nullptr && cotangent.greatest > lowest_cotangent)
    hold_lowest_look(row_, geometry_, lowest_cotangent, aspects().sine(0));
  const bool one_elevation = aspects().elevation_cell(cotangent.least) == aspects().elevation_cell(cotangent.greatest);
  const Extremes beams = beam_extremes(row_);
  std::size_t begin = 0;
  while (begin < row_.count) {
    const atlas::AspectCell cell{azimuth_cell_at(row_.beam[begin]), aspects().elevation_cell(row_.cotangent[begin])};
    const double start = aspects().azimuth_start(cell.azimuth), width = aspects().azimuth_width(cell.azimuth);
    const double of_first_beam = wrapped_azimuth(first_azimuth_rad_ + pi - start + pi) - pi;
    // A cell may be wider than half a turn: counted by whole turns so that this place lies in it.
    const double here = of_first_beam + parts_.settings.beam_step_rad * static_cast<double>(row_.beam[begin]);
    const double offset = of_first_beam - 2.0 * pi * std::round((here - 0.5 * width) / (2.0 * pi));
    const auto per_beam = static_cast<float>(parts_.settings.beam_step_rad / width);
    const auto at_zero = static_cast<float>(offset / width);
    const double steepness = atlas::azimuth_blend_steepness(width);
    const auto& cotangents = aspects().cotangents();
    std::size_t end = row_.count;
    const auto is_of_azimuth = [&](float beam) {
      const float part = at_zero + per_beam * beam;
      return part >= 0.0F && part < 1.0F;
    };
    // Most rows lie in one cell from end to end.
    if (!one_elevation || !is_of_azimuth(beams.least) || !is_of_azimuth(beams.greatest)) {
      end = begin + 1;
      while (end < row_.count && is_of_azimuth(row_.beam[end]) &&
             aspects().elevation_cell(row_.cotangent[end]) == cell.elevation) {
        ++end;
      }
    }
    const PageRow source = pages_.row_of({place.tile, cell}, place.row, place.first_column + begin);
    if (source.page != nullptr) {
      blend(row_, begin, end - begin,
            {.blocks = pages_.blocks_of(source, end - begin),
             .next_blocks = source.next_blocks(),
             .scale = source.page->scale.data(),
             .looks = source.page->looks,
             .area_m2 = area_m2,
             .second_azimuth_at_zero = static_cast<float>(0.5 + steepness * (offset / width - 0.5)),
             .second_azimuth_per_beam = static_cast<float>(steepness * parts_.settings.beam_step_rad / width),
             .cotangent = {cotangents[cell.elevation], cotangents[cell.elevation + 1U]},
             .sine = {aspects().sine(cell.elevation), aspects().sine(cell.elevation + 1U)},
             .frequency_part = {aspects().frequency_part(0), aspects().frequency_part(1)}});
    }
    if (source.page == nullptr) blend_nothing(row_, begin, end - begin);
    const Shortfall piece = of(source, end - begin);
    shortfall.coarse += piece.coarse;
    shortfall.dark += piece.dark;
    begin = end;
  }
  return shortfall;
}

void SectorTask::draw() {
  const std::size_t reckoned = row_.whole_vectors();
  for (std::size_t i = 0; i < reckoned; ++i) {
    columns_[i] = first_cell_.column + static_cast<int>(i);
    rows_[i] = first_cell_.row;
  }
  using radar::Draw;
  std::size_t k = 0;
  for (const Draw which : {Draw::First, Draw::Second, Draw::Third}) {
    parts_.lattice.values_of({columns_.data(), reckoned}, {rows_.data(), reckoned}, static_cast<int>(level_), which,
                             {gaussians_[k].data(), reckoned}, {gaussians_[k + 1].data(), reckoned});
    k += 2;
  }
}

}  // namespace sigmascape::live
