#include "maggic/truth_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "assignment/assignment.hpp"

namespace maggic {
namespace {

double distance(cv::Point2d a, cv::Point2d b) { return std::hypot(a.x - b.x, a.y - b.y); }

double heading_error_deg(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)) * 180.0 / std::numbers::pi;
}

using Pair = std::pair<const RobotDetection*, const RobotDetection*>;

/// Pairs of found and true robots: as many as possible, and of those the nearest in total.
std::vector<Pair> matched(const Detections& found, const Detections& truth, double max_mm) {
  std::vector<Pair> pairs;
  std::vector<double> scores;
  std::vector<int> groups;
  for (std::size_t t = 0; t < truth.robots.size(); ++t) {
    for (const RobotDetection& robot : found.robots) {
      const double apart = distance(robot.position_mm, truth.robots[t].position_mm);
      if (!(apart <= max_mm)) continue;
      pairs.emplace_back(&robot, &truth.robots[t]);
      // One pair more outweighs any distances the others can lose by it.
      const double one_more = max_mm * static_cast<double>(truth.robots.size() + 1);
      scores.push_back(one_more + max_mm - apart + 1e-9);
      groups.push_back(static_cast<int>(t));
    }
  }
  std::vector<std::pair<int, int>> conflicts;
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    for (int k = 0; k < i; ++k) {
      if (pairs[i].first == pairs[k].first) conflicts.emplace_back(k, i);
    }
  }
  AssignmentSolver solver(1'000'000);
  std::vector<int> chosen;
  solver.solve(scores, groups, conflicts, chosen);
  std::vector<Pair> result;
  for (const int i : chosen) result.push_back(pairs[i]);
  return result;
}

}  // namespace

void ErrorSum::add(double error) {
  squares += error * error;
  max = std::max(max, std::abs(error));
  ++count;
}

double ErrorSum::rmse() const {
  return count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count));
}

void TruthScore::add(const Detections& found, const Detections& truth) {
  ++frames;
  const std::vector<Pair> pairs = matched(found, truth, max_distance_mm_);
  robots_true += truth.robots.size();
  robots_found += pairs.size();
  robots_false += found.robots.size() - pairs.size();
  for (const auto& [robot, real] : pairs) {
    if (robot->team == real->team && robot->id == real->id) ++robots_right_id;
    robot_position_mm.add(distance(robot->position_mm, real->position_mm));
    robot_heading_deg.add(heading_error_deg(robot->heading_rad, real->heading_rad));
  }

  if (truth.ball) ++balls_true;
  if (!found.ball) return;
  const double apart =
      truth.ball ? distance(found.ball->position_mm, truth.ball->position_mm) : max_distance_mm_;
  if (truth.ball && apart <= max_distance_mm_) {
    ++balls_found;
    ball_position_mm.add(apart);
  } else {
    ++balls_false;
  }
}

}  // namespace maggic
