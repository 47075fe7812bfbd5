/// Shipped pipelines with hand-made calibrations on recorded footage. The footage is not part of
/// the project; where `../shared/footage` is absent these tests say so and skip.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "annotation.hpp"
#include "maggic/runner.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

const std::filesystem::path kProject = MAGGIC_SOURCE_DIR;
const std::filesystem::path kFootage = kProject / ".." / "shared" / "footage";

// Sanitizer builds run 20 times slower; they look for memory errors, not for the share of frames.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kMaxFrames = 30;
#else
constexpr std::uint64_t kMaxFrames = 1'000'000;
#endif

struct FootageCase {
  std::string clip;      // <clip>.json and the media it names; also the calibration's name
  std::string pipeline;  // in pipelines/
  std::string source;    // plugin that reads it
  double share_of_frames;
  bool check_headings;
};

void PrintTo(const FootageCase& c, std::ostream* out) { *out << c.clip; }

double turn_between_deg(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

/// What is wrong with one frame's detections; empty when all is right.
std::string fault(const Detections& found, const Annotation& truth, const Palette& palette,
                  bool check_headings) {
  if (found.robots.size() != truth.robots.size()) {
    return fmt::format("{} robots, expected {}", found.robots.size(), truth.robots.size());
  }
  for (const AnnotatedRobot& robot : truth.robots) {
    const auto near = std::ranges::find_if(found.robots, [&](const RobotDetection& r) {
      return cv::norm(r.centroid_px - robot.centroid_px) <= truth.tolerance_px;
    });
    if (near == found.robots.end()) {
      return fmt::format("no robot within {} px of ({}, {})", truth.tolerance_px,
                         robot.centroid_px.x, robot.centroid_px.y);
    }
    std::vector<std::string> colors;
    for (const Label label : near->player_colors) colors.emplace_back(palette.name(label));
    if (name_of(near->team) != robot.team || colors != robot.player_colors) {
      return fmt::format("robot at ({}, {}): found {} [{}], expected {} [{}]", robot.centroid_px.x,
                         robot.centroid_px.y, name_of(near->team), fmt::join(colors, ","),
                         robot.team, fmt::join(robot.player_colors, ","));
    }
    // The front is the side of the player tags, so it points away from the team tag.
    const double heading_deg = near->heading_rad * 180.0 / std::numbers::pi;
    const double off_deg = turn_between_deg(heading_deg, robot.players_to_team_deg + 180.0);
    if (check_headings && off_deg > 8.0) {
      return fmt::format("robot at ({}, {}): heading off by {:.1f} degrees", robot.centroid_px.x,
                         robot.centroid_px.y, off_deg);
    }
  }
  if (found.ball.has_value() != truth.ball_px.has_value()) {
    return found.ball ? fmt::format("a ball at ({:.1f}, {:.1f}) where there is none",
                                    found.ball->centroid_px.x, found.ball->centroid_px.y)
                      : "no ball";
  }
  if (found.ball && cv::norm(found.ball->centroid_px - *truth.ball_px) > truth.tolerance_px) {
    return fmt::format("ball at ({:.1f}, {:.1f}), expected ({}, {})", found.ball->centroid_px.x,
                       found.ball->centroid_px.y, truth.ball_px->x, truth.ball_px->y);
  }
  return {};
}

class Footage : public ::testing::TestWithParam<FootageCase> {};

TEST_P(Footage, EveryObjectIsFoundAndNothingElse) {
  const FootageCase& c = GetParam();
  if (!std::filesystem::exists(kFootage / (c.clip + ".json"))) {
    GTEST_SKIP() << "no footage at " << kFootage;
  }
  const Annotation truth = load_annotation(kFootage / (c.clip + ".json"));
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / (c.pipeline + ".yaml");
  request.calibration = kProject / "pipelines" / "calibrations" / (c.clip + ".yaml");
  request.source = parse_document(
      fmt::format("{}: {{path: '{}'}}", c.source, (kFootage / truth.media).string()), "test");
  testing::RecordingReporter reporter;
  BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  built.sinks.clear();

  const std::atomic<bool> stop{false};
  std::uint64_t frames = 0;
  std::uint64_t right = 0;
  std::string first_fault;
  const RunSummary summary =
      run(built, {.max_frames = kMaxFrames}, stop, reporter,
          [&](const FrameResult& result, const RunSummary&) {
            ++frames;
            const std::string wrong =
                fault(result.detections, truth, built.pipeline->palette(), c.check_headings);
            right += wrong.empty();
            if (!wrong.empty() && first_fault.empty()) {
              first_fault = fmt::format("frame {}: {}", result.frame.sequence, wrong);
            }
          });
  EXPECT_TRUE(summary.clean()) << summary.first_error;
  ASSERT_GT(frames, 0u);
  EXPECT_GE(static_cast<double>(right), c.share_of_frames * static_cast<double>(frames))
      << right << " of " << frames << " frames right; " << first_fault;
}

INSTANTIATE_TEST_SUITE_P(
    Clips, Footage,
    ::testing::Values(FootageCase{"static", "maggic_3v3", "video", 0.99, true},
                      FootageCase{"static", "legacy_3v3", "video", 0.99, true},
                      FootageCase{"tags_3v3_0", "maggic_3v3_three_tag", "video", 1.0, true},
                      FootageCase{"tags_3v3_1", "maggic_3v3_three_tag", "video", 1.0, true},
                      FootageCase{"all_tags", "maggic_3v3_three_tag", "video", 1.0, true},
                      FootageCase{"rinobot_1", "maggic_3v3", "images", 1.0, true},
                      // The picture is stretched, so its annotated headings are not true angles.
                      FootageCase{"vsssdk_model_3908ae", "diagonal_tags", "images", 1.0, false}),
    [](const auto& test) { return test.param.clip + "_" + test.param.pipeline; });

}  // namespace
}  // namespace maggic
