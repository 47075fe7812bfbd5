#include <algorithm>
#include <chrono>
#include <vector>

#include <opencv2/core.hpp>

#include "conformance.hpp"

namespace maggic::testing {
namespace {

using std::chrono::steady_clock;

constexpr std::size_t kMostFrames = 20;
constexpr int kMostRetries = 4;  // a device that is not there answers nothing else
/// The contract says about 200 ms; a loaded machine under a sanitizer is slower.
constexpr std::chrono::seconds kLongestRead{5};

struct Recording {
  SourceInfo info;
  std::vector<Frame> frames;  ///< With pictures of their own.
  bool ended = false;
};

void check_labels(const Frame& frame, Findings& findings) {
  const cv::Mat& labels = frame.truth_labels;
  if (labels.empty()) return;
  if (labels.size() != frame.bgr.size() || labels.type() != CV_8UC1) {
    findings.add("the true labels are not CV_8UC1 of the picture's size");
    return;
  }
  double largest = 0.0;
  cv::minMaxLoc(labels, nullptr, &largest);
  if (largest >= static_cast<double>(standard_palette().size())) {
    findings.add("the true labels hold {}, expected less than the palette's {}", largest,
                 standard_palette().size());
  }
}

/// Reads up to kMostFrames. @param reuse_buffer hands the same frame in again, its picture painted
///   over: a source that kept a reference to it would now hand out the paint.
Recording record(Source& source, bool reuse_buffer, Findings& findings) {
  Recording recording;
  recording.info = source.open();
  Frame frame;
  int retries = 0;
  while (recording.frames.size() < kMostFrames && retries < kMostRetries) {
    if (!reuse_buffer) frame = Frame{};
    frame.has_truth = false;
    frame.truth_labels.release();
    const auto begin = steady_clock::now();
    const ReadStatus status = source.read(frame);
    if (steady_clock::now() - begin > kLongestRead) {
      findings.add("a read blocked for seconds, expected kRetry after about 200 ms");
    }
    if (status == ReadStatus::kEnd) {
      recording.ended = true;
      break;
    }
    if (status == ReadStatus::kRetry) {
      ++retries;
      continue;
    }
    if (frame.bgr.empty()) findings.add("a frame without a picture was given as kFrame");
    check_labels(frame, findings);
    recording.frames.push_back(frame);
    recording.frames.back().bgr = frame.bgr.clone();
    recording.frames.back().truth_labels = frame.truth_labels.clone();
    if (reuse_buffer) frame.bgr.setTo(cv::Scalar::all(77));
  }
  if (recording.ended) {
    for (int again = 0; again < 3; ++again) {
      if (source.read(frame) != ReadStatus::kEnd) {
        findings.add("after kEnd a read said something else, expected kEnd again");
      }
    }
  }
  return recording;
}

bool same_picture(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  const std::size_t bytes = a.elemSize() * static_cast<std::size_t>(a.cols);
  for (int row = 0; row < a.rows; ++row) {
    if (!std::equal(a.ptr(row), a.ptr(row) + bytes, b.ptr(row))) return false;
  }
  return true;
}

bool same_truth(const Frame& a, const Frame& b) {
  if (a.has_truth != b.has_truth) return false;
  if (!a.has_truth) return true;
  return std::ranges::equal(
      a.truth.robots, b.truth.robots, [](const RobotDetection& x, const RobotDetection& y) {
        return x.team == y.team && x.id == y.id && x.position_mm == y.position_mm &&
               x.heading_rad == y.heading_rad;
      });
}

void check_info(const Recording& recording, Findings& findings) {
  const SourceInfo& info = recording.info;
  if (!(info.frames_per_second >= 0.0 && info.frames_per_second < 1e6)) {
    findings.add("frames per second are {}, expected 0 (unknown) or a plausible rate",
                 info.frames_per_second);
  }
  if (info.live && info.frame_count) findings.add("a live source states a number of frames");
  for (std::size_t i = 1; i < recording.frames.size(); ++i) {
    if (recording.frames[i].captured < recording.frames[i - 1].captured) {
      findings.add("the capture time went backwards");
    }
  }
}

void check_repeats(const Recording& first, const Recording& second, Findings& findings) {
  if (first.frames.size() != second.frames.size() || first.ended != second.ended) {
    findings.add("opened again it gave {} frames rather than {}", second.frames.size(),
                 first.frames.size());
    return;
  }
  for (std::size_t i = 0; i < first.frames.size(); ++i) {
    const Frame& a = first.frames[i];
    const Frame& b = second.frames[i];
    if (!same_picture(a.bgr, b.bgr)) {
      findings.add("opened again it gave other pictures, or it keeps the host's buffer");
    }
    if (a.captured != b.captured) findings.add("opened again it gave other capture times");
    if (!same_picture(a.truth_labels, b.truth_labels)) {
      findings.add("opened again it gave other true labels");
    }
    if (!same_truth(a, b)) findings.add("opened again it gave another ground truth");
  }
}

}  // namespace

void check_source(const Maker<Source>& make, Findings& findings) {
  make();  // and destroyed without being opened, as `maggic check` does
  runs(findings, "reading", [&] {
    const StagePtr<Source> first = make();
    const Recording recording = record(*first, false, findings);
    check_info(recording, findings);
    if (recording.info.live) return;
    const StagePtr<Source> second = make();
    check_repeats(recording, record(*second, true, findings), findings);
  });
}

}  // namespace maggic::testing
