#include "pivot_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic::hue_pivots {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;

constexpr Label kRed = 4;
constexpr Label kOrange = 1;
constexpr Label kYellow = 3;
constexpr Label kBlue = 2;

/// Tags, each of one colour, with the hues of their pixels.
class Tags {
 public:
  Tags& tag(Label label, int first_hue, int last_hue, int pixels_a_hue = 10) {
    for (int hue = first_hue; hue <= last_hue; ++hue) {
      for (int i = 0; i < pixels_a_hue; ++i) add(label, hue, tags_);
    }
    ++tags_;
    return *this;
  }
  Tags& background(int hue, int pixels) {
    for (int i = 0; i < pixels; ++i) add(kBackground, hue, kNoTag);
    return *this;
  }
  /// The same tags under other light.
  Tags& imagine(Label label, int first_hue, int last_hue) {
    for (int hue = first_hue; hue <= last_hue; ++hue) {
      imagined_hues_.push_back(static_cast<std::uint8_t>((hue + 256) % 256));
      imagined_labels_.push_back(label);
    }
    return *this;
  }

  PivotFit fit(const Pivots& known = {}) const {
    return fit_pivots(hues_, labels_, ids_, {imagined_hues_, imagined_labels_}, known);
  }

  /// Share of a tag's pixels these pivots give its label, of the tag that keeps least.
  double worst_share(const Pivots& pivots) const {
    const auto label_of = nearest_pivots(pivots);
    std::map<std::int32_t, std::pair<double, double>> kept_of;
    for (std::size_t i = 0; i < hues_.size(); ++i) {
      if (labels_[i] == kBackground) continue;
      auto& [kept, all] = kept_of[ids_[i]];
      kept += label_of[hues_[i]] == labels_[i] ? 1.0 : 0.0;
      all += 1.0;
    }
    double worst = 1.0;
    for (const auto& [id, count] : kept_of) worst = std::min(worst, count.first / count.second);
    return worst;
  }

 private:
  void add(Label label, int hue, std::int32_t id) {
    hues_.push_back(static_cast<std::uint8_t>((hue + 256) % 256));
    labels_.push_back(label);
    ids_.push_back(id);
  }

  std::vector<std::uint8_t> hues_;
  std::vector<Label> labels_;
  std::vector<std::int32_t> ids_;
  std::int32_t tags_ = 0;
  std::vector<std::uint8_t> imagined_hues_;
  std::vector<Label> imagined_labels_;
};

Pivots pivots_of(const PivotFit& fit) {
  Pivots pivots;
  for (const FittedColor& color : fit.colors) {
    if (!color.pivots.empty()) pivots.push_back({color.label, color.pivots});
  }
  return pivots;
}

const FittedColor& color_of(const PivotFit& fit, Label label) {
  return *std::ranges::find(fit.colors, label, &FittedColor::label);
}

/// Last hue, going up from `hue`, that still gets the same label.
int end_of(const PivotFit& fit, int hue) {
  const auto label_of = nearest_pivots(pivots_of(fit));
  const Label label = label_of[static_cast<std::size_t>(hue)];
  while (label_of[static_cast<std::size_t>(hue + 1) % 256] == label) ++hue;
  return hue;
}

Pivots moved(const PivotFit& fit, Label label, int by) {
  Pivots pivots = pivots_of(fit);
  for (auto& [name, hues] : pivots) {
    if (name != label) continue;
    for (int& hue : hues) hue = (hue + by + 256) % 256;
  }
  return pivots;
}

TEST(NearestPivots, GoRoundTheCircleAndTiesGoToTheFirstListed) {
  const auto labels = nearest_pivots({{kRed, {0}}, {kYellow, {40}}});
  EXPECT_EQ(labels[250], kRed);
  EXPECT_EQ(labels[19], kRed);
  EXPECT_EQ(labels[20], kRed) << "as far from both";
  EXPECT_EQ(labels[21], kYellow);
}

TEST(PivotFit, PutsTheBorderInTheMiddleOfTheGap) {
  const PivotFit fit = Tags().tag(kOrange, 10, 20).tag(kYellow, 40, 50).fit();
  EXPECT_NEAR(end_of(fit, 15), 30, 1);
  EXPECT_THAT(fit.overlaps, IsEmpty());
}

