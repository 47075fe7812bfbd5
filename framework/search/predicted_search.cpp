#include "search/predicted_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace maggic {
namespace {

// What a motion may be off the prediction: what wheels, or a kick, can do within a frame.
constexpr double kRobotSlackMm = 30.0;
constexpr double kBallSlackMm = 80.0;
constexpr double kSpeedShare = 0.5;  // of the way expected within the frame
// Corner to centre, with a tag that reaches over the edge.
constexpr double kRobotRadiusMm = PredictedSearch::kRobotBreadthMm / 2.0;
constexpr double kBallRadiusMm = 25.0;
// A new robot's tags all lie within one turn's rows if turns overlap by a robot.
constexpr double kOverlapMm = PredictedSearch::kRobotBreadthMm;
constexpr double kLongestGapS = 0.25;
constexpr double kMostGrowth = 2.0;  // of a blob's area from frame to frame, either way

double mm_per_px(const Field& field, cv::Point2d point_px, double height_mm) {
  return std::sqrt(std::max(field.mm2_per_px2(point_px, height_mm), 1e-6));
}

}  // namespace

bool may_go_on_unseen(const Blob& blob, const ScanArea& area, const ScanArea& field_area) {
  const cv::Rect& box = blob.bounds_px;
  return !covers(area, field_area, {box.x - 1, box.y - 1, box.width + 2, box.height + 2});
}

void PredictedSearch::forget() {
  started_ = false;
  last_.reset();
}

const ScanArea* PredictedSearch::plan(Timestamp captured, const Field& field,
                                      const ScanArea& field_area) {
  const double dt_s =
      last_ ? std::chrono::duration<double>(captured - *last_).count() : kLongestGapS + 1.0;
  last_ = captured;
  if (!started_ || dt_s < 0.0 || dt_s > kLongestGapS) {
    started_ = true;
    full_frames_left_ = turns_;
  }
  if (full_frames_left_ > 0) {
    --full_frames_left_;
    return nullptr;
  }
  if (!all_seen_ || field_area.empty()) return nullptr;

  field_area_ = &field_area;
  regions_.clear();
  expected_.clear();
  for (const RobotDetection& robot : seen_.robots) expect_robot(robot, field, dt_s);
  if (seen_.ball) expect_ball(*seen_.ball, field, dt_s);
  const cv::Size size = field.frame_size_px();
  const cv::Point2d middle_px((size.width - 1) / 2.0, (size.height - 1) / 2.0);
  join_regions_and_turn(field_area,
                        kOverlapMm / mm_per_px(field, middle_px, field.robot_height_mm()));
  turn_ = (turn_ + 1) % turns_;
  return &area_;
}

void PredictedSearch::expect_robot(const RobotDetection& robot, const Field& field, double dt_s) {
  const Motion motion = predict(robot.position_mm, robot.velocity_mm_s, field.robot_height_mm(),
                                {kRobotRadiusMm, kRobotSlackMm}, field, dt_s);
  for (const TagSighting& tag : robot.tags) {
    expect_blob(tag.label, tag.centroid_px, tag.area_px, motion, field);
  }
}

void PredictedSearch::expect_ball(const BallDetection& ball, const Field& field, double dt_s) {
  const Motion motion = predict(ball.position_mm, ball.velocity_mm_s, field.ball_height_mm(),
                                {kBallRadiusMm, kBallSlackMm}, field, dt_s);
  expect_blob(ball.label, ball.centroid_px, ball.area_px, motion, field);
}

PredictedSearch::Motion PredictedSearch::predict(cv::Point2d position_mm, cv::Point2d velocity_mm_s,
                                                 double height_mm, const Extent& extent,
                                                 const Field& field, double dt_s) {
  const double slack_mm = extent.slack_mm + kSpeedShare * cv::norm(velocity_mm_s) * dt_s;
  const cv::Point2d predicted_mm = position_mm + dt_s * velocity_mm_s;
  add_region(field, predicted_mm, height_mm, extent.radius_mm + slack_mm);
  return {field.to_image_px(predicted_mm, height_mm) - field.to_image_px(position_mm, height_mm),
          slack_mm, height_mm};
}

