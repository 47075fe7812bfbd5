#include "maggic/score_figures.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<Figure> figures_of(const Scorecard& card) {
  return score_figures(card, StepStatistics(), std::nullopt);
}

const Figure& figure(const std::vector<Figure>& figures, std::string_view name) {
  const auto found = std::ranges::find(figures, name, &Figure::name);
  if (found == figures.end()) throw std::invalid_argument("no figure " + std::string(name));
  return *found;
}

/// One frame: two robots in the truth, one of them seen 3 mm off; a false ball.
Scorecard half_right() {
  TrueScene scene;
  Detections detections;
  for (const int id : {0, 1}) {
    TrueRobot& robot = scene.robots.emplace_back();
    robot.identity.id = id;
    robot.position_mm = cv::Point2d(300.0 * id, 0.0);
  }
  detections.robots.emplace_back().id = 0;
  detections.robots.back().position_mm = {3.0, 0.0};
  detections.ball.emplace();
  Scorecard card;
  card.add(detections, scene, Field(FieldParameters(), {640, 480}));
  return card;
}

TEST(ScoreFigures, AreSharesOfWhatTheyAreSharesOf) {
  const auto figures = figures_of(half_right());
  EXPECT_EQ(figure(figures, "seen").value, 50.0);
  EXPECT_EQ(figure(figures, "missed").value, 50.0);
  EXPECT_EQ(figure(figures, "identity").value, 50.0);
  EXPECT_EQ(figure(figures, "within_tolerance").value, 100.0);
  EXPECT_EQ(figure(figures, "position_rmse_mm").value, 3.0);
  EXPECT_EQ(figure(figures, "false_balls").value, 1.0);
  EXPECT_EQ(figure(figures, "frames_right").value, 0.0);
}

TEST(ScoreFigures, HaveNoValueWhereThereWasNothingToMeasure) {
  for (const Figure& of_nothing : figures_of(Scorecard())) {
    if (of_nothing.name == "swaps") continue;
    EXPECT_FALSE(of_nothing.value) << of_nothing.name;
  }
  EXPECT_FALSE(figure(figures_of(half_right()), "ball_seen").value);
}

TEST(ScoreFigures, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Figure& f : figures_of(Scorecard())) {
    EXPECT_TRUE(names.insert(f.name).second) << f.name;
    EXPECT_FALSE(f.meaning.empty()) << f.name;
  }
}

TEST(ScoreFigures, TimesAreInMilliseconds) {
  StepStatistics times;
  StepTimes of_a_frame;
  of_a_frame[Step::kTrack] = std::chrono::microseconds(1500);
  times.add(of_a_frame);
  const auto figures = score_figures(Scorecard(), times, std::nullopt);
  EXPECT_NEAR(figure(figures, "track_p50_ms").value.value(), 1.5, 0.02);
  EXPECT_NEAR(figure(figures, "frame_path_p99_ms").value.value(), 1.5, 0.02);
}

TEST(CornerError, IsTheFarthestOfTheFour) {
  Truth truth;
  truth.field_corners_px = {{64.5, 18.5}, {574.5, 18.5}, {577.5, 464.5}, {64.5, 460.5}};
  FieldParameters parameters;
  parameters.corners_px = {{64.5, 18.5}, {574.5, 18.5}, {574.5, 460.5}, {64.5, 460.5}};
  for (const bool half_time : {false, true}) {
    parameters.half_time = half_time;
    EXPECT_NEAR(corner_error_px(Field(parameters, {640, 480}), truth).value(), 5.0, 1e-6);
  }
  EXPECT_FALSE(corner_error_px(Field(parameters, {640, 480}), Truth()));
}

TEST(ScoreFigures, AreWrittenOutAndComparedInWords) {
  const Figure seen{"seen", 98.0, "%", Better::kHigher, ""};
  const Figure less{"seen", 97.5, "%", Better::kHigher, ""};
  const Figure error{"position_rmse_mm", 1.25, "mm", Better::kLower, ""};
  const Figure smaller{"position_rmse_mm", 1.0, "mm", Better::kLower, ""};
  const Figure nothing{"seen", std::nullopt, "%", Better::kHigher, ""};
  EXPECT_EQ(value_text(seen), "98.00 %");
  EXPECT_EQ(value_text(error), "1.250 mm");
  EXPECT_EQ(value_text(Figure{"swaps", 2.0, "", Better::kLower, ""}), "2");
  EXPECT_EQ(value_text(nothing), "-");
  EXPECT_EQ(difference_text(less, seen), "-0.50 %, worse");
  EXPECT_EQ(difference_text(smaller, error), "-0.250 mm, better");
  EXPECT_EQ(difference_text(seen, seen), "same");
  EXPECT_EQ(difference_text(seen, nothing), "");
}

TEST(Requirements, AreMetAtTheLimitInTheFiguresOwnDirection) {
  const auto figures = figures_of(half_right());
  EXPECT_THAT(unmet(parse_requirements("seen=50,position_rmse_mm=3,false=0"), figures), IsEmpty());
  EXPECT_THAT(unmet(parse_requirements("seen=50.1,false_balls=0.5"), figures),
              ElementsAre("seen: 50 %, required at least 50.1 %",
                          "false_balls: 1 a frame, required at most 0.5 a frame"));
}

TEST(Requirements, AreNotMetByAFigureWithoutAValue) {
  EXPECT_THAT(unmet(parse_requirements("ball_seen=1"), figures_of(half_right())),
              ElementsAre(HasSubstr("ball_seen: there was nothing to measure")));
}

TEST(Requirements, MistakesAreToldInWords) {
  const auto message = [](std::string_view text) -> std::string {
    try {
      parse_requirements(text);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "no mistake";
  };
  EXPECT_THAT(message("sene=9"), AllOf(HasSubstr("unknown figure 'sene', did you mean 'seen'?"),
                                       HasSubstr("known: frames_right, seen")));
  EXPECT_THAT(message("seen"), HasSubstr("seen: found nothing, expected a number"));
  EXPECT_THAT(message("seen=nan"), HasSubstr("found 'nan', expected a number"));
  EXPECT_THAT(message("seen=9x"), HasSubstr("found '9x', expected a number"));
  EXPECT_THAT(message("seen=9,seen=8"), HasSubstr("seen occurs twice"));
  EXPECT_THAT(message("seen=9,"), HasSubstr("unknown figure ''"));
  EXPECT_THAT(message(""), HasSubstr("unknown figure ''"));
}

}  // namespace
}  // namespace maggic
