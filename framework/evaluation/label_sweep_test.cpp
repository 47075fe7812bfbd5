#include "maggic/label_sweep.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <opencv2/core.hpp>

#include "maggic/label_image.hpp"

namespace maggic {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Label kOrange = 1;
constexpr Label kBlue = 2;

/// Red pixels are orange, blue ones blue; gray where the largest channel is at most the threshold.
struct ChannelSegmenter : ColorSegmenter {
  int threshold = 0;
  void segment(const ColorBatch&, const ColorBatch& c, std::span<Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Label color = c.r[i] > c.b[i] ? kOrange : kBlue;
      labels[i] = std::max(c.r[i], c.b[i]) <= threshold ? kBackground : color;
    }
  }
};

struct Half : ColorNormalizer {
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    for (std::size_t i = 0; i < in.size(); ++i) {
      out.b[i] = in.b[i] / 2;
      out.g[i] = in.g[i] / 2;
      out.r[i] = in.r[i] / 2;
    }
  }
};

struct Same : ColorNormalizer {
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    std::ranges::copy(in.b, out.b.begin());
    std::ranges::copy(in.g, out.g.begin());
    std::ranges::copy(in.r, out.r.begin());
  }
};

/// Four orange pixels of red 100 (three) and 60, two blue ones of blue 80, two of background at red
/// 20 and 40.
LabelledColors small_picture() {
  cv::Mat bgr(2, 4, CV_8UC3);
  cv::Mat labels(2, 4, CV_8UC1);
  const auto set = [&](int i, cv::Vec3b color, Label label) {
    bgr.at<cv::Vec3b>(i / 4, i % 4) = color;
    labels.at<Label>(i / 4, i % 4) = label;
  };
  for (const int i : {0, 1, 2}) set(i, {0, 0, 100}, kOrange);
  set(3, {0, 0, 60}, kOrange);
  set(4, {80, 0, 0}, kBlue);
  set(5, {80, 0, 0}, kBlue);
  set(6, {0, 0, 20}, kBackground);
  set(7, {0, 0, 40}, kBackground);
  LabelledColors colors(Palette::standard());
  colors.add(bgr, labels);
  return colors;
}

std::vector<LabelSweep> swept(const LabelledColors& colors) {
  const Same same;
  const Half half;
  const std::vector<const ColorNormalizer*> normalizers{&same, &half};
  ChannelSegmenter segmenter;
  return sweep_gray_threshold(colors, normalizers, [&](int t) -> const ColorSegmenter& {
    segmenter.threshold = t;
    return segmenter;
  });
}