void PredictedSearch::expect_blob(Label label, cv::Point2d centroid_px, double area_px,
                                  const Motion& motion, const Field& field) {
  expected_.push_back({label, centroid_px + motion.moved_px,
                       motion.slack_mm / mm_per_px(field, centroid_px, motion.height_mm), area_px});
}

void PredictedSearch::add_region(const Field& field, cv::Point2d position_mm, double height_mm,
                                 double radius_mm) {
  cv::Rect2d box(field.to_image_px(position_mm, height_mm), cv::Size2d(0.0, 0.0));
  double right = box.x;
  double bottom = box.y;
  for (const double x : {-radius_mm, radius_mm}) {
    for (const double y : {-radius_mm, radius_mm}) {
      const cv::Point2d corner = field.to_image_px(position_mm + cv::Point2d(x, y), height_mm);
      box.x = std::min(box.x, corner.x);
      box.y = std::min(box.y, corner.y);
      right = std::max(right, corner.x);
      bottom = std::max(bottom, corner.y);
    }
  }
  const cv::Size size = field.frame_size_px();
  const int left_px = static_cast<int>(std::clamp(std::floor(box.x), 0.0, size.width - 1.0));
  const int top_px = static_cast<int>(std::clamp(std::floor(box.y), 0.0, size.height - 1.0));
  const int right_px =
      static_cast<int>(std::clamp(std::ceil(right) + 1.0, 1.0, double(size.width)));
  const int bottom_px =
      static_cast<int>(std::clamp(std::ceil(bottom) + 1.0, 1.0, double(size.height)));
  regions_.push_back(
      {left_px, top_px, std::max(1, right_px - left_px), std::max(1, bottom_px - top_px)});
}

void PredictedSearch::join_regions_and_turn(const ScanArea& field_area, double overlap_px) {
  std::ranges::sort(regions_, {}, [](const cv::Rect& region) { return region.x; });
  const int first_row = field_area.front().row;
  const int rows = field_area.back().row - first_row + 1;
  const auto turn_begin = [&](int turn) { return first_row + rows * turn / turns_; };
  const double turn_top = turn_begin(turn_) - overlap_px;
  const double turn_bottom = turn_begin(turn_ + 1) + overlap_px;

  area_.clear();
  for (const RowSpan& span : field_area) {
    if (span.row >= turn_top && span.row < turn_bottom) {
      area_.push_back(span);
      continue;
    }
    int begin = 0;
    int end = 0;  // of what was joined so far; nothing yet
    const auto take = [&] {
      const int from = std::max<int>(begin, span.begin);
      const int to = std::min<int>(end, span.end);
      if (from < to) {
        area_.push_back(
            {span.row, static_cast<std::uint16_t>(from), static_cast<std::uint16_t>(to)});
      }
    };
    for (const cv::Rect& region : regions_) {
      if (span.row < region.y || span.row >= region.y + region.height) continue;
      if (region.x > end) {
        take();
        begin = region.x;
        end = region.x;
      }
      end = std::max(end, region.x + region.width);
    }
    take();
  }
}

bool PredictedSearch::accept(std::vector<Blob>& blobs) const {
  std::erase_if(blobs,
                [this](const Blob& blob) { return may_go_on_unseen(blob, area_, *field_area_); });
  return std::ranges::all_of(expected_, [&](const Expected& expected) {
    return std::ranges::any_of(blobs, [&](const Blob& blob) {
      const cv::Point2d off = blob.centroid_px - expected.centroid_px;
      return blob.label == expected.label &&
             off.dot(off) <= expected.reach_px * expected.reach_px &&
             blob.area_px <= kMostGrowth * expected.area_px &&
             blob.area_px * kMostGrowth >= expected.area_px;
    });
  });
}

void PredictedSearch::remember(const Detections& detections) {
  seen_ = detections;
  const auto is_seen = [](const auto& object) { return object.state == TrackState::kSeen; };
  all_seen_ = std::ranges::all_of(seen_.robots, is_seen) && (!seen_.ball || is_seen(*seen_.ball));
}

}  // namespace maggic
