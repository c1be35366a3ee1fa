#include "sigmascape/receiver/stripmap_imager.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/window_response.h"
#include "sigmascape/receiver/carrier_phase.h"
#include "sigmascape/receiver/multilook.h"
#include "sigmascape/receiver/smear.h"

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

radar::ImageAxis image_axis(const GatedAxis& axis) {
  return {axis.start_m + static_cast<double>(axis.guard) * axis.step_m, axis.step_m, axis.samples};
}

}  // namespace

/// What the beam sees of a point as it passes it, and where a point at rest would look the same.
struct StripmapImager::Seen {
  double time_s = 0.0, range_m = 0.0, along_m = 0.0, closest_range_m = 0.0;
};

StripmapImager::StripmapImager(const radar::Radar& radar, const radar::Motion& platform, const Strip& strip,
                               const RangeGate& gate, VoltageGain gain)
    : strip_(strip),
      range_(gated_axis(radar, gate)),
      along_(along_axis(strip)),
      gain_(std::move(gain)),
      speed_mps_(length(moving(platform).velocity_mps)),
      direction_(normalized(platform.velocity_mps)),
      plane_(along_.axis, range_.axis) {
  frame_.platform = platform;
  frame_.squint_rad = strip.squint_rad;
  frame_.frequency_hz = radar.frequency_hz;
  frame_.along_m = image_axis(along_);
  frame_.closest_range_m = image_axis(range_);
  frame_.closest_range_cell_m =
      speed_of_light_mps / (2.0 * range_.bandwidth_hz) * radar::WindowResponse(radar.waveform.window).noise_bandwidth();
  frame_.along_cell_m = radar::WindowResponse(strip.window).noise_bandwidth() / band_per_m(strip);
}

/// At the time when the line of sight stands at the squint.
StripmapImager::Seen StripmapImager::seen_from(double time_s, const radar::Motion& target) const {
  const Vec3d away = target.position - (frame_.platform.position + frame_.platform.velocity_mps * time_s);
  const double range_m = length(away);
  const double own_rate = dot(target.velocity_mps, away) / range_m;
  const double sine = std::clamp(dot(away, direction_) / range_m - own_rate / speed_mps_, -1.0, 1.0);
  return {time_s, range_m, speed_mps_ * time_s + range_m * sine, range_m * std::sqrt(1.0 - sine * sine)};
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

void StripmapImager::add(std::span<const radar::Scatterer> ground, unsigned threads) {
  std::vector<PlacedAmplitude> places(ground.size());
  const double tangent = std::tan(strip_.squint_rad);
  constexpr std::size_t chunk = 4096;
  parallel_for((ground.size() + chunk - 1) / chunk, threads, [&](std::size_t part, unsigned) {
    for (std::size_t i = part * chunk; i < std::min(ground.size(), (part + 1) * chunk); ++i) {
      const Vec3d away = ground[i].position - frame_.platform.position;
      const double along_m = dot(away, direction_), closest_m = length(away - direction_ * along_m);
      const Seen seen{(along_m - closest_m * tangent) / speed_mps_, closest_m / std::cos(strip_.squint_rad), along_m,
                      closest_m};
      places[i] = placed(seen, ground[i].position, ground[i].amplitude_m);
    }
  });
  plane_.add(places, threads);
}

void StripmapImager::add(std::span<const radar::Target> targets) {
  std::vector<PlacedAmplitude> places;
  const double wavelength = wavelength_m(frame_.frequency_hz);
  const double bins_a_cell = 1.0 / (band_per_m(strip_) * along_.step_m);
  const double sine = std::sin(strip_.squint_rad), cosine = std::cos(strip_.squint_rad);
  for (const radar::Target& target : targets) {
    // The beam reaches a slower mover after few steps of: where it is then, when the beam gets there.
    double time_s = 0.0;
    for (int step = 0; step < 20; ++step) {
      const Vec3d away = target.track.position_at(time_s) - frame_.platform.position;
      const double along_m = dot(away, direction_);
      time_s = (along_m - length(away - direction_ * along_m) * sine / cosine) / speed_mps_;
    }
    const radar::Motion motion = radar::motion_of(target, time_s);
    const Seen seen = seen_from(time_s, motion);
    const Vec3d seen_at = frame_.platform.position + frame_.platform.velocity_mps * time_s;
    const radar::Channels rcs = radar::rcs_of(target, seen_at, frame_.frequency_hz, {time_s, strip_.dwell, 0});
    const PlacedAmplitude whole = placed(seen, motion.position, radar::steady_amplitude(rcs));
    const Vec3d relative = motion.velocity_mps - frame_.platform.velocity_mps;
    const double rate_error = -2.0 * (dot(relative, relative) - speed_mps_ * speed_mps_) / (seen.range_m * wavelength);
    // The time for which the processed band sees a point: band over Doppler rate.
    const double interval_s = band_per_m(strip_) * wavelength * seen.range_m / (2.0 * speed_mps_ * cosine * cosine);
    for (const SmearedPart& part : smeared(rate_error, interval_s)) {
      places.push_back({whole.column + part.cells * bins_a_cell, whole.row, whole.amplitude * part.amplitude});
    }
  }
  plane_.add(places);
}

radar::StripmapImage StripmapImager::image(unsigned threads) const {
  radar::StripmapImage image = frame_;
  const auto rows = rows_from(plane_.bins({}, threads), range_.guard, range_.samples);
  image.amplitude_m = Array2D<radar::ComplexChannels>(along_.samples, range_.samples);
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    std::ranges::copy(rows.row(row).subspan(along_.guard, along_.samples), image.amplitude_m.row(row).begin());
  }
  return image;
}

Array2D<radar::Channels> StripmapImager::power(std::size_t looks, unsigned threads) const {
  const auto all = multilooked(plane_, looks, range_.guard, range_.samples, threads);
  Array2D<radar::Channels> strip(along_.samples, range_.samples);
  for (std::size_t row = 0; row < all.rows(); ++row) {
    std::ranges::copy(all.row(row).subspan(along_.guard, along_.samples), strip.row(row).begin());
  }
  return strip;
}

}  // namespace sigmascape::receiver