TEST(LabelledColors, CountsEachColourWithEachLabelOnce) {
  LabelledColors colors = small_picture();
  EXPECT_EQ(colors.size(), 5u);
  EXPECT_EQ(colors.pixels(kOrange), 4u);
  EXPECT_EQ(colors.pixels(kBackground), 2u);
  // The same colour under another label is another entry, under the same one a larger count.
  colors.add(cv::Mat(1, 2, CV_8UC3, cv::Scalar(80, 0, 0)), cv::Mat(1, 2, CV_8UC1, cv::Scalar(2)));
  EXPECT_EQ(colors.size(), 5u);
  colors.add(cv::Mat(1, 2, CV_8UC3, cv::Scalar(80, 0, 0)), cv::Mat(1, 2, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(colors.size(), 6u);
  EXPECT_EQ(colors.pixels(kBlue), 4u);
}

TEST(LabelledColors, RefusesLabelsThatDoNotFitThePicture) {
  LabelledColors colors(Palette::standard());
  const cv::Mat bgr(3, 4, CV_8UC3, cv::Scalar::all(0));
  EXPECT_THAT([&] { colors.add(bgr, cv::Mat(4, 3, CV_8UC1, cv::Scalar(0))); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("3 x 4, the picture is 4 x 3")));
  EXPECT_THAT([&] { colors.add(bgr, cv::Mat(3, 4, CV_8UC1, cv::Scalar(77))); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("label 77 at x 0, y 0")));
  EXPECT_EQ(colors.size(), 0u);
  EXPECT_EQ(colors.pixels(kBackground), 0u);
}

TEST(LabelSweep, GivesTheSharesOfAPictureWorkedOutByHand) {
  const LabelSweep sweep = swept(small_picture())[0];
  EXPECT_EQ(sweep.share(kBackground, 0), 0.0);
  EXPECT_EQ(sweep.share(kBackground, 19), 0.0);
  EXPECT_EQ(sweep.share(kBackground, 20), 0.5);
  EXPECT_EQ(sweep.share(kBackground, 40), 1.0);
  EXPECT_EQ(sweep.share(kOrange, 59), 1.0);
  EXPECT_EQ(sweep.share(kOrange, 60), 0.75);
  EXPECT_EQ(sweep.share(kOrange, 99), 0.75);
  EXPECT_EQ(sweep.share(kOrange, 100), 0.0);
  EXPECT_EQ(sweep.share(kBlue, 79), 1.0);
  EXPECT_EQ(sweep.share(kBlue, 80), 0.0);
  EXPECT_TRUE(std::isnan(sweep.share(3, 0))) << "the picture has no yellow";
}

TEST(LabelSweep, FindsTheRangeInWhichEveryLabelKeepsItsShare) {
  const std::vector<LabelSweep> sweeps = swept(small_picture());
  const auto all = sweeps[0].usable(1.0);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->first, 40u);
  EXPECT_EQ(all->last, 59u);
  EXPECT_EQ(all->width(), 20u);
  const auto most = sweeps[0].usable(0.7);
  EXPECT_EQ(most->last, 79u) << "a quarter of the orange pixels may go";
  const auto half = sweeps[1].usable(1.0);
  EXPECT_EQ(half->first, 20u);
  EXPECT_EQ(half->last, 29u);
}

TEST(LabelSweep, NamesTheBestThresholdAndWhatItCosts) {
  LabelledColors colors = small_picture();
  // Background as red as an orange pixel: no threshold is right for both.
  colors.add(cv::Mat(1, 8, CV_8UC3, cv::Scalar(0, 0, 90)), cv::Mat(1, 8, CV_8UC1, cv::Scalar(0)));
  const LabelSweep sweep = swept(colors)[0];
  EXPECT_FALSE(sweep.usable(0.5));
  EXPECT_EQ(sweep.best_threshold(), 40u);
  EXPECT_EQ(sweep.smallest_share(40).second, kBackground);
  EXPECT_EQ(sweep.smallest_share(40).first, 0.2);
}

RC_GTEST_PROP(LabelSweepProperty, EqualsAskingForEveryPixel, ()) {
  const auto n = *rc::gen::inRange(1, 30);
  cv::Mat bgr(1, n, CV_8UC3);
  cv::Mat labels(1, n, CV_8UC1);
  for (int i = 0; i < n; ++i) {
    bgr.at<cv::Vec3b>(i) = {static_cast<std::uint8_t>(*rc::gen::inRange(0, 4) * 60), 0,
                            static_cast<std::uint8_t>(*rc::gen::inRange(0, 4) * 60)};
    labels.at<Label>(i) = static_cast<Label>(*rc::gen::inRange(0, 3));
  }
  LabelledColors colors(Palette::standard());
  colors.add(bgr, labels);
  const LabelSweep sweep = swept(colors)[0];
  ChannelSegmenter segmenter;
  segmenter.threshold = *rc::gen::inRange(0, 256);
  std::array<int, 3> all{};
  std::array<int, 3> right{};
  for (int i = 0; i < n; ++i) {
    const auto& pixel = bgr.at<cv::Vec3b>(i);
    const std::array<std::uint8_t, 1> b{pixel[0]}, g{pixel[1]}, r{pixel[2]};
    std::array<Label, 1> found{};
    segmenter.segment({b, g, r}, {b, g, r}, found);
    const Label label = labels.at<Label>(i);
    ++all[label];
    right[label] += found[0] == label;
  }
  for (Label label = 0; label < 3; ++label) {
    const double share = sweep.share(label, static_cast<std::size_t>(segmenter.threshold));
    if (all[label] == 0) {
      RC_ASSERT(std::isnan(share));
    } else {
      RC_ASSERT(share == static_cast<double>(right[label]) / all[label]);
    }
  }
}

TEST(LabelImage, IsReadFromGrayValuesAndFromDisplayColours) {
  const Palette palette = Palette::standard();
  cv::Mat gray(1, 3, CV_8UC1);
  cv::Mat colors(1, 3, CV_8UC3);
  cv::Mat with_alpha(1, 3, CV_8UC4);
  for (int i = 0; i < 3; ++i) {
    const auto label = static_cast<Label>(i);
    const DisplayColor shown = palette.display_color(label);
    gray.at<Label>(i) = label;
    colors.at<cv::Vec3b>(i) = {shown.blue, shown.green, shown.red};
    with_alpha.at<cv::Vec4b>(i) = {shown.blue, shown.green, shown.red, 255};
  }
  for (const cv::Mat& picture : {gray, colors, with_alpha}) {
    EXPECT_EQ(cv::norm(labels_of(picture, palette), gray, cv::NORM_INF), 0.0);
  }
}

TEST(LabelImage, SaysWhereAPixelIsNoLabel) {
  const Palette palette = Palette::standard();
  cv::Mat gray = cv::Mat::zeros(4, 5, CV_8UC1);
  gray.at<Label>(2, 3) = 200;
  EXPECT_THAT([&] { labels_of(gray, palette); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("gray value 200 at x 3, y 2")));
  cv::Mat colors = cv::Mat::zeros(4, 5, CV_8UC3);
  colors.at<cv::Vec3b>(1, 0) = {3, 2, 1};
  EXPECT_THAT(
      [&] { labels_of(colors, palette); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("1 2 3 (red, green, blue) at x 0, y 1")));
  EXPECT_THAT([&] { labels_of(cv::Mat::zeros(4, 5, CV_16UC1), palette); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("1 channel of 16 bits")));
  EXPECT_THROW(labels_of(cv::Mat(), palette), std::invalid_argument);
}

}  // namespace
}  // namespace maggic
