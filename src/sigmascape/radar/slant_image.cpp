#include "sigmascape/radar/slant_image.h"

#include "sigmascape/base/units.h"

namespace sigmascape::radar {

Vec2d RangeDopplerImage::place_of(const Motion& in_frame) const {
  const Vec2d foot{platform.position.x, platform.position.y};
  const Motion seen{earth.bent(in_frame.position, foot), earth.turned(in_frame.velocity_mps, in_frame.position, foot)};
  const double frequency = radar::doppler_hz(range_rate_mps(platform, seen), wavelength_m(frequency_hz));
  const double half_bin = 0.5 * doppler_hz.step;
  const double folded = folded_hz(frequency, doppler_hz.first - half_bin, pulse_repetition_hz);
  return {doppler_hz.place_of(folded), range_m.place_of(length(seen.position - platform.position))};
}

Vec2d StripmapImage::place_of(Vec3d point) const {
  const Vec3d direction = normalized(platform.velocity_mps),
              away = earth.bent(point, {platform.position.x, platform.position.y}) - platform.position;
  const double along = dot(away, direction);
  return {along_m.place_of(along), closest_range_m.place_of(length(away - direction * along))};
}

}  // namespace sigmascape::radar
