#pragma once
/// Views of a frame as pictures: drawn and encoded once for all who look.

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/overlay.hpp"
#include "studio/session/newest_frame.hpp"
#include "studio/session/picture.hpp"
#include "studio/session/pipeline_exchange.hpp"

namespace maggic::studio {

/// Safe from any thread.
class ViewPictures {
 public:
  /// Both outlive the pictures.
  ViewPictures(NewestFrame& frames, PipelineExchange& exchange, Palette palette);

  /// overlay, original, normalized, filtered, labels.
  static std::vector<std::string> names();

  /// As the normalizer in use makes it; nothing where that needs the whole picture, which is the
  /// run loop's business.
  std::optional<cv::Mat> normalized(const cv::Mat& bgr);

  /// See Session::next_picture.
  std::shared_ptr<const Picture> next(std::string_view view, int width_px, std::uint64_t after,
                                      std::chrono::milliseconds timeout);

 private:
  /// One view at one width.
  struct Shelf {
    explicit Shelf(const Palette& palette) : overlay(palette, {.scale = 1, .caption = false}) {}

    std::mutex mutex;  ///< Held while it is drawn and encoded: others wait and get the same.
    std::shared_ptr<const Picture> newest;
    Overlay overlay;
  };

  std::shared_ptr<Shelf> shelf_of(std::string_view view, int width_px);
  cv::Mat draw(std::string_view view, const KeptFrame& frame, Overlay& overlay);
  cv::Mat labels(const KeptFrame& frame) const;

  NewestFrame& frames_;
  PipelineExchange& exchange_;
  const Palette palette_;
  std::mutex mutex_;
  /// The latest asked for last; a page that asks for ever new widths fills no memory.
  std::deque<std::pair<std::pair<std::string, int>, std::shared_ptr<Shelf>>> shelves_;
};

}  // namespace maggic::studio
