#include "sigmascape/receiver/strip_target.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/fourier.h"

namespace sigmascape::receiver {
namespace {

/// Cells of a series beyond those that the target wanders through, for the tails.
constexpr double series_tail_cells = 12.0;
/// What wanders through ranges is shown in so many places of a cell.
constexpr double subbands_a_range_cell = 2.0;
constexpr double most_folds = 1e6;
constexpr double most_wander_cells = 4096.0, most_subbands = 512.0;
/// Points with less than that part of the brightest one's power are left out.
constexpr float least_power = 1e-6F;

/// What the processor makes of a target at one place of its band, from −½ to ½.
struct Believed {
  double along_m = 0.0, closest_range_m = 0.0, voltage = 0.0;
  double turns = 0.0;  ///< of the phase: −2r/λ − (f' + k f_p) t
  TargetPassage seen = {};
};

class StripTarget {
 public:
  StripTarget(const radar::Target& target, const StripProcessing& processing, const StripPattern& pattern)
      : target_(target),
        processing_(processing),
        pattern_(pattern),
        speed_mps_(length(processing.platform.velocity_mps)),
        direction_(normalized(processing.platform.velocity_mps)) {}

  /// The k under which the target is seen nearest to the beam's axis; nothing when it never comes there.
  [[nodiscard]] std::optional<int> plain_fold() const {
    constexpr int most_steps = 8;
    int fold = 0;
    for (int step = 0; step < most_steps; ++step) {
      const auto seen = passage(processing_.sine_at(0.0), fold, 0.0);
      if (!seen) return std::nullopt;
      const double own_rate_mps = dot(seen->target.velocity_mps, seen->away) / seen->range_m;
      const auto next = static_cast<int>(-std::clamp(std::round(own_rate_mps / fold_mps()), -most_folds, most_folds));
      if (next == fold) break;
      fold = next;
    }
    return fold;
  }

  [[nodiscard]] std::optional<Believed> believed(double part_of_band, int fold, double near_s) const {
    const double sine = processing_.sine_at(part_of_band);
    if (!(std::abs(sine) < 1.0)) return std::nullopt;
    const auto seen = passage(sine, fold, near_s);
    if (!seen) return std::nullopt;
    const double closing_mps = closing(sine, fold), cosine2 = 1.0 - sine * sine;
    const double past_mps2 = seen->relative_speed_mps * seen->relative_speed_mps - closing_mps * closing_mps;
    const double along_m = dot(seen->away, direction_);
    const Vec3d across = seen->away - direction_ * along_m;
    const double voltage = std::sqrt(cosine2 * speed_mps_ * speed_mps_ / past_mps2) *
                           pattern_.voltage(along_m / seen->range_m, sine, across.z / length(across));
    return Believed{.along_m = speed_mps_ * seen->time_s + seen->range_m * sine,
                    .closest_range_m = seen->range_m * std::sqrt(cosine2),
                    .voltage = voltage,
                    .turns = -2.0 * (seen->range_m + closing_mps * seen->time_s) / processing_.wavelength_m,
                    .seen = *seen};
  }

  /// Turns of the phase that a point at rest has there.
  [[nodiscard]] double turns_of_rest(double part_of_band, double along_m, double closest_range_m) const {
    const double sine = processing_.sine_at(part_of_band);
    return -2.0 * (closest_range_m * std::sqrt(1.0 - sine * sine) + along_m * sine) / processing_.wavelength_m;
  }

  /// Pulses for which the band sees a point at rest that far away.
  [[nodiscard]] std::size_t pulses(double range_m) const {
    return static_cast<std::size_t>(std::max(1.0, std::round(processing_.pulses_a_metre() * range_m)));
  }
  /// Cells through which the band reaches, of those over which all Doppler spreads a target.
  [[nodiscard]] double band_in_cells(double range_m) const {
    return 0.5 * static_cast<double>(pulses(range_m)) * processing_.band_per_m * speed_mps_ / processing_.repetition_hz;
  }

 private:
  /// By how much closing in differs from fold to fold.
  [[nodiscard]] double fold_mps() const { return 0.5 * processing_.wavelength_m * processing_.repetition_hz; }
  [[nodiscard]] double closing(double sine, int fold) const { return speed_mps_ * sine + fold * fold_mps(); }
  [[nodiscard]] std::optional<TargetPassage> passage(double sine, int fold, double near_s) const {
    return target_passage(target_.track, processing_.platform, closing(sine, fold), near_s);
  }

