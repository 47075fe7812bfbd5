#include "maggic/frame_store.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "maggic/frame_conversion.hpp"
#include "pipeline/stage_guard.hpp"

namespace maggic {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{10};
constexpr double kUsualFramesPerSecond = 60.0;

std::chrono::nanoseconds period_at(double frames_per_second) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / frames_per_second));
}

}  // namespace

FrameStore::FrameStore(NamedStage<Source>& source, const Limits& limits, Reporter& reporter) {
  read(source, limits, reporter);
  if (pictures_.empty()) {
    throw std::runtime_error(fmt::format("no frame ever came from the source '{}'", source.name));
  }
  given_ = pictures_.size();
  fill_up(limits);
}

void FrameStore::get(std::uint64_t i, Frame& frame) const {
  frame.sequence = i;
  frame.captured = period_ * static_cast<std::int64_t>(i);
  frame.bgr = pictures_[i % pictures_.size()];
  frame.has_truth = false;
}

bool FrameStore::is_full(const Limits& limits) const {
  if (pictures_.empty()) return false;
  const std::size_t frame_bytes = pictures_.front().total() * pictures_.front().elemSize();
  return pictures_.size() >= limits.frames || (pictures_.size() + 1) * frame_bytes > limits.bytes;
}

void FrameStore::read(NamedStage<Source>& source, const Limits& limits, Reporter& reporter) {
  const SourceInfo info =
      guarded(StageKind::kSource, source.name, "to open", [&] { return source.stage->open(); });
  Timestamp first{0};
  Timestamp last{0};
  std::int64_t read = 0;
  auto last_came = Clock::now();
  Frame frame;
  while (!is_full(limits)) {
    frame.has_truth = false;
    frame.truth_labels.release();
    const ReadStatus status =
        guarded(StageKind::kSource, source.name, AtFrame{static_cast<std::uint64_t>(read)},
                [&] { return source.stage->read(frame); });
    if (status == ReadStatus::kEnd) break;
    if (status == ReadStatus::kRetry) {
      if (Clock::now() - last_came <= kPatience) continue;
      throw std::runtime_error(fmt::format("nothing came from the source '{}' for {} seconds",
                                           source.name, kPatience.count()));
    }
    last_came = Clock::now();
    if (read++ == 0) first = frame.captured;
    last = frame.captured;
    if (const auto unusable = convert_to_bgr8(frame.bgr)) {
      reporter.warn(fmt::format("a frame was passed over: {}", *unusable));
      continue;
    }
    if (!pictures_.empty() && frame.bgr.size() != frame_size_px()) {
      reporter.warn("a frame was passed over: it has another size than the first one");
      continue;
    }
    pictures_.push_back(frame.bgr.clone());
  }
  if (info.frames_per_second > 0.0) {
    period_ = period_at(info.frames_per_second);
  } else if (last > first) {
    period_ = (last - first) / (read - 1);
  } else {
    period_ = period_at(kUsualFramesPerSecond);
  }
}

void FrameStore::fill_up(const Limits& limits) {
  for (std::size_t i = 0; !is_full(limits); ++i) pictures_.push_back(pictures_[i].clone());
}

}  // namespace maggic
