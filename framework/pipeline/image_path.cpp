#include "pipeline/image_path.hpp"

namespace maggic {

void ImagePath::Planes::resize(std::size_t size) {
  b.resize(size);
  g.resize(size);
  r.resize(size);
}

void ImagePath::Planes::split(const std::uint8_t* bgr_row) {
  for (std::size_t i = 0; i < b.size(); ++i) {
    b[i] = bgr_row[3 * i];
    g[i] = bgr_row[3 * i + 1];
    r[i] = bgr_row[3 * i + 2];
  }
}

void ImagePath::Planes::join(std::uint8_t* bgr_row) const {
  for (std::size_t i = 0; i < b.size(); ++i) {
    bgr_row[3 * i] = b[i];
    bgr_row[3 * i + 1] = g[i];
    bgr_row[3 * i + 2] = r[i];
  }
}

void ImagePath::normalize(const cv::Mat& bgr, Normalizer& normalizer) {
  normalized_.create(bgr.size(), CV_8UC3);
  if (const auto* by_color = dynamic_cast<const ColorNormalizer*>(&normalizer)) {
    normalize_rows(bgr, *by_color);
  } else {
    dynamic_cast<ImageNormalizer&>(normalizer).normalize(bgr, normalized_);
  }
}

const cv::Mat& ImagePath::segment(const cv::Mat& bgr, Segmenter& segmenter) {
  labels_.create(bgr.size(), CV_8UC1);
  if (const auto* by_color = dynamic_cast<const ColorSegmenter*>(&segmenter)) {
    segment_rows(bgr, *by_color);
  } else {
    dynamic_cast<ImageSegmenter&>(segmenter).segment(bgr, normalized_, labels_);
  }
  return labels_;
}

void ImagePath::normalize_rows(const cv::Mat& bgr, const ColorNormalizer& normalizer) {
  original_.resize(static_cast<std::size_t>(bgr.cols));
  changed_.resize(static_cast<std::size_t>(bgr.cols));
  for (int row = 0; row < bgr.rows; ++row) {
    original_.split(bgr.ptr(row));
    normalizer.normalize(original_.batch(), changed_.mutable_batch());
    changed_.join(normalized_.ptr(row));
  }
}

void ImagePath::segment_rows(const cv::Mat& bgr, const ColorSegmenter& segmenter) {
  original_.resize(static_cast<std::size_t>(bgr.cols));
  changed_.resize(static_cast<std::size_t>(bgr.cols));
  for (int row = 0; row < bgr.rows; ++row) {
    original_.split(bgr.ptr(row));
    changed_.split(normalized_.ptr(row));
    segmenter.segment(original_.batch(), changed_.batch(),
                      {labels_.ptr(row), static_cast<std::size_t>(bgr.cols)});
  }
}

}  // namespace maggic
