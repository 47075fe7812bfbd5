#include "maggic/run_extractor.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class PassThrough final : public ColorNormalizer {
 public:
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    std::ranges::copy(in.b, out.b.begin());
    std::ranges::copy(in.g, out.g.begin());
    std::ranges::copy(in.r, out.r.begin());
  }
};

/// Label = blue modulo 4, so that every channel layout mistake shows: green and red shift it.
class BlueModuloFour final : public ColorSegmenter {
 public:
  void segment(const ColorBatch& original, const ColorBatch& /*normalized*/,
               std::span<Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const int mixed = original.b[i] + 2 * (original.g[i] > 127) + 3 * (original.r[i] > 127);
      labels[i] = static_cast<Label>(mixed % 4);
    }
  }
};

const ColorTable& table() {
  static const ColorTable compiled = ColorTable::compile(PassThrough(), BlueModuloFour(), 4);
  return compiled;
}

std::vector<Run> runs_of(const cv::Mat& labels) {
  std::vector<maggic::Run> runs;
  extract_runs(labels, runs);
  return runs;
}

/// Pixel by pixel, as the contract's words have it.
std::vector<Run> plain_runs(const cv::Mat& labels) {
  std::vector<maggic::Run> runs;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const Label label = labels.at<Label>(y, x);
      if (label == kBackground) continue;
      const bool goes_on = x > 0 && labels.at<Label>(y, x - 1) == label;
      if (goes_on) {
        ++runs.back().end;
      } else {
        runs.push_back({static_cast<std::uint16_t>(y), static_cast<std::uint16_t>(x),
                        static_cast<std::uint16_t>(x + 1), label});
      }
    }
  }
  return runs;
}

RC_GTEST_PROP(RunExtractor, FindsEveryMaximalRunOfRandomStretches, ()) {
  const int width = *rc::gen::inRange(1, 70);
  const int height = *rc::gen::inRange(1, 6);
  cv::Mat padded(height, width + 5, CV_8UC1, cv::Scalar(1));
  cv::Mat labels = padded(cv::Rect(2, 0, width, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const int length = *rc::gen::inRange(1, 25);
      const auto label = static_cast<Label>(*rc::gen::element(0, 0, 1, 2, 255));
      for (const int end = std::min(width, x + length); x < end; ++x) {
        labels.at<Label>(y, x) = label;
      }
    }
  }
  RC_ASSERT(runs_of(labels) == plain_runs(labels));
}

TEST(RunExtractor, FindsEveryRunOfFullNoise) {
  cv::RNG random(3);
  cv::Mat labels(37, 1001, CV_8UC1);
  random.fill(labels, cv::RNG::UNIFORM, 0, 256);
  EXPECT_EQ(runs_of(labels), plain_runs(labels));
  random.fill(labels, cv::RNG::UNIFORM, 0, 2);
  EXPECT_EQ(runs_of(labels), plain_runs(labels));
}

TEST(RunExtractor, FindsSinglePixelsOfACheckerboard) {
  cv::Mat labels(9, 11, CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      labels.at<Label>(y, x) = static_cast<Label>((x + y) % 2);
    }
  }
  EXPECT_EQ(runs_of(labels), plain_runs(labels));
}

TEST(RunExtractor, GivesNoRunForBackground) {
  for (const int width : {1, 7, 8, 9, 64}) {
    EXPECT_THAT(runs_of(cv::Mat::zeros(3, width, CV_8UC1)), IsEmpty());
  }
}

TEST(RunExtractor, EndsARunAtTheEndOfItsRow) {
  const std::vector<std::uint16_t> widths{1, 7, 8, 9, 64};
  for (const std::uint16_t width : widths) {
    const cv::Mat labels(2, width, CV_8UC1, cv::Scalar(1));
    EXPECT_THAT(runs_of(labels), ElementsAre(maggic::Run{0, 0, width, 1}, maggic::Run{1, 0, width, 1}));
  }
}

TEST(RunExtractor, TakesFramesOf65535Columns) {
  const cv::Mat labels(1, 65535, CV_8UC1, cv::Scalar(9));
  EXPECT_THAT(runs_of(labels), ElementsAre(maggic::Run{0, 0, 65535, 9}));
  EXPECT_THAT(runs_of(cv::Mat::zeros(1, 65535, CV_8UC1)), IsEmpty());
}

TEST(RunExtractor, ReplacesTheRunsOfTheFrameBefore) {
  std::vector<maggic::Run> runs(5);
  extract_runs(cv::Mat::zeros(2, 2, CV_8UC1), runs);
  EXPECT_THAT(runs, IsEmpty());
}

TEST(RunExtractor, LooksUpEveryPixelOfAPicture) {
  cv::RNG random(11);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 1), cv::Size(67, 5), cv::Size(128, 3)}) {
    cv::Mat bgr(size, CV_8UC3);
    random.fill(bgr, cv::RNG::UNIFORM, 0, 256);
    cv::Mat labels(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const auto pixel = bgr.at<cv::Vec3b>(y, x);
        labels.at<Label>(y, x) = table()(pixel[0], pixel[1], pixel[2]);
      }
    }
    std::vector<maggic::Run> runs;
    extract_runs(bgr, table(), runs);
    EXPECT_EQ(runs, plain_runs(labels));
  }
}

TEST(RunExtractor, ReadsNothingBesideThePicture) {
  // A vector of exactly the pixels: AddressSanitizer sees a read behind it.
  std::vector<std::uint8_t> pixels(3 * 5 * 4, 1);
  const cv::Mat bgr(5, 4, CV_8UC3, pixels.data());
  std::vector<maggic::Run> runs;
  extract_runs(bgr, table(), runs);
  EXPECT_EQ(runs.size(), 5U);
}

TEST(RunExtractor, GoesByRowsWhereRowsArePadded) {
  const cv::Mat padded(3, 9, CV_8UC3, cv::Scalar(1, 0, 0));
  std::vector<maggic::Run> runs;
  extract_runs(padded(cv::Rect(2, 1, 4, 2)), table(), runs);
  EXPECT_THAT(runs, ElementsAre(maggic::Run{0, 0, 4, 1}, maggic::Run{1, 0, 4, 1}));
}

TEST(DrawRuns, PaintsTheLabelImageTheRunsCameFrom) {
  cv::RNG random(5);
  cv::Mat labels(13, 29, CV_8UC1);
  random.fill(labels, cv::RNG::UNIFORM, 0, 3);
  cv::Mat drawn(2, 2, CV_8UC3);
  draw_runs(runs_of(labels), labels.size(), drawn);
  EXPECT_EQ(drawn.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(drawn, labels, cv::NORM_INF), 0.0);
}

TEST(ExtractRuns, ThroughAChannelMapGiveTheRunsOfTheMappedPicture) {
  ChannelMap map;
  for (std::size_t value = 0; value < 256; ++value) {
    map.b[value] = static_cast<std::uint8_t>(255 - value);
    map.g[value] = static_cast<std::uint8_t>(value / 2);
    map.r[value] = static_cast<std::uint8_t>(value ^ 0x80u);
  }
  cv::Mat noise(21, 35, CV_8UC3);
  cv::randu(noise, 0, 256);
  cv::Mat mapped;
  apply(map, noise, mapped);
  std::vector<maggic::Run> through_map;
  std::vector<maggic::Run> of_mapped;
  extract_runs(noise, table(), map, through_map);
  extract_runs(mapped, table(), of_mapped);
  EXPECT_EQ(through_map, of_mapped);
  EXPECT_FALSE(of_mapped.empty());
}

}  // namespace
}  // namespace maggic
