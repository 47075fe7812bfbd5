#include "app/progress.hpp"

namespace maggic::app {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTerminalInterval{100};
constexpr milliseconds kPlainInterval{2000};
constexpr double kRateSmoothing = 0.2;  // weight of the latest interval on a terminal

}  // namespace

Progress::Progress(Console& console, std::optional<std::uint64_t> max_taken) : console_(console) {
  state_.max_taken = max_taken;
  thread_ = std::thread([this] { show_until_done(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_one();
  thread_.join();
  console_.end_live();
}

void Progress::update(const FrameResult& result, const RunSummary& summary,
                      std::optional<std::uint64_t> total) {
  const std::lock_guard lock(mutex_);
  state_.processed = summary.processed;
  state_.dropped = summary.dropped;
  state_.skipped = summary.skipped;
  state_.failed = summary.failed;
  state_.total = total;
  state_.robots = result.detections.robots.size();
  state_.ball = result.detections.ball.has_value();
  if (!quantiles_wanted_.exchange(false)) return;
  state_.frame_path = quantiles_of(summary.times.frame_path());
  for (std::size_t i = 0; i < state_.steps.size(); ++i) {
    state_.steps[i] = quantiles_of(summary.times.of(static_cast<Step>(i)));
  }
}

void Progress::show_until_done() {
  const bool terminal = console_.is_terminal();
  const milliseconds interval = terminal ? kTerminalInterval : kPlainInterval;
  std::uint64_t processed_before = 0;
  Clock::time_point before = started_;
  std::optional<double> rate;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, interval, [this] { return done_; })) {
    const Clock::time_point now = Clock::now();
    const double latest_rate = static_cast<double>(state_.processed - processed_before) /
                               std::chrono::duration<double>(now - before).count();
    processed_before = state_.processed;
    before = now;
    rate = terminal && rate ? *rate + kRateSmoothing * (latest_rate - *rate) : latest_rate;
    LiveState shown = state_;
    shown.frames_per_second = *rate;
    shown.elapsed_s = std::chrono::duration<double>(now - started_).count();
    quantiles_wanted_ = true;
    lock.unlock();
    // One column short: a full last column makes some terminals wrap.
    console_.live(live_line(shown, console_.width() - 1));
    lock.lock();
  }
}

}  // namespace maggic::app
