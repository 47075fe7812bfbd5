#include "maggic/comparison.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

/// Two pipelines that saw what a test says.
class ComparisonTest : public ::testing::Test {
 protected:
  static FrameResult seen(std::vector<std::pair<int, cv::Point2d>> robots) {
    FrameResult result;
    for (const auto& [id, position_mm] : robots) {
      RobotDetection& robot = result.detections.robots.emplace_back();
      robot.id = id;
      robot.position_mm = position_mm;
    }
    return result;
  }

  double add(const FrameResult& a, const FrameResult& b, const TrueScene* truth = nullptr) {
    const Comparison::Entry entries[] = {{&a, &field_, truth}, {&b, &field_, truth}};
    return comparison_.add(entries);
  }

  const Field field_{FieldParameters(), {640, 480}};
  Comparison comparison_{2, Tolerance{10.0, Tolerance::Unit::kMillimeters}};
};

TEST_F(ComparisonTest, EqualResultsDoNotDiffer) {
  const FrameResult a = seen({{0, {100, 0}}, {1, {-300, 200}}});
  EXPECT_EQ(add(a, a), 0.0);
  EXPECT_EQ(comparison_.against_first(1).frames_right(), 1u);
  EXPECT_EQ(comparison_.against_first(0).frames(), 0u);
  EXPECT_EQ(comparison_.against_truth(0).frames(), 0u) << "nobody knows the truth";
}

TEST_F(ComparisonTest, CountsWhatOnlyOneOfThemSawAndWhatTheyNameDifferently) {
  EXPECT_EQ(add(seen({{0, {0, 0}}, {1, {400, 0}}}), seen({{0, {0, 0}}})), 1.0);
  EXPECT_EQ(add(seen({{0, {0, 0}}}), seen({{0, {0, 0}}, {1, {400, 0}}})), 1.0);
  EXPECT_EQ(add(seen({{0, {0, 0}}}), seen({{2, {0, 0}}})), 1.0);
  EXPECT_NEAR(add(seen({{0, {0, 0}}}), seen({{0, {6, 8}}})), 0.010, 1e-9);
  EXPECT_NEAR(add(seen({{0, {0, 0}}}), seen({{0, {0, 30}}})), 1.030, 1e-9);
}

TEST_F(ComparisonTest, PlotsErrorsAgainstTheTruthWhereItIsKnownElseAgainstTheFirst) {
  const FrameResult a = seen({{0, {3, 0}}});
  const FrameResult b = seen({{0, {8, 0}}});
  const TrueScene truth = scene_of(seen({{0, {0, 0}}}).detections);
  add(a, b, &truth);
  add(a, b);
  ASSERT_THAT(comparison_.rows(), SizeIs(2));
  const auto& known = comparison_.rows()[0].points;
  EXPECT_DOUBLE_EQ(known[0].position_error_mm, 3.0);
  EXPECT_DOUBLE_EQ(known[1].position_error_mm, 8.0);
  const auto& unknown = comparison_.rows()[1].points;
  EXPECT_TRUE(std::isnan(unknown[0].position_error_mm));
  EXPECT_DOUBLE_EQ(unknown[1].position_error_mm, 5.0);
  EXPECT_EQ(unknown[1].objects_seen, 1.0);
  EXPECT_EQ(comparison_.against_truth(1).frames(), 1u);
}

TEST_F(ComparisonTest, APipelineThatFailedLeavesAGap) {
  const FrameResult a = seen({{0, {0, 0}}});
  const Comparison::Entry entries[] = {{nullptr, nullptr, nullptr}, {&a, &field_, nullptr}};
  EXPECT_EQ(comparison_.add(entries), 0.0);
  EXPECT_TRUE(std::isnan(comparison_.rows()[0].points[0].objects_seen));
  EXPECT_EQ(comparison_.rows()[0].points[1].objects_seen, 1.0);
}

std::vector<std::uint64_t> numbers_of(const DifferentFrames& frames) {
  std::vector<std::uint64_t> numbers;
  for (const auto& kept : frames.kept()) numbers.push_back(kept.sequence);
  return numbers;
}

TEST(DifferentFrames, KeepsTheMostDifferentOnesApartFromEachOther) {
  DifferentFrames frames(2, 10);
  int drawn = 0;
  const auto draw = [&] {
    ++drawn;
    return cv::Mat();
  };
  frames.offer(0, 1.0, draw);
  frames.offer(5, 3.0, draw);  // near 0, and differs more
  frames.offer(6, 2.0, draw);  // near 5, and differs less
  frames.offer(40, 1.5, draw);
  frames.offer(80, 1.0, draw);  // no room
  frames.offer(90, 4.0, draw);
  EXPECT_THAT(numbers_of(frames), ElementsAre(90, 5));
  EXPECT_EQ(drawn, 4);
}

TEST(DifferentFrames, KeepsNoneWhenNoneAreWanted) {
  DifferentFrames frames(0, 10);
  frames.offer(0, 1.0, [] { return cv::Mat(); });
  EXPECT_THAT(frames.kept(), SizeIs(0));
}

}  // namespace
}  // namespace maggic
