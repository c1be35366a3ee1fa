#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/power_books.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// How paths are weighted that could as well have been found from their other end.
enum class Estimator {
  Reciprocal,  ///< by 2/(1 + q), q the density of the reversed path over its own: no extra rays, far less noise
  OneWay,      ///< by 1: the plain estimator, against which the other is tested
};

/// Where the numbers come from that places and directions are drawn with.
enum class Sampler {
  OwenSobol,    ///< Owen-scrambled Sobol points of every cell
  Independent,  ///< every number by itself: plain sampling, against which the other is measured
};

struct PathOptions {
  int max_bounces = 8;  ///< 1 to most_bounces
  Estimator estimator = Estimator::Reciprocal;
  bool roulette = true;  ///< end dark paths early, without bias
  /// A path goes on in roulette with so many times the part of the power sent that it still carries for its chance. Two
  /// is best for texels of their own, in L1; benchmarks/README.md.
  float survival_per_power = 2.0F;
  Sampler sampler = Sampler::OwenSobol;
  bool power_books = false;  ///< keep account of what becomes of the power: TraceCounts::power
  bool coherent = false;     ///< hand out amplitudes with the echoes: TileEchoes::amplitudes_m
};

/// As many as an Echo can count.
inline constexpr int most_bounces = 255;

/// Throws Error for a greatest number of bounces that is not from 1 to `most_bounces`; `where` says whose it is.
void check_bounces(int max_bounces, const std::string& where);

/// Which of each cell's samples to trace; samples first … first + count − 1 of `of` share the cell's area. Of cells
/// that stand about the target, LaunchCell::share of them are traced.
struct SampleRange {
  std::uint32_t first = 0;
  std::uint32_t count = 16;
  std::uint32_t of = 16;
};

/// Which of a range's samples a cell gets by its share: of every 1 / share one, counted from a place that the seed
/// draws, so that ranges which follow one another share them without a gap. Each then stands for 1 / share as much.
[[nodiscard]] SampleRange samples_for(const LaunchCell& cell, const SampleRange& samples, std::uint64_t seed);

struct TraceCounts {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;
  std::uint64_t echoes = 0;
  PowerBooks power;  ///< empty unless PathOptions::power_books; the same for any threads but for rounding

  TraceCounts& operator+=(const TraceCounts& other) {
    paths += other.paths;
    rays += other.rays;
    echoes += other.echoes;
    power += other.power;
    return *this;
  }
};

/// The scattering models of all of a scene's materials at one frequency, in the scene's order.
[[nodiscard]] std::vector<scatter::SurfaceModel> surface_models(const scene::Scene& scene, double frequency_hz);

/// The scattering models of a scene's materials at several frequencies: [frequency][material].
using SpectralSurfaces = std::vector<std::vector<scatter::SurfaceModel>>;
[[nodiscard]] SpectralSurfaces surface_models(const scene::Scene& scene, std::span<const double> frequencies_hz);

class TilePaths;
struct PathStart;

/// What the paths of one tile bring back at one frequency.
struct TileEchoes {
  std::span<const radar::Echo> echoes;
  /// The square roots of the echoes' cross-sections with their phases, one an echo; none unless PathOptions::coherent.
  /// The phase of the way, exp(−j 4π range / λ), is left to the receiver. Every echo is one sample of many: those whose
  /// phases differ at random add up to the right mean power, those in step (a smooth mirror) do not, for their sum
  /// grows with the number of samples. docs/physics/estimator.md, Eq. (10).
  std::span<const radar::ComplexChannels> amplitudes_m;
  std::size_t frequency = 0;  ///< its place in the tracer's surfaces
  unsigned worker = 0;        ///< number of the calling thread
  /// The paths one by one, for who wants to know which brought what: `paths->echoes(frequency, k)` of start k.
  std::span<const PathStart> starts = {};
  const TilePaths* paths = nullptr;
  bool completes_tile = true;  ///< nothing more comes of this tile and frequency
};

