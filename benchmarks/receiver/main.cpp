// What the receiver costs, in processor time of one thread: 10,000 targets a frame, scatterers of the lattice, complex
// bins beside the fixed-point bins of the power mode, and focused images.
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

#include "figures.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/radar/window_response.h"
#include "sigmascape/receiver/coherent_bins.h"
#include "sigmascape/receiver/power_bins.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/response_plane.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/receiver/target_frame.h"

namespace {

using namespace sigmascape;  // NOLINT: a program of its own
using bench::Figures;
using bench::prove;

/// Best processor time of several runs, in seconds.
template <typename Work>
double seconds_of(const Work& work) {
  double best = 1e30;
  for (int run = 0; run < 7; ++run) {
    const double start_s = bench::processor_seconds();
    work();
    best = std::min(best, bench::processor_seconds() - start_s);
  }
  return best;
}

double unit(std::uint64_t i, int dimension) {
  return unit_float(hashed(i, dimension));
}

std::vector<radar::Target> moving_targets() {
  std::vector<radar::Target> targets;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    radar::Target target;
    target.track = radar::Track::straight({unit(i, 0) * 10'000.0 - 5000.0, unit(i, 1) * 10'000.0, 0.0},
                                          {unit(i, 2) * 20.0, unit(i, 3) * 20.0, 0.0});
    target.rcs_m2 = radar::Channels{10.0F, 10.0F, 0.0F, 10.0F};
    target.fluctuation = i % 2 == 0 ? radar::Swerling::Case1 : radar::Swerling::Case0;
    target.seed = i;
    targets.push_back(target);
  }
  return targets;
}

