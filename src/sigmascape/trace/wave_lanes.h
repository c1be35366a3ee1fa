#pragma once

#include "sigmascape/scatter/lanes.h"
#include "sigmascape/trace/path.h"

namespace sigmascape::trace {

/// The waves of sixteen paths at one frequency.
struct WaveLanes {
  scatter::FieldPairLanes fields;
  FloatLanes forward, reverse;

  [[nodiscard]] Wave operator[](std::size_t i) const { return {fields[i], forward[i], reverse[i]}; }
  void set(std::size_t i, const Wave& wave) {
    fields.set(i, wave.fields);
    forward[i] = wave.forward;
    reverse[i] = wave.reverse;
  }
};

/// What directions off the vertices of sixteen paths mean there, as cosine_at and density_at say: `extinction_per_m` is
/// zero on surfaces. Lanes of paths that have no direction get answers of no meaning from all of these.
void weigh_directions(const scatter::ArrivalLanes& at, const FloatLanes& extinction_per_m, const VectorLanes& direction,
                      FloatLanes& cosine, FloatLanes& density);

/// What the radar sends along rays that have come from there: a unit field in either polarization, of any strength of
/// path.
[[nodiscard]] inline Wave transmitted(Vec3f direction) {
  const scatter::PolarizationBasis transmit(direction);
  return {{{transmit.v, {}}, {transmit.h, {}}}, 1.0F, 1.0F};
}
void transmit(const scatter::ArrivalLanes& at, WaveLanes& waves);

/// Takes the density of the vertices, as seen along the rays that have met them, out of the reversed densities.
void arrive(const FloatLanes& density, WaveLanes& waves);

/// Lets the waves leave their vertices: with the fields that `passage` gives them, divided by the square root of the
/// density `pdf` with which their hero drew the directions. `is_hero` tells whether they are the heroes'.
void leave(const scatter::PassageLanes& passage, const FloatLanes& cosine, const FloatLanes& pdf, bool is_hero,
           WaveLanes& waves);

/// The vertices' part of the reversed densities; at the first vertex there is none yet, only the forward one to divide
/// by.
void reverse(const scatter::PassageLanes& passage, const FloatLanes& density, const FloatLanes& pdf, bool is_first,
             WaveLanes& waves);

/// `power` becomes the greater one of itself and what these fields carry.
void raise_to_power_of(const scatter::FieldPairLanes& fields, FloatLanes& power);

/// Chances to go on of paths that carry so much, `per_power` times that between `least` and 1, and by how much the
/// fields of those gain that do.
void chances_in_roulette(const FloatLanes& power, float per_power, float least, FloatLanes& chance, FloatLanes& gain);

void multiply(scatter::FieldPairLanes& fields, const FloatLanes& factor);

}  // namespace sigmascape::trace
