#include "calibration/plateau.hpp"

#include <array>

#include <gmock/gmock.h>

namespace maggic::calibration {
namespace {

Plateau find(std::initializer_list<double> worth) {
  return find_plateau({worth.begin(), worth.size()}, 0.05);
}

TEST(Plateau, IsTheLongestStretchOfTheBestWorth) {
  const Plateau plateau = find({1.0, 6.0, 6.0, 5.9, 6.0, 2.0});
  EXPECT_EQ(plateau.first, 1u);
  EXPECT_EQ(plateau.last, 4u);
  EXPECT_EQ(plateau.middle(), 3u);
}

TEST(Plateau, OutlastsALonePeak) {
  const Plateau plateau = find({0.0, 7.0, 6.0, 6.0, 6.0, 1.0});
  EXPECT_EQ(plateau.first, 2u);
  EXPECT_EQ(plateau.last, 4u);
}

TEST(Plateau, IsNotALongStretchOfLittleWorth) {
  const Plateau plateau = find({1.0, 1.0, 1.0, 1.0, 6.0});
  EXPECT_EQ(plateau.first, 4u);
}

TEST(Plateau, IsTheLeastBadStepWhereNothingIsGood) {
  const Plateau plateau = find({-3.0, -1.0, -2.0});
  EXPECT_EQ(plateau.first, 1u);
  EXPECT_EQ(plateau.last, 1u);
}

}  // namespace
}  // namespace maggic::calibration
