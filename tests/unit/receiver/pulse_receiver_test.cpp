#include "sigmascape/receiver/pulse_receiver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

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

}  // namespace
}  // namespace sigmascape::receiver