  const radar::Target& target_;
  const StripProcessing& processing_;
  const StripPattern& pattern_;
  double speed_mps_;
  Vec3d direction_;
};

/// Evenly over the band, the first and last half a step from its ends; nothing where the target has no such Doppler.
using Band = std::vector<std::optional<Believed>>;

double part_of_band(std::size_t sample, std::size_t samples) {
  return (static_cast<double>(sample) + 0.5) / static_cast<double>(samples) - 0.5;
}

Band band_of(const StripTarget& target, int fold, std::size_t samples) {
  Band band(samples);
  double near_s = 0.0;
  for (std::size_t n = 0; n < samples; ++n) {
    band[n] = target.believed(part_of_band(n, samples), fold, near_s);
    if (band[n]) near_s = band[n]->seen.time_s;
  }
  return band;
}

/// By how much a number of all places of a band differs.
double spread(const Band& band, double Believed::*number) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const auto& believed : band) {
    if (!believed || believed->voltage == 0.0) continue;
    least = std::min(least, (*believed).*number);
    most = std::max(most, (*believed).*number);
  }
  return std::max(most - least, 0.0);
}

/// A part of the band about its middle that fades into its neighbours, so that all together are one. Whole where it is
/// the only one.
struct FadingSubband {
  std::size_t number = 0, count = 1;

  [[nodiscard]] double middle() const { return (static_cast<double>(number) + 0.5) / static_cast<double>(count) - 0.5; }
  [[nodiscard]] double weight(double part) const {
    if (count == 1) return 1.0;
    const double steps = (part - middle()) * static_cast<double>(count);
    const bool is_outermost = (number == 0 && steps < 0.0) || (number + 1 == count && steps > 0.0);
    if (is_outermost) return 1.0;
    return std::abs(steps) < 1.0 ? 0.5 + 0.5 * std::cos(pi * steps) : 0.0;
  }
};

/// The points of a sub-band, about one place.
struct Series {
  Believed about = {};
  std::vector<std::complex<float>> points;  ///< as transforms have them: those of negative cells at the end
};

/// Where the processor sees the target in the middle of a sub-band, or nearest to it.
std::optional<Believed> middle_of(const Band& band, const FadingSubband& part) {
  const auto samples = static_cast<double>(band.size());
  const auto middle = static_cast<std::size_t>(std::clamp((part.middle() + 0.5) * samples, 0.0, samples - 1.0));
  for (std::size_t off = 0; off < band.size(); ++off) {
    if (middle >= off && band[middle - off]) return band[middle - off];
    if (middle + off < band.size() && band[middle + off]) return band[middle + off];
  }
  return std::nullopt;
}

/// Turns of the phase by which a place of a squinted strip differs from another one. Images have −2 r_c/λ at every
/// place; a point at rest has that of the middle of the band, −2 (r_c cos φ + s sin φ)/λ.
double turns_beside(const Believed& other, const Believed& about, const StripProcessing& processing) {
  const double along_m = about.along_m - other.along_m, outwards_m = about.closest_range_m - other.closest_range_m;
  return 2.0 * ((1.0 - std::cos(processing.squint_rad)) * outwards_m - std::sin(processing.squint_rad) * along_m) /
         processing.wavelength_m;
}

/// `turns_of_place`: those beside the place of the whole target, so that parts at several places add up.
Series series_of(const StripTarget& target, const Band& band, const FadingSubband& part, const Believed& about,
                 double turns_of_place) {
  const std::size_t samples = band.size();
  std::vector<std::complex<float>> left_over(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const double place = part_of_band(n, samples), weight = part.weight(place);
    if (!band[n] || weight == 0.0) continue;
    const double turns =
        band[n]->turns - target.turns_of_rest(place, about.along_m, about.closest_range_m) + turns_of_place;
    left_over[n] = std::complex<float>(
        std::polar(band[n]->voltage * weight / static_cast<double>(samples), 2.0 * pi * std::remainder(turns, 1.0)));
  }
  Series series{about, std::vector<std::complex<float>>(samples)};
  Fourier(samples, Fourier::Direction::Forward).transform(left_over, series.points);
  return series;
}

