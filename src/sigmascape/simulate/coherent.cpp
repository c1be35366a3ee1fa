#include "sigmascape/simulate/coherent.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/never_scanned.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/radar/strip_beam.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/radar/windblown_vegetation.h"
#include "sigmascape/receiver/calibrated_voltage.h"
#include "sigmascape/receiver/carrier_phase.h"
#include "sigmascape/receiver/doppler_imager.h"
#include "sigmascape/receiver/pattern_gain.h"
#include "sigmascape/receiver/pulse_receiver.h"
#include "sigmascape/receiver/receiver_output.h"
#include "sigmascape/receiver/stripmap_imager.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/simulate/doppler_rim.h"
#include "sigmascape/simulate/recorded_beam.h"
#include "sigmascape/simulate/scatterer_spacing.h"

namespace sigmascape::simulate {
namespace {

/// Samples a resolution of the pulses, and of images.
constexpr double pulse_oversampling = 1.25;
constexpr double image_oversampling = 1.5;

void check_moves(const radar::Radar& radar) {
  if (!(length(radar.velocity_mps) > 0.0)) {
    throw Error(radar::title_of(radar), "stands still", "give it a velocity: coherent modes live from motion");
  }
}

/// A sector that is scanned passes over every place of it, and over no other. Of spotlights and strips the antenna is
/// steered however it scans; what a fixed beam sees beside its axis its pattern tells.
void check_sector_takes_in(const radar::Rectangle& area, const radar::Radar& radar) {
  const bool is_steered = radar.mode == radar::Mode::Spotlight || radar.mode == radar::Mode::Stripmap;
  if (radar.scan.kind == radar::ScanKind::Sector && !is_steered) radar::require_scanned(radar, area);
}

/// A point of the local frame in the straight space under this radar.
Vec3d bent(const radar::Radar& radar, Vec3d point) {
  return radar::earth_of(radar).bent(point, {radar.position.x, radar.position.y});
}

/// A radar may stand lower than a ridge, but not in the ground, nor lower than all of it.
void check_over_ground(const radar::Radar& radar, const terrain::HeightField& terrain) {
  const Vec2d foot{radar.position.x, radar.position.y};
  const bool is_above_scene = terrain.extent().contains(foot);
  double ground_m = std::numeric_limits<double>::infinity();
  if (is_above_scene) {
    ground_m = terrain.height_at(foot);
  } else {
    for (const Vec3d corner : radar::corners_of(terrain.extent(), static_cast<double>(terrain.lowest_m())))
      ground_m = std::min(ground_m, bent(radar, corner).z);
  }
  if (radar.position.z > ground_m) return;
  throw Error(radar::title_of(radar),
              fmt::format("stands at {:.1f} m, and the {} at {:.1f} m", radar.position.z,
                          is_above_scene ? "ground under it" : "lowest ground of the scene", ground_m),
              "place it higher: altitudes count from mean sea level");
}

/// The middle of the area in the local frame.
Vec3d local_middle_of(const radar::Rectangle& area, const terrain::HeightField& terrain) {
  const Vec2d middle = area.centre();
  return {middle.x, middle.y, terrain.height_at(middle)};
}

/// The middle of the area in the straight space.
Vec3d middle_of(const radar::Rectangle& area, const terrain::HeightField& terrain, const radar::Radar& radar) {
  return bent(radar, local_middle_of(area, terrain));
}

/// The ranges, or what else `measure` gives, that the area spans between its lowest and highest ground, seen from a
/// place.
template <typename Measure>
std::array<double, 2> span_of(const radar::Rectangle& area, const terrain::HeightField& terrain, Vec3d place,
                              const Measure& measure) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  const auto take_in = [&](Vec3d point) {
    const double value = measure(point);
    least = std::min(least, value);
    most = std::max(most, value);
  };
  const Vec2d inside = radar::nearest_point(area, {place.x, place.y});
  const auto lowest_m = static_cast<double>(terrain.lowest_m()), highest_m = static_cast<double>(terrain.highest_m());
  // Ground as high as the radar is nearer than what lies above and below.
  for (const double height : {lowest_m, std::clamp(place.z, lowest_m, highest_m), highest_m}) {
    std::ranges::for_each(radar::corners_of(area, height), take_in);
    take_in({inside.x, inside.y, height});
  }
  return {least, most};
}

/// Of the ranges that the area spans, or that the receiver states: `over_slant` times those.
receiver::RangeGate gate_over(const radar::Radar& radar, std::array<double, 2> ranges_m, double oversampling,
                              double over_slant = 1.0) {
  const double spare_m = 2.0 * radar.range_resolution_m;
  const auto &first_m = radar.receiver.first_range_m, &last_m = radar.receiver.last_range_m;
  return {first_m ? *first_m * over_slant : std::max(0.0, ranges_m[0] - spare_m),
          last_m ? *last_m * over_slant : ranges_m[1] + spare_m, oversampling, over_slant};
}

/// A place of the antenna, at the height of what is as high as it where the area is nearest to it.
Vec3d as_high_as(const radar::Radar& radar, Vec3d antenna, const radar::Rectangle& area) {
  const Vec2d nearest = radar::nearest_point(area, {antenna.x, antenna.y});
  const double drop_m = -bent(radar, {nearest.x, nearest.y, 0.0}).z;
  return {antenna.x, antenna.y, antenna.z + drop_m};
}

/// Of the ranges that the area spans at time zero, or while the radar flies past from one time to another.
receiver::RangeGate gate_over(const radar::Radar& radar, const radar::Rectangle& area,
                              const terrain::HeightField& terrain, double oversampling, double from_s = 0.0,
                              double to_s = 0.0) {
  const Vec3d velocity = radar.velocity_mps;
  const auto range_m = [&](Vec3d point, double time_s) {
    return length(bent(radar, point) - (radar.position + velocity * time_s));
  };
  const auto closest_m = [&](Vec3d point) {
    const double speed2 = dot(velocity, velocity);
    const double abeam_s = speed2 > 0.0 ? dot(bent(radar, point) - radar.position, velocity) / speed2 : 0.0;
    return range_m(point, std::clamp(abeam_s, from_s, to_s));
  };
  const auto farthest_m = [&](Vec3d point) { return std::max(range_m(point, from_s), range_m(point, to_s)); };
  double least_m = std::numeric_limits<double>::infinity(), most_m = 0.0;
  for (const double time_s : {from_s, 0.0, to_s}) {
    const Vec3d foot = radar.position + velocity * time_s;
    least_m = std::min(least_m, span_of(area, terrain, as_high_as(radar, foot, area), closest_m)[0]);
    most_m = std::max(most_m, span_of(area, terrain, foot, farthest_m)[1]);
  }
  return gate_over(radar, {least_m, most_m}, oversampling);
}

/// Gives each scatterer of a plant the velocity that is drawn for its place, and the phase to which that has brought it
/// by the moment of time zero.
void blow_on(std::vector<radar::Scatterer>& scatterers, const Windblown& windblown, const radar::Radar& radar,
             const CoherentSettings& settings) {
  const radar::WindblownVegetation leaves(radar.wind_mps, radar.frequency_hz);
  const double wavelength = wavelength_m(radar.frequency_hz);
  constexpr std::size_t chunk = 4096;
  parallel_for((scatterers.size() + chunk - 1) / chunk, settings.threads, [&](std::size_t part, unsigned) {
    for (std::size_t i = part * chunk; i < std::min(scatterers.size(), (part + 1) * chunk); ++i) {
      const Vec3d place = scatterers[i].position;
      if (!windblown({place.x, place.y})) continue;
      const float rate_mps = leaves.range_rate_mps(
          hashed(settings.seed, std::bit_cast<std::uint64_t>(place.x), std::bit_cast<std::uint64_t>(place.y)));
      scatterers[i].range_rate_mps = rate_mps;
      if (settings.moment_s == 0.0 || rate_mps == 0.0F) continue;
      const double gone_m = static_cast<double>(rate_mps) * settings.moment_s;
      scatterers[i].amplitude_m = scatterers[i].amplitude_m * receiver::carrier_phase(gone_m, wavelength);
    }
  });
}

/// `rim`: around what is mapped of the area, if only a part of it is.
std::vector<radar::Scatterer> scatterers_of(const CoherentScene& scene, const radar::Radar& radar,
                                            const radar::Vantage& vantage, const radar::Rectangle& area,
                                            const CoherentSettings& settings, const DopplerRim* rim = nullptr) {
  const radar::ScattererLattice lattice({.seed = settings.seed, .cell_m = settings.scatterer_spacing_m, .levels = 1});
  auto scatterers = render::ground_scatterers(
      *scene.terrain, scene.sigma0, lattice,
      {.vantage = vantage, .area = area, .level = 0, .threads = settings.threads, .earth = radar::earth_of(radar)},
      scene.targets);
  if (rim)
    std::erase_if(scatterers, [&](const radar::Scatterer& scatterer) { return !rim->takes_part(scatterer.position); });
  if (radar.wind_mps > 0.0 && scene.windblown) blow_on(scatterers, scene.windblown, radar, settings);
  if (radar.earth_refraction) {
    for (radar::Scatterer& scatterer : scatterers) scatterer.position = bent(radar, scatterer.position);
  }
  return scatterers;
}

/// The settings with a spacing of scatterers, this one where none was asked for.
CoherentSettings spaced(CoherentSettings settings, double spacing_m) {
  if (!(settings.scatterer_spacing_m > 0.0)) settings.scatterer_spacing_m = spacing_m;
  return settings;
}

/// Those of which something is seen when they are looked at, in the straight space under the radar.
std::vector<radar::Target> targets_heard(const CoherentScene& scene, const radar::Radar& radar,
                                         const radar::Vantage& vantage) {
  if (scene.targets.empty()) return {};
  const Obstructions obstructions{*scene.terrain, obstacles_of(scene.sigma0), radar::earth_of(radar)};
  std::vector<radar::Target> heard;
  for (const TargetInSight& sight : targets_in_sight(
           scene.targets, vantage, [&](Vec3d from, Vec3d point) { return part_seen(obstructions, from, point); })) {
    if (!(sight.part_seen > 0.0)) continue;
    heard.push_back(radar::bent(radar::weakened(*sight.target, sight.part_seen), radar::earth_of(radar),
                                {radar.position.x, radar.position.y}, sight.time_s));
  }
  return heard;
}

/// The angle of the middle of a strip ahead of broadside, as the beam passes over it.
double squint_of(const radar::Radar& radar, Vec3d aim) {
  return std::asin(dot(normalized(radar::way_as_passed(radar, aim)), normalized(radar.velocity_mps)));
}

/// Of a sharpened or spotlight image; none where it passes over every place as it scans, or as that of a strip does.
receiver::BeamAzimuth beam_of_image(const radar::Radar& radar, Vec3d aim) {
  const bool scans = radar.scan.kind != radar::ScanKind::Fixed;
  if (radar.mode == radar::Mode::Stripmap || (radar.mode == radar::Mode::DopplerBeamSharpening && scans)) return {};
  return steered_beam(radar, aim);
}

/// What the pattern leaves of an image made in metres, or nothing where that is not asked for.
receiver::VoltageGain image_gain(const radar::Radar& radar, receiver::BeamAzimuth beam) {
  return radar.processing.antenna_pattern ? receiver::pattern_gain(radar, std::move(beam)) : receiver::VoltageGain{};
}

/// The noise of an image made in metres, lifted by what the pattern leaves where that is not in the image.
receiver::EquivalentNoise image_noise(const radar::Radar& radar, receiver::BeamAzimuth beam,
                                      const CoherentSettings& settings) {
  return {radar, receiver::noise_seed(settings.seed, settings.dwell),
          radar.processing.antenna_pattern ? receiver::VoltageGain{} : receiver::pattern_gain(radar, std::move(beam))};
}

/// Where that beam points in the middle of the interval, if an image has its pattern.
std::optional<double> azimuth_of_image_beam(const radar::Radar& radar, const radar::Rectangle& area) {
  const Vec2d middle = area.centre();
  const receiver::BeamAzimuth beam = beam_of_image(radar, {middle.x, middle.y, 0.0});
  if (!radar.processing.antenna_pattern || !beam) return std::nullopt;
  return beam({.platform = {radar.position, radar.velocity_mps}});
}

/// The same of a strip, all along it.
std::optional<double> azimuth_of_strip_beam(const radar::Radar& radar, const radar::Rectangle& area) {
  if (!radar.processing.antenna_pattern) return std::nullopt;
  if (const auto azimuth_rad = radar::fixed_strip_azimuth_rad(radar)) return azimuth_rad;
  const Vec2d away = area.centre() - Vec2d{radar.position.x, radar.position.y};
  return azimuth_of(away);
}

/// The ground whose ghosts fall into an area.
radar::Rectangle seen_as(const radar::Rectangle& area, const receiver::AzimuthAmbiguity& ambiguity, Vec3d direction,
                         Vec2d outwards) {
  const auto spread = [&](double west_or_south, double east_or_north, double along, double out) {
    const auto shifts = std::minmax({-along * ambiguity.least_shift_m, -along * ambiguity.most_shift_m});
    const auto outward = std::minmax({-out * ambiguity.least_outwards_m, -out * ambiguity.most_outwards_m});
    return std::array{west_or_south + shifts.first + outward.first, east_or_north + shifts.second + outward.second};
  };
  const auto x = spread(area.west_m, area.east_m, direction.x, outwards.x);
  const auto y = spread(area.south_m, area.north_m, direction.y, outwards.y);
  return {x[0], y[0], x[1], y[1]};
}

/// The level direction from the track of that course to the area.
Vec2d away_from_track(const radar::Rectangle& area, Vec3d position, Vec3d direction) {
  const Vec2d abeam{direction.y, -direction.x};
  const double side = dot(area.centre() - Vec2d{position.x, position.y}, abeam) < 0.0 ? -1.0 : 1.0;
  return abeam * (side / length(abeam));
}

std::size_t pulses_in(const radar::Radar& radar, const CoherentSettings& settings) {
  if (!(settings.interval_s > 0.0 && settings.interval_s <= 1e4))
    throw Error("interval_s", fmt::format("is {:g} s", settings.interval_s), "give more than 0, up to 10000 s");
  const double repetition_hz = radar.waveform.pulse_repetition_hz;
  const double pulses = std::round(settings.interval_s * repetition_hz);
  if (pulses < 2.0) {
    throw Error("interval_s",
                fmt::format("of {:g} s is shorter than two pulses at a pulse repetition frequency of {:g} Hz",
                            settings.interval_s, repetition_hz),
                fmt::format("give at least {:g} s, or send more pulses", 2.0 / repetition_hz));
  }
  return static_cast<std::size_t>(pulses);
}

receiver::DopplerImager doppler_imager(const CoherentScene& scene, const radar::Radar& radar,
                                       const radar::Rectangle& area, const CoherentSettings& asked) {
  check_moves(radar);
  check_over_ground(radar, *scene.terrain);
  const radar::Rectangle mapped = asked.mapped.value_or(area);
  check_sector_takes_in(mapped, radar);
  const double across_m = resolution_of_interval_m(radar, local_middle_of(mapped, *scene.terrain), asked.interval_s);
  const CoherentSettings settings = spaced(asked, scatterer_spacing_m(radar, across_m));
  const radar::Vantage vantage(radar.position);
  const Vec3d aim = middle_of(mapped, *scene.terrain, radar);
  receiver::DopplerImager imager(radar, radar::Track::straight(radar.position, radar.velocity_mps),
                                 {.middle_time_s = 0.0,
                                  .pulses = pulses_in(radar, settings),
                                  .repetition_hz = radar.waveform.pulse_repetition_hz,
                                  .window = radar.waveform.window,
                                  .oversampling = image_oversampling,
                                  .dwell = settings.dwell},
                                 gate_over(radar, area, *scene.terrain, image_oversampling), aim,
                                 image_gain(radar, beam_of_image(radar, aim)));
  if (radar.processing.thermal_noise) imager.add(image_noise(radar, beam_of_image(radar, aim), settings));
  const DopplerRim rim(radar, mapped, area);
  imager.add(scatterers_of(scene, radar, vantage, area, settings, settings.mapped ? &rim : nullptr), settings.threads);
  imager.add(targets_heard(scene, radar, vantage));
  return imager;
}

/// Adds what ground beside the area, and within it, folds into it.
void add_ghosts(receiver::StripmapImager& imager, std::span<const receiver::AzimuthAmbiguity> ambiguities,
                const CoherentScene& scene, const radar::Radar& radar, const radar::Vantage& vantage,
                const radar::Rectangle& area, const CoherentSettings& settings) {
  const Vec3d direction = normalized(radar.velocity_mps);
  const Vec2d outwards = away_from_track(area, radar.position, direction);
  const auto ground_of = [&](const receiver::AzimuthAmbiguity& ambiguity) {
    return radar::common_part(seen_as(area, ambiguity, direction, outwards), scene.terrain->extent());
  };
  const auto has_ground = [](const radar::Rectangle& there) { return there.width_m() > 0.0 && there.height_m() > 0.0; };
  double sum_m2 = 0.0, all_m2 = 0.0;
  std::optional<radar::Rectangle> all;
  for (const receiver::AzimuthAmbiguity& ambiguity : ambiguities) {
    const radar::Rectangle there = ground_of(ambiguity);
    if (!has_ground(there)) continue;
    all = all ? joined(*all, there) : there;
    sum_m2 += there.width_m() * there.height_m();
    all_m2 = all->width_m() * all->height_m();
  }
  if (!all) return;
  // Where the orders' grounds overlap, what answers there is found once for all of them.
  const bool together = all_m2 < sum_m2;
  std::vector<radar::Scatterer> ground;
  if (together) ground = scatterers_of(scene, radar, vantage, *all, settings);
  for (const receiver::AzimuthAmbiguity& ambiguity : ambiguities) {
    const radar::Rectangle there = ground_of(ambiguity);
    if (!has_ground(there)) continue;
    if (!together) ground = scatterers_of(scene, radar, vantage, there, settings);
    imager.add(ground, settings.threads, ambiguity.order);
  }
}

receiver::StripmapImager stripmap_imager(const CoherentScene& scene, const radar::Radar& radar,
                                         const radar::Rectangle& area, const CoherentSettings& asked) {
  check_moves(radar);
  check_over_ground(radar, *scene.terrain);
  const CoherentSettings settings = spaced(asked, scatterer_spacing_m(radar, asked.along_resolution_m));
  const radar::Vantage vantage = radar::vantage_of_strip(radar, area.centre());
  const Vec3d direction = normalized(radar.velocity_mps);
  const auto along = [&](Vec3d point) { return dot(bent(radar, point) - radar.position, direction); };
  const auto closest = [&](Vec3d point) {
    return length(bent(radar, point) - radar.position - direction * along(point));
  };
  const Vec3d here = as_high_as(radar, radar.position, area);
  const auto along_m = span_of(area, *scene.terrain, here, along);
  const Vec3d aim = middle_of(area, *scene.terrain, radar);
  const double squint_rad = squint_of(radar, aim);
  // The axis of a strip is of closest ranges, of which the slant range that the receiver knows is the longer one.
  const auto gate =
      gate_over(radar, span_of(area, *scene.terrain, here, closest), image_oversampling, std::cos(squint_rad));
  receiver::StripmapImager imager(radar, {radar.position, radar.velocity_mps},
                                  {.first_along_m = along_m[0],
                                   .last_along_m = along_m[1],
                                   .resolution_m = settings.along_resolution_m,
                                   .window = radar.waveform.window,
                                   .oversampling = image_oversampling,
                                   .squint_rad = squint_rad,
                                   .looks_left = radar::leftwards(radar.velocity_mps, aim - radar.position) > 0.0,
                                   .ground_m = aim.z,
                                   .relief_m = std::max(0.0, scene.terrain->highest_m() - aim.z),
                                   .dwell = settings.dwell},
                                  gate, image_gain(radar, {}));
  if (radar.processing.thermal_noise) imager.add(image_noise(radar, {}, settings));
  const auto targets = targets_heard(scene, radar, vantage);
  imager.add(scatterers_of(scene, radar, vantage, area, settings), settings.threads);
  imager.add(targets);
  if (!radar.processing.ambiguities) return imager;
  const auto ambiguities = imager.ambiguities();
  for (const receiver::AzimuthAmbiguity& ambiguity : ambiguities) imager.add(targets, ambiguity.order);
  add_ghosts(imager, ambiguities, scene, radar, vantage, area, settings);
  return imager;
}

/// An imager's image of some of the pulses, with the Earth under it and where its beam points.
template <typename Imager>
auto image_of(const Imager& imager, const radar::Radar& radar, std::optional<double> azimuth_rad,
              const receiver::Subband& part, unsigned threads) {
  auto image = imager.image(part, threads);
  image.earth = radar::earth_of(radar);
  image.beam_azimuth_rad = azimuth_rad;
  return image;
}

/// Every look, one after another.
template <typename Imager, typename Visit>
void show_looks(const Imager& imager, const radar::Radar& radar, std::optional<double> azimuth_rad, std::size_t looks,
                unsigned threads, const Visit& visit) {
  for (std::size_t look = 0; look < looks; ++look) visit(image_of(imager, radar, azimuth_rad, {look, looks}, threads));
}

/// What records pulses, and which.
struct Recording {
  receiver::PulseReceiver receiver;
  receiver::PulseTrain train;
};

Recording recording(const radar::Radar& radar, const radar::Rectangle& area, const terrain::HeightField& terrain,
                    const CoherentSettings& settings) {
  // What stands still can record; but a strip is what a beam passes over.
  if (radar.mode == radar::Mode::Stripmap) check_moves(radar);
  check_over_ground(radar, terrain);
  check_sector_takes_in(area, radar);
  const double repetition_hz = radar.waveform.pulse_repetition_hz;
  const std::size_t count = pulses_in(radar, settings), before_now = count / 2;
  const double first_s = -static_cast<double>(before_now) / repetition_hz,
               last_s = static_cast<double>(count - before_now) / repetition_hz;
  Recording recording{
      receiver::PulseReceiver(radar, gate_over(radar, area, terrain, pulse_oversampling, first_s, last_s)),
      {.first_time_s = first_s, .count = count, .repetition_hz = repetition_hz, .dwell = settings.dwell}};
  recording.receiver.check(recording.train, machine_memory_bytes());
  return recording;
}

}  // namespace

