#include "sigmascape/radar/radar_equation.h"

#include <cmath>
#include <gtest/gtest.h>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::radar {
namespace {

void expect_budget_db(const char* name, double expected_db, double measured_db, const char* source) {
  validation::expect_close({.group = "Radar equation",
                            .name = name,
                            .expected = expected_db,
                            .measured = measured_db,
                            .tolerance = 0.1,
                            .unit = "dB",
                            .source = source});
}

/// 10 GHz (λ = 29.979 mm), 10 kW, 30 dB of gain, 5 dB of losses.
Radar round_numbers() {
  Radar radar;
  radar.frequency_hz = 10e9;
  radar.antenna.gain = 1000.0;
  radar.waveform.peak_power_w = 10e3;
  radar.receiver.losses = linear_from_db(5.0);
  return radar;
}

// By hand in decibels: 40 + 60 − 30.463 + 10 − 32.976 − 160 − 5 dBW.
TEST(RadarEquation, TenSquareMetresAtTenKilometres) {
  expect_budget_db("received power, 10 m² at 10 km", 40.0 + 60.0 - 30.463 + 10.0 - 32.976 - 160.0 - 5.0,
                   db_from_linear(received_power_w(round_numbers(), 10.0, 10e3)), "decibel budget");
}

TEST(RadarEquation, AirTakesItsDecibelsOnBothWays) {
  Radar radar = round_numbers();
  const double clear = received_power_w(radar, 1.0, 10e3);
  radar.atmosphere_per_m = std::log(linear_from_db(0.4)) / 1e3;
  EXPECT_NEAR(db_from_linear(received_power_w(radar, 1.0, 10e3) / clear), -8.0, 1e-9);
}

// −174 dBm/Hz: k T₀ = 4.00e-21 J.
TEST(Noise, OfOneMegahertzIsMinus114DecibelMilliwatts) {
  expect_budget_db("k T₀ B, 1 MHz", -113.975, db_from_linear(thermal_noise_w(1e6, 1.0) * 1e3), "IEEE, T₀ = 290 K");
  EXPECT_DOUBLE_EQ(thermal_noise_w(2e6, 4.0), 8.0 * thermal_noise_w(1e6, 1.0));
}

// SNR of one pulse is an energy ratio, P τ / (k T₀ F), less the loss of the window: it does not depend on bandwidth.
TEST(SignalToNoise, DependsOnTheEnergyOfThePulse) {
  Radar radar = round_numbers();
  radar.waveform.pulse_length_s = 10e-6;
  radar.receiver.noise_figure = linear_from_db(4.0);
  for (const double resolution_m : {1.0, 30.0}) {
    radar.range_resolution_m = resolution_m;
    radar.waveform.window = {.shape = WindowShape::Rectangular};
    const double energy_ratio =
        received_power_w(radar, 10.0, 10e3) * 10e-6 / (1.380649e-23 * 290.0 * linear_from_db(4.0));
    EXPECT_NEAR(signal_to_noise(radar, 10.0, 10e3) / energy_ratio, 1.0, 1e-9);
    radar.waveform.window = {.shape = WindowShape::Hamming};
    expect_budget_db("loss of the Hamming window", -1.34,
                     db_from_linear(signal_to_noise(radar, 10.0, 10e3) / energy_ratio), "Harris, Proc. IEEE 66 (1978)");
  }
}

}  // namespace
}  // namespace sigmascape::radar
