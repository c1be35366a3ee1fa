#include <array>

#include "sigmascape/trace/tile_tracer.h"
#include "sigmascape/trace/vertex.h"

namespace sigmascape::trace {
namespace {

/// No chance in roulette is less.
constexpr float least_survival = 0.05F;

constexpr float least_cosine = 1e-6F;

}  // namespace

void TileTracer::carry_on(const Company& company, int bounce) {
  PairLanes pairs;
  draw_pairs_for(company.points, static_cast<std::uint32_t>(bounce), pairs);
  VectorLanes directions;
  surfaces_[company.hero][company.material].sample(company.at, pairs, directions);
  const auto first_dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
  PairLanes draws;
  draw_phases(company, first_dimension + PhaseA, draws);
  for (std::size_t f = 0; f < frequencies_; ++f)
    surfaces_[f][company.material].pass_on(lanes_[f].fields, company.at, directions, draws, passages_[f]);
  weigh_directions(company.at, company.extinction_per_m, directions, cosine_, density_);
  leave(company, bounce);

  FloatLanes lots, chances, gains;
  draw_independent(company.points, first_dimension + RouletteChoice, lots);
  chances_in_roulette(power_, options_.survival_per_power, options_.roulette ? least_survival : 1.0F, chances, gains);
  const FloatLanes& pdf = passages_[company.hero].pdf;
  std::array<bool, lane_count> lives{};
  for (std::size_t lane = 0; lane < company.count(); ++lane) {
    lives[lane] = pdf[lane] > 0.0F && cosine_[lane] > least_cosine && power_[lane] > 0.0F &&
                  survives_roulette(lane, chances[lane], lots[lane]);
  }
  for (std::size_t f = 0; f < frequencies_; ++f) {
    multiply(lanes_[f].fields, gains);
    reverse(passages_[f], density_, pdf, bounce == 1, lanes_[f]);
  }
  for (std::size_t lane = 0; lane < company.count(); ++lane) {
    if (lives[lane]) begin_leg(company.legs[lane], lane, directions[lane], bounce);
  }
}

void TileTracer::begin_leg(std::size_t leg, std::size_t lane, Vec3f direction, int bounce) {
  next_.rays.push_back({start_from(hits_[leg]), direction});
  Leg& next = next_.legs.emplace_back(now_.legs[leg]);
  if (bounce > 1) next.travelled_m = travelled_after(leg);
  for (const WaveLanes& waves : lanes_) next_.waves.push_back(waves[lane]);
}

void TileTracer::leave(const Company& company, int bounce) {
  power_ = {};
  for (std::size_t f = 0; f < frequencies_; ++f) {
    WaveLanes& waves = lanes_[f];
    trace::leave(passages_[f], cosine_, passages_[company.hero].pdf, f == company.hero, waves);
    for (std::size_t lane = 0; options_.coherent && lane < company.count(); ++lane) {
      const auto phasor = roughness_phasor(company.legs[lane], f, bounce);
      waves.fields.set(lane, waves.fields[lane].turned(phasor));
    }
    raise_to_power_of(waves.fields, power_);
  }
  for (std::size_t lane = 0; frequencies_ > 1 && lane < lane_count; ++lane) power_[lane] /= mean_forward(lane);
}

float TileTracer::mean_forward(std::size_t lane) const {
  if (frequencies_ == 1) return 1.0F;
  float sum = 0.0F;
  for (const WaveLanes& waves : lanes_) sum += waves.forward[lane];
  return sum / static_cast<float>(frequencies_);
}

bool TileTracer::survives_roulette(std::size_t lane, float chance, float lot) {
  const bool survives = lot < chance;
  if (books_.keeps_books()) {
    double before = 0.0, density = 0.0;
    for (const WaveLanes& waves : lanes_) {
      before += static_cast<double>(waves.fields[lane].mean_power());
      density += static_cast<double>(waves.forward[lane]);
    }
    before /= density;
    books_.meets_roulette(before, survives ? before / static_cast<double>(chance) : 0.0);
  }
  return survives;
}

}  // namespace sigmascape::trace
