#include "sigmascape/radar/channels.h"

#include <gtest/gtest.h>

namespace sigmascape::radar {
namespace {

constexpr Channels example{2.0F, 3.0F, 0.5F, -1.0F};

TEST(Channels, PolarizationsChooseTheirPower) {
  EXPECT_EQ(example.power(Polarization::VV), 2.0F);
  EXPECT_EQ(example.power(Polarization::HH), 3.0F);
  EXPECT_EQ(example.power(Polarization::HV), 0.5F);
  EXPECT_EQ(example.power(Polarization::VH), 0.5F);
}

TEST(Channels, SumCountsBothCrossPolarizations) {
  EXPECT_EQ(example.power(Polarization::Sum), 6.0F);
}

TEST(Channels, AddAndScaleAllFour) {
  Channels sum = example;
  sum += Channels{1.0F, 1.0F, 1.0F, 1.0F};
  EXPECT_EQ(sum, (Channels{3.0F, 4.0F, 1.5F, 0.0F}));
  EXPECT_EQ(example * 2.0F, (Channels{4.0F, 6.0F, 1.0F, -2.0F}));
}

}  // namespace
}  // namespace sigmascape::radar
