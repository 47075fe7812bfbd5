#include "maggic/comparison_report.hpp"

#include <limits>

#include <gmock/gmock.h>

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

ComparedPipeline pipeline(std::string name, double seen, bool is_first) {
  ComparedPipeline compared;
  compared.name = std::move(name);
  compared.figures = {{"seen", seen, "%", Better::kHigher, "true objects that were found"},
                      {"ball_seen", std::nullopt, "%", Better::kHigher, "never measured"}};
  if (!is_first) compared.agreement = compared.figures;
  return compared;
}

ComparisonReport small_report() {
  ComparisonReport report;
  report.title = "A & B";
  report.facts = {{"source", "<script>alert('x')</script>"}};
  report.pipelines = {pipeline("A \"one\"", 98.0, true), pipeline("B two", 97.0, false)};
  report.has_truth = true;
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    report.rows.push_back({frame, {{1.0, 7.0, {}}, {frame == 1 ? unknown : 2.0, 6.0, {}}}});
  }
  report.different_frames = {{"frame 2: 1 object unlike", "png bytes"}};
  report.segmented = {"frame 2, as it came", "original"};
  report.thresholds = {20, 40, 60};
  report.labels = {{"A \"one\"", {"low", "middle", "high"}}, {"B two", {"only"}}};
  return report;
}

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ComparisonReport, IsOnePageThatFetchesNothing) {
  const std::string html = to_html(small_report());
  EXPECT_THAT(html,
              AllOf(StartsWith("<!doctype html>"), HasSubstr("prefers-color-scheme: dark"),
                    HasSubstr("name=\"viewport\""), Not(HasSubstr("<script")),
                    Not(HasSubstr("<link")), Not(HasSubstr("@import")), Not(HasSubstr("url("))));
  EXPECT_EQ(count_of(html, "src=\""), count_of(html, "src=\"data:image/png;base64,"));
  EXPECT_EQ(count_of(html, "href="), 0u);
}

TEST(ComparisonReport, EscapesWhatItIsGiven) {
  EXPECT_THAT(to_html(small_report()),
              AllOf(HasSubstr("<title>A &amp; B</title>"), HasSubstr("A &quot;one&quot;"),
                    HasSubstr("&lt;script&gt;alert(&apos;x&apos;)&lt;/script&gt;")));
}

TEST(ComparisonReport, SaysOfEachFigureHowItDiffersFromTheFirst) {
  const std::string html = to_html(small_report());
  EXPECT_THAT(html, AllOf(HasSubstr("98.00 %"), HasSubstr("<td>97.00 %<small>-1.00 %, worse"),
                          Not(HasSubstr("ball_seen"))));
}

TEST(ComparisonReport, HoldsPicturesAndPlots) {
  const std::string html = to_html(small_report());
  EXPECT_THAT(html, AllOf(HasSubstr("base64,cG5nIGJ5dGVz\""),  // "png bytes"
                          HasSubstr("frame 2: 1 object unlike"), HasSubstr("Objects seen")));
  EXPECT_GE(count_of(html, "<svg"), 3u);
}

TEST(ComparisonReport, AMethodWithoutThresholdSpansTheRowsOfTheOthers) {
  const std::string html = to_html(small_report());
  EXPECT_EQ(count_of(html, "rowspan=\"3\""), 1u);
  for (const char* threshold : {"<th>20</th>", "<th>40</th>", "<th>60</th>"}) {
    EXPECT_THAT(html, HasSubstr(threshold));
  }
  ComparisonReport without = small_report();
  without.labels = {{"A", {"only"}}, {"B", {"only"}}};
  EXPECT_THAT(to_html(without), AllOf(Not(HasSubstr("rowspan")), Not(HasSubstr("<th>20</th>"))));
}

TEST(ComparisonReport, LeavesOutWhatItDoesNotHave) {
  ComparisonReport report = small_report();
  report.different_frames.clear();
  report.segmented = {};
  report.has_truth = false;
  EXPECT_THAT(to_html(report), AllOf(Not(HasSubstr("differ most")), Not(HasSubstr("Segmentation")),
                                     Not(HasSubstr("<img")), Not(HasSubstr("Against the truth"))));
}

}  // namespace
}  // namespace maggic
