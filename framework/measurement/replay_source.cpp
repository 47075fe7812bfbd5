#include "measurement/replay_source.hpp"

#include <algorithm>
#include <thread>

namespace maggic {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLongestBlock{100};

}  // namespace

// Rather than the Unix epoch's clock, which may be set while a latency is measured.
Timestamp ReplaySource::now() { return Clock::now().time_since_epoch(); }

SourceInfo ReplaySource::open() {
  due_ = Clock::now();
  SourceInfo info;
  info.live = true;
  info.frames_per_second = 1.0 / std::chrono::duration<double>(store_.period()).count();
  return info;
}

ReadStatus ReplaySource::read(Frame& frame) {
  const auto wake = std::min(due_, Clock::now() + kLongestBlock);
  std::this_thread::sleep_until(wake);
  if (wake < due_) return ReadStatus::kRetry;
  store_.get(next_++, frame);
  frame.captured = now();
  // One that came late does not make those behind it come early.
  due_ = std::max(due_, Clock::now() - store_.period()) + store_.period();
  return ReadStatus::kFrame;
}

}  // namespace maggic
