#include "app/border_notes.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "app/console_reporter.hpp"
#include "maggic/runner.hpp"

namespace maggic::app {
namespace {

constexpr std::chrono::seconds kPatience{10};

/// Sets `stop` when it has lived for long enough.
class TimeLimit {
 public:
  explicit TimeLimit(std::atomic<bool>& stop)
      : thread_([this, &stop](const std::stop_token& ended) {
          std::unique_lock lock(mutex_);
          woken_.wait_for(lock, ended, kPatience, [] { return false; });
          stop = true;
        }) {}

 private:
  std::mutex mutex_;
  std::condition_variable_any woken_;
  std::jthread thread_;  // last: uses the above
};

}  // namespace

bool print_border_notes(const Pipeline& pipeline, const BlobColors& colors, Console& console) {
  const std::vector<DoubtfulBorder> borders = find_doubtful_borders(pipeline, colors);
  for (const DoubtfulBorder& border : borders) {
    console.line(border.to_string(pipeline.palette()), Console::Tone::kWarning, "note: ");
  }
  return !borders.empty();
}

void look_at_source(BuiltPipeline& built, Console& console) {
  built.sinks.clear();
  ConsoleReporter reporter(console);
  std::atomic<bool> stop = false;
  BlobColors colors;
  RunOptions options;
  options.max_frames = BlobColors::kMaxFrames;
  RunSummary summary;
  {
    const TimeLimit limit(stop);
    summary =
        run(built, options, stop, reporter, [&](const FrameResult& result, const RunSummary&) {
          colors.offer(result, built.pipeline->channel_gains());
        });
  }
  if (summary.processed == 0) {
    console.line(fmt::format("colours were not looked at: {}", summary.first_error.empty()
                                                                   ? "no frame came from the source"
                                                                   : summary.first_error),
                 Console::Tone::kWarning, "note: ");
    return;
  }
  print_border_notes(*built.pipeline, colors, console);
}

}  // namespace maggic::app
