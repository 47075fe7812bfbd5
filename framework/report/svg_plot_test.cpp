#include "maggic/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "report/xml_for_tests.hpp"

namespace maggic {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<XmlElement> parsed(const std::string& svg) {
  const auto elements = XmlReader::read(svg);
  EXPECT_TRUE(elements) << svg;
  return elements.value_or(std::vector<XmlElement>());
}

std::vector<XmlElement> named(const std::string& svg, std::string_view name) {
  std::vector<XmlElement> found;
  for (const XmlElement& element : parsed(svg)) {
    if (element.name == name) found.push_back(element);
  }
  return found;
}

std::vector<std::string> texts(const std::string& svg) {
  std::vector<std::string> found;
  for (const XmlElement& element : named(svg, "text")) found.push_back(element.text);
  return found;
}

PlotSeries series(std::string name, std::vector<cv::Point2d> points) {
  return {std::move(name), {200, 30, 30}, std::move(points), {}};
}

LinePlot two_lines() {
  LinePlot plot;
  plot.title = "Shares";
  plot.x_axis = {"gray threshold", "steps", 0.0, 255.0, false};
  plot.y_axis = {"share", "%", 0.0, 100.0, false};
  plot.series = {series("red", {{0, 100}, {100, 90}, {255, 0}}),
                 series("green", {{0, 80}, {100, 95}, {255, 10}})};
  return plot;
}

TEST(SvgPlot, DrawsOneLineASeriesWithTitleAxesAndLegend) {
  const std::string svg = to_svg(two_lines());
  EXPECT_EQ(named(svg, "polyline").size(), 2u);
  EXPECT_THAT(texts(svg), ::testing::IsSupersetOf({"Shares", "gray threshold [steps]", "share [%]",
                                                   "red", "green", "0", "250", "100"}));
}

TEST(SvgPlot, IsTheSameOnEveryRun) { EXPECT_EQ(to_svg(two_lines()), to_svg(two_lines())); }

TEST(SvgPlot, HoldsNoIdentifierThatCouldClashInAPage) {
  for (const XmlElement& element : parsed(to_svg(two_lines()))) {
    EXPECT_FALSE(element.attributes.contains("id"));
  }
}

TEST(SvgPlot, TellsSeriesOfOneColourApartByTheirDashes) {
  std::set<std::string> dashes;
  for (XmlElement& line : named(to_svg(two_lines()), "polyline")) {
    dashes.insert(line.attributes["stroke-dasharray"]);
  }
  EXPECT_EQ(dashes.size(), 2u);
}

TEST(SvgPlot, LeavesAGapWhereAPointIsNotANumber) {
  LinePlot plot = two_lines();
  plot.series = {series("broken", {{0, 1}, {1, 2}, {2, kNan}, {3, 1}, {4, 2}, {5, 9}})};
  EXPECT_EQ(named(to_svg(plot), "polyline").size(), 2u);
  EXPECT_THAT(to_svg(plot), ::testing::Not(::testing::HasSubstr("nan")));
}

TEST(SvgPlot, MarksAPointBetweenTwoGaps) {
  LinePlot plot = two_lines();
  plot.series = {series("", {{50, 50}, {60, kNan}})};
  EXPECT_TRUE(named(to_svg(plot), "polyline").empty());
  EXPECT_EQ(named(to_svg(plot), "circle").size(), 1u);
}

TEST(SvgPlot, EscapesTextAndReplacesWhatXmlCannotHold) {
  LinePlot plot = two_lines();
  plot.title = "a<b & \"c\" \x01 \xff 80 µm";
  plot.series[0].name = "'>'";
  EXPECT_THAT(texts(to_svg(plot)),
              ::testing::IsSupersetOf({"a&lt;b &amp; &quot;c&quot; \xEF\xBF\xBD \xEF\xBF\xBD 80 µm",
                                       "&apos;&gt;&apos;"}));
}

TEST(SvgPlot, ShadesAndNamesBands) {
  LinePlot plot = two_lines();
  const std::size_t before = named(to_svg(plot), "rect").size();
  plot.bands = {{30, 60, "usable", {}}, {kNan, 60, "nowhere", {}}};
  EXPECT_EQ(named(to_svg(plot), "rect").size(), before + 1);
  EXPECT_THAT(texts(to_svg(plot)), ::testing::Contains("usable"));
}

TEST(SvgPlot, WritesDecadesOnALogarithmicAxis) {
  LinePlot plot = two_lines();
  plot.y_axis = {"time", "ms", {}, {}, true};
  plot.series = {series("t", {{0, 0.02}, {1, 30}, {2, 0.0}, {3, -1}})};
  EXPECT_THAT(texts(to_svg(plot)), ::testing::IsSupersetOf({"0.01", "0.1", "1", "10", "100"}));
}

TEST(SvgPlot, LeavesOutPointsThatChangeNothing) {
  LinePlot straight = two_lines();
  straight.series = {series("", {})};
  for (int x = 0; x < 256; ++x) straight.series[0].points.emplace_back(x, x / 3.0);
  const std::string points = named(to_svg(straight), "polyline").at(0).attributes["points"];
  EXPECT_EQ(std::ranges::count(points, ' '), 1);
}

TEST(SvgPlot, DrawsAPlotWithoutAPoint) {
  EXPECT_THAT(texts(to_svg(LinePlot())), ::testing::IsSupersetOf({"0.0", "1.0"}));
}

TEST(SvgGrid, SharesOneLegendAndOneSizeAmongItsPlots) {
  LinePlot other = two_lines();
  other.title = "Others";
  other.series.push_back(series("blue", {{0, 1}, {1, 2}}));
  const std::string svg = to_svg(PlotGrid{"All", {two_lines(), other, other}, 2});
  EXPECT_EQ(named(svg, "polyline").size(), 8u);
  const std::vector<std::string> all = texts(svg);
  EXPECT_EQ(std::ranges::count(all, "red"), 1);
  EXPECT_EQ(std::ranges::count(all, "blue"), 1);
  EXPECT_EQ(std::ranges::count(all, "Others"), 2);
  const XmlElement root = parsed(svg).at(0);
  EXPECT_EQ(root.attributes.at("width"), std::to_string(2 * two_lines().size_px.width));
  EXPECT_GT(std::stoi(root.attributes.at("height")), 2 * two_lines().size_px.height);
}

TEST(SvgGrid, DrawsAnEmptyGrid) { EXPECT_FALSE(parsed(to_svg(PlotGrid{})).empty()); }

TEST(AxisTicks, AreRoundNumbersAboutAsManyAsAskedFor) {
  EXPECT_THAT(axis_ticks(0, 255, 6), ::testing::ElementsAre(0, 50, 100, 150, 200, 250, 300));
  EXPECT_THAT(axis_ticks(-1, 1, 5), ::testing::ElementsAre(-1, -0.5, 0, 0.5, 1));
}

RC_GTEST_PROP(AxisTicks, CoverTheRangeAscendingAndFew, ()) {
  const double exponent = *rc::gen::inRange(-250, 250);
  const double low = *rc::gen::inRange(-1000, 1000) * std::pow(10.0, exponent);
  const double high = low + *rc::gen::inRange(0, 1000) * std::pow(10.0, exponent);
  const auto about = *rc::gen::inRange<std::size_t>(0, 30);
  const std::vector<double> ticks = axis_ticks(high, low, about);
  RC_ASSERT(ticks.size() >= 2u);
  RC_ASSERT(ticks.size() <= 2 * std::max<std::size_t>(about, 2) + 2);
  RC_ASSERT(ticks.front() <= low);
  RC_ASSERT(ticks.back() >= high);
  RC_ASSERT(std::ranges::adjacent_find(ticks, std::greater_equal<>()) == ticks.end());
}

RC_GTEST_PROP(AxisTicks, EndForWhateverNumbersThereAre, (double a, double b)) {
  RC_PRE(std::isfinite(a) && std::isfinite(b));
  const std::vector<double> ticks = axis_ticks(a, b, 6);
  RC_ASSERT(ticks.size() >= 2u && ticks.size() <= 14u);
}

RC_GTEST_PROP(DecadeTicks, CoverTheRange, ()) {
  const double a = std::pow(10.0, *rc::gen::inRange(-60, 60) / 10.0);
  const double b = std::pow(10.0, *rc::gen::inRange(-60, 60) / 10.0);
  const std::vector<double> ticks = decade_ticks(a, b);
  RC_ASSERT(ticks.size() >= 2u);
  RC_ASSERT(ticks.front() <= std::min(a, b));
  RC_ASSERT(ticks.back() >= std::max(a, b));
}

RC_GTEST_PROP(SvgPlot, IsWellFormedWhateverTheTexts, (const std::string& text)) {
  LinePlot plot;
  plot.title = plot.x_axis.label = text;
  plot.series = {series(text, {{0, 1}, {1, 2}})};
  RC_ASSERT(XmlReader::read(to_svg(plot)));
}

}  // namespace
}  // namespace maggic
