#include "box_fit.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic::yuv_boxes {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Label kBlue = 2;
constexpr Label kRed = 4;

struct Samples {
  std::vector<Yuv> colors;
  std::vector<Label> labels;
  std::vector<std::int32_t> tags;

  /// A pixel for every third value of a cube of colours.
  Samples& add(Label label, Yuv first, Yuv last, std::int32_t tag) {
    for (int y = first[0]; y <= last[0]; y += 3) {
      for (int u = first[1]; u <= last[1]; u += 3) {
        for (int v = first[2]; v <= last[2]; v += 3) {
          colors.push_back({static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(u),
                            static_cast<std::uint8_t>(v)});
          labels.push_back(label);
          tags.push_back(label == kBackground ? kNoTag : tag);
        }
      }
    }
    return *this;
  }
  std::vector<FittedBox> fit() const { return fit_boxes(colors, labels, tags); }
};

double share_held(const Samples& samples, const FittedBox& box, bool own) {
  double held = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < samples.colors.size(); ++i) {
    if ((samples.labels[i] == box.label) != own) continue;
    held += holds(box.box, samples.colors[i]) ? 1.0 : 0.0;
    all += 1.0;
  }
  return held / all;
}

TEST(Holds, BothEndsOfEverySide) {
  const std::array<Side, 3> box{{{10, 20}, {30, 40}, {50, 60}}};
  EXPECT_TRUE(holds(box, {10, 30, 50}));
  EXPECT_TRUE(holds(box, {20, 40, 60}));
  EXPECT_FALSE(holds(box, {9, 30, 50}));
  EXPECT_FALSE(holds(box, {10, 41, 50}));
  EXPECT_FALSE(holds(box, {10, 30, 61}));
}

TEST(BoxFit, NoTagsNoBoxes) {
  EXPECT_THAT(Samples().add(kBackground, {50, 120, 120}, {60, 130, 130}, 0).fit(), IsEmpty());
}

TEST(BoxFit, ABoxHoldsWhatWasSeenAndTheRoomRoundIt) {
  const auto boxes = Samples().add(kBlue, {80, 170, 90}, {110, 185, 105}, 0).fit();
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_EQ(boxes[0].label, kBlue);
  EXPECT_EQ(boxes[0].tags, 1);
  EXPECT_EQ(boxes[0].seen[0].min, 80);
  EXPECT_EQ(boxes[0].seen[1].max, 185);
  // 40 steps of brightness, 14 of colour: light changes the one far more than the other.
  EXPECT_NEAR(boxes[0].box[0].min, 40, 1);
  EXPECT_NEAR(boxes[0].box[0].max, 149, 2);
  EXPECT_NEAR(boxes[0].box[1].min, 156, 1);
  EXPECT_NEAR(boxes[0].box[2].max, 119, 1);
  EXPECT_EQ(boxes[0].foreign, 0.0);
}

TEST(BoxFit, ABoxStopsWhereAnotherColourBegins) {
  Samples samples;
  samples.add(kBlue, {80, 170, 90}, {110, 185, 105}, 0)
      .add(kRed, {80, 194, 90}, {110, 209, 105}, 1);
  for (const FittedBox& box : samples.fit()) {
    EXPECT_EQ(share_held(samples, box, true), 1.0);
    EXPECT_EQ(share_held(samples, box, false), 0.0);
  }
}

TEST(BoxFit, ABoxStopsWhereTheBackgroundBegins) {
  Samples samples;
  samples.add(kBlue, {80, 170, 90}, {110, 185, 105}, 0)
      .add(kBackground, {20, 160, 90}, {74, 200, 120}, 0);
  const auto boxes = samples.fit();
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_GT(boxes[0].box[0].min, 74);
  EXPECT_EQ(share_held(samples, boxes[0], true), 1.0);
}

TEST(BoxFit, SaysHowMuchOfABoxIsSomethingElse) {
  Samples samples;
  samples.add(kBlue, {80, 170, 90}, {110, 185, 105}, 0)
      .add(kRed, {80, 170, 90}, {110, 185, 105}, 1);
  for (const FittedBox& box : samples.fit()) EXPECT_NEAR(box.foreign, 0.5, 0.05);
}

TEST(BoxFit, CountsTagsAndOrdersByLabel) {
  Samples samples;
  samples.add(kRed, {80, 100, 200}, {90, 110, 210}, 0)
      .add(kBlue, {80, 170, 90}, {90, 180, 100}, 1)
      .add(kRed, {85, 100, 200}, {95, 110, 210}, 2);
  const auto boxes = samples.fit();
  ASSERT_THAT(boxes, SizeIs(2));
  EXPECT_EQ(boxes[0].label, kBlue);
  EXPECT_EQ(boxes[1].label, kRed);
  EXPECT_EQ(boxes[1].tags, 2);
}

TEST(BoxFit, APixelIsEnough) {
  const auto boxes = Samples().add(kRed, {0, 255, 128}, {0, 255, 128}, 0).fit();
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_TRUE(holds(boxes[0].box, {0, 255, 128}));
  EXPECT_GE(boxes[0].box[0].min, 0);
  EXPECT_LE(boxes[0].box[1].max, 255);
}

RC_GTEST_PROP(BoxFitProperty, BoxesStayWithinAByteAndHoldTheHeartOfTheirColour, ()) {
  Samples samples;
  const int count = *rc::gen::inRange(1, 5);
  for (int i = 0; i < count; ++i) {
    Yuv first{};
    Yuv last{};
    for (std::size_t c = 0; c < 3; ++c) {
      first[c] = static_cast<std::uint8_t>(*rc::gen::inRange(0, 230));
      last[c] = static_cast<std::uint8_t>(first[c] + *rc::gen::inRange(0, 20));
    }
    samples.add(static_cast<Label>(i), first, last, i);  // the first one is background
  }
  const auto boxes = samples.fit();
  RC_ASSERT(boxes.size() == static_cast<std::size_t>(count - 1));
  for (const FittedBox& box : boxes) {
    for (std::size_t c = 0; c < 3; ++c) {
      RC_ASSERT(box.box[c].min >= 0 && box.box[c].max <= 255);
      RC_ASSERT(box.box[c].min <= box.box[c].max);
    }
    RC_ASSERT(share_held(samples, box, true) > 0.2);
  }
}

}  // namespace
}  // namespace maggic::yuv_boxes
