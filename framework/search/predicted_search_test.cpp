#include "search/predicted_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

const cv::Size kSize{640, 480};
constexpr double kFrameS = 1.0 / 60.0;
constexpr Label kBlue = 1;
constexpr Label kRed = 2;
constexpr Label kOrange = 3;

/// A field in a picture of its own shape, so that a pixel is a square of 2.5 mm.
Field square_pixels() {
  FieldParameters parameters;
  parameters.length_mm = 1600;
  parameters.width_mm = 1200;
  return {parameters, kSize};
}

/// The picture without a rim, as a field's area is.
ScanArea inner_part() {
  ScanArea area;
  for (int row = 20; row < kSize.height - 30; ++row) {
    area.push_back(
        {static_cast<std::uint16_t>(row), 40, static_cast<std::uint16_t>(kSize.width - 40)});
  }
  return area;
}

class PredictedSearchTest : public ::testing::Test {
 protected:
  /// Sees a robot at `position_mm`: a team patch on its left, a player patch on its right.
  void see_robot(cv::Point2d position_mm, cv::Point2d velocity_mm_s = {}) {
    RobotDetection& robot = seen_.robots.emplace_back();
    robot.position_mm = position_mm;
    robot.velocity_mm_s = velocity_mm_s;
    for (const auto& [label, x_mm] : {std::pair(kBlue, -17.5), std::pair(kRed, 17.5)}) {
      robot.tags.push_back({label, image_px(position_mm + cv::Point2d(x_mm, 0.0)), 200.0});
    }
  }
  void see_ball(cv::Point2d position_mm) {
    seen_.ball.emplace();
    seen_.ball->label = kOrange;
    seen_.ball->position_mm = position_mm;
    seen_.ball->centroid_px = field_.to_image_px(position_mm, field_.ball_height_mm());
    seen_.ball->area_px = 200.0;
  }

  cv::Point2d image_px(cv::Point2d position_mm) const {
    return field_.to_image_px(position_mm, field_.robot_height_mm());
  }

  const ScanArea* plan(double after_s = kFrameS) {
    captured_ += std::chrono::nanoseconds(std::llround(1e9 * after_s));
    return search_.plan(captured_, field_, field_area_);
  }
  /// The plan once every turn's first full search is over.
  const ScanArea* plan_when_settled() {
    for (int i = 0; i < kTurns; ++i) {
      EXPECT_EQ(plan(), nullptr);
      search_.remember(seen_);
    }
    return plan();
  }

  /// What would be found of what is seen, moved by `moved_px`.
  std::vector<Blob> blobs(cv::Point2d moved_px = {}) const {
    std::vector<Blob> found;
    const auto add = [&](Label label, cv::Point2d centroid_px) {
      Blob& blob = found.emplace_back();
      blob.label = label;
      blob.area_px = 200;
      blob.centroid_px = centroid_px + moved_px;
      blob.bounds_px = cv::Rect(cv::Point(blob.centroid_px) - cv::Point(7, 7), cv::Size(14, 14));
    };
    for (const RobotDetection& robot : seen_.robots) {
      for (const TagSighting& tag : robot.tags) add(tag.label, tag.centroid_px);
    }
    if (seen_.ball) add(seen_.ball->label, seen_.ball->centroid_px);
    return found;
  }

  static constexpr int kTurns = 4;
  const Field field_ = square_pixels();
  const ScanArea field_area_ = inner_part();
  PredictedSearch search_{kTurns};
  Detections seen_;
  Timestamp captured_{0};
};

std::size_t pixels(const ScanArea& area) {
  std::size_t sum = 0;
  for (const RowSpan& span : area) sum += static_cast<std::size_t>(span.end - span.begin);
  return sum;
}

TEST_F(PredictedSearchTest, LooksAllOverUntilEverythingHadItsChance) {
  for (int i = 0; i < kTurns; ++i) {
    EXPECT_EQ(plan(), nullptr);
    search_.remember(seen_);
  }
  EXPECT_NE(plan(), nullptr);
}

