#include "calibration/sample_store.hpp"

#include <algorithm>
#include <array>
#include <set>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "calibration/tags_for_tests.hpp"

namespace maggic::calibration {
namespace {

using tags::label;

const cv::Scalar kFloor{60, 61, 62};
const cv::Scalar kRed{10, 20, 200};
const cv::Scalar kBlue{210, 30, 15};
const cv::Scalar kOrange{5, 120, 250};

/// A frame with a blue and a red half-tag, a ball, and the rim of all of them in white.
class SampleStoreTest : public ::testing::Test {
 protected:
  SampleStoreTest() {
    cv::Mat picture(120, 160, CV_8UC3, kFloor);
    const auto draw = [&](cv::Rect where, const cv::Scalar& color) {
      picture(where + cv::Size(8, 8) - cv::Point(4, 4)).setTo(cv::Scalar(255, 255, 255));
      picture(where).setTo(color);
      Patch patch = tags::patch_at(cv::Point2d(where.tl() + where.br() - cv::Point(1, 1)) / 2.0,
                                   where.area(), 0.0);
      for (int y = where.y; y < where.br().y; ++y) {
        for (int x = where.x; x < where.br().x; ++x) patch.pixels.emplace_back(x, y);
      }
      return patch;
    };
    found_.resize(1);
    found_[0].patches = {draw({30, 40, 12, 24}, kBlue), draw({60, 40, 12, 24}, kRed)};
    naming_.frames.resize(1);
    naming_.frames[0].label_of_patch = {label("blue"), label("red")};
    ball_.by_frame = {draw({100, 80, 14, 14}, kOrange)};
    ball_.count = 1;
    frames_ = {tags::look_at(picture)};
  }

  SampleStore store() const { return {frames_, found_, naming_, ball_, label("orange")}; }
  static ColorSamples samples(const SampleStore& store) {
    return store.samples(palette(), {.best = 30});
  }
  static const Palette& palette() { return testing::standard_palette(); }
  static cv::Scalar color(const ColorBatch& batch, std::size_t i) {
    return {static_cast<double>(batch.b[i]), static_cast<double>(batch.g[i]),
            static_cast<double>(batch.r[i])};
  }

  std::vector<ChromaFrame> frames_;
  std::vector<FramePatches> found_;
  Naming naming_;
  BallSightings ball_;
};

TEST_F(SampleStoreTest, EverySampleHasTheColourItsLabelSays) {
  const SampleStore kept = store();
  const ColorSamples all = samples(kept);
  ASSERT_EQ(all.labels.size(), all.original.size());
  ASSERT_EQ(all.labels.size(), all.normalized.size());
  ASSERT_EQ(all.labels.size(), all.tags.size());
  std::array<int, 10> count{};
  for (std::size_t i = 0; i < all.labels.size(); ++i) {
    ++count[all.labels[i]];
    const cv::Scalar expected = all.labels[i] == label("blue")     ? kBlue
                                : all.labels[i] == label("red")    ? kRed
                                : all.labels[i] == label("orange") ? kOrange
                                                                   : kFloor;
    ASSERT_EQ(color(all.original, i), expected) << "the rim is neither tag nor floor";
  }
  for (const char* name : {"blue", "red", "orange"}) EXPECT_GE(count[label(name)], 20) << name;
  EXPECT_GT(count[kBackground], 1000);
  EXPECT_EQ(all.gray_threshold.best, 30);
}

TEST_F(SampleStoreTest, EveryTagHasANumberOfItsOwn) {
  const SampleStore kept = store();
  const ColorSamples all = samples(kept);
  std::set<std::pair<Label, std::int32_t>> seen;
  std::set<std::int32_t> numbers;
  for (std::size_t i = 0; i < all.labels.size(); ++i) {
    EXPECT_EQ(all.labels[i] == kBackground, all.tags[i] < 0);
    if (all.tags[i] < 0) continue;
    seen.insert({all.labels[i], all.tags[i]});
    numbers.insert(all.tags[i]);
  }
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_EQ(numbers.size(), 3u);
}

TEST_F(SampleStoreTest, APatchOfNoRobotIsBackground) {
  naming_.frames[0].label_of_patch[1] = kBackground;
  const SampleStore kept = store();
  const ColorSamples all = samples(kept);
  EXPECT_EQ(std::ranges::count(all.labels, label("red")), 0);
  bool red_is_background = false;
  for (std::size_t i = 0; i < all.labels.size(); ++i) {
    if (color(all.original, i) == kRed) red_is_background |= all.labels[i] == kBackground;
  }
  EXPECT_TRUE(red_is_background);
}

TEST_F(SampleStoreTest, StraysAreMarkedAsSuch) {
  SampleStore kept = store();
  const std::vector<std::vector<Stray>> strays{{{{10.0, 10.0}, 50.0}}};
  const std::size_t before = samples(kept).labels.size();
  kept.add_strays(frames_, strays);
  const ColorSamples all = samples(kept);
  const auto count = std::ranges::count(all.tags, kStrayTag);
  EXPECT_GT(count, 5);
  EXPECT_EQ(all.labels.size(), before + static_cast<std::size_t>(count));
  for (std::size_t i = before; i < all.labels.size(); ++i) EXPECT_EQ(all.labels[i], kBackground);
}

TEST_F(SampleStoreTest, AStrayAtThePicturesCornerIsTakenAsFarAsItIsSeen) {
  SampleStore kept = store();
  const std::vector<std::vector<Stray>> strays{{{{0.0, 0.0}, 400.0}, {{159.0, 119.0}, 400.0}}};
  kept.add_strays(frames_, strays);
  EXPECT_GT(std::ranges::count(samples(kept).tags, kStrayTag), 20);
}

TEST_F(SampleStoreTest, OtherLightIsImaginedForTagsOnly) {
  SampleStore kept = store();
  EXPECT_EQ(samples(kept).imagined.labels.size(), 0u);
  kept.imagine_other_light(fakes::SameNormalizer());
  const ColorSamples all = samples(kept);
  EXPECT_GT(all.imagined.labels.size(), 100u);
  EXPECT_EQ(all.imagined.labels.size(), all.imagined.original.size());
  EXPECT_EQ(all.imagined.labels.size(), all.imagined.normalized.size());
  EXPECT_EQ(std::ranges::count(all.imagined.labels, kBackground), 0);
}

}  // namespace
}  // namespace maggic::calibration
