#include "app/frame_sampler.hpp"

#include <chrono>
#include <stdexcept>

#include <fmt/format.h>

#include "maggic/frame_conversion.hpp"

namespace maggic::app {
namespace {

constexpr std::size_t kKept = 24;
constexpr std::chrono::seconds kPatience{10};

}  // namespace

std::vector<cv::Mat> sample_frames(Source& source, std::uint64_t most, Console& console) {
  using Clock = std::chrono::steady_clock;
  source.open();
  std::vector<cv::Mat> frames;
  std::uint64_t read = 0;
  std::uint64_t stride = 1;
  auto last = Clock::now();
  Frame frame;
  while (read < most) {
    frame.has_truth = false;
    frame.truth_labels.release();
    const ReadStatus status = source.read(frame);
    if (status == ReadStatus::kEnd) break;
    if (status == ReadStatus::kRetry) {
      if (Clock::now() - last <= kPatience) continue;
      throw std::runtime_error(
          fmt::format("nothing came from the source for {} seconds", kPatience.count()));
    }
    last = Clock::now();
    if (read++ % stride != 0) continue;
    if (const auto unusable = convert_to_bgr8(frame.bgr)) {
      console.line(*unusable, Console::Tone::kWarning, "a frame was passed over: ");
      continue;
    }
    if (!frames.empty() && frame.bgr.size() != frames.front().size()) {
      console.line("it has another size than the first one", Console::Tone::kWarning,
                   "a frame was passed over: ");
      continue;
    }
    frames.push_back(frame.bgr.clone());
    if (frames.size() < 2 * kKept) continue;
    // Twice too many: every second one goes, and from here on only every second one comes.
    for (std::size_t i = 0; i < kKept; ++i) frames[i] = frames[2 * i];
    frames.resize(kKept);
    stride *= 2;
  }
  if (frames.size() <= kKept) return frames;
  std::vector<cv::Mat> kept;
  for (std::size_t i = 0; i < kKept; ++i) kept.push_back(frames[i * frames.size() / kKept]);
  return kept;
}

}  // namespace maggic::app
