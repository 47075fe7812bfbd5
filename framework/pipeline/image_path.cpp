#include "pipeline/image_path.hpp"

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/core.hpp>

namespace maggic {
namespace {

void expect_like(const cv::Mat& made, const cv::Mat& bgr, int type, std::string_view what) {
  if (made.dims > 2) {
    throw std::runtime_error(
        fmt::format("it made {} of {} dimensions, expected 2", what, made.dims));
  }
  if (made.size() != bgr.size()) {
    throw std::runtime_error(fmt::format("it made {} of {}x{} for a picture of {}x{}", what,
                                         made.cols, made.rows, bgr.cols, bgr.rows));
  }
  if (made.type() != type) {
    throw std::runtime_error(fmt::format("it made {} of type {}, expected {}", what,
                                         cv::typeToString(made.type()), cv::typeToString(type)));
  }
}

void expect_below(const cv::Mat& labels, std::size_t palette_size) {
  double highest = 0.0;
  cv::minMaxLoc(labels, nullptr, &highest);
  if (highest < static_cast<double>(palette_size)) return;
  throw std::runtime_error(
      fmt::format("it gave the label {}, expected a label below the "
                  "palette's size {}",
                  highest, palette_size));
}

}  // namespace

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
    expect_like(normalized_, bgr, CV_8UC3, "a normalized picture");
  }
}

const cv::Mat& ImagePath::segment(const cv::Mat& bgr, Segmenter& segmenter,
                                  std::size_t palette_size) {
  labels_.create(bgr.size(), CV_8UC1);
  if (const auto* by_color = dynamic_cast<const ColorSegmenter*>(&segmenter)) {
    segment_rows(bgr, *by_color);
  } else {
    dynamic_cast<ImageSegmenter&>(segmenter).segment(bgr, normalized_, labels_);
    expect_like(labels_, bgr, CV_8UC1, "a label image");
  }
  expect_below(labels_, palette_size);
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
