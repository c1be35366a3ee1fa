#include "sigmascape/trace/wave_lanes.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::trace {

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void weigh_directions(const scatter::ArrivalLanes& at,
                                                                 const FloatLanes& extinction_per_m,
                                                                 const VectorLanes& direction, FloatLanes& cosine,
                                                                 FloatLanes& density) {
  for (std::size_t i = 0; i < lane_count; ++i) {
    const float upwards = dot(direction[i], at.normal[i]), extinction = extinction_per_m[i];
    cosine[i] = extinction > 0.0F ? 1.0F : upwards;
    density[i] = extinction > 0.0F ? extinction : upwards;
  }
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void transmit(const scatter::ArrivalLanes& at, WaveLanes& waves) {
  for (std::size_t i = 0; i < lane_count; ++i) waves.set(i, transmitted(-at.to_source[i]));
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void arrive(const FloatLanes& density, WaveLanes& waves) {
  for (std::size_t i = 0; i < lane_count; ++i) waves.reverse[i] /= std::abs(density[i]);
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void leave(const scatter::PassageLanes& passage, const FloatLanes& cosine,
                                                      const FloatLanes& pdf, bool is_hero, WaveLanes& waves) {
  for (std::size_t i = 0; i < lane_count; ++i) {
    waves.fields.set(i, passage.fields[i] * std::sqrt(cosine[i] / pdf[i]));
  }
  if (is_hero) return;
  for (std::size_t i = 0; i < lane_count; ++i) waves.forward[i] *= passage.pdf[i] / pdf[i];
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void reverse(const scatter::PassageLanes& passage, const FloatLanes& density,
                                                        const FloatLanes& pdf, bool is_first, WaveLanes& waves) {
  for (std::size_t i = 0; i < lane_count; ++i) {
    const float so_far = is_first ? waves.reverse[i] : waves.reverse[i] * passage.reverse_pdf[i];
    waves.reverse[i] = so_far * (density[i] / pdf[i]);
  }
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void raise_to_power_of(const scatter::FieldPairLanes& fields,
                                                                  FloatLanes& power) {
  for (std::size_t i = 0; i < lane_count; ++i) power[i] = std::max(power[i], fields[i].mean_power());
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void chances_in_roulette(const FloatLanes& power, float per_power,
                                                                    float least, FloatLanes& chance, FloatLanes& gain) {
  for (std::size_t i = 0; i < lane_count; ++i) {
    chance[i] = std::min(std::max(per_power * power[i], least), 1.0F);
    gain[i] = 1.0F / std::sqrt(chance[i]);
  }
}

SIGMASCAPE_VECTOR_TARGETS [[gnu::flatten]] void multiply(scatter::FieldPairLanes& fields, const FloatLanes& factor) {
  for (std::size_t i = 0; i < lane_count; ++i) fields.set(i, fields[i] * factor[i]);
}

}  // namespace sigmascape::trace