std::size_t check_recording(const radar::Radar& radar, const radar::Rectangle& area,
                            const terrain::HeightField& terrain, const CoherentSettings& asked) {
  const auto [receiver, train] = recording(radar, area, terrain, asked);
  const double spacing_m = pulse_scatterer_spacing_m(radar, area, terrain, asked.interval_s);
  render::check_scatterers(area, spaced(asked, spacing_m).scatterer_spacing_m);
  return train.count * receiver.samples();
}

radar::PhaseHistory phase_history(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                                  const CoherentSettings& asked) {
  const auto [receiver, train] = recording(radar, area, *scene.terrain, asked);
  const CoherentSettings settings =
      spaced(asked, pulse_scatterer_spacing_m(radar, area, *scene.terrain, asked.interval_s));
  const radar::Vantage vantage = radar::vantage_of(radar, area.centre());
  const auto ground = scatterers_of(scene, radar, vantage, area, settings);
  const auto targets = targets_heard(scene, radar, vantage);
  const receiver::BeamAzimuth beam = recorded_beam(radar, middle_of(area, *scene.terrain, radar), settings.moment_s);
  const receiver::VoltageGain gain =
      settings.calibrated ? receiver::calibrated_voltage(radar, beam) : receiver::VoltageGain{};
  auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps), train, ground, targets,
                                  gain, settings.threads, settings.progress);
  if (settings.calibrated) {
    for (radar::Pulse& pulse : history.pulses) pulse.beam_azimuth_rad = beam(pulse);
    receiver::add_thermal_noise(history, radar, receiver::noise_seed(settings.seed, settings.dwell), settings.threads);
    receiver::bring_to_output(history, radar, settings.threads);
  }
  return history;
}

