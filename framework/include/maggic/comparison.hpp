#pragma once
/// How several pipelines did on the same frames, against the truth and against each other.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/field.hpp"
#include "maggic/frame_result.hpp"
#include "maggic/scorecard.hpp"

namespace maggic {

/// What one pipeline made of one frame, in numbers to plot. Not a number: not known.
struct FramePoint {
  /// RMSE over robots and ball that were seen and matched: against the truth, else against the
  /// first pipeline.
  double position_error_mm = 0.0;
  double objects_seen = 0.0;  ///< Robots and ball reported as seen.
  std::array<double, static_cast<std::size_t>(Step::kCount)> step_ms{};
};

/// One frame, with a point a pipeline.
struct FrameRow {
  std::uint64_t sequence = 0;
  std::vector<FramePoint> points;
};

/// Accumulates frames. The first pipeline is what the others are compared with.
class Comparison {
 public:
  /// One pipeline at one frame.
  struct Entry {
    const FrameResult* result = nullptr;  ///< Null where it failed at this frame.
    const Field* field = nullptr;         ///< Null with `result`.
    const TrueScene* truth = nullptr;     ///< Null where nobody knows.
  };

  Comparison(std::size_t pipelines, Tolerance tolerance);

  /// @param entries one a pipeline, in order.
  /// @return how much the others differ from the first in this frame: objects only one of the two
  ///   saw, that are named differently, or farther apart than the tolerance; plus the RMSE of the
  ///   places in metres, which orders frames that are alike otherwise. Of several pipelines the
  ///   largest; 0 where the first failed.
  double add(std::span<const Entry> entries);

  const Scorecard& against_truth(std::size_t pipeline) const { return truth_cards_[pipeline]; }
  /// What the first pipeline saw taken as the truth. The first one against itself is empty.
  const Scorecard& against_first(std::size_t pipeline) const { return first_cards_[pipeline]; }
  /// Every frame; grows by about 50 bytes a frame and pipeline.
  const std::vector<FrameRow>& rows() const { return rows_; }

 private:
  Tolerance tolerance_;
  std::vector<Scorecard> truth_cards_;
  std::vector<Scorecard> first_cards_;
  std::vector<FrameRow> rows_;
};

/// The frames that differ most, with a picture of each, a few and not next to each other.
class DifferentFrames {
 public:
  struct Kept {
    std::uint64_t sequence = 0;
    double difference = 0.0;
    cv::Mat picture;
  };

  /// @param count at most so many. @param apart at least so many frames from one to the next.
  DifferentFrames(std::size_t count, std::uint64_t apart) : count_(count), apart_(apart) {}

  /// Keeps the frame if it belongs among the most different ones so far, in place of one that does
  /// not any more. @param draw called only if it is kept.
  void offer(std::uint64_t sequence, double difference, const std::function<cv::Mat()>& draw);

  const std::vector<Kept>& kept() const { return kept_; }  ///< The most different first.

 private:
  std::size_t count_;
  std::uint64_t apart_;
  std::vector<Kept> kept_;
};

}  // namespace maggic
