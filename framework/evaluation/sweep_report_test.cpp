#include "maggic/sweep_report.hpp"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>

namespace maggic {
namespace {

constexpr Label kOrange = 1;

/// Ten pixels of background, right from threshold 20 on, and four of orange, right up to 59.
NamedSweep example() {
  NamedSweep named{"none", LabelSweep({10, 4, 0})};
  for (std::size_t t = 20; t < LabelSweep::kThresholds; ++t) {
    named.sweep.count_right(kBackground, t, 10);
  }
  for (std::size_t t = 0; t < 60; ++t) named.sweep.count_right(kOrange, t, 4);
  return named;
}

TEST(SweepReport, DrawsALineForEveryLabelThePicturesHave) {
  const LinePlot plot = plot_of(example(), Palette::standard(), 0.9, {640, 400});
  ASSERT_EQ(plot.series.size(), 2u);
  EXPECT_EQ(plot.series[0].name, "background");
  EXPECT_EQ(plot.series[1].name, "orange");
  EXPECT_EQ(plot.series[1].points[59], cv::Point2d(59.0, 100.0));
  EXPECT_EQ(plot.series[1].points[60], cv::Point2d(60.0, 0.0));
}

TEST(SweepReport, ShadesTheUsableThresholdsWhereThereAreAny) {
  const LinePlot plot = plot_of(example(), Palette::standard(), 0.9, {640, 400});
  ASSERT_EQ(plot.bands.size(), 1u);
  EXPECT_EQ(plot.bands[0].from, 20.0);
  EXPECT_EQ(plot.bands[0].to, 59.0);
  EXPECT_EQ(plot.bands[0].name, "all ≥ 90 %: 20 … 59");
  NamedSweep hopeless{"none", LabelSweep({10, 4, 0})};
  EXPECT_TRUE(plot_of(hopeless, Palette::standard(), 0.9, {640, 400}).bands.empty());
}

TEST(SweepReport, WritesARowForEveryNormalizerAndThreshold) {
  const std::string csv = csv_of({example(), example()}, Palette::standard());
  EXPECT_THAT(csv, ::testing::StartsWith("normalizer,gray_threshold,background_percent,"
                                         "orange_percent\nnone,0,0.000,100.000\n"));
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * 256);
  EXPECT_EQ(csv_of({}, Palette::standard()), "normalizer,gray_threshold\n");
}

}  // namespace
}  // namespace maggic
