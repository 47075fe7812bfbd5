#include "studio/session/pipeline_exchange.hpp"

#include <utility>

namespace maggic::studio {

bool PipelineExchange::offer(std::unique_ptr<Pipeline> next, History history,
                             std::chrono::milliseconds timeout) {
  std::unique_ptr<Pipeline> spent;
  std::unique_lock lock(mutex_);
  spent = std::move(spent_);
  // One that was offered before and never taken goes out of scope with it.
  std::swap(next_, next);
  history_ = history;
  waiting_ = true;
  return taken_.wait_for(lock, timeout, [&] { return !waiting_; });
}

bool PipelineExchange::between_frames() {
  if (!waiting_) return false;
  const std::unique_lock look_lock(in_use_, std::try_to_lock);
  if (!look_lock) return false;
  {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || next_ == nullptr) return false;
    if (history_ == History::kKept) next_->continue_from(*running_.pipeline);
    spent_ = std::exchange(running_.pipeline, std::move(next_));
    waiting_ = false;
  }
  taken_.notify_all();
  return true;
}

void PipelineExchange::with_pipeline(const std::function<void(const Pipeline&)>& look) {
  const std::lock_guard lock(in_use_);
  look(*running_.pipeline);
}

}  // namespace maggic::studio
