#include "sigmascape/simulate/coherent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/receiver/calibrated_voltage.h"
#include "sigmascape/receiver/doppler_imager.h"
#include "sigmascape/receiver/pulse_receiver.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/stripmap_imager.h"
#include "sigmascape/receiver/target_echoes.h"

namespace sigmascape::simulate {
namespace {

/// Samples a resolution of the pulses, and of images.
constexpr double pulse_oversampling = 1.25;
constexpr double image_oversampling = 1.5;

void check_moves(const radar::Radar& radar) {
  if (!(length(radar.velocity_mps) > 0.0)) {
    throw Error("radar " + radar.name, "stands still", "give it a velocity: coherent modes live from motion");
  }
}

Vec3d middle_of(const radar::Rectangle& area, const terrain::HeightField& terrain) {
  const Vec2d middle = area.centre();
  return {middle.x, middle.y, terrain.height_at(middle)};
}

/// The ranges, or what else `measure` gives, that the area spans between its lowest and highest ground.
template <typename Measure>
std::array<double, 2> span_of(const radar::Rectangle& area, const terrain::HeightField& terrain, Vec2d nearest,
                              const Measure& measure) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  const Vec2d inside{std::clamp(nearest.x, area.west_m, area.east_m),
                     std::clamp(nearest.y, area.south_m, area.north_m)};
  for (const double height : {static_cast<double>(terrain.lowest_m()), static_cast<double>(terrain.highest_m())}) {
    for (const Vec2d corner : {Vec2d{area.west_m, area.south_m},
                               {area.west_m, area.north_m},
                               {area.east_m, area.south_m},
                               {area.east_m, area.north_m},
                               inside}) {
      const double value = measure(Vec3d{corner.x, corner.y, height});
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  return {least, most};
}

receiver::RangeGate gate_over(const radar::Radar& radar, std::array<double, 2> ranges_m, double oversampling) {
  const double spare_m = 2.0 * radar.range_resolution_m;
  return {radar.receiver.first_range_m.value_or(std::max(0.0, ranges_m[0] - spare_m)),
          radar.receiver.last_range_m.value_or(ranges_m[1] + spare_m), oversampling};
}

receiver::RangeGate gate_over(const radar::Radar& radar, const radar::Rectangle& area,
                              const terrain::HeightField& terrain, double oversampling) {
  return gate_over(radar,
                   span_of(area, terrain, {radar.position.x, radar.position.y},
                           [&](Vec3d point) { return length(point - radar.position); }),
                   oversampling);
}

std::vector<radar::Scatterer> scatterers_of(const CoherentScene& scene, const radar::Radar& radar,
                                            const radar::Rectangle& area, const CoherentSettings& settings) {
  const double spacing_m =
      settings.scatterer_spacing_m > 0.0 ? settings.scatterer_spacing_m : radar.range_resolution_m / 2.0;
  const radar::ScattererLattice lattice({.seed = settings.seed, .cell_m = spacing_m, .levels = 1});
  return render::ground_scatterers(
      *scene.terrain, scene.sigma0, lattice,
      {.radar_position = radar.position, .area = area, .level = 0, .time_s = 0.0, .threads = settings.threads},
      scene.targets);
}

/// Those that are seen at time zero.
std::vector<radar::Target> targets_seen(const CoherentScene& scene, Vec3d radar_position) {
  const Surroundings surroundings{*scene.terrain, obstacles_of(scene.sigma0)};
  return seen_targets(scene.targets, 0.0,
                      [&](Vec3d position) { return part_seen(surroundings, radar_position, position); });
}

/// The angle of the middle of the area ahead of broadside, at time zero.
double squint_of(const radar::Radar& radar, Vec3d aim) {
  return std::asin(dot(normalized(aim - radar.position), normalized(radar.velocity_mps)));
}

receiver::BeamAzimuth beam_of(const radar::Radar& radar, Vec3d aim) {
  if (radar.mode != radar::Mode::Stripmap) return receiver::towards(aim);
  const Vec3d away = aim - radar.position;
  return receiver::abeam(std::atan2(away.x, away.y) - std::atan2(radar.velocity_mps.x, radar.velocity_mps.y));
}

std::size_t pulses_in(const radar::Radar& radar, const CoherentSettings& settings) {
  return static_cast<std::size_t>(std::max(2.0, std::round(settings.interval_s * radar.waveform.pulse_repetition_hz)));
}

receiver::DopplerImager doppler_imager(const CoherentScene& scene, const radar::Radar& radar,
                                       const radar::Rectangle& area, const CoherentSettings& settings) {
  check_moves(radar);
  receiver::DopplerImager imager(radar, radar::Track::straight(radar.position, radar.velocity_mps),
                                 {.middle_time_s = 0.0,
                                  .pulses = pulses_in(radar, settings),
                                  .repetition_hz = radar.waveform.pulse_repetition_hz,
                                  .window = radar.waveform.window,
                                  .oversampling = image_oversampling,
                                  .dwell = settings.dwell},
                                 gate_over(radar, area, *scene.terrain, image_oversampling),
                                 middle_of(area, *scene.terrain));
  imager.add(scatterers_of(scene, radar, area, settings), settings.threads);
  imager.add(targets_seen(scene, radar.position));
  return imager;
}

receiver::StripmapImager stripmap_imager(const CoherentScene& scene, const radar::Radar& radar,
                                         const radar::Rectangle& area, const CoherentSettings& settings) {
  check_moves(radar);
  const Vec3d direction = normalized(radar.velocity_mps);
  const auto along = [&](Vec3d point) { return dot(point - radar.position, direction); };
  const auto closest = [&](Vec3d point) { return length(point - radar.position - direction * along(point)); };
  const Vec2d here{radar.position.x, radar.position.y};
  const auto along_m = span_of(area, *scene.terrain, here, along);
  receiver::StripmapImager imager(radar, {radar.position, radar.velocity_mps},
                                  {.first_along_m = along_m[0],
                                   .last_along_m = along_m[1],
                                   .resolution_m = settings.along_resolution_m,
                                   .window = radar.waveform.window,
                                   .oversampling = image_oversampling,
                                   .squint_rad = squint_of(radar, middle_of(area, *scene.terrain)),
                                   .dwell = settings.dwell},
                                  gate_over(radar, span_of(area, *scene.terrain, here, closest), image_oversampling));
  imager.add(scatterers_of(scene, radar, area, settings), settings.threads);
  imager.add(targets_seen(scene, radar.position));
  return imager;
}

/// The frame of an image in cells of one look.
radar::RangeDopplerImage frame_of(radar::RangeDopplerImage image, std::size_t looks) {
  image.doppler_cell_hz *= static_cast<double>(looks);
  return image;
}
radar::StripmapImage frame_of(radar::StripmapImage image, std::size_t looks) {
  image.along_cell_m *= static_cast<double>(looks);
  return image;
}

}  // namespace

radar::PhaseHistory phase_history(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                                  const CoherentSettings& settings) {
  check_moves(radar);
  const double repetition_hz = radar.waveform.pulse_repetition_hz;
  const std::size_t count = pulses_in(radar, settings);
  const receiver::PulseReceiver receiver(radar, gate_over(radar, area, *scene.terrain, pulse_oversampling));
  const auto ground = scatterers_of(scene, radar, area, settings);
  const auto targets = targets_seen(scene, radar.position);
  const receiver::VoltageGain gain =
      settings.calibrated ? receiver::calibrated_voltage(radar, beam_of(radar, middle_of(area, *scene.terrain)))
                          : receiver::VoltageGain{};
  auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps),
                                  {.first_time_s = -static_cast<double>(count / 2) / repetition_hz,
                                   .count = count,
                                   .repetition_hz = repetition_hz,
                                   .dwell = settings.dwell},
                                  ground, targets, gain, settings.threads);
  if (settings.calibrated) receiver::add_thermal_noise(history, radar, settings.seed, settings.threads);
  return history;
}