/// Takes the echoes of one tile, one frequency after another, of many samples part by part; called from several threads
/// at once.
using TileSink = std::function<void(const TileEchoes& tile)>;
/// The same for a tracer of one frequency; one of several gives their echoes without telling them apart.
using EchoSink = std::function<void(std::span<const radar::Echo>, unsigned worker)>;

/// A sample to follow: number `sample` of the sequence `sequence` of a cell. Sequences of a cell are scrambled
/// independently of one another.
struct PathStart {
  LaunchCell cell;
  std::uint32_t sequence = 0;
  std::uint32_t sample = 0;
};

/// One tile for the user to trace as he sees fit: as many samples of each cell as it turns out to need.
class TilePaths {
 public:
  virtual ~TilePaths() = default;
  [[nodiscard]] virtual std::span<const LaunchCell> cells() const = 0;
  /// Follows all these paths; many together are faster than one by one. What they bring takes the place of what those
  /// before brought.
  virtual void follow(std::span<const PathStart> starts) = 0;
  /// The echoes of start number `start` of those followed, each as though its sample stood for the whole cell, whatever
  /// the cell's share.
  [[nodiscard]] virtual std::span<const radar::Echo> echoes(std::size_t frequency, std::size_t start) const = 0;
  /// As TileEchoes::amplitudes_m, of the same start.
  [[nodiscard]] virtual std::span<const radar::ComplexChannels> amplitudes_m(std::size_t frequency,
                                                                             std::size_t start) const = 0;
};

/// What is done with a tile; called from several threads at once, `worker` tells them apart.
using TileBody = std::function<void(TilePaths& tile, unsigned worker)>;

/// Scene and viewpoint to echoes: the path tracer.
///
/// Rays are aimed at Owen-scrambled Sobol points of every launch cell. Where a path meets a surface that sees the
/// radar, it returns an echo of cross-section
///
///     4π w |S_pq|²            first surface                         docs/physics/estimator.md, Eq. (1)
///     4π w ½ |(S + Sᵀ)_pq|²   later ones, for the path and its reversal add coherently in monostatic geometry   Eq.
///     (4)
///
/// at half the length of the way and the mean cross position of the two ends. The draw of every path depends on seed,
/// cell and sample alone.
///
/// Several frequencies share one set of paths: each path is drawn from the densities of one of them and weighted by the
/// mean density of all, so that each frequency has the mean that it has alone (Eq. 9). The rays are those of one.
class PathTracer {
 public:
  /// For one frequency. Both throw Error for options that check_bounces refuses.
  PathTracer(const SceneGeometry& geometry, std::vector<scatter::SurfaceModel> surfaces, const Viewpoint& viewpoint,
             const PathOptions& options, std::uint64_t seed);
  /// For all frequencies of `surfaces`, of which there is one at least.
  PathTracer(const SceneGeometry& geometry, SpectralSurfaces surfaces, const Viewpoint& viewpoint,
             const PathOptions& options, std::uint64_t seed);

  /// Traces the given samples of every cell of the area and hands the echoes to `sink`, tile by tile in any order.
  TraceCounts trace(const LaunchArea& area, SampleRange samples, unsigned threads, const EchoSink& sink) const;
  TraceCounts trace(const LaunchArea& area, SampleRange samples, unsigned threads, const TileSink& sink) const;
  /// The same of some of the area's cells alone, which go together in tiles as they follow one another.
  TraceCounts trace(const LaunchArea& area, std::span<const LaunchCell> cells, SampleRange samples, unsigned threads,
                    const TileSink& sink) const;
  /// Calls `body` for every tile of the area.
  TraceCounts trace_tiles(const LaunchArea& area, unsigned threads, const TileBody& body) const;

  [[nodiscard]] std::size_t frequencies() const { return surfaces_.size(); }

 private:
  TraceCounts trace_tiles(const LaunchArea& area, std::span<const LaunchCell> cells, unsigned threads,
                          const TileBody& body) const;

  const SceneGeometry* geometry_;
  SpectralSurfaces surfaces_;
  Viewpoint viewpoint_;
  PathOptions options_;
  std::uint64_t seed_;
};

}  // namespace sigmascape::trace
