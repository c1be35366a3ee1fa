#include "sigmascape/receiver/stripmap_imager.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/range_cell.h"
#include "sigmascape/radar/window_response.h"
#include "sigmascape/receiver/carrier_phase.h"

namespace sigmascape::receiver {
namespace {

radar::Motion moving(const radar::Motion& platform) {
  if (!(length(platform.velocity_mps) > 0.0)) {
    throw Error("stripmap", "the platform does not move", "give it a velocity along the strip");
  }
  return platform;
}

/// Cycles a metre along the flight that the processor keeps.
double band_per_m(const Strip& strip) {
  return radar::WindowResponse(strip.window).half_power_width() / strip.resolution_m;
}

GatedAxis along_axis(const Strip& strip) {
  if (!(strip.last_along_m > strip.first_along_m) || !(strip.resolution_m > 0.0) || !(strip.oversampling >= 1.0) ||
      !(std::abs(strip.squint_rad) < pi / 2.0)) {
    throw Error(
        "strip",
        fmt::format("goes from {} m to {} m at {} m resolution, {} bins a cell and {:.1f}° squint", strip.first_along_m,
                    strip.last_along_m, strip.resolution_m, strip.oversampling, deg_from_radians(strip.squint_rad)),
        "let it end beyond where it begins, with positive resolution, at least one bin a cell and less than 90° "
        "of squint");
  }
  return guarded_axis(strip.first_along_m, strip.last_along_m, 1.0 / band_per_m(strip), strip.oversampling,
                      strip.window);
}

/// Of closest ranges, by cos φ of which slant ranges differ.
GatedAxis closest_range_axis(radar::Radar radar, const RangeGate& gate, double squint_rad) {
  radar.range_resolution_m *= std::cos(squint_rad);
  return gated_axis(radar, gate);
}

/// Along level ground, so far below the track, to what has this closest range.
double over_ground_m(double closest_m, double height_m) {
  return std::sqrt(std::max(closest_m * closest_m - height_m * height_m, 0.0));
}

radar::ImageAxis image_axis(const GatedAxis& axis) {
  return {axis.start_m + static_cast<double>(axis.guard) * axis.step_m, axis.step_m, axis.samples};
}

}  // namespace

/// What the beam sees of a point as it passes it, and where a point at rest would look the same.
struct StripmapImager::Seen {
  double time_s = 0.0, range_m = 0.0, along_m = 0.0, closest_range_m = 0.0;
};

/// Sines of the angle ahead of broadside at which a point is seen and of that at which its folded Doppler makes the
/// processor believe it, and the window there over its r.m.s. value.
struct StripmapImager::Fold {
  double observed = 0.0, processed = 0.0, window = 1.0;
};

StripmapImager::StripmapImager(const radar::Radar& radar, const radar::Motion& platform, const Strip& strip,
                               const RangeGate& gate, VoltageGain gain)
    : strip_(strip),
      along_(along_axis(strip)),
      range_(closest_range_axis(radar, gate, strip.squint_rad)),
      gain_(std::move(gain)),
      speed_mps_(length(moving(platform).velocity_mps)),
      band_per_m_(band_per_m(strip)),
      repetition_hz_(radar.waveform.pulse_repetition_hz),
      direction_(normalized(platform.velocity_mps)),
      pattern_(radar::antenna_pattern(radar).azimuth(), strip.squint_rad, strip.looks_left),
      response_(strip.window),
      window_terms_(radar::cosine_terms(strip.window)),
      plane_(along_.axis, range_.axis) {
  frame_.platform = platform;
  frame_.squint_rad = strip.squint_rad;
  frame_.frequency_hz = radar.frequency_hz;
  frame_.along_m = image_axis(along_);
  frame_.closest_range_m = image_axis(range_);
  frame_.closest_range_cell_m = radar::range_cell_m(range_.bandwidth_hz, radar.waveform.window);
  frame_.along_cell_m = radar::WindowResponse(strip.window).noise_bandwidth() / band_per_m(strip);
  const double band_hz = band_per_m_ * speed_mps_;
  if (band_hz > repetition_hz_ * (1.0 + 1e-9)) {
    throw Error(
        "stripmap",
        fmt::format("processes a Doppler band of {:.4g} Hz, wider than the pulse repetition frequency of {:g} Hz",
                    band_hz, repetition_hz_),
        "send more pulses or ask for a coarser resolution along the flight");
  }
  const double near_m = nearest_ground_m() / std::cos(strip.squint_rad),
               pulses = processing().pulses_a_metre() * near_m;
  if (!(pulses >= 2.0)) {
    throw Error(
        "stripmap",
        fmt::format("processes {:.2g} pulses of what is {:.0f} m away, at a pulse repetition frequency of {:g} Hz",
                    pulses, near_m, repetition_hz_),
        fmt::format("send at least {:.3g} a second", 2.0 / pulses * repetition_hz_));
  }
}

/// As the platform passes a place of the strip.
double StripmapImager::height_over_ground_m(double along_m) const {
  return std::abs(frame_.platform.position.z + direction_.z * along_m - strip_.ground_m);
}

double StripmapImager::height_over_middle_m() const {
  return height_over_ground_m(0.5 * (strip_.first_along_m + strip_.last_along_m));
}

/// The gate may open before any ground answers.
double StripmapImager::nearest_ground_m() const {
  const double lowest_m =
      std::min(height_over_ground_m(strip_.first_along_m), height_over_ground_m(strip_.last_along_m));
  return std::max(frame_.closest_range_m.first, lowest_m - strip_.relief_m);
}

StripProcessing StripmapImager::processing() const {
  return {.platform = frame_.platform,
          .wavelength_m = wavelength_m(frame_.frequency_hz),
          .repetition_hz = repetition_hz_,
          .squint_rad = strip_.squint_rad,
          .band_per_m = band_per_m_,
          .closest_range_cell_m = frame_.closest_range_cell_m,
          .dwell = strip_.dwell};
}

StripmapImager::Fold StripmapImager::unfolded() const {
  const double sine = std::sin(strip_.squint_rad);
  return {sine, sine, 1.0};
}

/// `part_of_band`: from −½ to ½ of the processed Doppler band. docs/physics/doppler.md, Eq. (13).
StripmapImager::Fold StripmapImager::fold_of(int order, double part_of_band) const {
  const double processed = processing().sine_at(part_of_band);
  const double folded = order * wavelength_m(frame_.frequency_hz) * repetition_hz_ / (2.0 * speed_mps_);
  double window = 0.0;
  for (const radar::CosineTerm& term : window_terms_)
    window += term.amplitude * std::cos(2.0 * pi * term.cycles * part_of_band);
  // The window has a mean of one, so that its mean square is its noise bandwidth.
  return {processed + folded, processed, window / std::sqrt(response_.noise_bandwidth())};
}

/// Of what stands still, under the window. docs/physics/doppler.md, Eq. (14).
double StripmapImager::ghost_voltage(const Fold& fold, double sine_depression) const {
  return fold.window * pattern_.voltage(fold.observed, fold.processed, sine_depression);
}

/// Of the ground that is passed at this range.
double StripmapImager::sine_depression_at(double closest_m) const {
  return std::min(0.99, height_over_middle_m() / closest_m);
}

/// By how much the processor that evens out the pattern over its band raises the noise there, whose power has the
/// window alone: the mean of w²/g⁴ over that of w². docs/physics/doppler.md, Eq. (12a).
double StripmapImager::noise_lift(double closest_m) const {
  constexpr int parts = 64;
  const double axis = std::sin(strip_.squint_rad), sine_depression = sine_depression_at(closest_m);
  double lift = 0.0;
  for (int part = 0; part < parts; ++part) {
    const Fold fold = fold_of(0, (part + 0.5) / parts - 0.5);
    const double voltage = fold.window * pattern_.voltage(axis, fold.processed, sine_depression);
    lift += voltage * voltage / parts;
  }
  return lift;
}

/// A place at this slant range on the ground of the strip's middle, wherever around the platform.
Vec3d StripmapImager::ground_beside(double range_m) const {
  const double below_m = std::min(range_m, height_over_middle_m());
  return frame_.platform.position + Vec3d{std::sqrt(range_m * range_m - below_m * below_m), 0.0, -below_m};
}

std::vector<AzimuthAmbiguity> StripmapImager::ambiguities() const {
  constexpr double least_power = 1e-6;
  constexpr int parts = 64;
  const double near_m = nearest_ground_m(),
               far_m = std::max(near_m, frame_.closest_range_m.middle_of(static_cast<double>(range_.samples)));
  const double height_m = height_over_middle_m();
  const double sine_depression = sine_depression_at(0.5 * (near_m + far_m));
  const int most = static_cast<int>(4.0 * speed_mps_ / (wavelength_m(frame_.frequency_hz) * repetition_hz_)) + 1;
  std::vector<AzimuthAmbiguity> found;
  for (int order = -most; order <= most; ++order) {
    if (order == 0) continue;
    AzimuthAmbiguity ambiguity{.order = order,
                               .least_shift_m = 1e300,
                               .most_shift_m = -1e300,
                               .least_outwards_m = 1e300,
                               .most_outwards_m = -1e300};
    for (int part = 0; part < parts; ++part) {
      const Fold fold = fold_of(order, (part + 0.5) / parts - 0.5);
      const double voltage = ghost_voltage(fold, sine_depression);
      ambiguity.power += voltage * voltage / parts;
      if (std::abs(fold.observed) >= 1.0) continue;
      const double stretch = std::sqrt((1.0 - fold.processed * fold.processed) / (1.0 - fold.observed * fold.observed));
      for (const double closest_m : {near_m, far_m}) {
        // At the range at which the ghost's source is seen, which has the image's closest range where it is believed.
        const double range_m = closest_m / std::sqrt(1.0 - fold.processed * fold.processed);
        const double shift_m = range_m * (fold.processed - fold.observed);
        ambiguity.least_shift_m = std::min(ambiguity.least_shift_m, shift_m);
        ambiguity.most_shift_m = std::max(ambiguity.most_shift_m, shift_m);
        const double outwards_m = over_ground_m(closest_m, height_m) - over_ground_m(closest_m / stretch, height_m);
        ambiguity.least_outwards_m = std::min(ambiguity.least_outwards_m, outwards_m);
        ambiguity.most_outwards_m = std::max(ambiguity.most_outwards_m, outwards_m);
      }
    }
    if (ambiguity.power > least_power) found.push_back(ambiguity);
  }
  return found;
}

/// A point at rest but for a range rate of its own, at the time when the line of sight stands where the fold says.
StripmapImager::Seen StripmapImager::seen(Vec3d position, double own_range_rate_mps, const Fold& fold) const {
  const Vec3d away = position - frame_.platform.position;
  const double along_m = dot(away, direction_), closest_m = length(away - direction_ * along_m);
  const double cosine = std::sqrt(1.0 - fold.observed * fold.observed), range_m = closest_m / cosine;
  const double way_m = along_m - closest_m * fold.observed / cosine;
  const double sine = std::clamp(fold.processed - own_range_rate_mps / speed_mps_, -1.0, 1.0);
  return {way_m / speed_mps_, range_m, way_m + range_m * sine, range_m * std::sqrt(1.0 - sine * sine)};
}

PlacedAmplitude StripmapImager::placed(const Seen& seen, Vec3d position,
                                       const radar::ComplexChannels& amplitude) const {
  float voltage = 1.0F;
  if (gain_) {
    const radar::Motion platform{frame_.platform.position + frame_.platform.velocity_mps * seen.time_s,
                                 frame_.platform.velocity_mps};
    voltage = gain_({seen.time_s, platform}, position, seen.range_m);
  }
  return {frame_.along_m.place_of(seen.along_m) + static_cast<double>(along_.guard),
          frame_.closest_range_m.place_of(seen.closest_range_m) + static_cast<double>(range_.guard),
          amplitude * (carrier_phase(seen.closest_range_m, wavelength_m(frame_.frequency_hz)) * voltage)};
}

void StripmapImager::add(std::span<const radar::Scatterer> ground, unsigned threads, int order) {
  std::vector<PlacedAmplitude> places(ground.size());
  const Fold plain = unfolded();
  constexpr std::size_t chunk = 4096;
  parallel_for((ground.size() + chunk - 1) / chunk, threads, [&](std::size_t part, unsigned) {
    for (std::size_t i = part * chunk; i < std::min(ground.size(), (part + 1) * chunk); ++i) {
      const radar::Scatterer& point = ground[i];
      if (order == 0) {
        places[i] = placed(seen(point.position, point.range_rate_mps, plain), point.position, point.amplitude_m);
        continue;
      }
      const std::uint64_t key =
          hashed(std::bit_cast<std::uint64_t>(point.position.x), std::bit_cast<std::uint64_t>(point.position.y), order);
      const Fold fold = fold_of(order, static_cast<double>(unit_float(key)) - 0.5);
      const Vec3d away = point.position - frame_.platform.position;
      const Vec3d across = away - direction_ * dot(away, direction_);
      const double voltage = ghost_voltage(fold, across.z / length(across));
      if (voltage == 0.0) {
        places[i].column = places[i].row = std::nan("");
        continue;
      }
      places[i] = placed(seen(point.position, point.range_rate_mps, fold), point.position,
                         point.amplitude_m * static_cast<float>(voltage));
    }
  });
  plane_.add(places, threads);
}

void StripmapImager::add(std::span<const radar::Target> targets, int order) {
  const StripProcessing processed = processing();
  std::vector<PlacedAmplitude> places;
  for (const radar::Target& target : targets) {
    for (const StripPart& part : strip_parts(target, processed, pattern_, order)) {
      const TargetPassage& at = part.seen;
      const Vec3d seen_from = at.target.position - at.away;
      const auto rcs = radar::mean_rcs_of(target, seen_from, frame_.frequency_hz, at.time_s);
      places.push_back(placed({at.time_s, at.range_m, part.along_m, part.closest_range_m}, at.target.position,
                              radar::steady_amplitude(rcs) * part.amplitude));
    }
  }
  plane_.add(places);
}

void StripmapImager::add(const EquivalentNoise& noise) {
  const double cosine = std::cos(strip_.squint_rad), pulses_a_metre = processing().pulses_a_metre();
  std::vector<double> powers(range_.samples);
  for (std::size_t row = 0; row < powers.size(); ++row) {
    const double closest_m = frame_.closest_range_m.middle_of(static_cast<double>(row) + 0.5);
    const double range_m = closest_m / cosine;
    powers[row] = noise.rcs_m2(range_m, pulses_a_metre * range_m, response_.noise_bandwidth()) * noise_lift(closest_m) *
                  noise.lift({0.0, frame_.platform}, ground_beside(range_m));
  }
  noise_ = {.power = [powers = std::move(powers)](std::size_t row) { return powers[row]; }, .seed = noise.seed()};
}

radar::StripmapImage StripmapImager::image(const Subband& part, unsigned threads) const {
  radar::StripmapImage image = frame_;
  const auto rows = noisy_rows(plane_, noise_, range_.guard, range_.samples, part, threads);
  image.along_cell_m *= plane_.cells_of_a_look(part.looks);
  image.amplitude_m = Array2D<radar::ComplexChannels>(along_.samples, range_.samples);
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    std::ranges::copy(rows.row(row).subspan(along_.guard, along_.samples), image.amplitude_m.row(row).begin());
  }
  return image;
}

}  // namespace sigmascape::receiver
