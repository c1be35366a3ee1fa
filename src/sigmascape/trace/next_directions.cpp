#include <algorithm>
#include <cmath>

#include "sigmascape/trace/tile_tracer.h"
#include "sigmascape/trace/vertex.h"

namespace sigmascape::trace {
namespace {

/// A path goes on with the chance of the part of the power sent that it still carries, but with no less than this. On
/// the paper's scene four times the part and no less than a tenth took up to half more time for hardly less noise in
/// the median texel, and about the same in L1 at equal time.
constexpr float least_survival = 0.05F;

constexpr float least_cosine = 1e-6F;

}  // namespace

void TileTracer::carry_on(int bounce) {
  for_each_company([&](const Company& company) { carry_on(company, bounce); });
  std::erase_if(living_, [&](std::uint32_t path) { return !paths_[path].is_alive; });
}

void TileTracer::carry_on(const Company& company, int bounce) {
  VectorLanes directions;
  surfaces_[company.hero][company.material].sample(
      company.at, drawn_pairs(company.points, static_cast<std::uint32_t>(bounce)), directions);
  const auto first_dimension = static_cast<std::uint32_t>(bounce) * DimensionsPerVertex;
  const PairLanes draws = phase_draws(company, first_dimension + PhaseA);
  for (std::size_t f = 0; f < frequencies_; ++f) {
    gather_fields(company, f);
    surfaces_[f][company.material].pass_on(fields_, company.at, directions, draws, passages_[f]);
  }
  FloatLanes lots;
  draw_independent(company.points, first_dimension + RouletteChoice, lots);
  for (std::size_t lane = 0; lane < company.paths.size(); ++lane) {
    Path& path = paths_[company.paths[lane]];
    path.is_alive = carry_on(path, lane, directions[lane], lots[lane], bounce);
  }
}

bool TileTracer::carry_on(Path& path, std::size_t lane, Vec3f direction, float lot, int bounce) {
  const float pdf = passages_[path.hero].pdf[lane], cosine = cosine_at(path.hit, direction);
  if (pdf <= 0.0F || cosine <= least_cosine) return false;
  const std::span<Wave> waves = waves_of(path);
  for (std::size_t f = 0; f < frequencies_; ++f) {
    Wave& wave = waves[f];
    wave.fields = passages_[f].fields[lane] * std::sqrt(cosine / pdf);
    if (options_.coherent) wave.fields = wave.fields.turned(roughness_phasor(path, f, bounce));
    if (f != path.hero) wave.forward *= passages_[f].pdf[lane] / pdf;
  }
  if (!survives_roulette(waves, lot)) return false;
  for (std::size_t f = 0; f < frequencies_; ++f) {
    // The vertex's part of the reversed density: at the first vertex there is none yet, only the forward one to divide
    // by.
    if (bounce > 1) waves[f].reverse *= passages_[f].reverse_pdf[lane];
    waves[f].reverse *= density_at(path.hit, direction) / pdf;
  }
  path.ray = {start_from(path.hit), direction};
  return true;
}

bool TileTracer::survives_roulette(std::span<Wave> waves, float u) {
  const float power = greatest_power(waves);
  if (power <= 0.0F) return false;
  if (!options_.roulette) return true;
  const float survival = std::clamp(power, least_survival, 1.0F);
  const double before = books_.keeps_books() ? Bookkeeper::carried(waves) : 0.0;
  const bool survives = u < survival;
  if (survives) {
    for (Wave& wave : waves) wave.fields = wave.fields * (1.0F / std::sqrt(survival));
  }
  if (books_.keeps_books()) books_.meets_roulette(before, survives ? Bookkeeper::carried(waves) : 0.0);
  return survives;
}

}  // namespace sigmascape::trace
