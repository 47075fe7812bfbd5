#pragma once
/// How right detections are, where the truth is known. Match by position first, compare identity
/// afterwards.

#include <cstdint>

#include "maggic/detections.hpp"

namespace maggic {

/// Running sums of an error, for RMSE and maximum.
struct ErrorSum {
  double squares = 0.0;
  double max = 0.0;
  std::uint64_t count = 0;
  void add(double error);
  /// Root of the mean square; 0 when nothing was added.
  double rmse() const;
};

/// Accumulates frames. Objects match when within `max_distance_mm`, nearest pairs over the whole
/// frame (optimal assignment by total distance). Predicted objects count like seen ones.
class TruthScore {
 public:
  explicit TruthScore(double max_distance_mm = 50.0) : max_distance_mm_(max_distance_mm) {}

  void add(const Detections& found, const Detections& truth);

  std::uint64_t frames = 0;
  std::uint64_t robots_true = 0;     ///< Robot-frames in the truth.
  std::uint64_t robots_found = 0;    ///< … matched by position.
  std::uint64_t robots_right_id = 0; ///< … and team and id agree.
  std::uint64_t robots_false = 0;    ///< Reported where there is none.
  std::uint64_t balls_true = 0;
  std::uint64_t balls_found = 0;
  std::uint64_t balls_false = 0;
  ErrorSum robot_position_mm;
  ErrorSum robot_heading_deg;
  ErrorSum ball_position_mm;

 private:
  double max_distance_mm_;
};

}  // namespace maggic