std::optional<double> beam_azimuth_rad(const radar::Radar& radar, const radar::Rectangle& area) {
  return radar.mode == radar::Mode::Stripmap ? azimuth_of_strip_beam(radar, area) : azimuth_of_image_beam(radar, area);
}

const char* look_side(const radar::Radar& radar, const radar::Rectangle& area) {
  const Vec2d middle = area.centre();
  return radar::look_side(radar.velocity_mps, Vec3d{middle.x, middle.y, 0.0} - radar.position);
}

void range_doppler_looks(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                         const CoherentSettings& settings, std::size_t looks,
                         const std::function<void(const radar::RangeDopplerImage&)>& visit) {
  const auto azimuth_rad = azimuth_of_image_beam(radar, settings.mapped.value_or(area));
  show_looks(doppler_imager(scene, radar, area, settings), radar, azimuth_rad, looks, settings.threads, visit);
}

void stripmap_looks(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                    const CoherentSettings& settings, std::size_t looks,
                    const std::function<void(const radar::StripmapImage&)>& visit) {
  show_looks(stripmap_imager(scene, radar, area, settings), radar, azimuth_of_strip_beam(radar, area), looks,
             settings.threads, visit);
}

radar::RangeDopplerImage range_doppler_image(const CoherentScene& scene, const radar::Radar& radar,
                                             const radar::Rectangle& area, const CoherentSettings& settings) {
  const auto azimuth_rad = azimuth_of_image_beam(radar, settings.mapped.value_or(area));
  return image_of(doppler_imager(scene, radar, area, settings), radar, azimuth_rad, {}, settings.threads);
}

radar::StripmapImage stripmap_image(const CoherentScene& scene, const radar::Radar& radar, const radar::Rectangle& area,
                                    const CoherentSettings& settings) {
  return image_of(stripmap_imager(scene, radar, area, settings), radar, azimuth_of_strip_beam(radar, area), {},
                  settings.threads);
}

void add_targets(radar::RangeAzimuthImage& image, const radar::Radar& radar, const Obstructions& obstructions,
                 std::span<const radar::Target> targets, const radar::Moment& moment) {
  if (targets.empty()) return;
  const auto seen = seen_targets(targets, moment.time_s,
                                 [&](Vec3d position) { return part_seen(obstructions, radar.position, position); });
  receiver::add_echoes(image, radar, receiver::target_echoes(seen, radar, moment));
}

}  // namespace sigmascape::simulate
