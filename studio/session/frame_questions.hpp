#pragma once
/// Questions that only the run loop's thread can answer, about the frame it has just processed.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/point_explanation.hpp"

namespace maggic::studio {

/// What became of a pixel.
struct PixelAnswer {
  cv::Size frame_size_px;
  cv::Vec3b bgr;                    ///< As it came.
  cv::Vec3b followed_bgr;           ///< Taken back to the light of the calibration.
  std::vector<StageAnswer> stages;  ///< Empty when the pixel lies outside of the frame.
};

/// One question at a time; a second asker waits for the first.
class FrameQuestions {
 public:
  /// @return nothing when no frame came within `timeout`.
  std::optional<PixelAnswer> ask(cv::Point pixel_px, std::chrono::milliseconds timeout);

  /// On the run loop's thread, after each frame.
  void answer(const Pipeline& pipeline, const FrameResult& result);

 private:
  std::mutex asking_;  ///< Held by the one who asks.
  std::mutex mutex_;
  std::condition_variable answered_;
  std::atomic<bool> is_asked_{false};
  cv::Point pixel_px_;
  std::optional<PixelAnswer> answer_;
};

}  // namespace maggic::studio
