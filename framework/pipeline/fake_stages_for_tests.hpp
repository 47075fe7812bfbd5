#pragma once
/// Stages made in the test program itself, to drive the frame path and the run loop.

#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "maggic/pipeline_builder.hpp"
#include "maggic/testing.hpp"

namespace maggic::fakes {

/// Gives `count` frames of `picture(i)`, 10 ms apart unless told otherwise.
struct CountingSource : Source {
  std::uint64_t count = 0;
  bool live = false;
  std::function<cv::Mat(std::uint64_t)> picture = [](std::uint64_t) {
    return cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(0));
  };
  std::function<Timestamp(std::uint64_t)> captured = [](std::uint64_t i) {
    return std::chrono::milliseconds(10 * i);
  };
  std::function<void(std::uint64_t)> before_read = [](std::uint64_t) {};
  std::uint64_t labelled = 0;  ///< So many frames, from the first one on, come with true labels.
  std::uint64_t given = 0;

  SourceInfo open() override { return {live, count, 100.0}; }
  ReadStatus read(Frame& frame) override {
    if (given == count) return ReadStatus::kEnd;
    before_read(given);
    frame.bgr = picture(given);
    frame.captured = captured(given);
    if (given < labelled) frame.truth_labels = cv::Mat(frame.bgr.size(), CV_8UC1, cv::Scalar(0));
    ++given;
    return ReadStatus::kFrame;
  }
};

/// Every colour stays what it is.
struct SameNormalizer : ColorNormalizer {
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    for (std::size_t i = 0; i < in.size(); ++i) {
      out.b[i] = in.b[i];
      out.g[i] = in.g[i];
      out.r[i] = in.r[i];
    }
  }
};

/// Label 1 where red is above 127.
struct RedSegmenter : ColorSegmenter {
  void segment(const ColorBatch&, const ColorBatch& normalized,
               std::span<Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = normalized.r[i] > 127 ? 1 : 0;
  }
};

/// The same answers from the picture rather than from the colour.
struct SameImageNormalizer : ImageNormalizer {
  void normalize(const cv::Mat& bgr, cv::Mat& normalized) override { bgr.copyTo(normalized); }
};
struct RedImageSegmenter : ImageSegmenter {
  std::function<void(const cv::Mat&)> at_picture = [](const cv::Mat&) {};
  void segment(const cv::Mat& bgr, const cv::Mat& normalized, cv::Mat& labels) override {
    at_picture(bgr);
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        labels.at<Label>(y, x) = normalized.at<cv::Vec3b>(y, x)[2] > 127 ? 1 : 0;
      }
    }
  }
};

/// Finds nothing; does `at_frame` first.
struct HookTracker : Tracker {
  std::function<void(std::uint64_t)> at_frame = [](std::uint64_t) {};
  void track(const TrackerInput& input, Detections&) override { at_frame(input.sequence); }
};

/// Keeps the sequence numbers it was given.
struct RecordingSink : Sink {
  std::vector<std::uint64_t> sequences;
  std::function<void()> at_open = [] {};
  std::function<void(std::uint64_t)> at_write = [](std::uint64_t) {};
  std::function<void(const cv::Mat&)> at_picture = [](const cv::Mat&) {};
  bool closed = false;

  void open(const RunInfo&) override { at_open(); }
  void write(const FrameResult& result, const Field&) override {
    at_write(result.frame.sequence);
    at_picture(result.frame.bgr);
    sequences.push_back(result.frame.sequence);
  }
  void close() override { closed = true; }
};

template <class Kind>
NamedStage<Kind> named(std::string name, std::unique_ptr<Kind> stage) {
  return {std::move(name), StagePtr<Kind>(stage.release())};
}

/// A pipeline of the fakes above, with handles to reach into them.
struct Rig {
  testing::RecordingReporter reporter;
  CountingSource* source = nullptr;
  RedImageSegmenter* segmenter = nullptr;  ///< Null unless the stages need the picture.
  HookTracker* tracker = nullptr;
  std::vector<RecordingSink*> sinks;
  BuiltPipeline built;

  explicit Rig(std::uint64_t frames, std::size_t sink_count = 1, bool image_stages = false,
               const FieldParameters& field = {}, const LightParameters& light = {},
               const BlobParameters& blobs = {.min_area_mm2 = 0.0, .max_area_mm2 = 1e9},
               const ScanParameters& scan = {}) {
    auto new_source = std::make_unique<CountingSource>();
    source = new_source.get();
    source->count = frames;
    auto new_tracker = std::make_unique<HookTracker>();
    tracker = new_tracker.get();
    PipelineParts parts;
    parts.palette = Palette::standard();
    parts.field = field;
    parts.light = light;
    if (image_stages) {
      parts.normalizer = named<Normalizer>("same", std::make_unique<SameImageNormalizer>());
      auto new_segmenter = std::make_unique<RedImageSegmenter>();
      segmenter = new_segmenter.get();
      parts.segmenter = named<Segmenter>("red", std::move(new_segmenter));
    } else {
      parts.normalizer = named<Normalizer>("same", std::make_unique<SameNormalizer>());
      parts.segmenter = named<Segmenter>("red", std::make_unique<RedSegmenter>());
    }
    parts.tracker = named<Tracker>("hook", std::move(new_tracker));
    parts.blobs = blobs;
    parts.scan = scan;
    built.pipeline = std::make_unique<Pipeline>(std::move(parts), reporter);
    built.source = named<Source>("counting", std::move(new_source));
    for (std::size_t i = 0; i < sink_count; ++i) {
      auto sink = std::make_unique<RecordingSink>();
      sinks.push_back(sink.get());
      built.sinks.push_back(named<Sink>("recording", std::move(sink)));
    }
  }
};

}  // namespace maggic::fakes
