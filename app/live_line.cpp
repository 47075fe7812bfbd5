#include "app/live_line.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/milliseconds.hpp"

namespace maggic::app {
namespace {

/// Short on narrow terminals: the numbers tell more than the bar.
int bar_cells(int width) { return width >= 150 ? 20 : width >= 110 ? 10 : 6; }

std::string clock(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole >= 3600) {
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

/// How much of the run is over, by the limit that will be reached first.
std::optional<double> share_done(const LiveState& state) {
  const std::uint64_t taken = state.processed + state.skipped + state.failed;
  std::optional<double> done;
  const auto count = [&](std::uint64_t frames, std::optional<std::uint64_t> limit) {
    if (!limit || *limit == 0) return;
    const double share = static_cast<double>(frames) / static_cast<double>(*limit);
    done = std::clamp(share, done.value_or(0.0), 1.0);
  };
  count(taken, state.max_taken);
  count(taken + state.dropped, state.total);
  return done;
}

std::string progress(const LiveState& state, int width) {
  const std::optional<double> known = share_done(state);
  if (!known) return fmt::format("frame {}", state.processed);
  const double done = *known;
  const int bar = bar_cells(width);
  const int cells = static_cast<int>(done * bar);
  std::string text = fmt::format("[{:#<{}}{:-<{}}] {:3.0f}%", "", cells, "", bar - cells,
                                 std::floor(done * 100.0));
  // The rate of the whole run: the latest one jumps, and so would the time left.
  if (done > 0.0 && done < 1.0) {
    text += " ETA " + clock(state.elapsed_s / done * (1.0 - done));
  }
  return text;
}

std::string quantiles_text(std::string_view name, const Quantiles& q) {
  return fmt::format("{} {:.2f}/{:.2f}", name, q.p50_ms, q.p99_ms);
}

}  // namespace

Quantiles quantiles_of(const DurationHistogram& histogram) {
  return {in_ms(histogram.quantile(0.5)), in_ms(histogram.quantile(0.99))};
}

std::string live_line(const LiveState& state, int width) {
  const std::size_t room = static_cast<std::size_t>(std::max(width, 1));
  if (state.processed + state.skipped + state.failed == 0) {
    return fmt::format("waiting for the first frame ({:.0f} s); Ctrl-C ends",
                       std::floor(state.elapsed_s))
        .substr(0, room);
  }
  std::vector<std::string> parts;
  parts.push_back(progress(state, width));
  parts.push_back(fmt::format("{:.0f} fps", state.frames_per_second));
  parts.push_back(fmt::format("{} robot{}{}", state.robots, state.robots == 1 ? "" : "s",
                              state.ball ? "+ball" : ", no ball"));
  if (state.failed > 0) parts.push_back(fmt::format("{} failed", state.failed));
  parts.push_back(fmt::format("{} dropped", state.dropped));
  if (state.skipped > 0) parts.push_back(fmt::format("{} skipped", state.skipped));
  parts.push_back(quantiles_text("p50/p99", state.frame_path) + " ms");
  for (const Step step : {Step::kSegment, Step::kBlobs, Step::kTrack, Step::kRead}) {
    parts.push_back(quantiles_text(name_of(step), state.steps[static_cast<std::size_t>(step)]));
  }

  std::string line;
  for (const std::string& part : parts) {
    const std::string_view gap = line.empty() ? "" : "  ";
    if (line.size() + gap.size() + part.size() > room) break;
    line.append(gap).append(part);
  }
  return line.empty() ? parts.front().substr(0, room) : line;
}

}  // namespace maggic::app