/// Adds the points of a series that are bright enough and near enough to its place.
void add_points(const Series& series, double cell_m, double reach_cells, float least, std::vector<StripPart>& parts) {
  const auto samples = std::ssize(series.points);
  for (std::ptrdiff_t k = 0; k < samples; ++k) {
    const std::complex<float> point = series.points[static_cast<std::size_t>(k)];
    const auto cells = static_cast<double>(k <= samples / 2 ? k : k - samples);
    if (std::norm(point) < least || std::abs(cells) > reach_cells) continue;
    // From the first sample to the middle of the band. What grows over the band lies behind.
    const double turns = 0.5 * cells * (1.0 - 1.0 / static_cast<double>(samples));
    parts.push_back({.along_m = series.about.along_m - cells * cell_m,
                     .closest_range_m = series.about.closest_range_m,
                     .amplitude = point * std::complex<float>(std::polar(1.0, 2.0 * pi * turns)),
                     .seen = series.about.seen});
  }
}

/// Multiplies what the processor makes of a target by what it fluctuates.
void fluctuate(Band& band, const radar::Target& target, std::uint64_t dwell, bool by_pulse) {
  for (std::size_t n = 0; n < band.size(); ++n) {
    if (!band[n]) continue;
    const std::uint64_t pulse = by_pulse ? n : 0;
    band[n]->voltage *= std::sqrt(radar::fluctuation(target.fluctuation, target.seed, dwell, pulse));
  }
}

}  // namespace

double StripProcessing::sine_at(double part_of_band) const {
  return std::sin(squint_rad) + 0.5 * wavelength_m * band_per_m * part_of_band;
}

double StripProcessing::pulses_a_metre() const {
  const double cosine = std::cos(squint_rad);
  return repetition_hz * band_per_m * wavelength_m / (2.0 * length(platform.velocity_mps) * cosine * cosine);
}

std::vector<StripPart> strip_parts(const radar::Target& target, const StripProcessing& processing,
                                   const StripPattern& pattern, int order) {
  const StripTarget strip(target, processing, pattern);
  const auto plain = strip.plain_fold();
  if (!plain) return {};
  const int fold = *plain + order;
  constexpr std::size_t at_a_glance = 64;
  const Band glance = band_of(strip, fold, at_a_glance);
  const auto seen = std::ranges::find_if(glance, [](const auto& at) { return at && at->voltage > 0.0; });
  if (seen == glance.end()) return {};

  const double cell_m = 1.0 / processing.band_per_m;
  const double subbands = std::clamp(
      std::ceil(subbands_a_range_cell * spread(glance, &Believed::closest_range_m) / processing.closest_range_cell_m),
      1.0, most_subbands);
  const double wander_cells = std::min(std::ceil(spread(glance, &Believed::along_m) / cell_m), most_wander_cells);
  // What changes from pulse to pulse is spread over all Doppler, of which the processor keeps its band; its ghosts,
  // which are smeared already, have the mean power.
  const bool changes_by_pulse = radar::changes_by_pulse(target.fluctuation), by_pulse = changes_by_pulse && order == 0;
  const double range_m = (*seen)->seen.range_m;
  const std::size_t samples =
      by_pulse ? strip.pulses(range_m)
               : fast_length(static_cast<std::size_t>(2.0 * wander_cells + 4.0 * series_tail_cells * subbands));
  const double reach_cells = by_pulse ? strip.band_in_cells(range_m) : std::numeric_limits<double>::infinity();
  Band band = band_of(strip, fold, samples);
  if (by_pulse || !changes_by_pulse) fluctuate(band, target, processing.dwell, by_pulse);

  const auto whole = middle_of(band, {});
  std::vector<Series> all;
  float brightest = 0.0F;
  for (std::size_t number = 0; number < static_cast<std::size_t>(subbands); ++number) {
    const FadingSubband part{number, static_cast<std::size_t>(subbands)};
    const auto about = middle_of(band, part);
    if (!about || !whole) return {};
    all.push_back(series_of(strip, band, part, *about, turns_beside(*whole, *about, processing)));
    for (const std::complex<float> point : all.back().points) brightest = std::max(brightest, std::norm(point));
  }
  std::vector<StripPart> parts;
  for (const Series& series : all) add_points(series, cell_m, reach_cells, least_power * brightest, parts);
  return parts;
}

}  // namespace sigmascape::receiver
