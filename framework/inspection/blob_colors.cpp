#include <algorithm>
#include <numeric>

#include "maggic/border_check.hpp"

namespace maggic {
namespace {

std::size_t pixels_of(const std::vector<Blob>& blobs) {
  return std::accumulate(blobs.begin(), blobs.end(), std::size_t{0},
                         [](std::size_t sum, const Blob& blob) {
                           return sum + static_cast<std::size_t>(blob.area_px);
                         });
}

std::uint32_t packed(const cv::Vec3b& bgr) {
  return std::uint32_t{bgr[2]} << 16 | std::uint32_t{bgr[1]} << 8 | bgr[0];
}

}  // namespace

void BlobColors::offer(const FrameResult& result, const ChannelGains* gains) {
  if (offered_++ % stride_ != 0) return;
  if (frames_.size() == kMaxFrames) {
    for (std::size_t i = 0; i < kMaxFrames / 2; ++i) std::swap(frames_[i], frames_[2 * i]);
    frames_.resize(kMaxFrames / 2);
    stride_ *= 2;
    if ((offered_ - 1) % stride_ != 0) return;
  }
  std::vector<std::uint32_t>& colors = frames_.emplace_back();
  const std::size_t step = pixels_of(result.blobs) / kMaxPixels + 1;
  std::size_t seen = 0;
  for (const Blob& blob : result.blobs) {
    const cv::Rect& box = blob.bounds_px;
    auto run = std::ranges::lower_bound(result.runs, box.y, {}, &Run::row);
    for (; run != result.runs.end() && run->row < box.y + box.height; ++run) {
      if (run->label != blob.label || run->begin < box.x || run->end > box.x + box.width) continue;
      for (int column = run->begin; column < run->end; ++column) {
        if (seen++ % step != 0) continue;
        const cv::Vec3b color = result.frame.bgr.at<cv::Vec3b>(run->row, column);
        colors.push_back(packed(gains == nullptr ? color : (*gains)(color)));
      }
    }
  }
}

std::vector<BlobColors::Count> BlobColors::counts() const {
  std::vector<std::uint32_t> all;
  for (const std::vector<std::uint32_t>& colors : frames_) {
    all.insert(all.end(), colors.begin(), colors.end());
  }
  std::ranges::sort(all);
  std::vector<Count> counts;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i] != all[i - 1]) {
      const auto channel = [&](int shift) { return static_cast<std::uint8_t>(all[i] >> shift); };
      counts.push_back({channel(0), channel(8), channel(16), 0});
    }
    ++counts.back().pixels;
  }
  return counts;
}

}  // namespace maggic
