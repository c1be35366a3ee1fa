#include "sigmascape/atlas/atlas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/texel_blend.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::atlas {
namespace {

/// Weights of looks times the scale under which each was stored on one patch.
std::array<float, 8> stored_weights(const AspectWeights& weights, const std::vector<float>& scales) {
  std::array<float, 8> product{};
  for (std::size_t i = 0; i < weights.count; ++i) product[i] = weights.weight[i] * scales[weights.look[i]];
  return product;
}

/// The floor, where there is no instruction for it.
int whole_below(double value) {
  const auto towards_zero = static_cast<int>(value);
  return static_cast<double>(towards_zero) > value ? towards_zero - 1 : towards_zero;
}

}  // namespace

std::size_t Atlas::memory_bytes() const {
  std::size_t bytes = table_->memory_bytes();
  if (ground_layers_) {
    bytes +=
        ground_layers_->sigma0.memory_bytes() + ground_layers_->obstacles.obstacles.size() * sizeof(radar::Obstacle);
    if (ground_layers_->buildings) bytes += ground_layers_->buildings->memory_bytes();
  }
  return bytes;
}

const PatchTexels* Atlas::patch_at(int column, int row, std::size_t level) const {
  if (column < 0 || column >= patch_columns_ || row < 0 || row >= patch_rows_) return nullptr;
  const PatchTexels* patch =
      patches_in_memory_ + static_cast<std::size_t>(row) * static_cast<std::size_t>(patch_columns_) + column;
  return patch->levels[level - finest_level_].empty() ? nullptr : patch;
}

void Atlas::prepare(const radar::Rectangle& area, double level) const {
  const double within = drawn_to_levels(level);
  const auto finer = static_cast<std::size_t>(within);
  // Readings blend the texels about a point of this level and the next.
  const double texel_m = patches_.texel_m * std::exp2(std::ceil(within));
  const double side_m = patches_.side_m();
  const radar::Rectangle whole{north_west_.x * side_m, (north_west_.y + 1 - patch_rows_) * side_m,
                               (north_west_.x + patch_columns_) * side_m, (north_west_.y + 1) * side_m};
  table_->read(patches_.block_over(radar::common_part(radar::widened(area, texel_m), whole)), finer);
  if (ground_layers_) ground_layers_->sigma0.prepare(area, level);
}

void Atlas::check_whole() const {
  table_->check_whole();
  if (ground_layers_) ground_layers_->sigma0.check_whole();
}

bool Atlas::covers(Vec2d point_m) const {
  const double side_m = patches_.side_m();
  const double columns = point_m.x / side_m - north_west_.x;
  const double rows = (north_west_.y + 1) - point_m.y / side_m;
  return columns >= 0.0 && columns <= patch_columns_ && rows >= 0.0 && rows <= patch_rows_;
}

void Atlas::check_frequency(double frequency_hz) const {
  atlas::check_frequency(aspects_, frequency_hz);
}

double Atlas::drawn_to_levels(double level) const {
  // In this order NaN becomes the finest level.
  return std::max(static_cast<double>(finest_level_), std::min(level, static_cast<double>(coarsest_level())));
}

double Atlas::level_for(double cell_side_m) const {
  return drawn_to_levels(std::log2(cell_side_m / patches_.texel_m));
}

radar::Channels Atlas::at_level(Vec2d point_m, const AspectWeights& weights, std::size_t level) const {
  const auto side = static_cast<int>(patches_.texels_per_side >> level);
  const int log2_side = std::countr_zero(patches_.texels_per_side >> level);
  const double texel_m = patches_.texel_m * static_cast<double>(std::size_t{1} << level);
  const double side_m = patches_.side_m();
  // Texels counted from the north-western corner of the atlas; 0 is the centre of the first.
  const double across = (point_m.x - north_west_.x * side_m) / texel_m - 0.5;
  const double down = ((north_west_.y + 1) * side_m - point_m.y) / texel_m - 0.5;
  const int column = whole_below(across), row = whole_below(down);
  const float u = share_of_next(across - column), v = share_of_next(down - row);

  TexelParts parts;
  std::array<std::array<float, 8>, 4> stored;  // one a patch
  const PatchTexels* scaled_for = nullptr;
  const Half* looks_of_patch = nullptr;
  float total = 0.0F;
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner & 1;
    const int below = corner >> 1;
    const float part = (right == 1 ? u : 1.0F - u) * (below == 1 ? v : 1.0F - v);
    const int texel_column = column + right;
    const int texel_row = row + below;
    const PatchTexels* patch = patch_at(texel_column >> log2_side, texel_row >> log2_side, level);
    if (part == 0.0F || patch == nullptr) continue;
    const std::size_t n = parts.count;
    const bool is_another = patch != scaled_for;
    if (is_another) {
      scaled_for = patch;
      stored[n] = stored_weights(weights, patch->scales);
      looks_of_patch = patch->levels[level - finest_level_].data();
    }
    const auto row_in_patch = static_cast<std::size_t>(texel_row & (side - 1));
    const auto column_in_patch = static_cast<std::size_t>(texel_column & (side - 1));
    const std::size_t texel = (row_in_patch << log2_side) + column_in_patch;
    parts.texels[n] = {.looks = looks_of_patch + texel * patch->scales.size() * texel_halves,
                       .weight = is_another ? stored[n].data() : parts.texels[n - 1].weight,
                       .part = part};
    ++parts.count;
    total += part;
  }
  if (total == 0.0F) return {};
  return blended(parts, weights) * (1.0F / total);
}

radar::Channels Atlas::sigma0_at(Vec2d point_m, const AspectWeights& weights, double level) const {
  if (weights.count == 0 || !covers(point_m)) return {};
  const double within = drawn_to_levels(level);
  const auto finer = static_cast<std::size_t>(within);
  const auto part = static_cast<float>(within - static_cast<double>(finer));
  const radar::Channels fine = at_level(point_m, weights, finer);
  if (part == 0.0F) return fine;
  return fine * (1.0F - part) + at_level(point_m, weights, finer + 1) * part;
}

}  // namespace sigmascape::atlas
