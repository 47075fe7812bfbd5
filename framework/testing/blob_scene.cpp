#include "blob_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

namespace maggic::testing {
namespace {

constexpr std::size_t kFrames = 90;
constexpr double kHalfTag_px = 16.0;  // half of a tag's side at this scene's scale

class Scene {
 public:
  explicit Scene(const Palette& palette) : palette_(palette) {}

  BlobFrame frame(std::size_t index) {
    BlobFrame frame;
    frame.captured = time_of(index);
    if (index == 0) return frame;
    if (index > 1) {
      for (int robot = 0; robot < 8; ++robot) add_robot(robot, static_cast<double>(index), frame);
      add_clutter(static_cast<int>(index % 40), frame);
    }
    add(*palette_.find("orange"), {100.0 + 3.0 * static_cast<double>(index), 240.5}, 18, 18, frame);
    std::ranges::shuffle(frame.blobs, random_);
    return frame;
  }

 private:
  static Timestamp time_of(std::size_t index) {
    using std::chrono::milliseconds;
    const milliseconds steady(16 * index);
    if (index == 20) return milliseconds(16 * (index - 1));                // stands still
    if (index >= 40 && index < 60) return steady + std::chrono::hours(1);  // jumps ahead
    if (index >= 75) return steady - std::chrono::seconds(1);              // goes backwards
    return steady;
  }

  double uniform(double low, double high) {
    // Not std::uniform_real_distribution: its values differ between standard libraries.
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }

  void add(Label label, cv::Point2d at, double width, double height, BlobFrame& frame) {
    Blob blob;
    blob.label = label;
    blob.area_px = std::max(1, static_cast<int>(width * height));
    // Jitter makes every centroid one of its kind and the picture a little noisy.
    blob.centroid_px = {at.x + uniform(-0.2, 0.2), at.y + uniform(-0.2, 0.2)};
    blob.bounds_px =
        cv::Rect(static_cast<int>(at.x - width / 2), static_cast<int>(at.y - height / 2),
                 std::max(1, static_cast<int>(width)), std::max(1, static_cast<int>(height)));
    blob.moment_xx_px2 = width * width / 12;
    blob.moment_yy_px2 = height * height / 12;
    frame.blobs.push_back(blob);
  }

  /// Even ones carry two patches, odd ones three; the colours repeat after four, so that ids are
  /// asked for twice. A patch is missing now and then.
  void add_robot(int robot, double time, BlobFrame& frame) {
    constexpr std::string_view kPlayers[] = {"red", "green", "cyan", "magenta"};
    const double heading = 0.7 * robot + 0.03 * time;
    const cv::Point2d ahead(std::cos(heading), -std::sin(heading));
    const cv::Point2d left(ahead.y, -ahead.x);
    const cv::Point2d at(80.0 + 60.0 * robot + time, 100.0 + 40.0 * (robot % 4) + 0.5 * time);
    const auto label = [&](std::string_view name) { return *palette_.find(name); };
    const auto side = kHalfTag_px;
    add(label(robot < 4 ? "blue" : "yellow"), at - ahead * (side / 2), side, 2 * side, frame);
    if (uniform(0, 1) < 0.15) return;
    const cv::Point2d front = at + ahead * (side / 2);
    if (robot % 2 == 0) return add(label(kPlayers[robot / 2 % 4]), front, side, 2 * side, frame);
    add(label(kPlayers[robot / 2 % 4]), front + left * (side / 2), side, side, frame);
    add(label(kPlayers[(robot / 2 + 1) % 4]), front - left * (side / 2), side, side, frame);
  }

  void add_clutter(int count, BlobFrame& frame) {
    for (int i = 0; i < count; ++i) {
      const auto label = static_cast<Label>(1 + random_() % (palette_.size() - 1));
      const double size = i % 7 == 0 ? uniform(1, 200) : uniform(1, 20);
      const cv::Point2d at = i % 11 == 0 ? cv::Point2d(0, 0)
                                         : cv::Point2d(uniform(0, BlobFrame::kSize.width),
                                                       uniform(0, BlobFrame::kSize.height));
      add(label, at, size, uniform(1, size + 1), frame);
    }
  }

  const Palette& palette_;
  std::mt19937 random_{11};
};

}  // namespace

std::vector<BlobFrame> blob_scene(const Palette& palette) {
  Scene scene(palette);
  std::vector<BlobFrame> frames;
  for (std::size_t i = 0; i < kFrames; ++i) frames.push_back(scene.frame(i));
  return frames;
}

}  // namespace maggic::testing
