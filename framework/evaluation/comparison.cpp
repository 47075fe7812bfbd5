#include "maggic/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace maggic {
namespace {

/// Over robots and ball; not a number when nothing was matched.
double position_rmse_mm(const Scorecard& card) {
  ErrorDistribution all = card.ball().position_mm;
  all.merge(card.robots().position_mm);
  return all.count() == 0 ? std::numeric_limits<double>::quiet_NaN() : all.rmse();
}

/// Of a card with one frame on it.
double difference_in(const Scorecard& card) {
  const ObjectTally robots = card.robots();
  const ObjectTally& ball = card.ball();
  const std::uint64_t unlike = (robots.frames - robots.seen) + card.false_robots() +
                               (robots.seen - robots.within_tolerance) + robots.wrong_identity +
                               robots.unknown_identity + (ball.frames - ball.seen) +
                               card.false_balls() + (ball.seen - ball.within_tolerance);
  const double apart_mm = position_rmse_mm(card);
  return static_cast<double>(unlike) + (std::isnan(apart_mm) ? 0.0 : apart_mm / 1000.0);
}

double objects_seen(const Detections& found) {
  const auto robots = std::ranges::count(found.robots, TrackState::kSeen, &RobotDetection::state);
  const bool ball = found.ball && found.ball->state == TrackState::kSeen;
  return static_cast<double>(robots + (ball ? 1 : 0));
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

FramePoint unknown_point() {
  FramePoint point{kUnknown, kUnknown, {}};
  point.step_ms.fill(kUnknown);
  return point;
}

}  // namespace

Comparison::Comparison(std::size_t pipelines, Tolerance tolerance)
    : tolerance_(tolerance),
      truth_cards_(pipelines, Scorecard(tolerance)),
      first_cards_(pipelines, Scorecard(tolerance)) {}

double Comparison::add(std::span<const Entry> entries) {
  FrameRow row;
  double difference = 0.0;
  const FrameResult* first = entries.front().result;
  TrueScene seen_by_first;
  if (first != nullptr) seen_by_first = scene_of(first->detections);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    FramePoint& point = row.points.emplace_back(unknown_point());
    if (entry.result == nullptr) continue;
    row.sequence = entry.result->frame.sequence;
    const Detections& found = entry.result->detections;
    point.objects_seen = objects_seen(found);
    for (std::size_t step = 0; step < point.step_ms.size(); ++step) {
      point.step_ms[step] =
          std::chrono::duration<double, std::milli>(entry.result->times.of[step]).count();
    }
    if (entry.truth != nullptr) {
      truth_cards_[i].add(found, *entry.truth, *entry.field);
      Scorecard of_frame(tolerance_);
      of_frame.add(found, *entry.truth, *entry.field);
      point.position_error_mm = position_rmse_mm(of_frame);
    }
    if (i == 0 || first == nullptr) continue;
    first_cards_[i].add(found, seen_by_first, *entry.field);
    Scorecard of_frame(tolerance_);
    of_frame.add(found, seen_by_first, *entry.field);
    difference = std::max(difference, difference_in(of_frame));
    if (entry.truth == nullptr) point.position_error_mm = position_rmse_mm(of_frame);
  }
  rows_.push_back(std::move(row));
  return difference;
}

void DifferentFrames::offer(std::uint64_t sequence, double difference,
                            const std::function<cv::Mat()>& draw) {
  const auto near = std::ranges::find_if(kept_, [&](const Kept& kept) {
    const std::uint64_t apart =
        std::max(kept.sequence, sequence) - std::min(kept.sequence, sequence);
    return apart < apart_;
  });
  if (near != kept_.end()) {
    if (near->difference >= difference) return;
    kept_.erase(near);
  } else if (kept_.size() >= count_) {
    if (kept_.empty() || kept_.back().difference >= difference) return;
    kept_.pop_back();
  }
  const auto place =
      std::ranges::find_if(kept_, [&](const Kept& kept) { return kept.difference < difference; });
  kept_.insert(place, {sequence, difference, draw()});
}

}  // namespace maggic
