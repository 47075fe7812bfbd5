#include "maggic/run_scanner.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <opencv2/core.hpp>

#include "maggic/simd_target.hpp"
#include "scan/plain_runs_for_tests.hpp"

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

/// A formula as a segmenter.
class Formula final : public ColorSegmenter {
 public:
  explicit Formula(std::function<int(int b, int g, int r)> formula)
      : formula_(std::move(formula)) {}

  void segment(const ColorBatch& original, const ColorBatch& /*normalized*/,
               std::span<Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i] = static_cast<Label>(formula_(original.b[i], original.g[i], original.r[i]));
    }
  }

 private:
  std::function<int(int, int, int)> formula_;
};

ColorTable table_of(std::function<int(int b, int g, int r)> formula) {
  return ColorTable::compile(PassThrough(), Formula(std::move(formula)), 16);
}

/// Every channel matters and no colour is sure to be background: no gate.
const ColorTable& mixed() {
  static const ColorTable table =
      table_of([](int b, int g, int r) { return (b + 2 * (g > 127) + 3 * (r > 127)) % 4; });
  return table;
}

/// Gray is background, the more so the darker; what is left is cut by hue and value.
const ColorTable& colors_on_gray() {
  static const ColorTable table = table_of([](int b, int g, int r) {
    const int value = std::max({b, g, r});
    const int spread = value - std::min({b, g, r});
    if (spread < 40 - value / 16) return 0;
    return 1 + (value == r ? 0 : value == g ? 1 : 2) + 3 * (value > 99) + 6 * (b == 17);
  });
  return table;
}

/// Every colour has a label.
const ColorTable& never_background() {
  static const ColorTable table = table_of([](int b, int g, int r) { return 1 + (b ^ g ^ r) % 7; });
  return table;
}

cv::Mat labels_by(const ColorTable& table, const ChannelGains& gains, const cv::Mat& bgr) {
  cv::Mat labels(bgr.size(), CV_8UC1);
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const cv::Vec3b color = gains(bgr.at<cv::Vec3b>(y, x));
      labels.at<Label>(y, x) = table(color[0], color[1], color[2]);
    }
  }
  return labels;
}

std::vector<Run> runs_of(const cv::Mat& labels) {
  std::vector<maggic::Run> runs;
  RunScanner().scan_labels(labels, whole_picture(labels.size()), runs);
  return runs;
}

std::vector<Run> runs_of(const cv::Mat& bgr, const ColorTable& table, unsigned threads = 1) {
  RunScanner scanner(threads);
  scanner.set_table(table);
  std::vector<maggic::Run> runs;
  scanner.scan(bgr, whole_picture(bgr.size()), nullptr, runs);
  return runs;
}

/// Stretches of one colour with noise on them, and some of noise alone.
cv::Mat random_picture(int width, int height, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat bgr(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const int length = random.uniform(1, 90);
      const std::array<int, 3> color{random.uniform(0, 256), random.uniform(0, 256),
                                     random.uniform(0, 256)};
      const int noise = random.uniform(0, 4) == 0 ? 256 : random.uniform(1, 30);
      for (const int end = std::min(width, x + length); x < end; ++x) {
        const auto noisy = [&](std::size_t channel) {
          return static_cast<std::uint8_t>((color[channel] + random.uniform(0, noise)) & 255);
        };
        bgr.at<cv::Vec3b>(y, x) = {noisy(0), noisy(1), noisy(2)};
      }
    }
  }
  return bgr;
}

/// Every vector instruction set of this machine in turn.
class EveryTarget : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_simd_target(GetParam()); }
  void TearDown() override { use_simd_target({}); }
};

TEST_P(EveryTarget, GivesTheRunsThatSinglePixelsGive) {
  const std::vector<ChannelGains> all_gains{ChannelGains(), ChannelGains({1.7, 0.9, 1.05}),
                                            ChannelGains({0.2, 5.0, 15.9})};
  std::uint64_t seed = 0;
  for (const ColorTable* table : {&mixed(), &colors_on_gray(), &never_background()}) {
    RunScanner scanner;
    scanner.set_table(*table);
    for (const int width : {1, 2, 15, 16, 17, 63, 64, 65, 130, 640}) {
      const cv::Mat bgr = random_picture(width, 7, ++seed);
      const ScanArea area = whole_picture(bgr.size());
      for (const ChannelGains& gains : all_gains) {
        std::vector<maggic::Run> runs;
        scanner.scan(bgr, area, gains == ChannelGains() ? nullptr : &gains, runs);
        EXPECT_EQ(runs, plain_runs(labels_by(*table, gains, bgr), area)) << "width " << width;
      }
    }
  }
}

TEST_P(EveryTarget, FindsTheRunsOfLabels) {
  cv::RNG random(3);
  for (const int labels_used : {2, 3, 256}) {
    cv::Mat labels(37, 1001, CV_8UC1);
    random.fill(labels, cv::RNG::UNIFORM, 0, labels_used);
    EXPECT_EQ(runs_of(labels), plain_runs(labels, whole_picture(labels.size())));
  }
}

INSTANTIATE_TEST_SUITE_P(Simd, EveryTarget, ::testing::ValuesIn(simd_targets()),
                         [](const auto& test) { return test.param; });

