#include "calibration/sample_store.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "maggic/color_temperature.hpp"

namespace maggic::calibration {
namespace {

constexpr std::size_t kPixelsPerTag = 80;
constexpr std::size_t kFewestInnerPixels = 20;
constexpr std::size_t kBackgroundPixels = 24'000;
constexpr double kStrayHeart = 0.7;  // of its radius
// Warmer and colder, relative to the light there is, as steps of colour temperature from 6500 K.
// The light is followed as a whole; this is for what lamps and windows do to parts of the field.
// Dimmed, so that nothing saturates that did not.
constexpr std::array<double, 4> kOtherLight{4800.0, 5600.0, 7700.0, 9500.0};
constexpr double kDimmed = 0.6;
constexpr int kRimPx = 4;  // around tags, where colours mix: neither tag nor background

/// Pixels away from the rim, which mixes with what is beside it, as far as that leaves enough.
std::vector<cv::Point> inner_pixels(const std::vector<cv::Point>& pixels) {
  const cv::Rect box = cv::boundingRect(pixels);
  cv::Mat mask = cv::Mat::zeros(box.size() + cv::Size(2, 2), CV_8UC1);
  const cv::Point origin = box.tl() - cv::Point(1, 1);
  for (const cv::Point& p : pixels) mask.at<std::uint8_t>(p - origin) = 255;
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L1, 3);
  for (const float rim_px : {2.0f, 1.0f}) {
    std::vector<cv::Point> inner;
    for (const cv::Point& p : pixels) {
      if (distance.at<float>(p - origin) > rim_px) inner.push_back(p);
    }
    if (inner.size() >= kFewestInnerPixels) return inner;
  }
  return pixels;
}

}  // namespace

void SampleStore::Planes::add(cv::Vec3b bgr) {
  b.push_back(bgr[0]);
  g.push_back(bgr[1]);
  r.push_back(bgr[2]);
}

void SampleStore::Planes::resize(std::size_t size) {
  b.resize(size);
  g.resize(size);
  r.resize(size);
}

SampleStore::SampleStore(std::span<const ChromaFrame> frames, std::span<const FramePatches> found,
                         const Naming& named, const BallSightings& ball, Label ball_color) {
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::vector<const Patch*> tags;
    for (std::size_t p = 0; p < found[f].patches.size(); ++p) {
      const Label label = named.frames[f].label_of_patch[p];
      if (label == kBackground) continue;
      tags.push_back(&found[f].patches[p]);
      add_tag(frames[f], *tags.back(), label);
    }
    if (const std::optional<Patch>& seen = ball.by_frame[f]) {
      tags.push_back(&*seen);
      add_tag(frames[f], *seen, ball_color);
    }
    add_background(frames[f], tags, kBackgroundPixels / frames.size());
  }
}

void SampleStore::add_strays(std::span<const ChromaFrame> frames,
                             std::span<const std::vector<Stray>> strays) {
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const cv::Rect picture({}, frames[f].bgr.size());
    for (const Stray& stray : strays[f]) {
      // The heart of it, whatever its shape.
      const double radius_px = kStrayHeart * std::sqrt(stray.area_px / std::numbers::pi);
      const int reach = std::max(1, static_cast<int>(radius_px));
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const cv::Point pixel(cvRound(stray.centroid_px.x) + x, cvRound(stray.centroid_px.y) + y);
          if (std::hypot(x, y) > radius_px || !picture.contains(pixel)) continue;
          add(frames[f], pixel, kBackground, kStrayTag);
        }
      }
    }
  }
}

void SampleStore::add(const ChromaFrame& frame, cv::Point pixel, Label label, std::int32_t tag) {
  original_.add(frame.bgr.at<cv::Vec3b>(pixel));
  normalized_.add(frame.normalized.at<cv::Vec3b>(pixel));
  labels_.push_back(label);
  tags_.push_back(tag);
}

void SampleStore::add_tag(const ChromaFrame& frame, const Patch& patch, Label label) {
  const std::vector<cv::Point> pixels = inner_pixels(patch.pixels);
  const std::size_t step = std::max<std::size_t>(1, pixels.size() / kPixelsPerTag);
  for (std::size_t i = 0; i < pixels.size(); i += step) add(frame, pixels[i], label, next_tag_);
  ++next_tag_;
}

void SampleStore::add_background(const ChromaFrame& frame,
                                 const std::vector<const Patch*>& apart_from, std::size_t wanted) {
  cv::Mat tags = cv::Mat::zeros(frame.bgr.size(), CV_8UC1);
  for (const Patch* patch : apart_from) {
    for (const cv::Point& pixel : patch->pixels) tags.at<std::uint8_t>(pixel) = 255;
  }
  cv::dilate(tags, tags,
             cv::getStructuringElement(cv::MORPH_RECT, {2 * kRimPx + 1, 2 * kRimPx + 1}));
  const std::size_t total = tags.total();
  // The golden ratio spreads the picks evenly whatever the picture's width.
  const std::size_t count = std::min(wanted, total);
  constexpr double kGolden = 0.6180339887498949;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = std::fmod(static_cast<double>(i) * kGolden, 1.0);
    const auto index = static_cast<int>(share * static_cast<double>(total));
    const cv::Point pixel(index % tags.cols, index / tags.cols);
    if (tags.at<std::uint8_t>(pixel) == 0) add(frame, pixel, kBackground, -1);
  }
}

void SampleStore::imagine_other_light(const ColorNormalizer& normalizer) {
  for (const double kelvin : kOtherLight) {
    const std::array<double, 3> gains = lamp_gains(kelvin);  // red, green, blue
    const auto lit = [](std::uint8_t value, double gain) {
      return static_cast<std::uint8_t>(std::min(255.0, kDimmed * gain * value + 0.5));
    };
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (labels_[i] == kBackground) continue;
      imagined_original_.add({lit(original_.b[i], gains[2]), lit(original_.g[i], gains[1]),
                              lit(original_.r[i], gains[0])});
      imagined_labels_.push_back(labels_[i]);
    }
  }
  imagined_normalized_.resize(imagined_labels_.size());
  normalizer.normalize(imagined_original_.batch(), imagined_normalized_.mutable_batch());
}

ColorSamples SampleStore::samples(const Palette& palette,
                                  const GrayThreshold& gray_threshold) const {
  return {original_.batch(),
          normalized_.batch(),
          labels_,
          tags_,
          {imagined_original_.batch(), imagined_normalized_.batch(), imagined_labels_},
          palette,
          gray_threshold};
}

}  // namespace maggic::calibration
