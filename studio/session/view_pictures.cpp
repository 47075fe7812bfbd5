#include "studio/session/view_pictures.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "maggic/label_picture.hpp"
#include "maggic/run_scanner.hpp"
#include "studio/session/jpeg.hpp"

namespace maggic::studio {
namespace {

constexpr std::size_t kMostShelves = 16;

cv::Mat narrowed(const cv::Mat& picture, int width_px) {
  if (width_px <= 0 || width_px >= picture.cols) return picture;
  const double scale = static_cast<double>(width_px) / picture.cols;
  const int height_px = std::max(1, static_cast<int>(picture.rows * scale + 0.5));
  cv::Mat small;
  cv::resize(picture, small, {width_px, height_px}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

ViewPictures::ViewPictures(NewestFrame& frames, PipelineExchange& exchange, Palette palette)
    : frames_(frames), exchange_(exchange), palette_(std::move(palette)) {}

std::vector<std::string> ViewPictures::names() {
  return {"overlay", "original", "normalized", "filtered", "labels"};
}

std::shared_ptr<const Picture> ViewPictures::next(std::string_view view, int width_px,
                                                  std::uint64_t after,
                                                  std::chrono::milliseconds timeout) {
  const std::shared_ptr<const KeptFrame> frame = frames_.next(after, timeout);
  if (!frame) return nullptr;
  const std::shared_ptr<Shelf> shelf = shelf_of(view, width_px);
  const std::lock_guard lock(shelf->mutex);
  if (!shelf->newest || shelf->newest->sequence < frame->number) {
    auto picture = std::make_shared<Picture>();
    picture->sequence = frame->number;
    picture->jpeg = jpeg_of(narrowed(draw(view, *frame, shelf->overlay), width_px));
    shelf->newest = std::move(picture);
  }
  return shelf->newest;
}

std::shared_ptr<ViewPictures::Shelf> ViewPictures::shelf_of(std::string_view view, int width_px) {
  const std::pair<std::string, int> key(view, width_px);
  const std::lock_guard lock(mutex_);
  const auto known =
      std::ranges::find(shelves_, key, [](const auto& entry) { return entry.first; });
  std::shared_ptr<Shelf> shelf;
  if (known != shelves_.end()) {
    shelf = known->second;
    shelves_.erase(known);
  } else {
    shelf = std::make_shared<Shelf>(palette_);
  }
  shelves_.emplace_back(key, shelf);
  if (shelves_.size() > kMostShelves) shelves_.pop_front();
  return shelf;
}

cv::Mat ViewPictures::draw(std::string_view view, const KeptFrame& frame, Overlay& overlay) {
  const cv::Mat& bgr = frame.result.frame.bgr;
  if (view == "overlay") {
    cv::Mat picture;
    overlay.draw(frame.result, *frame.field, picture);
    return picture;
  }
  if (view == "normalized") return normalized(bgr).value_or(bgr);
  if (view == "filtered") {
    cv::Mat picture;
    normalized(bgr).value_or(bgr).copyTo(picture, labels(frame) != kBackground);
    return picture;
  }
  if (view == "labels") return colored_labels(labels(frame), palette_);
  return bgr;
}

std::optional<cv::Mat> ViewPictures::normalized(const cv::Mat& bgr) {
  std::optional<cv::Mat> picture;
  exchange_.with_pipeline([&](const Pipeline& pipeline) {
    Normalizer& normalizer = *pipeline.parts().normalizer.stage;
    if (dynamic_cast<const ColorNormalizer*>(&normalizer) == nullptr) return;
    picture = normalized_picture(bgr, normalizer);
  });
  return picture;
}

// From the runs: what the frame path found, and where it looked.
cv::Mat ViewPictures::labels(const KeptFrame& frame) const {
  cv::Mat labels;
  draw_runs(frame.result.runs, frame.result.frame.bgr.size(), labels);
  return labels;
}

}  // namespace maggic::studio