TEST(SimdTarget, KnowsPlainCodeAndRefusesOthersByName) {
  EXPECT_EQ(simd_targets().back(), "SCALAR");
  EXPECT_EQ(simd_target(), simd_targets().front());
  try {
    use_simd_target("MMX");
    FAIL() << "expected std::invalid_argument";
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("'MMX' here (known: "));
  }
}

RC_GTEST_PROP(RunScanner, FindsEveryMaximalRunOfRandomStretches, ()) {
  const int width = *rc::gen::inRange(1, 150);
  const int height = *rc::gen::inRange(1, 6);
  cv::Mat padded(height, width + 5, CV_8UC1, cv::Scalar(1));
  cv::Mat labels = padded(cv::Rect(2, 0, width, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width;) {
      const int length = *rc::gen::inRange(1, 70);
      const auto label = static_cast<Label>(*rc::gen::element(0, 0, 1, 2, 255));
      for (const int end = std::min(width, x + length); x < end; ++x) {
        labels.at<Label>(y, x) = label;
      }
    }
  }
  RC_ASSERT(runs_of(labels) == plain_runs(labels, whole_picture(labels.size())));
}

RC_GTEST_PROP(RunScanner, LooksAtNothingButItsArea, ()) {
  const cv::Mat bgr = random_picture(200, 12, *rc::gen::arbitrary<std::uint64_t>());
  ScanArea area;
  for (std::uint16_t row = 0; row < 12; ++row) {
    auto x = *rc::gen::inRange<std::uint16_t>(0, 80);
    while (*rc::gen::inRange(0, 3) != 0) {
      const auto end = static_cast<std::uint16_t>(x + *rc::gen::inRange(1, 90));
      if (end > 200) break;
      area.push_back({row, x, end});
      x = static_cast<std::uint16_t>(end + *rc::gen::inRange(1, 20));
    }
  }
  RunScanner scanner(*rc::gen::inRange(1U, 4U));
  scanner.set_table(colors_on_gray());
  std::vector<maggic::Run> runs;
  scanner.scan(bgr, area, nullptr, runs);
  RC_ASSERT(runs == plain_runs(labels_by(colors_on_gray(), ChannelGains(), bgr), area));
}

TEST(RunScanner, GivesTheSameRunsOnAnyNumberOfThreads) {
  const cv::Mat bgr = random_picture(333, 101, 9);
  const std::vector<maggic::Run> one = runs_of(bgr, colors_on_gray());
  for (const unsigned threads : {2U, 3U, 8U, 200U}) {
    EXPECT_EQ(runs_of(bgr, colors_on_gray(), threads), one);
  }
}

TEST(RunScanner, FindsSinglePixelsOfACheckerboard) {
  cv::Mat labels(9, 11, CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      labels.at<Label>(y, x) = static_cast<Label>((x + y) % 2);
    }
  }
  EXPECT_EQ(runs_of(labels), plain_runs(labels, whole_picture(labels.size())));
}

TEST(RunScanner, GivesNoRunForBackground) {
  for (const int width : {1, 7, 8, 9, 64}) {
    EXPECT_THAT(runs_of(cv::Mat::zeros(3, width, CV_8UC1)), IsEmpty());
  }
}

TEST(RunScanner, EndsARunAtTheEndOfItsRow) {
  for (const std::uint16_t width : std::vector<std::uint16_t>{1, 7, 8, 9, 63, 64, 65, 128}) {
    const cv::Mat labels(2, width, CV_8UC1, cv::Scalar(1));
    EXPECT_THAT(runs_of(labels),
                ElementsAre(maggic::Run{0, 0, width, 1}, maggic::Run{1, 0, width, 1}));
  }
}

TEST(RunScanner, TakesFramesOf65535Columns) {
  const cv::Mat labels(1, 65535, CV_8UC1, cv::Scalar(9));
  EXPECT_THAT(runs_of(labels), ElementsAre(maggic::Run{0, 0, 65535, 9}));
  EXPECT_THAT(runs_of(cv::Mat::zeros(1, 65535, CV_8UC1)), IsEmpty());
}

TEST(RunScanner, ReplacesTheRunsOfTheFrameBefore) {
  std::vector<maggic::Run> runs(5);
  RunScanner().scan_labels(cv::Mat::zeros(2, 2, CV_8UC1), whole_picture({2, 2}), runs);
  EXPECT_THAT(runs, IsEmpty());
}

TEST(RunScanner, ReadsNothingBesideThePicture) {
  // A vector of exactly the pixels: AddressSanitizer sees a read behind it.
  for (const int width : {4, 16, 64, 65}) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * 5 * width), 1);
    EXPECT_EQ(runs_of(cv::Mat(5, width, CV_8UC3, pixels.data()), mixed()).size(), 5U);
  }
}

TEST(RunScanner, GoesByRowsWhereRowsArePadded) {
  const cv::Mat padded(3, 9, CV_8UC3, cv::Scalar(1, 0, 0));
  EXPECT_THAT(runs_of(padded(cv::Rect(2, 1, 4, 2)), mixed()),
              ElementsAre(maggic::Run{0, 0, 4, 1}, maggic::Run{1, 0, 4, 1}));
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

}  // namespace
}  // namespace maggic
