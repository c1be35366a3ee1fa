#include "sigmascape/dataset/sample_radar.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar_file.h"

namespace sigmascape::dataset {

Vec3d middle_of(const SamplePlan& plan, const terrain::HeightField& terrain) {
  return {plan.centre.x, plan.centre.y, terrain.height_at(plan.centre)};
}

radar::Radar radar_of(const DatasetSpec& spec, const SamplePlan& plan, const terrain::HeightField& terrain) {
  radar::RadarFile drawn = spec.radar;
  drawn.radar.frequency_hz = plan.frequency_hz;
  if (spec.radar_ranges.range_resolution_m) radar::set_range_resolution(drawn, plan.range_resolution_m);
  if (spec.radar_ranges.beam_width_rad) radar::set_beam_width(drawn, plan.beam_width_rad);
  radar::Radar& radar = drawn.radar;
  radar.velocity_mps = {plan.flight_mps.x, plan.flight_mps.y, 0.0};
  radar.position = radar::position_seeing(middle_of(plan, terrain), plan.azimuth_rad, plan.elevation_rad,
                                          plan.slant_range_m, radar::earth_of(radar)) +
                   radar.velocity_mps * plan.time_s;
  return drawn.radar;
}

std::size_t nearest_frame(const DatasetSpec& spec, const SamplePlan& begin, const terrain::HeightField& terrain) {
  const Vec2d flight = begin.flight_mps;
  const double speed2 = dot(flight, flight);
  if (!(speed2 > 0.0)) return 0;
  const Vec3d position = radar_of(spec, begin, terrain).position;
  const Vec2d to_map{begin.centre.x - position.x, begin.centre.y - position.y};
  const double frame = std::round(dot(to_map, flight) / speed2 / spec.sequence.interval_s);
  return static_cast<std::size_t>(std::clamp(frame, 0.0, static_cast<double>(spec.sequence.frames - 1)));
}

bool flies(const Sequence& sequence) {
  return sequence.frames > 1 && sequence.speed_mps.highest > 0.0;
}

}  // namespace sigmascape::dataset
