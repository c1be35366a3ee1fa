#include "sigmascape/receiver/receiver_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "physics/level_terrain.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/iq_record.h"
#include "sigmascape/radar/analog_to_digital.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/receiver/calibrated_voltage.h"
#include "sigmascape/receiver/pulse_receiver.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::string_view receiver_group = "Receiver";

/// Looks north from the south, 20° down on the middle of the terrain, and flies east.
radar::Radar spotlight_looking_north() {
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(20.0), 4000.0);
  radar.velocity_mps = {100.0, 0.0, 0.0};
  radar.range_resolution_m = 3.0;
  radar.beam_width_rad = radians_from_deg(20.0);
  radar.waveform.pulse_repetition_hz = 2000.0;
  radar.mode = radar::Mode::Spotlight;
  return radar;
}

/// Volts of the noise in I or Q, root mean square.
double noise_v(const radar::Radar& radar) {
  return std::sqrt(radar::noise_power_w(radar) * radar.receiver.gain * radar.receiver.impedance_ohm / 2.0);
}

/// 64 pulses of nothing but noise, behind the first amplifier.
radar::PhaseHistory noise_of(const radar::Radar& radar) {
  const receiver::PulseReceiver receiver(radar, {3500.0, 4500.0, 1.2});
  auto history = receiver.receive(radar::Track::straight(radar.position, radar.velocity_mps), {.count = 64}, {}, {},
                                  receiver::calibrated_voltage(radar, receiver::towards({})));
  receiver::add_thermal_noise(history, radar, 5);
  return history;
}

radar::PhaseHistory output_of(radar::PhaseHistory history, const radar::Radar& radar, unsigned threads = 0) {
  receiver::bring_to_output(history, radar, threads);
  return history;
}

/// Mean square of I and of Q of what two recordings differ by, V².
std::array<double, 2> mean_square_difference(const radar::PhaseHistory& a, const radar::PhaseHistory& b) {
  std::array<double, 2> sums{};
  const auto of_a = a.samples.values(), of_b = b.samples.values();
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const std::complex<float> pairs[3] = {of_a[i].vv - of_b[i].vv, of_a[i].hh - of_b[i].hh, of_a[i].hv - of_b[i].hv};
    for (const std::complex<float> difference : pairs) {
      sums[0] += std::pow(static_cast<double>(difference.real()), 2);
      sums[1] += std::pow(static_cast<double>(difference.imag()), 2);
    }
  }
  for (double& sum : sums) sum /= 3.0 * static_cast<double>(of_a.size());
  return sums;
}

TEST(ReceiverOutput, HasATwelfthOfAStepSquaredOfRoundingNoiseInIAndInQ) {
  radar::Radar radar = spotlight_looking_north();
  const auto before = noise_of(radar);
  radar.receiver.analog_to_digital = radar::AnalogToDigital{.bits = 5, .full_scale_v = 16.0 * noise_v(radar)};
  const auto after = output_of(before, radar);
  const double step_v = noise_v(radar);
  const auto [in_i, in_q] = mean_square_difference(after, before);
  validation::expect_close({receiver_group, "rounding noise in I of pulses, over the step squared", 1.0 / 12.0,
                            in_i / (step_v * step_v), 0.002, "1", "Δ²/12"});
  validation::expect_close({receiver_group, "rounding noise in Q of pulses, over the step squared", 1.0 / 12.0,
                            in_q / (step_v * step_v), 0.002, "1", "Δ²/12"});
  EXPECT_EQ(after.saturated, 0U);
  for (const auto& sample : after.samples.values())
    ASSERT_NEAR(std::remainder(static_cast<double>(sample.hv.imag()) / step_v, 1.0), 0.0, 1e-5);
}

/// Of Gaussian noise of spread s, I lies beyond ±a with the probability erfc(a/√2s), and I or Q with 1 − (1 − p)².
TEST(ReceiverOutput, IsClippedInIAndInQAtFullScale) {
  radar::Radar radar = spotlight_looking_north();
  const auto before = noise_of(radar);
  const double full_scale_v = 1.5 * noise_v(radar);
  radar.receiver.analog_to_digital = radar::AnalogToDigital{.bits = 14, .full_scale_v = full_scale_v};
  const auto after = output_of(before, radar);
  double highest = -1.0, lowest = 1.0;
  for (const auto& sample : after.samples.values()) {
    for (const float part : {sample.vv.real(), sample.vv.imag(), sample.hh.real(), sample.hv.imag()}) {
      highest = std::max(highest, static_cast<double>(part) / full_scale_v);
      lowest = std::min(lowest, static_cast<double>(part) / full_scale_v);
    }
  }
  EXPECT_NEAR(highest, 1.0 - 1.0 / 8192.0, 1e-6) << "the greatest code is one less than half of them";
  EXPECT_NEAR(lowest, -1.0, 1e-6);
  const double part = std::erfc(1.5 / std::numbers::sqrt2), samples = 3.0 * static_cast<double>(after.samples.size());
  validation::expect_close({receiver_group, "clipped part of noise, full scale at 1.5 times its spread in I and Q",
                            1.0 - (1.0 - part) * (1.0 - part), static_cast<double>(after.saturated) / samples, 0.005,
                            "1", "erfc"});
  EXPECT_THAT(receiver::output_warnings(after), ElementsAre(HasSubstr("the converter clips 2")));
}

/// What lies less than half a step below full scale has no code of its own.
TEST(ReceiverOutput, CountsWhatTheGreatestCodeFallsShortOf) {
  const radar::AnalogToDigital converter{.bits = 3, .full_scale_v = 1.0};
  EXPECT_FALSE(radar::saturates(converter, 0.87));
  EXPECT_TRUE(radar::saturates(converter, 0.88));
  EXPECT_FALSE(radar::saturates(converter, -1.12));
  EXPECT_TRUE(radar::saturates(converter, -1.13));
  EXPECT_FALSE(radar::saturates(converter, std::nan("")));
}

