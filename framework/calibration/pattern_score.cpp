#include "calibration/pattern_score.hpp"

#include <algorithm>

#include "maggic/tracker.hpp"

namespace maggic::calibration {
namespace {

// Longer than any tracker carries a motion on.
constexpr std::chrono::seconds kApart{10};

bool is_complete(const RobotDetection& robot, const std::vector<TagLayout>& layouts) {
  return robot.id != kUnknownId && std::ranges::any_of(layouts, [&](const TagLayout& layout) {
           return layout.patches.size() == robot.tags.size();
         });
}

}  // namespace

PatternScore score_by_pattern(Pipeline& pipeline, std::span<const cv::Mat> frames,
                              const std::function<void(const FrameResult&)>& on_frame) {
  const auto pattern = pipeline.parts().tracker.stage->pattern();
  const std::vector<TagLayout> layouts = pattern ? pattern->layouts : std::vector<TagLayout>{};
  PatternScore score;
  FrameResult result;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    result.frame.sequence = i;
    result.frame.captured = kApart * static_cast<int>(i + 1);
    result.frame.bgr = frames[i];
    if (pipeline.process(result) != FrameOutcome::kProcessed) continue;
    ++score.frames;
    for (const RobotDetection& robot : result.detections.robots) {
      (is_complete(robot, layouts) ? score.robots : score.doubtful) += 1.0;
    }
    if (result.detections.ball) score.balls += 1.0;
    if (on_frame) on_frame(result);
  }
  if (score.frames == 0) return score;
  const auto count = static_cast<double>(score.frames);
  score.robots /= count;
  score.doubtful /= count;
  score.balls /= count;
  return score;
}

}  // namespace maggic::calibration
