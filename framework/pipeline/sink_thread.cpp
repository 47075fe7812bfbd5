#include "pipeline/sink_thread.hpp"

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

void SinkThread::give(const FramePtr& frame) {
  while (!queue_.push(frame, kPatience)) {
  }
}

SinkSummary SinkThread::finish() {
  queue_.close();
  thread_.join();
  summary_.dropped = dropped_;
  return summary_;
}

void SinkThread::work() {
  bool open = false;
  try {
    guarded(StageKind::kSink, sink_.name, "to open", [&] { sink_.stage->open(info_); });
    open = true;
  } catch (const StageError& e) {
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
    } catch (const StageError& e) {
      ++summary_.failed;
      fail(e.what());
    }
  }
  if (!open) return;
  try {
    guarded(StageKind::kSink, sink_.name, "to close", [&] { sink_.stage->close(); });
  } catch (const StageError& e) {
    fail(e.what());
  }
}

void SinkThread::fail(const std::string& message) {
  if (!summary_.first_error.empty()) return;
  summary_.first_error = message;
  reporter_.warn(message);
}

}  // namespace maggic
