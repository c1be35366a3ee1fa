#include "sigmascape/radar/coherent_advice.h"

#include <fmt/format.h>

#include "sigmascape/radar/advised_number.h"
#include "sigmascape/radar/coherent_plan.h"

namespace sigmascape::radar {
namespace {

double sharpening_of(const Radar& radar) {
  return radar.processing.sharpening.value_or(usual_sharpening);
}

}  // namespace

std::string advice_for_coarser(const Radar& radar, double width_m, double interval_s, double finest_m) {
  const double too_fine = finest_m / width_m;
  const char* const fewer_looks = radar.processing.looks > 1 ? " or fewer looks" : "";
  if (radar.processing.interval_s)
    return fmt::format("give mode.interval_s of less than {:g}{}", rounded_down(interval_s / too_fine, advised_digits),
                       fewer_looks);
  if (radar.mode == Mode::DopplerBeamSharpening)
    return fmt::format("give mode.sharpening of less than {:g}{}",
                       rounded_down(sharpening_of(radar) / too_fine, advised_digits), fewer_looks);
  return fmt::format("give mode.along_resolution_m of more than {:g}{}", rounded_up(finest_m, advised_digits),
                     fewer_looks);
}

std::string advice_for_longer(const Radar& radar, double width_m, double interval_s, double more) {
  if (radar.processing.interval_s)
    return fmt::format("give mode.interval_s of at least {:g}{}", rounded_up(interval_s * more, advised_digits),
                       radar.processing.looks > 1 ? ", fewer mode.looks" : "");
  if (radar.mode == Mode::DopplerBeamSharpening)
    return fmt::format("give mode.sharpening of at least {:g}",
                       rounded_up(sharpening_of(radar) * more, advised_digits));
  return fmt::format("give mode.along_resolution_m of at most {:g}", rounded_down(width_m / more, advised_digits));
}

const char* keys_of_resolution(const Radar& radar) {
  if (radar.processing.interval_s)
    return radar.processing.looks > 1 ? "a longer mode.interval_s or fewer mode.looks" : "a longer mode.interval_s";
  return radar.mode == Mode::DopplerBeamSharpening ? "mode.sharpening" : "mode.along_resolution_m";
}

}  // namespace sigmascape::radar
