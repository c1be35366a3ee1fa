#include "sigmascape/simulate/traced_scatterers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/carrier_phase.h"

namespace sigmascape::simulate {
namespace {

/// The scatterers of cells side by side in a row.
class ScattererRow {
 public:
  ScattererRow(const ScattererView& view, radar::LatticeCell first, std::size_t count)
      : columns_(count), rows_(count, first.row), x_m_(count), y_m_(count) {
    for (std::size_t i = 0; i < count; ++i) columns_[i] = first.column + static_cast<std::int32_t>(i);
    view.lattice.positions_of(first, view.level, x_m_, y_m_);
    using radar::Draw;
    for (const Draw which : {Draw::First, Draw::Second, Draw::Third}) {
      auto& [re, im] = drawn_[static_cast<std::size_t>(which)];
      re.resize(count);
      im.resize(count);
      view.lattice.values_of(columns_, rows_, view.level, which, re, im);
    }
  }

  [[nodiscard]] Vec2d place(std::size_t i) const { return {x_m_[i], y_m_[i]}; }
  [[nodiscard]] radar::DrawnCell drawn(std::size_t i) const {
    const auto value = [&](std::size_t which) { return radar::ComplexPair{drawn_[which][0][i], drawn_[which][1][i]}; };
    return {value(0), value(1), value(2)};
  }

 private:
  std::vector<std::int32_t> columns_, rows_;
  std::vector<double> x_m_, y_m_;
  std::array<std::array<std::vector<float>, 2>, 3> drawn_;  // [draw][re, im]
};

/// Bins of amplitudes, in which a scatterer is shared between four.
class AmplitudeBins {
 public:
  AmplitudeBins(const TracedView& view, std::span<std::complex<float>> amplitudes_m)
      : grid_(view.bins),
        goes_round_(view.bins.goes_round()),
        first_beam_(static_cast<std::ptrdiff_t>(view.first_beam)),
        end_beam_(static_cast<std::ptrdiff_t>(view.first_beam + view.beams)),
        amplitudes_m_(amplitudes_m) {}

  void add(LatticeSums::Place place, const radar::ComplexChannels& amplitude) {
    const double beam = std::floor(place.beam - 0.5), range = std::floor(place.range - 0.5);
    const double next_beam = place.beam - 0.5 - beam, next_range = place.range - 0.5 - range;
    for (const int across : {0, 1}) {
      for (const int along : {0, 1}) {
        const double share = (across == 1 ? next_beam : 1.0 - next_beam) * (along == 1 ? next_range : 1.0 - next_range);
        add_to(static_cast<std::ptrdiff_t>(beam) + across, static_cast<std::ptrdiff_t>(range) + along,
               amplitude * static_cast<float>(std::sqrt(share)));
      }
    }
  }

 private:
  void add_to(std::ptrdiff_t beam, std::ptrdiff_t range, const radar::ComplexChannels& amplitude) {
    const auto beams = static_cast<std::ptrdiff_t>(grid_.azimuths), ranges = static_cast<std::ptrdiff_t>(grid_.ranges);
    if (goes_round_) beam = (beam % beams + beams) % beams;
    if (beam < first_beam_ || beam >= end_beam_ || range < 0 || range >= ranges) return;
    auto* const bin = &amplitudes_m_[static_cast<std::size_t>((beam * ranges + range) * 4)];
    bin[0] += amplitude.vv;
    bin[1] += amplitude.hh;
    bin[2] += amplitude.hv;
    bin[3] += amplitude.hv;
  }

  const radar::RangeAzimuthGrid& grid_;
  bool goes_round_;
  std::ptrdiff_t first_beam_, end_beam_;
  std::span<std::complex<float>> amplitudes_m_;
};

}  // namespace

void add_scatterers(const TracedGround& ground, const ScattererView& view,
                    std::span<std::complex<float>> amplitudes_m) {
  const terrain::HeightField& terrain = ground.view().scene.terrain;
  AmplitudeBins bins(ground.view(), amplitudes_m);
  const double of_one_pass = 1.0 / static_cast<double>(ground.bins().passes());
  const auto add_run = [&](radar::LatticeCell first, std::span<const LatticeSums::Sum> sums) {
    const auto is_dark = [](const LatticeSums::Sum& sum) { return sum.rcs_m2 == radar::Channels{}; };
    if (std::ranges::all_of(sums, is_dark)) return;
    const ScattererRow scatterers(view, first, sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const LatticeSums::Sum& sum = sums[i];
      if (is_dark(sum)) continue;
      const Vec2d place = scatterers.place(i);
      const double distance_m = std::hypot(place.x - view.radar.x, place.y - view.radar.y);
      const double range_m = view.earth.slant_range_m(view.radar.z, terrain.height_at(place), distance_m);
      const LatticeSums::Place middle = ground.middle_of({first.column + static_cast<std::int32_t>(i), first.row});
      bins.add({middle.beam + sum.place.beam, middle.range + sum.place.range},
               radar::polarized(scatterers.drawn(i), sum.rcs_m2) *
                   receiver::carrier_phase(range_m, wavelength_m(view.frequency_hz)));
    }
  };
  ground.cells().for_each_run(of_one_pass, add_run);
}

}  // namespace sigmascape::simulate
