#include "pipeline/sink_thread.hpp"

#include <optional>

#include "pipeline/stage_guard.hpp"

namespace maggic {
namespace {

constexpr std::chrono::milliseconds kPatience{50};

}  // namespace

SinkThread::SinkThread(NamedStage<Sink>& sink, const RunInfo& info, std::size_t queue_frames,
                       Reporter& reporter)
    : sink_(sink), info_(info), reporter_(reporter), queue_(queue_frames) {
  summary_.name = sink.name;
  thread_ = std::thread([this] { work(); });
}

SinkThread::~SinkThread() {
  if (thread_.joinable()) finish();
}

bool SinkThread::offer(const FramePtr& frame) {
  if (queue_.push(frame, std::chrono::milliseconds(0))) return true;
  ++dropped_;
  return false;
}

bool SinkThread::give(const FramePtr& frame, const std::atomic<bool>& stop,
                      std::chrono::milliseconds patience) {
  std::optional<std::chrono::steady_clock::time_point> give_up;
  while (!queue_.push(frame, kPatience)) {
    if (!stop) continue;
    const auto now = std::chrono::steady_clock::now();
    if (!give_up) give_up = now + patience;
    if (now < *give_up) continue;
    ++dropped_;
    return false;
  }
  return true;
}

SinkSummary SinkThread::finish() {
  close();
  thread_.join();
  summary_.dropped = dropped_;
  return summary_;
}

void SinkThread::work() {
  bool open = false;
  try {
    guarded(StageKind::kSink, sink_.name, "to open", [&] { sink_.stage->open(info_); });
    open = true;
  } catch (const std::exception& e) {
    fail(e.what());
  }
  // The queue is emptied even without a sink to write to, so that nobody waits for room in it.
  while (!queue_.finished()) {
    const FramePtr frame = queue_.pop(kPatience);
    if (!frame || !open) continue;
    try {
      guarded(StageKind::kSink, sink_.name, AtFrame{frame->result.frame.sequence},
              [&] { sink_.stage->write(frame->result, *frame->field); });
      ++summary_.written;
    } catch (const std::exception& e) {
      ++summary_.failed;
      fail(e.what());
    }
  }
  if (!open) return;
  try {
    guarded(StageKind::kSink, sink_.name, "to close", [&] { sink_.stage->close(); });
  } catch (const std::exception& e) {
    fail(e.what());
  }
}

void SinkThread::fail(const std::string& message) {
  if (!summary_.first_error.empty()) return;
  summary_.first_error = message;
  tell(reporter_, message);
}

}  // namespace maggic