TEST(PivotFit, PutsItNearTheMiddleWhateverTheWidthsAndTheNeighbours) {
  const PivotFit fit = Tags()
                           .tag(kOrange, 10, 14)
                           .tag(kYellow, 30, 70)
                           .tag(kBlue, 150, 170)
                           .tag(kRed, 240, 250)
                           .fit();
  // A quarter of the gap to either side is not worth a second pivot; rounding takes one step more.
  EXPECT_NEAR(end_of(fit, 12), 22, 16 / 4 + 1);
  EXPECT_NEAR(end_of(fit, 50), 110, 80 / 4 + 1);
  EXPECT_NEAR(end_of(fit, 160), 205, 70 / 4 + 1);
  EXPECT_NEAR(end_of(fit, 245), 258, 16 / 4 + 1);
}

TEST(PivotFit, KeepsAColourAroundZeroInOnePiece) {
  const Tags tags = Tags().tag(kRed, -6, 6).tag(kOrange, 20, 26);
  const PivotFit fit = tags.fit();
  EXPECT_EQ(color_of(fit, kRed).first_hue, 250);
  EXPECT_EQ(color_of(fit, kRed).last_hue, 6);
  EXPECT_EQ(tags.worst_share(pivots_of(fit)), 1.0);
  EXPECT_NEAR(end_of(fit, 0), 13, 14 / 4 + 1);
}

TEST(PivotFit, ALonePivotOwnsTheCircle) {
  const PivotFit fit = Tags().tag(kBlue, 150, 160).fit();
  ASSERT_THAT(fit.colors, SizeIs(1));
  EXPECT_THAT(fit.colors[0].pivots, ElementsAre(AllOf(Ge(150), Le(160))));
  EXPECT_EQ(fit.colors[0].tags, 1);
}

TEST(PivotFit, NoTagsNoColours) { EXPECT_THAT(Tags().background(30, 100).fit().colors, IsEmpty()); }

TEST(PivotFit, BackgroundMovesNoBorder) {
  Tags tags = Tags().tag(kOrange, 10, 20).tag(kYellow, 40, 50);
  const Pivots without = pivots_of(tags.fit());
  EXPECT_EQ(pivots_of(tags.background(35, 5000).fit()), without);
}

TEST(PivotFit, ReportsColoursThatNoBorderParts) {
  const PivotFit fit = Tags().tag(kOrange, 10, 29).tag(kYellow, 20, 39).fit();
  ASSERT_THAT(fit.overlaps, Not(IsEmpty()));
  EXPECT_THAT((std::vector<Label>{fit.overlaps[0].a, fit.overlaps[0].b}),
              ::testing::UnorderedElementsAre(kOrange, kYellow));
  EXPECT_GE(fit.overlaps[0].share, 0.2);
  EXPECT_LE(fit.overlaps[0].share, 0.55);
}

TEST(PivotFit, ImaginedLightDecidesWhereWhatWasSeenLeavesAChoice) {
  Tags tags = Tags().tag(kOrange, 10, 20).tag(kYellow, 60, 70);
  const int before = end_of(tags.fit(), 15);
  const int after = end_of(tags.imagine(kOrange, 20, 50).fit(), 15);
  EXPECT_NEAR(before, 40, 1);
  EXPECT_GE(after, 45) << "orange may be seen up to 50";
}

TEST(PivotFit, ImaginedLightNeverOutweighsWhatWasSeen) {
  const PivotFit fit =
      Tags().tag(kOrange, 10, 20).tag(kYellow, 30, 40).imagine(kOrange, 30, 60).fit();
  EXPECT_LT(end_of(fit, 15), 30);
}

TEST(PivotFit, AColourNotSeenKeepsItsPivot) {
  const PivotFit fit =
      Tags().tag(kOrange, 10, 20).tag(kYellow, 40, 50).fit({{kBlue, {160}}, {kOrange, {99}}});
  ASSERT_THAT(fit.colors, SizeIs(3));
  EXPECT_EQ(fit.colors[0].label, kBlue) << "known ones first, in their order";
  EXPECT_THAT(fit.colors[0].pivots, ElementsAre(160));
  EXPECT_EQ(fit.colors[0].tags, 0);
  EXPECT_EQ(fit.colors[1].label, kOrange);
  EXPECT_EQ(fit.colors[2].label, kYellow);
}

