#include "maggic/color_samples.hpp"

#include <gmock/gmock.h>

namespace maggic {
namespace {

TEST(GrayThreshold, SaysWhatRoomThereIs) {
  EXPECT_EQ(describe(GrayThreshold{.best = 30, .lowest = 12, .highest = 48}),
            "12 … 48 finds the same robots");
}

TEST(GrayThreshold, SaysWhenThereIsNone) {
  EXPECT_EQ(describe(GrayThreshold{.best = 30, .lowest = 30, .highest = 30}),
            "the only one of those tried that finds all");
}

TEST(GrayThreshold, SaysWhenItWasChosenByHand) {
  EXPECT_EQ(describe(GrayThreshold{.best = 30, .lowest = 12, .highest = 48, .given = true}),
            "given by hand");
}

}  // namespace
}  // namespace maggic
