#include "pipeline/capture.hpp"

#include <algorithm>
#include <utility>

#include "pipeline/stage_guard.hpp"

namespace maggic {
namespace {

using std::chrono::milliseconds;

// How long any wait may keep a thread from noticing that the run is to end.
constexpr milliseconds kPatience{50};
// Read-ahead of a recorded source: decoding overlaps the frame path and its hiccups even out.
constexpr std::size_t kReadAheadFrames = 2;

}  // namespace

Capture::Capture(NamedStage<Source>& source, bool live, bool paced, FramePool& pool,
                 const std::atomic<bool>& stop)
    : source_(source),
      live_(live),
      paced_(paced),
      pool_(pool),
      stop_(stop),
      queue_(live ? 1 : kReadAheadFrames),
      thread_([this] { work(); }) {}

Capture::~Capture() {
  ended_ = true;
  thread_.join();
}

void Capture::work() {
  try {
    read_all();
  } catch (const std::exception& e) {
    error_ = e.what();
  }
  queue_.close();
}

void Capture::read_all() {
  std::uint64_t sequence = 0;
  FramePtr slot;
  while (!stopping()) {
    if (!slot) slot = pool_.acquire(kPatience);
    if (!slot) continue;
    Frame& frame = slot->result.frame;
    frame.has_truth = false;
    frame.truth_labels.release();  // of the frame that was in this slot before
    const auto start = std::chrono::steady_clock::now();
    const ReadStatus status = guarded(StageKind::kSource, source_.name, AtFrame{sequence},
                                      [&] { return source_.stage->read(frame); });
    if (status == ReadStatus::kEnd) return;
    if (status == ReadStatus::kRetry) continue;
    slot->result.times[Step::kRead] = std::chrono::steady_clock::now() - start;
    frame.sequence = sequence++;
    if (paced_) wait_until_due(frame.captured);
    if (live_) {
      if (queue_.push_newest(std::move(slot))) ++dropped_;
    } else {
      while (!queue_.push(slot, kPatience)) {
        if (stopping()) return;
      }
    }
    slot.reset();
  }
}

void Capture::wait_until_due(Timestamp captured) {
  const auto now = std::chrono::steady_clock::now();
  // A recording that loops or jumps back starts its clock anew.
  const bool anew = !last_captured_ || captured < *last_captured_;
  last_captured_ = captured;
  if (anew) {
    first_captured_ = captured;
    first_given_ = now;
    return;
  }
  const auto due = first_given_ + (captured - first_captured_);
  while (!stopping() && std::chrono::steady_clock::now() < due) {
    std::this_thread::sleep_until(std::min(due, std::chrono::steady_clock::now() + kPatience));
  }
}

}  // namespace maggic