TEST_F(PredictedSearchTest, LooksRoundWhatItKnowsWhicheverTurnItIs) {
  see_robot({400, 300});
  see_ball({-500, -350});
  const cv::Point robot_px(image_px({400, 300}));
  const cv::Point ball_px(field_.to_image_px({-500, -350}, field_.ball_height_mm()));
  const ScanArea* area = plan_when_settled();
  for (int i = 0; i < 2 * kTurns; ++i, area = plan()) {
    ASSERT_NE(area, nullptr);
    EXPECT_TRUE(holds(*area, robot_px));
    EXPECT_TRUE(holds(*area, ball_px));
    EXPECT_LT(pixels(*area), pixels(field_area_) * 2 / 3);
    search_.remember(seen_);
  }
}

TEST_F(PredictedSearchTest, LooksWhereARobotIsGoing) {
  see_robot({0, 0}, {3000, 0});
  const ScanArea* area = plan_when_settled();
  // A twentieth of a second: the robot is 150 mm, 60 px, farther on.
  for (int i = 0; i < kTurns; ++i) {
    search_.remember(seen_);
    area = plan(0.05);
    ASSERT_NE(area, nullptr);
    EXPECT_TRUE(holds(*area, image_px({150, 0})));
    EXPECT_TRUE(holds(*area, image_px({150 + 65, 0})));
  }
}

TEST_F(PredictedSearchTest, AFastRobotIsLookedForInALargerPart) {
  see_robot({0, 0});
  const std::size_t at_rest = pixels(*plan_when_settled());
  search_ = PredictedSearch(kTurns);
  seen_.robots.clear();
  see_robot({0, 0}, {2000, 0});
  EXPECT_GT(pixels(*plan_when_settled()), at_rest);
}

TEST_F(PredictedSearchTest, LooksAllOverWhileSomethingKnownIsOutOfSight) {
  see_robot({400, 300});
  see_ball({-500, -350});
  ASSERT_NE(plan_when_settled(), nullptr);
  seen_.robots[0].state = TrackState::kPredicted;
  search_.remember(seen_);
  EXPECT_EQ(plan(), nullptr);
  seen_.robots[0].state = TrackState::kSeen;
  seen_.ball->state = TrackState::kPredicted;
  search_.remember(seen_);
  EXPECT_EQ(plan(), nullptr);
  seen_.ball->state = TrackState::kSeen;
  search_.remember(seen_);
  EXPECT_NE(plan(), nullptr);
}

TEST_F(PredictedSearchTest, StartsOverWhenTimeJumps) {
  for (const double jump_s : {0.3, -kFrameS}) {
    search_.forget();
    ASSERT_NE(plan_when_settled(), nullptr);
    search_.remember(seen_);
    EXPECT_EQ(plan(jump_s), nullptr) << jump_s;
    for (int i = 1; i < kTurns; ++i) EXPECT_EQ(plan(), nullptr) << jump_s;
    EXPECT_NE(plan(), nullptr) << jump_s;
  }
}

TEST_F(PredictedSearchTest, WithoutAFieldInThePictureItLooksAllOver) {
  ASSERT_NE(plan_when_settled(), nullptr);
  search_.remember(seen_);
  captured_ += std::chrono::milliseconds(16);
  EXPECT_EQ(search_.plan(captured_, field_, {}), nullptr);
}

TEST_F(PredictedSearchTest, AcceptsWhatIsWhereItWasExpected) {
  see_robot({400, 300});
  see_ball({-500, -350});
  ASSERT_NE(plan_when_settled(), nullptr);
  std::vector<Blob> found = blobs({3.0, -2.0});
  EXPECT_TRUE(search_.accept(found));
  EXPECT_EQ(found.size(), 3u);
}