TEST(PivotFit, AColourNotSeenGoesWhenItIsInTheWay) {
  const Tags tags = Tags().tag(kOrange, 10, 20).tag(kYellow, 40, 50);
  const PivotFit fit = tags.fit({{kRed, {13}}, {kBlue, {160}}});
  EXPECT_THAT(color_of(fit, kRed).pivots, IsEmpty());
  EXPECT_THAT(color_of(fit, kBlue).pivots, ElementsAre(160));
  EXPECT_EQ(tags.worst_share(pivots_of(fit)), 1.0);
}

TEST(PivotFit, AColourNotSeenGoesWhenASeenOnesPivotComesToLieOnIts) {
  Tags tags = Tags().tag(kYellow, 58, 69).tag(kBlue, 144, 170).tag(kRed, 249, 250);
  const PivotFit alone = tags.fit();
  const std::vector<int> red = color_of(alone, kRed).pivots;
  ASSERT_THAT(red, SizeIs(1));
  EXPECT_THAT(color_of(tags.fit({{kOrange, red}}), kOrange).pivots, IsEmpty());
}

TEST(PivotFit, EveryTagCountsAlikeWhateverItsSize) {
  // Orange is one tag of 1 pixel a hue, yellow one of 100: the border is in the middle all the
  // same.
  const PivotFit fit = Tags().tag(kOrange, 10, 20, 1).tag(kYellow, 40, 50, 100).fit();
  EXPECT_NEAR(end_of(fit, 15), 30, 1);
}

/// Three to six colours, apart from each other, anywhere round the circle.
Tags any_tags(std::vector<Label>& labels) {
  Tags tags;
  const int count = *rc::gen::inRange(3, 7);
  const int start = *rc::gen::inRange(0, 256);
  const int room = 256 / count;
  for (int i = 0; i < count; ++i) {
    const auto label = static_cast<Label>(i + 1);
    const int width = *rc::gen::inRange(1, room / 2);
    const int first = start + i * room + *rc::gen::inRange(0, room / 2 - 4);
    const int tag_count = *rc::gen::inRange(1, 3);
    for (int tag = 0; tag < tag_count; ++tag) {
      tags.tag(label, (first + tag) % 256, (first + tag) % 256 + width, 2);
    }
    labels.push_back(label);
  }
  return tags;
}

RC_GTEST_PROP(PivotFitProperty, ColoursThatStandApartAreToldApart, ()) {
  std::vector<Label> labels;
  const Tags tags = any_tags(labels);
  const PivotFit fit = tags.fit();
  RC_ASSERT(fit.overlaps.empty());
  RC_ASSERT(tags.worst_share(pivots_of(fit)) == 1.0);
}

RC_GTEST_PROP(PivotFitProperty, ThePromisedRoomToMoveIsThereAndNoMore, ()) {
  std::vector<Label> labels;
  const Tags tags = any_tags(labels);
  const PivotFit fit = tags.fit();
  constexpr int kLongest = 64;
  for (const FittedColor& color : fit.colors) {
    for (const int sign : {-1, 1}) {
      const int room = sign < 0 ? color.move_down : color.move_up;
      for (int by = 0; by <= room; ++by) {
        RC_ASSERT(tags.worst_share(moved(fit, color.label, sign * by)) >= 0.5);
      }
      if (room == kLongest) continue;
      RC_ASSERT(tags.worst_share(moved(fit, color.label, sign * (room + 1))) < 0.5);
    }
  }
}

RC_GTEST_PROP(PivotFitProperty, EveryPivotIsAHueAndNoTwoColoursShareOne, ()) {
  std::vector<Label> labels;
  const PivotFit fit = any_tags(labels).fit({{9, {0, 128}}});
  std::vector<int> all;
  for (const FittedColor& color : fit.colors) {
    all.insert(all.end(), color.pivots.begin(), color.pivots.end());
  }
  for (const int hue : all) RC_ASSERT(hue >= 0 && hue < 256);
  std::ranges::sort(all);
  RC_ASSERT(std::ranges::adjacent_find(all) == all.end());
}

}  // namespace
}  // namespace maggic::hue_pivots