/// Even ground is recorded, lowered, and divided by what the file says of it: then each range has what it had.
TEST(ReceiverOutput, GivesSigma0BackByTheLawThatTheFileTells) {
  const auto terrain = level_terrain();
  radar::Radar radar = spotlight_looking_north();
  const auto recorded = [&] {
    const simulate::CoherentScene scene{&terrain, [](Vec2d, const radar::Aspect&) {
                                          return radar::Channels{1.0F, 0.5F, 0.1F, 0.0F};
                                        }};
    return simulate::phase_history(scene, radar, {-400.0, -400.0, 400.0, 400.0},
                                   {.interval_s = 0.004, .scatterer_spacing_m = 3.0, .calibrated = true});
  };
  const auto plain = recorded();
  EXPECT_FALSE(product::iq_record(plain, radar).numbers.contains("stc_exponent"));
  EXPECT_FALSE(product::iq_record(plain, radar).numbers.contains("adc_bits"));
  radar.receiver.sensitivity_time_control = radar::SensitivityTimeControl{4.1e3, 3.5};
  const auto lowered = recorded();
  const auto numbers = product::iq_record(lowered, radar).numbers;
  EXPECT_DOUBLE_EQ(numbers.at("stc_full_gain_range_m"), 4.1e3);
  EXPECT_DOUBLE_EQ(numbers.at("stc_exponent"), 3.5);
  ASSERT_EQ(lowered.samples.columns(), plain.samples.columns());
  double before_w = 0.0, after_w = 0.0, nearest_gain = 1.0;
  for (std::size_t m = 0; m < plain.samples.columns(); ++m) {
    const double range_m = numbers.at("first_range_m") + static_cast<double>(m) * numbers.at("range_step_m");
    const double gain =
        std::min(1.0, std::pow(range_m / numbers.at("stc_full_gain_range_m"), numbers.at("stc_exponent")));
    nearest_gain = std::min(nearest_gain, gain);
    for (std::size_t pulse = 0; pulse < plain.pulses.size(); ++pulse) {
      const auto expected = plain.samples(m, pulse).hh, given = lowered.samples(m, pulse).hh;
      ASSERT_NEAR(std::abs(given), std::sqrt(gain) * std::abs(expected), 1e-6 * std::abs(expected));
      before_w += std::norm(std::complex<double>(expected));
      after_w += std::norm(std::complex<double>(given)) / gain;
    }
  }
  EXPECT_LT(nearest_gain, 0.8) << "or nothing was lowered";
  validation::expect_close({receiver_group,
                            "power of even ground in pulses, time control divided out, over that without", 0.0,
                            db_from_linear(after_w / before_w), 0.001, "dB", "(r/r_full)^n"});
  EXPECT_EQ(numbers.at("noise_power_w"), product::iq_record(plain, radar).numbers.at("noise_power_w"));
}

/// The control comes first: full scale is that of what it has lowered.
TEST(ReceiverOutput, IsConvertedBehindTimeControl) {
  radar::Radar radar = spotlight_looking_north();
  const auto before = noise_of(radar);
  radar.receiver.sensitivity_time_control = radar::SensitivityTimeControl{40e3, 4.0};
  radar.receiver.analog_to_digital = radar::AnalogToDigital{.bits = 12, .full_scale_v = 0.2 * noise_v(radar)};
  const auto after = output_of(before, radar);
  EXPECT_EQ(after.saturated, 0U) << "noise is a hundredth of what it was before";
  const auto numbers = product::iq_record(after, radar).numbers;
  EXPECT_EQ(numbers.at("adc_bits"), 12.0);
  EXPECT_DOUBLE_EQ(numbers.at("adc_full_scale_v"), 0.2 * noise_v(radar));
  EXPECT_EQ(numbers.at("saturated_samples"), 0.0);
  EXPECT_THAT(receiver::output_warnings(after), IsEmpty());
}

TEST(ReceiverOutput, IsTheSameForAnyNumberOfThreadsAndWithoutKeysWhatWentIn) {
  radar::Radar radar = spotlight_looking_north();
  const auto before = noise_of(radar);
  EXPECT_TRUE(std::ranges::equal(output_of(before, radar).samples.values(), before.samples.values()));
  radar.receiver.sensitivity_time_control = radar::SensitivityTimeControl{4e3, 3.0};
  radar.receiver.analog_to_digital = radar::AnalogToDigital{.bits = 6, .full_scale_v = 2.0 * noise_v(radar)};
  const auto one = output_of(before, radar, 1), many = output_of(before, radar, 7);
  EXPECT_TRUE(std::ranges::equal(one.samples.values(), many.samples.values()));
  EXPECT_EQ(one.saturated, many.saturated);
  EXPECT_GT(one.saturated, 0U);
}

/// The default gain of 0 dB leaves microvolts, of which a converter of ±1 V makes zeros.
TEST(ReceiverOutput, IsWarnedOfWhereNothingIsLeft) {
  radar::Radar radar = spotlight_looking_north();
  radar.receiver.analog_to_digital = radar::AnalogToDigital{.bits = 12, .full_scale_v = 1.0};
  const auto history = output_of(noise_of(radar), radar);
  EXPECT_THAT(receiver::output_warnings(history),
              ElementsAre(HasSubstr("makes zero of every sample, for none comes to half of its step of 0.000488 V; "
                                    "raise receiver.gain_db")));
  auto metres = noise_of(radar);
  metres.unit = "m";
  EXPECT_THROW(receiver::bring_to_output(metres, radar), std::exception);
}

}  // namespace
}  // namespace sigmascape