void measure_targets(Figures& figures) {
  radar::Radar radar;
  radar.position = {0.0, -20'000.0, 5000.0};
  // A frame of about 1000 ranges by 500 azimuths.
  radar.range_resolution_m = 20.0;
  radar.beam_width_rad = 0.003;
  const std::vector<radar::Target> targets = moving_targets();
  const std::vector<Vec3d> corners{
      {-5000.0, 0.0, 0.0}, {5000.0, 0.0, 0.0}, {-5000.0, 10'000.0, 0.0}, {5000.0, 10'000.0, 0.0}};
  const auto first = receiver::target_echoes(targets, radar, {0.0, 0, 0});
  prove(first.size() == targets.size(), "every target echoes once a frame");
  receiver::RangeAzimuthReceiver receiver(radar, receiver::grid_covering(radar, corners));
  std::uint64_t frame = 0;
  figures.add("receiver.targets.echoes",
              1e3 * seconds_of([&] {
                (void)receiver::target_echoes(targets, radar, {0.1 * static_cast<double>(frame), frame++, 0});
              }),
              "ms");
  figures.add("receiver.targets.power_map", 1e3 * seconds_of([&] {
                                              receiver.add(receiver::target_echoes(targets, radar, {0.1, frame++, 0}));
                                            }),
              "ms");
}

/// A response of Taylor's window at two bins a cell in range, and of a Gaussian beam across.
receiver::TargetFrameBins with_responses(receiver::TargetFrameBins bins) {
  const radar::WindowResponse pulse(radar::Window{});
  const double cells_a_bin = pulse.half_power_width() / 2.0;
  bins.along = receiver::PointResponse::of([&](double offset) { return pulse.voltage(offset * cells_a_bin); });
  bins.across = receiver::PointResponse::of([](double offset) { return std::exp2(-0.25 * offset * offset); });
  return bins;
}

void measure_live_targets(Figures& figures) {
  const std::vector<radar::Target> targets = moving_targets();
  const receiver::TargetFrameBins plain{.beams = 512, .ranges = 512, .beam_step_rad = 1e-3, .range_step_m = 20.0};
  const receiver::TargetFramePose pose{
      .position = {0.0, -20'000.0, 5000.0}, .first_azimuth_rad = -0.256, .first_range_m = 20'400.0};
  for (const bool responses : {false, true}) {
    const receiver::TargetFrameBins bins = responses ? with_responses(plain) : plain;
    const std::string how =
        responses ? fmt::format("response_of_{}_by_{}", bins.across.taps(), bins.along.taps()) : "shared";
    receiver::TargetFrame frame(bins);
    std::vector<float> powers(4 * bins.beams * bins.ranges);
    std::vector<std::complex<float>> amplitudes(4 * bins.beams * bins.ranges);
    frame.look(targets, pose, {0.0, 0, 0});
    prove(frame.seen() > 0 && frame.seen() <= targets.size(), "a frame sees some targets and none twice");
    std::uint64_t number = 0;
    const auto look = [&] { frame.look(targets, pose, {0.1 * static_cast<double>(number), number++, 0}); };
    figures.add("receiver.live_targets.look." + how, 1e3 * seconds_of(look), "ms");
    figures.add("receiver.live_targets.powers." + how, 1e3 * seconds_of([&] {
                                                         look();
                                                         frame.tell_apart(0, bins.beams);
                                                         frame.add_powers(0, bins.beams, powers);
                                                       }),
                "ms");
    figures.add("receiver.live_targets.iq." + how, 1e3 * seconds_of([&] {
                                                     look();
                                                     frame.tell_apart(0, bins.beams);
                                                     frame.add_amplitudes(0, bins.beams, amplitudes);
                                                   }),
                "ms");
  }
}

void measure_lattice(Figures& figures) {
  constexpr std::size_t count = 1 << 20, row = 1024;
  std::vector<std::int32_t> columns(count), rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    columns[i] = static_cast<std::int32_t>(i % row);
    rows[i] = static_cast<std::int32_t>(i / row);
  }
  std::vector<float> re(row), im(row);
  for (const int levels : {1, 2, 4, 8}) {
    const radar::ScattererLattice lattice({.seed = 1, .cell_m = 1.0, .levels = levels});
    const double seconds = seconds_of([&] {
      for (std::size_t i = 0; i < count; i += row) {
        lattice.values_of({&columns[i], row}, {&rows[i], row}, 0, radar::Draw::First, re, im);
      }
    });
    figures.add(fmt::format("receiver.scatterer.{}_levels", levels), 1e9 * seconds / count, "ns");
  }
  const radar::ScattererLattice lattice({.seed = 1, .cell_m = 1.0, .levels = 8});
  std::vector<radar::ComplexPair> block;
  lattice.block({0, 0}, 0, 7, radar::Draw::First, block);
  double power = 0.0;
  for (const radar::ComplexPair& value : block) power += value.re * value.re + value.im * value.im;
  // Of exponentially distributed powers, of which levels tie some together: as sure as a tenth of their number, at
  // least.
  const auto values = static_cast<double>(block.size());
  prove(std::abs(power / values - 1.0) < 5.0 / std::sqrt(0.1 * values), "scatterers have unit mean power");
  figures.add("receiver.scatterer.8_levels_block", 1e9 * seconds_of([&] {
                                                     lattice.block({0, 0}, 0, 7, radar::Draw::First, block);
                                                   }) / (128.0 * 128.0),
              "ns");
}

void measure_bins(Figures& figures) {
  constexpr std::size_t count = 1 << 19, side = 1024;
  std::vector<receiver::PlacedAmplitude> placed;
  for (std::uint64_t i = 0; i < count; ++i) {
    placed.push_back(
        {1.0 + unit(i, 0) * (side - 2.0), 1.0 + unit(i, 1) * (side - 2.0), {{1.0F, 0.5F}, {0.3F, 0.1F}, {0.1F, 0.0F}}});
  }
  double all_m2 = 0.0;
  receiver::PowerBins proof(side, side);
  for (const auto& echo : placed) {
    const radar::Channels rcs_m2 = radar::power_of(echo.amplitude);
    all_m2 += rcs_m2.vv;
    proof.add_shared(echo.column, echo.row, rcs_m2);
  }
  prove(std::abs(proof.total()[0] / all_m2 - 1.0) < 1e-4, "fixed-point bins keep the power of all echoes");
  receiver::CoherentBins coherent(side, side);
  figures.add("receiver.complex_bins.echo", 1e9 * seconds_of([&] { coherent.add(placed, 1); }) / count, "ns");
  receiver::PowerBins power(side, side);
  figures.add("receiver.power_bins.echo", 1e9 * seconds_of([&] {
                                            for (const auto& echo : placed)
                                              power.add_shared(echo.column, echo.row, radar::power_of(echo.amplitude));
                                          }) / count,
              "ns");
  const receiver::ResponseAxis axis{.bins = side, .band = 511, .window = {}, .periodic = true};
  receiver::ResponsePlane plane(axis, axis);
  figures.add("receiver.responses.point", 1e9 * seconds_of([&] { plane.add(placed, 1); }) / count, "ns");
  figures.add("receiver.responses.image", 1e3 * seconds_of([&] { (void)plane.bins({}, 1); }), "ms");
}

}  // namespace

int main(int count, char** words) {
  const auto arguments = bench::Arguments::parsed(count, words);
  Figures figures(arguments.out);
  measure_targets(figures);
  measure_live_targets(figures);
  measure_lattice(figures);
  measure_bins(figures);
}
