#include "sigmascape/receiver/receiver_output.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>

#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/analog_to_digital.h"
#include "sigmascape/radar/sensitivity_time_control.h"
#include "sigmascape/receiver/receive_chain.h"

namespace sigmascape::receiver {
namespace {

void control(radar::PhaseHistory& history, const radar::SensitivityTimeControl& control, unsigned threads) {
  std::vector<float> voltage_gain(history.samples.columns());
  for (std::size_t m = 0; m < voltage_gain.size(); ++m) {
    const double range_m = history.first_range_m + static_cast<double>(m) * history.range_step_m;
    voltage_gain[m] = static_cast<float>(std::sqrt(radar::power_gain(control, range_m)));
  }
  parallel_for(history.samples.rows(), threads, [&](std::size_t pulse, unsigned) {
    const auto samples = history.samples.row(pulse);
    for (std::size_t m = 0; m < samples.size(); ++m) samples[m] = samples[m] * voltage_gain[m];
  });
  history.sensitivity_time_control = control;
}

void convert(radar::PhaseHistory& history, const radar::AnalogToDigital& converter, unsigned threads) {
  std::vector<std::uint64_t> saturated(history.samples.rows());
  parallel_for(history.samples.rows(), threads, [&](std::size_t pulse, unsigned) {
    for (radar::ComplexChannels& sample : history.samples.row(pulse)) {
      for (std::complex<float>* const of : {&sample.vv, &sample.hh, &sample.hv})
        saturated[pulse] += digitise({of, 1}, converter);
    }
  });
  history.analog_to_digital = converter;
  history.saturated = std::accumulate(saturated.begin(), saturated.end(), std::uint64_t{0});
}

}  // namespace

void bring_to_output(radar::PhaseHistory& history, const radar::Radar& radar, unsigned threads) {
  if (history.unit != "V")
    throw Error("receiver's output", "the record is in " + history.unit, "make it in volts, with calibrated_voltage");
  if (radar.receiver.sensitivity_time_control) control(history, *radar.receiver.sensitivity_time_control, threads);
  if (radar.receiver.analog_to_digital) convert(history, *radar.receiver.analog_to_digital, threads);
}

std::vector<std::string> output_warnings(const radar::PhaseHistory& history) {
  if (!history.analog_to_digital) return {};
  const auto samples = history.samples.values();
  const auto count = static_cast<double>(samples.size() * radar::ComplexChannels::count);
  if (history.saturated > 0) {
    return {
        fmt::format("the converter clips {:.2g} % of the samples, beyond ±{:g} V; raise receiver.adc_full_scale_v "
                    "or lower receiver.gain_db",
                    100.0 * static_cast<double>(history.saturated) / count, history.analog_to_digital->full_scale_v)};
  }
  if (std::ranges::all_of(samples, [](const radar::ComplexChannels& v) { return v == radar::ComplexChannels{}; })) {
    return {
        fmt::format("the converter makes zero of every sample, for none comes to half of its step of {:.3g} V; "
                    "raise receiver.gain_db or lower receiver.adc_full_scale_v",
                    radar::step_v(*history.analog_to_digital))};
  }
  return {};
}

}  // namespace sigmascape::receiver