TEST_F(PredictedSearchTest, AsksForAFullSearchWhenABlobIsMissing) {
  see_robot({400, 300});
  see_ball({-500, -350});
  ASSERT_NE(plan_when_settled(), nullptr);
  for (std::size_t missing = 0; missing < 3; ++missing) {
    std::vector<Blob> found = blobs();
    found.erase(found.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_FALSE(search_.accept(found)) << missing;
  }
}

TEST_F(PredictedSearchTest, AsksForAFullSearchWhenABlobIsAnotherOne) {
  see_robot({400, 300});
  ASSERT_NE(plan_when_settled(), nullptr);
  std::vector<Blob> recolored = blobs();
  recolored[0].label = kOrange;
  EXPECT_FALSE(search_.accept(recolored));
  std::vector<Blob> grown = blobs();
  grown[0].area_px = 401;
  EXPECT_FALSE(search_.accept(grown));
  std::vector<Blob> shrunk = blobs();
  shrunk[0].area_px = 99;
  EXPECT_FALSE(search_.accept(shrunk));
  // At rest a robot may be 30 mm, 12 px at this scale, off.
  std::vector<Blob> elsewhere = blobs({14.0, 0.0});
  EXPECT_FALSE(search_.accept(elsewhere));
}

TEST_F(PredictedSearchTest, TakesOutWhatMayGoOnOutsideOfTheArea) {
  see_robot({0, -450});
  const ScanArea* area = plan_when_settled();
  ASSERT_NE(area, nullptr);
  // A speck that touches the last column looked at, in a row that only the robot's region reaches.
  const int row = cvRound(image_px({0, -450}).y);
  const auto edge = std::ranges::find(*area, row, &RowSpan::row);
  ASSERT_NE(edge, area->end());
  ASSERT_LT(edge->end, kSize.width - 40);
  std::vector<Blob> found = blobs();
  Blob& speck = found.emplace_back();
  speck.label = kRed;
  speck.area_px = 4;
  speck.bounds_px = {edge->end - 2, row, 2, 2};
  speck.centroid_px = cv::Point2d(edge->end - 1.5, row + 0.5);
  EXPECT_TRUE(search_.accept(found));
  EXPECT_EQ(found.size(), 2u);
}

/// Turns and robots of a search, and the area of every frame of one round of turns.
struct Round {
  int turns = 1;
  std::vector<ScanArea> areas;
  ScanArea field_area = inner_part();
  Field field = square_pixels();
};

Round random_round(std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto below = [&](int count) {
    return static_cast<int>(engine() % static_cast<unsigned>(count));
  };
  Round round;
  round.turns = 1 + below(8);
  Detections seen;
  for (int i = below(7); i > 0; --i) {
    seen.robots.emplace_back().position_mm = cv::Point2d(below(1800) - 900, below(1400) - 700);
  }
  PredictedSearch search(round.turns);
  Timestamp captured{0};
  for (int i = 0; i < 2 * round.turns; ++i) {
    captured += std::chrono::milliseconds(16);
    const ScanArea* area = search.plan(captured, round.field, round.field_area);
    if (area) round.areas.push_back(*area);
    search.remember(seen);
  }
  return round;
}

RC_GTEST_PROP(PredictedSearchProperty, AreasAreRowsInOrderWithinTheField, (std::uint32_t seed)) {
  const Round round = random_round(seed);
  RC_ASSERT(round.areas.size() == static_cast<std::size_t>(round.turns));
  const int first_row = round.field_area.front().row;
  for (const ScanArea& area : round.areas) {
    for (std::size_t i = 0; i < area.size(); ++i) {
      const RowSpan& span = area[i];
      RC_ASSERT(span.begin < span.end);
      RC_ASSERT(span.row >= first_row);
      RC_ASSERT(span.row <= round.field_area.back().row);
      const RowSpan& whole = round.field_area[static_cast<std::size_t>(span.row - first_row)];
      RC_ASSERT(whole.begin <= span.begin);
      RC_ASSERT(span.end <= whole.end);
      if (i == 0) continue;
      const RowSpan& before = area[i - 1];
      RC_ASSERT(before.row < span.row || (before.row == span.row && before.end < span.begin));
    }
  }
}

// What the parameter unseen_frames promises: the tags of a robot that was put down anywhere are
// seen, all of them in one frame, within so many frames.
RC_GTEST_PROP(PredictedSearchProperty, ANewRobotIsWhollyInSightWithinTheTurns,
              (std::uint32_t seed)) {
  const Round round = random_round(seed);
  std::mt19937 engine(seed);
  const double x_mm = -600.0 + static_cast<double>(engine() % 1200);
  const double y_mm = -450.0 + static_cast<double>(engine() % 900);
  const double radius_mm = 50.0;
  const double height_mm = round.field.robot_height_mm();
  const cv::Point first(round.field.to_image_px({x_mm - radius_mm, y_mm + radius_mm}, height_mm));
  const cv::Point last(round.field.to_image_px({x_mm + radius_mm, y_mm - radius_mm}, height_mm));
  RC_ASSERT(std::ranges::any_of(round.areas, [&](const ScanArea& area) {
    for (int row = first.y; row <= last.y; ++row) {
      if (!holds(area, {first.x, row}) || !holds(area, {last.x, row})) return false;
    }
    return true;
  }));
}

}  // namespace
}  // namespace maggic
