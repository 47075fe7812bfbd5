#pragma once
/// The frame path for stages that need the picture, and for a colour stage paired with one.

#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/normalizer.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// Runs a normalizer, then a segmenter, of either variant over whole pictures. A colour stage is
/// fed row by row, split into planes. Keeps its working memory.
class ImagePath {
 public:
  /// First step. @param bgr CV_8UC3.
  /// @throws std::runtime_error when the stage made a picture of another size or type.
  void normalize(const cv::Mat& bgr, Normalizer& normalizer);

  /// What the first step made; valid until the next call.
  const cv::Mat& normalized() const { return normalized_; }

  /// Second step, on the same picture.
  /// @return labels below `palette_size`, CV_8UC1 of the same size; valid until the next call.
  /// @throws std::runtime_error when the stage made anything else.
  const cv::Mat& segment(const cv::Mat& bgr, Segmenter& segmenter, std::size_t palette_size);

 private:
  /// One row as three planes.
  struct Planes {
    std::vector<std::uint8_t> b, g, r;
    void resize(std::size_t size);
    void split(const std::uint8_t* bgr_row);
    void join(std::uint8_t* bgr_row) const;
    ColorBatch batch() const { return {b, g, r}; }
    MutableColorBatch mutable_batch() { return {b, g, r}; }
  };

  void normalize_rows(const cv::Mat& bgr, const ColorNormalizer& normalizer);
  void segment_rows(const cv::Mat& bgr, const ColorSegmenter& segmenter);

  Planes original_;
  Planes changed_;
  cv::Mat normalized_;
  cv::Mat labels_;
};

}  // namespace maggic
