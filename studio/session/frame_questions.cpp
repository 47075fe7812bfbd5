#include "studio/session/frame_questions.hpp"

#include <utility>

namespace maggic::studio {
std::optional<PixelAnswer> FrameQuestions::ask(cv::Point pixel_px,
                                               std::chrono::milliseconds timeout) {
  const std::lock_guard asking(asking_);
  std::unique_lock lock(mutex_);
  pixel_px_ = pixel_px;
  answer_.reset();
  is_asked_ = true;
  answered_.wait_for(lock, timeout, [&] { return answer_.has_value(); });
  is_asked_ = false;
  return std::exchange(answer_, std::nullopt);
}

void FrameQuestions::answer(const Pipeline& pipeline, const FrameResult& result) {
  if (!is_asked_) return;
  {
    const std::lock_guard lock(mutex_);
    if (!is_asked_ || answer_) return;
    PixelAnswer answer;
    answer.frame_size_px = result.frame.bgr.size();
    if (cv::Rect({}, answer.frame_size_px).contains(pixel_px_)) {
      answer.bgr = result.frame.bgr.at<cv::Vec3b>(pixel_px_);
      const ChannelGains* gains = pipeline.channel_gains();
      answer.followed_bgr = gains != nullptr ? (*gains)(answer.bgr) : answer.bgr;
      answer.stages = explain_point(pipeline, result, pixel_px_);
    }
    answer_ = std::move(answer);
  }
  answered_.notify_all();
}

}  // namespace maggic::studio
