#include "maggic/normalizer_plot.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "report/xml_for_tests.hpp"

namespace maggic {
namespace {

/// Every channel by a factor; the channels may be swapped round.
struct Scaling : ColorNormalizer {
  int percent = 100;
  bool swaps_red_and_green = false;
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    const auto scaled = [&](std::uint8_t v) {
      return static_cast<std::uint8_t>(v * percent / 100);
    };
    for (std::size_t i = 0; i < in.size(); ++i) {
      out.b[i] = scaled(in.b[i]);
      out.g[i] = scaled(swaps_red_and_green ? in.r[i] : in.g[i]);
      out.r[i] = scaled(swaps_red_and_green ? in.g[i] : in.r[i]);
    }
  }
};

TEST(NormalizerPlot, ShowsAsDotsWhatDoesNotMove) {
  const auto elements = XmlReader::read(to_svg(normalizer_plot("same", Scaling())));
  ASSERT_TRUE(elements);
  EXPECT_EQ(std::ranges::count(*elements, "polygon", &XmlElement::name), 0);
  EXPECT_EQ(std::ranges::count(*elements, "circle", &XmlElement::name), 2 * 81 + 2 * 96);
}

TEST(NormalizerPlot, ArrowsLeadFromTheOriginalToTheNormalisedColour) {
  Scaling swapping;
  swapping.swaps_red_and_green = true;
  const PlotGrid grid = normalizer_plot("swapping", swapping);
  for (const PlotArrow& arrow : grid.plots[0].arrows) {
    EXPECT_EQ(arrow.to, cv::Point2d(arrow.from.y, arrow.from.x));
    EXPECT_EQ(arrow.color, (DisplayColor{static_cast<std::uint8_t>(arrow.from.x),
                                         static_cast<std::uint8_t>(arrow.from.y), 0}));
  }
}

TEST(NormalizerPlot, HalvingMovesTheValueAndLeavesHueAndSaturation) {
  Scaling halving;
  halving.percent = 50;
  const PlotGrid grid = normalizer_plot("half", halving);
  for (const PlotArrow& arrow : grid.plots[2].arrows) {
    EXPECT_NEAR(arrow.to.y, arrow.from.y / 2.0, 0.6);
    EXPECT_NEAR(arrow.to.x, arrow.from.x, 3.0) << "but for rounding";
  }
  for (const PlotArrow& arrow : grid.plots[3].arrows) {
    EXPECT_NEAR(arrow.to.y, arrow.from.y, 3.0);
  }
}

TEST(NormalizerPlot, GivesABlackenedColourNoHueOfItsOwn) {
  Scaling black;
  black.percent = 0;
  const PlotGrid grid = normalizer_plot("black", black);
  for (const PlotArrow& arrow : grid.plots[3].arrows) {
    EXPECT_EQ(arrow.to, cv::Point2d(arrow.from.x, 0.0));
  }
}

}  // namespace
}  // namespace maggic
