#include "sigmascape/live/row_light.h"

#include <cstdint>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/lesser_greater.h"

namespace sigmascape::live {
namespace {

/// Single precision leaves this much doubt in a slope; level ground must not hide itself.
constexpr float doubt = 1e-6F;

/// Where a row's texels read a map that lies [azimuth][distance].
struct Nodes {
  alignas(64) LatticeRow::Of<std::int32_t> index;  ///< of the node towards the radar, along the azimuth on the left
  alignas(64) LatticeRow::Of<float> part;          ///< that falls to the azimuth on the right
};

/// The last node before each texel, or with `ahead` 0.5 the nearest one.
SIGMASCAPE_VECTOR_TARGETS
void find_nodes(const LatticeRow& row, const Horizon& horizon, float ahead, Nodes& nodes) {
  const auto stride = static_cast<std::int32_t>(horizon.stride);
  const auto last_left = static_cast<float>(horizon.azimuths) - 2.0F;
  const auto last_node = static_cast<float>(horizon.distances) - 1.0F;
  const float first_beam = horizon.first_beam, per_beam = horizon.per_beam, turn = horizon.turn;
  const float near_m = horizon.near_m, per_step = horizon.per_step;
  const std::size_t count = row.whole_vectors();
  for (std::size_t i = 0; i < count; ++i) {
    float across = (row.beam[i] + first_beam) * per_beam;
    // Beams of a turn look over its ends.
    across += across < 0.0F ? turn : 0.0F;
    across -= across > turn ? turn : 0.0F;
    const auto left = static_cast<std::int32_t>(lesser(greater(across, 0.0F), last_left));
    const auto node =
        static_cast<std::int32_t>(lesser(greater((row.ground_m[i] - near_m) * per_step + ahead, 0.0F), last_node));
    nodes.part[i] = lesser(greater(across - static_cast<float>(left), 0.0F), 1.0F);
    nodes.index[i] = left * stride + node;
  }
}

/// What a map holds on the left and on the right of texels; what vector units gather they read one by one as well.
struct Beside {
  alignas(64) LatticeRow::Of<float> left, right;
};

void read_beside(const Nodes& nodes, const float* map, std::size_t stride, std::size_t count, Beside& beside) {
  const float* const right = map + stride;
  for (std::size_t i = 0; i < count; ++i) {
    beside.left[i] = map[nodes.index[i]];
    beside.right[i] = right[nodes.index[i]];
  }
}

SIGMASCAPE_VECTOR_TARGETS
std::size_t compare(LatticeRow& row, const Nodes& nodes, const Beside& beside) {
  const std::size_t count = row.whole_vectors();
  for (std::size_t i = 0; i < count; ++i) {
    const float steepest = (1.0F - nodes.part[i]) * beside.left[i] + nodes.part[i] * beside.right[i];
    row.horizon[i] = steepest;
    row.lit[i] = row.slope[i] >= steepest - doubt ? 1.0F : 0.0F;
  }
  std::uint32_t lit = 0;
  for (std::size_t i = 0; i < row.count; ++i) lit += row.lit[i] > 0.0F ? 1U : 0U;
  return lit;
}

/// What is left of the ground's light behind obstacles, and of that of what rises above the terrain's horizon.
SIGMASCAPE_VECTOR_TARGETS
void part_lights(LatticeRow& row, const Nodes& nodes, const Beside& solid, const Beside& through) {
  const std::size_t count = row.whole_vectors();
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    // Obstacles are narrower than terrain: their shadows, not their slopes, are shared between azimuths.
    const float slope = row.slope[i] + doubt;
    const float on_left = slope >= solid.left[i] ? through.left[i] : 0.0F;
    const float on_right = slope >= solid.right[i] ? through.right[i] : 0.0F;
    row.ground_lit[i] = row.lit[i] * (on_left + nodes.part[i] * (on_right - on_left));
    const float hidden_m = (row.horizon[i] - row.slope[i]) * row.ground_m[i];
    const float above = greater(1.0F - hidden_m / greater(row.top_m[i], 1e-3F), 0.0F);
    row.lit[i] = row.lit[i] > 0.0F ? 1.0F : above;
  }
}

}  // namespace

std::size_t light(LatticeRow& row, const Horizon& horizon) {
  Nodes nodes;
  Beside beside;
  find_nodes(row, horizon, 0.0F, nodes);
  read_beside(nodes, horizon.slopes, horizon.stride, row.whole_vectors(), beside);
  return compare(row, nodes, beside);
}

void light_apart(LatticeRow& row, const Horizon& horizon) {
  Nodes nodes;
  Beside solid, through;
  find_nodes(row, horizon, 0.5F, nodes);
  read_beside(nodes, horizon.solid_slopes, horizon.stride, row.whole_vectors(), solid);
  read_beside(nodes, horizon.through, horizon.stride, row.whole_vectors(), through);
  part_lights(row, nodes, solid, through);
}

SIGMASCAPE_VECTOR_TARGETS
void join_lights(LatticeRow& row) {
  for (std::size_t i = 0; i < row.count; ++i) {
    row.lit[i] = row.lit[i] + row.ground_area_m2[i] > 0.0F ? 1.0F : 0.0F;
  }
}

}  // namespace sigmascape::live
