#include "sigmascape/receiver/pulse_receiver.h"

#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "scratch_folder.h"

#include "sigmascape/receiver/calibrated_voltage.h"

namespace sigmascape::receiver {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(PulseReceiver, RefusesPulsesThatMemoryDoesNotHold) {
  const PulseReceiver receiver({}, {1000.0, 1500.0, 1.25});
  const PulseTrain few{.count = 2}, many{.count = 5'000'000};
  const std::size_t samples = receiver.receive(radar::Track::straight({}), few, {}, {}).samples.columns();
  // Of three polarizations in two floats each.
  const double few_bytes = 2.0 * static_cast<double>(samples) * 24.0;
  EXPECT_NO_THROW(receiver.check(few, few_bytes));
  EXPECT_THAT(message_of_error([&] { receiver.check(few, few_bytes - 1.0); }), HasSubstr("coherent interval"));
  EXPECT_THAT(message_of_error([&] { receiver.check(many, 4e9); }),
              AllOf(HasSubstr("has 5000000 pulses of"), HasSubstr("GB of memory, and there are 4;"),
                    EndsWith("record a shorter interval or a shorter range gate, or send fewer pulses a second")));
}

TEST(PulseReceiver, RefusesAGateThatIsWiderThanPulsesTellApart) {
  const PulseReceiver receiver({}, {1000.0, 1500.0, 1.25});
  EXPECT_NO_THROW(receiver.check({.repetition_hz = 250e3}, 1e9));
  // c/2f is 499.7 m.
  EXPECT_THAT(message_of_error([&] { receiver.check({.repetition_hz = 300e3}, 1e9); }), HasSubstr("range gate"));
}

/// The radar's own platform, in whatever list of targets it stands, echoes nothing; nor does it fold into the gate.
TEST(PulseReceiver, HearsNothingOfItsOwnPlatform) {
  const radar::Track platform = radar::Track::straight({0.0, 0.0, 1000.0}, {100.0, 0.0, 0.0});
  std::vector<radar::Target> own(1);
  own[0].track = platform;
  own[0].rcs_m2 = radar::Channels{10.0F, 10.0F, 0.0F, 10.0F};
  radar::Radar radar;
  const VoltageGain volts = calibrated_voltage(radar, fixed_at(0.0));
  const PulseReceiver receiver(radar, {1000.0, 1500.0, 1.25});
  // Of echoes that come twice around 1249 m are of no range at all.
  for (const double repetition_hz : {240e3, 1e3}) {
    const auto pulses = receiver.receive(platform, {.count = 2, .repetition_hz = repetition_hz}, {}, own, volts);
    for (const auto& sample : pulses.samples.values()) ASSERT_EQ(std::abs(sample.vv), 0.0F) << repetition_hz;
  }
}

}  // namespace
}  // namespace sigmascape::receiver
