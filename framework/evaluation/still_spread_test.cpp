#include "maggic/still_spread.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace maggic {
namespace {

TEST(StillSpread, SaysNothingWithoutALongEnoughStretch) {
  StillSpread spread;
  EXPECT_FALSE(spread.deviation());
  for (int i = 0; i < 4; ++i) spread.add({1.0 * i, 0.0}, {0.0, 0.0});
  EXPECT_FALSE(spread.deviation());
}

TEST(StillSpread, IsTheDeviationAboutTheOwnMeanSoThatABiasDoesNotCount) {
  StillSpread spread;
  for (const double x : {8.0, 9.0, 10.0, 11.0, 12.0}) spread.add({x, 700.0}, {0.0, 0.0});
  EXPECT_NEAR(spread.deviation().value(), std::sqrt(10.0 / 4.0), 1e-12);
}

TEST(StillSpread, AnObjectThatMovesHasNoJitter) {
  StillSpread spread;
  for (int i = 0; i < 50; ++i) spread.add({1.0 * i, 0.0}, {1.0 * i, 0.0});
  EXPECT_FALSE(spread.deviation());
}

TEST(StillSpread, PoolsStretchesEachAboutItsOwnMean) {
  StillSpread spread;
  for (const double x : {-1.0, -1.0, 0.0, 1.0, 1.0}) spread.add({x, 0.0}, {0.0, 0.0});
  for (const double x : {-1.0, -1.0, 0.0, 1.0, 1.0}) spread.add({300.0 + x, 0.0}, {300.0, 0.0});
  EXPECT_NEAR(spread.deviation().value(), 1.0, 1e-12);
}

TEST(StillSpread, MergesObjects) {
  StillSpread one;
  StillSpread two;
  for (const double x : {-1.0, -1.0, 0.0, 1.0, 1.0}) one.add({x, 0.0}, {0.0, 0.0});
  for (int i = 0; i < 5; ++i) two.add({40.0, 30.0}, {40.0, 30.0});
  one.merge(two);
  EXPECT_NEAR(one.deviation().value(), std::sqrt(4.0 / 8.0), 1e-12);
}

}  // namespace
}  // namespace maggic
