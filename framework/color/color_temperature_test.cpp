#include "maggic/color_temperature.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace maggic {
namespace {

using ::testing::Each;
using ::testing::Gt;

TEST(ColorTemperature, ChangesNothingAt6500K) {
  for (const double gain : lamp_gains(6500.0)) EXPECT_NEAR(gain, 1.0, 1e-12);
}

TEST(ColorTemperature, AgreesWithTabulatedBlackBodies) {
  // Linear sRGB of black bodies (2° observer): 4000 K (1, 0.617, 0.381), 6500 K (1, 0.947, 0.982),
  // 10000 K (0.604, 0.694, 1).
  const auto warm = lamp_gains(4000.0);
  EXPECT_NEAR(warm[0], (1 / 0.617) / (1 / 0.947), 0.1);
  EXPECT_NEAR(warm[2], (0.381 / 0.617) / (0.982 / 0.947), 0.05);
  const auto cool = lamp_gains(10000.0);
  EXPECT_NEAR(cool[0], (0.604 / 0.694) / (1 / 0.947), 0.04);
  EXPECT_NEAR(cool[2], (1 / 0.694) / (0.982 / 0.947), 0.06);
}

TEST(ColorTemperature, TurnsFromRedToBlueWithoutAKink) {
  auto before = lamp_gains(kLowestKelvin);
  for (double kelvin = kLowestKelvin + 10.0; kelvin <= kHighestKelvin; kelvin += 10.0) {
    const auto gains = lamp_gains(kelvin);
    EXPECT_LT(gains[0], before[0] + 1e-3) << kelvin;
    EXPECT_GT(gains[2], before[2] - 1e-3) << kelvin;
    EXPECT_LT(std::abs(gains[0] - before[0]), 0.05) << kelvin;
    EXPECT_THAT(gains, Each(Gt(0.0)));
    before = gains;
  }
}

}  // namespace
}  // namespace maggic
