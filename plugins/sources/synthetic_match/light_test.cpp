/// Classes of light, drifting light and true labels of the synthetic match, seen from outside.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "maggic/color_temperature.hpp"
#include "lamps.hpp"
#include "maggic/config_error.hpp"
#include "maggic/source.hpp"
#include "maggic/testing.hpp"

namespace maggic::synthetic_match {
namespace {

using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Lt;
using ::testing::ThrowsMessage;

Frame frame_of(std::string_view yaml, int number = 0) {
  const StagePtr<Source> source = testing::make<Source>("synthetic_match", yaml);
  source->open();
  Frame frame;
  for (int i = 0; i <= number; ++i) source->read(frame);
  return frame;
}

bool same_picture(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

double mean_green(const cv::Mat& bgr) { return cv::mean(bgr)[1]; }

/// Blue, green, red of a picture without noise at the same four places of the empty floor's rim,
/// where neither robots nor lines nor clutter are.
std::vector<cv::Scalar> walls(std::string_view light, int seed) {
  const Frame frame = frame_of(fmt::format(
      "{{width: 320, height: 240, light: {}, seed: {}, noise: 0, shot_noise: 0}}", light, seed));
  std::vector<cv::Scalar> colors;
  for (const cv::Point corner : {cv::Point(36, 12), {283, 12}, {36, 226}, {283, 226}}) {
    colors.push_back(cv::mean(frame.bgr(cv::Rect(corner, cv::Size(3, 3)))));
  }
  return colors;
}

TEST(Light, IsEvenUnlessAskedOtherwise) {
  EXPECT_TRUE(same_picture(frame_of("{width: 160, height: 120}").bgr,
                           frame_of("{width: 160, height: 120, light: even, gradient: 0.2}").bgr));
}

TEST(Light, LeavesThePicturesOfBeforeAsTheyWere) {
  const cv::Mat bgr = frame_of("{width: 160, height: 120, seed: 3}", 25).bgr;
  const cv::Scalar mean = cv::mean(bgr);
  EXPECT_NEAR(mean[0], 54.33698, 0.01);
  EXPECT_NEAR(mean[1], 54.98797, 0.01);
  EXPECT_NEAR(mean[2], 56.69641, 0.01);
}

TEST(Light, IdealIsTheSameEverywhere) {
  const auto colors = walls("ideal", 1);
  for (const cv::Scalar& color : colors) EXPECT_LE(cv::norm(color - colors[0]), 1.0);
}

TEST(Light, NormalIsMildlyUnevenAndAsBrightAsIdeal) {
  const cv::Mat light = light_over_picture(LightClass::kNormal, {160, 120}, 1);
  double low = 0.0;
  double high = 0.0;
  cv::Mat green;
  cv::extractChannel(light, green, 1);
  cv::minMaxLoc(green, &low, &high);
  EXPECT_NEAR(cv::mean(light)[1], 1.0, 1e-4);
  EXPECT_GT(low, 0.6);
  EXPECT_LT(high, 1.4);
  EXPECT_GT(high / low, 1.05);
}

TEST(Light, NormalHasSlightCastsAndChallengingStrongOnes) {
  const auto widest_cast = [](LightClass light, std::uint64_t seed) {
    const cv::Mat gains = light_over_picture(light, {160, 120}, seed);
    float low = 1e9f;
    float high = 0.0f;
    for (int y = 0; y < gains.rows; ++y) {
      for (int x = 0; x < gains.cols; ++x) {
        const auto& gain = gains.at<cv::Vec3f>(y, x);
        low = std::min(low, gain[0] / gain[2]);
        high = std::max(high, gain[0] / gain[2]);
      }
    }
    return high / low;
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const float normal = widest_cast(LightClass::kNormal, seed);
    EXPECT_THAT(normal, ::testing::AllOf(Gt(1.03f), Lt(1.5f))) << seed;
    EXPECT_GT(widest_cast(LightClass::kChallenging, seed), 1.6f) << seed;
  }
}

TEST(Light, ChallengingIsDimButNowhereDark) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const cv::Mat gains = light_over_picture(LightClass::kChallenging, {160, 120}, seed);
    cv::Mat green;
    cv::extractChannel(gains, green, 1);
    double low = 0.0;
    double high = 0.0;
    cv::minMaxLoc(green, &low, &high);
    EXPECT_GE(low, kDimmest - 1e-5) << seed;
    EXPECT_GT(high / low, 1.7) << seed;
    EXPECT_LT(cv::mean(green)[0], 0.75) << seed;
  }
}

TEST(Light, GetsDimmerFromClassToClassInThePicture) {
  const auto brightness = [](std::string_view light) {
    return mean_green(frame_of(fmt::format("{{width: 320, height: 240, light: {}}}", light)).bgr);
  };
  EXPECT_NEAR(brightness("normal") / brightness("ideal"), 1.0, 0.1);
  EXPECT_LT(brightness("challenging"), 0.85 * brightness("ideal"));
}

TEST(Light, AnotherSeedHangsOtherLampsOfTheClass) {
  for (const std::string_view light : {"normal", "challenging"}) {
    double difference = 0.0;
    const auto one = walls(light, 1);
    const auto other = walls(light, 2);
    for (std::size_t i = 0; i < one.size(); ++i) difference += cv::norm(one[i] - other[i]);
    EXPECT_GT(difference, 2.0) << light;
  }
}

TEST(Light, SameSeedGivesSameFramesInEveryClass) {
  for (const std::string_view light : {"ideal", "normal", "challenging"}) {
    const std::string yaml = fmt::format(
        "{{width: 160, height: 120, light: {}, seed: 9, drift: [{{time_s: 0}}, {{time_s: 1, "
        "brightness: 0.5}}]}}",
        light);
    EXPECT_TRUE(same_picture(frame_of(yaml, 20).bgr, frame_of(yaml, 20).bgr)) << light;
  }
}

TEST(Light, KeepsTheContractOfSourcesWithEverythingOn) {
  EXPECT_THAT(testing::check_conformance(
                  StageKind::kSource, "synthetic_match",
                  "{width: 65, height: 49, margin_px: 4, frames: 20, light: challenging, labels: "
                  "true, drift: [{time_s: 0}, {time_s: 0.1, brightness: 0.5}], drift_end: repeat}"),
              IsEmpty());
}

TEST(Clutter, IsBrownAndPurpleAndBackground) {
  const Frame frame = frame_of(
      "{width: 640, height: 480, light: challenging, labels: true, noise: 0, shot_noise: 0}");
  int colored = 0;
  for (int y = 0; y < frame.bgr.rows; ++y) {
    for (int x = 0; x < frame.bgr.cols; ++x) {
      if (frame.truth_labels.at<Label>(y, x) != kBackground) continue;
      const auto& pixel = frame.bgr.at<cv::Vec3b>(y, x);
      const auto [low, high] = std::minmax({pixel[0], pixel[1], pixel[2]});
      if (high - low > 40) ++colored;
    }
  }
  EXPECT_GT(colored, 1000);
}

/// A second of drift at 10 frames a second, without noise.
class DriftingMatch : public ::testing::Test {
 protected:
  static Frame at(int frame, std::string_view end = "hold") {
    return frame_of(
        fmt::format("{{width: 160, height: 120, fps: 10, gradient: 0, noise: 0, shot_noise: 0, "
                    "drift: [{{time_s: 0}}, {{time_s: 1, brightness: 0.4, color_temperature_k: "
                    "4000}}, {{time_s: 2}}], drift_end: {}}}",
                    end),
        frame);
  }
};

TEST_F(DriftingMatch, BeginsAsWithoutDrift) {
  EXPECT_TRUE(same_picture(
      at(0).bgr,
      frame_of("{width: 160, height: 120, fps: 10, gradient: 0, noise: 0, shot_noise: 0}").bgr));
}

TEST_F(DriftingMatch, FallsToFortyPercentAndTurnsWarm) {
  const cv::Rect floor(60, 6, 20, 3);
  const cv::Scalar start = cv::mean(at(0).bgr(floor));
  const cv::Scalar dim = cv::mean(at(10).bgr(floor));
  EXPECT_NEAR(dim[1] / start[1], 0.4, 0.02);
  EXPECT_NEAR(dim[2] / start[2], 0.4 * lamp_gains(4000.0)[0], 0.02);
  EXPECT_NEAR(dim[0] / start[0], 0.4 * lamp_gains(4000.0)[2], 0.02);
}

TEST_F(DriftingMatch, IsHalfWayInTheMiddle) {
  EXPECT_NEAR(mean_green(at(5).bgr) / mean_green(at(0).bgr), 0.7, 0.02);
}

TEST_F(DriftingMatch, HoldsOrRepeatsAfterTheLastKeyframe) {
  const double bright = mean_green(at(0).bgr);
  EXPECT_NEAR(mean_green(at(30).bgr) / bright, 1.0, 0.03);
  EXPECT_NEAR(mean_green(at(30, "repeat").bgr) / bright, 0.4, 0.03);
}

TEST(Drift, RefusesTimesThatDoNotAscend) {
  EXPECT_THAT([] { frame_of("{drift: [{time_s: 2}, {time_s: 2}]}"); },
              ThrowsMessage<ConfigError>(HasSubstr("expected ascending times")));
  EXPECT_THAT([] { frame_of("{drift: [{brightness: 0.4}]}"); },
              ThrowsMessage<ConfigError>(HasSubstr("time_s")));
}

TEST(TrueLabels, AreGivenOnlyWhenAskedFor) {
  EXPECT_TRUE(frame_of("{width: 160, height: 120}").truth_labels.empty());
  EXPECT_EQ(frame_of("{width: 160, height: 120, labels: true}").truth_labels.size(),
            cv::Size(160, 120));
}

TEST(TrueLabels, DoNotChangeThePicture) {
  EXPECT_TRUE(same_picture(frame_of("{width: 160, height: 120}", 9).bgr,
                           frame_of("{width: 160, height: 120, labels: true}", 9).bgr));
}

struct Region {
  int area = 0;
  cv::Point2d sum;
};

TEST(TrueLabels, HaveTheCentroidsAndAreasOfTheTruth) {
  // One robot a team, in other colours, so that every label but the ball's is one tag.
  const StagePtr<Source> source = testing::make<Source>(
      "synthetic_match",
      "{width: 800, height: 600, robots_per_team: 1, labels: true, light: challenging}");
  source->open();
  Frame frame;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 15; ++k) source->read(frame);
    std::map<std::pair<Label, int>, Region> regions;
    const auto nearest_robot = [&](cv::Point2d p) {
      const auto distance = [&](const RobotDetection& robot) {
        return cv::norm(robot.centroid_px - p);
      };
      return distance(frame.truth.robots[0]) < distance(frame.truth.robots[1]) ? 0 : 1;
    };
    for (int y = 0; y < 600; ++y) {
      for (int x = 0; x < 800; ++x) {
        const Label label = frame.truth_labels.at<Label>(y, x);
        if (label == kBackground) continue;
        Region& region = regions[{label, nearest_robot(cv::Point2d(x, y))}];
        ++region.area;
        region.sum += cv::Point2d(x, y);
      }
    }
    const auto check = [&](Label label, int robot, cv::Point2d centroid, double area) {
      const Region& region = regions[{label, robot}];
      ASSERT_GT(region.area, 0);
      EXPECT_LT(cv::norm(region.sum / region.area - centroid), 0.6);
      EXPECT_NEAR(region.area / area, 1.0, 0.05);
    };
    for (int robot = 0; robot < 2; ++robot) {
      for (const TagSighting& tag : frame.truth.robots[static_cast<std::size_t>(robot)].tags) {
        check(tag.label, robot, tag.centroid_px, tag.area_px);
      }
    }
    const BallDetection& ball = *frame.truth.ball;
    check(*Palette::standard().find("orange"), nearest_robot(ball.centroid_px), ball.centroid_px,
          ball.area_px);
    EXPECT_EQ(regions.size(), 5u) << "something else is labelled";
  }
}

}  // namespace
}  // namespace maggic::synthetic_match
