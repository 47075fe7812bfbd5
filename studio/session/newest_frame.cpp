#include "studio/session/newest_frame.hpp"

#include <utility>

namespace maggic::studio {
namespace {

constexpr std::chrono::milliseconds kBetweenPictures{30};
constexpr std::chrono::seconds kInterest{2};
// When nobody looks; so there is one to look at when frames cease to come.
constexpr std::chrono::seconds kBetweenUnseen{1};

}  // namespace

bool NewestFrame::is_wanted(Clock::time_point now) {
  const Clock::duration since_last = now - last_kept_;
  if (now - last_asked_ < kInterest) return since_last >= kBetweenPictures;
  return since_last >= kBetweenUnseen;
}

void NewestFrame::offer(const FrameResult& result, const Field& field) {
  {
    const std::lock_guard lock(mutex_);
    if (!is_wanted(Clock::now())) return;
  }
  keep(result, field);
}

void NewestFrame::keep(const FrameResult& result, const Field& field) {
  auto kept = std::make_shared<KeptFrame>();
  kept->result = result;
  // The picture is the pool's, which will be written over.
  kept->result.frame.bgr = result.frame.bgr.clone();
  kept->result.frame.truth_labels.release();
  kept->field = std::make_shared<const Field>(field);
  {
    const std::lock_guard lock(mutex_);
    last_kept_ = Clock::now();
    kept->number = ++count_;
    newest_ = std::move(kept);
  }
  kept_.notify_all();
}

std::shared_ptr<const KeptFrame> NewestFrame::next(std::uint64_t after,
                                                   std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  last_asked_ = Clock::now();
  const bool came =
      kept_.wait_for(lock, timeout, [&] { return newest_ && newest_->number > after; });
  return came ? newest_ : nullptr;
}

std::shared_ptr<const KeptFrame> NewestFrame::newest() {
  const std::lock_guard lock(mutex_);
  return newest_;
}

}  // namespace maggic::studio
