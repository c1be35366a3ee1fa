#include "sigmascape/receiver/range_gate.h"

#include <cmath>
#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace sigmascape::receiver {
namespace {

std::string fault_of(const radar::Radar& radar, const RangeGate& gate) {
  return message_of_error([&] { static_cast<void>(gated_axis(radar, gate)); });
}

/// One end is the radar file's and the other that of what is mapped: who reads it has to know which to change.
TEST(RangeGate, ThatIsEmptyNamesTheKeyThatMakesItSo) {
  radar::Radar radar;
  radar.name = "scout";
  radar.receiver.first_range_m = 20e3;
  EXPECT_EQ(fault_of(radar, {20e3, 8305.66}),
            "radar scout: receiver.first_range_km: opens the range gate at 20 km, and what is mapped ends at 8.30566 "
            "km; open it nearer, or map what lies farther away");
  const double squinted = std::cos(0.1);
  EXPECT_EQ(fault_of(radar, {20e3 * squinted, 8305.66 * squinted, 1.2, squinted}),
            "radar scout: receiver.first_range_km: opens the range gate at 20 km, and what is mapped ends at 8.30566 "
            "km; open it nearer, or map what lies farther away");
  radar.receiver.first_range_m.reset();
  radar.receiver.last_range_m = 2e3;
  EXPECT_EQ(fault_of(radar, {7500.0, 2e3}),
            "radar scout: receiver.last_range_km: closes the range gate at 2 km, and what is mapped begins at 7.5 km; "
            "close it farther away, or map what lies nearer");
  radar.receiver.last_range_m.reset();
  EXPECT_EQ(fault_of(radar, {7500.0, 7000.0}),
            "range gate: goes from 7500 m to 7000 m; let it end beyond where it begins");
}

}  // namespace
}  // namespace sigmascape::receiver