radar::RangeDopplerImage range_doppler_image(const CoherentScene& scene, const radar::Radar& radar,
                                             const radar::Rectangle& area, const CoherentSettings& settings) {
  return doppler_imager(scene, radar, area, settings).image(settings.threads);
}

radar::StripmapImage stripmap_image(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                                    const CoherentSettings& settings) {
  return stripmap_imager(scene, radar, area, settings).image(settings.threads);
}

radar::PowerImage<radar::RangeDopplerImage> range_doppler_power(const CoherentScene& scene, const radar::Radar& radar,
                                                                const radar::Rectangle& area,
                                                                const CoherentSettings& settings, std::size_t looks) {
  const auto imager = doppler_imager(scene, radar, area, settings);
  return {frame_of(imager.frame(), looks), imager.power(looks, settings.threads)};
}

radar::PowerImage<radar::StripmapImage> stripmap_power(const CoherentScene& scene, const radar::Radar& radar,
                                                       const radar::Rectangle& area, const CoherentSettings& settings,
                                                       std::size_t looks) {
  const auto imager = stripmap_imager(scene, radar, area, settings);
  return {frame_of(imager.frame(), looks), imager.power(looks, settings.threads)};
}

void add_targets(radar::RangeAzimuthImage& image, const radar::Radar& radar, const Surroundings& surroundings,
                 std::span<const radar::Target> targets, const radar::Moment& moment) {
  if (targets.empty()) return;
  const auto seen = seen_targets(targets, moment.time_s,
                                 [&](Vec3d position) { return part_seen(surroundings, radar.position, position); });
  receiver::RangeAzimuthReceiver receiver(radar, image.grid);
  receiver.add(receiver::target_echoes(seen, radar, moment));
  const auto answers = receiver.image();
  for (std::size_t i = 0; i < image.rcs_m2.size(); ++i) image.rcs_m2.values()[i] += answers.rcs_m2.values()[i];
}

}  // namespace sigmascape::simulate
