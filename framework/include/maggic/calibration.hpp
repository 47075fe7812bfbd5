#pragma once
/// Calibration without hands: from a few frames to the numbers of a venue.
///
/// Nothing is asked of the user. The tag pattern is the teacher: numbers are good when complete
/// robots with distinct identities and one ball come out of the frames, so patches that fit the
/// pattern tell which hue is which colour, how large a pixel is on the field, and how gray is gray.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/document.hpp"
#include "maggic/plugin_registry.hpp"

namespace maggic {

struct CalibrationRequest {
  /// The pipeline as it is without a calibration; its source and sinks are not used. What is found
  /// has to stand on its own, so it is tried on this.
  Node document;
  /// The same with the calibration there was so far laid over it: what has to be matched. Left out:
  /// `document`.
  std::optional<Node> with_known;
  /// The field section of that is of this camera, so it stands where the lines tell nothing better.
  /// Otherwise its corners are another camera's.
  bool field_is_known = false;
  /// Top-left, top-right, bottom-right, bottom-left; left out: found.
  std::optional<std::array<cv::Point2d, 4>> corners_px;
  std::optional<int> gray_threshold;  ///< 0 … 255; left out: found.
};

/// What a pipeline makes of frames, judged without knowing the truth.
struct PatternScore {
  std::size_t frames = 0;
  double robots = 0.0;    ///< Complete robots with a listed identity, a frame.
  double doubtful = 0.0;  ///< Incomplete or unknown ones, a frame.
  double balls = 0.0;     ///< Frames with a ball, share.

  /// One number to compare by; more is better.
  /// A doubtful robot may be a real one with a tag nobody could read, so it costs less than one
  /// counts.
  double value() const { return robots - 0.25 * doubtful + 0.5 * balls; }
};

struct CalibrationResult {
  std::string yaml;                    ///< The calibration file; empty when nothing was found.
  std::vector<std::string> findings;   ///< What was settled, a sentence each.
  std::vector<std::string> unsettled;  ///< What could not be, and what helps.
  PatternScore before;                 ///< Of the pipeline as it was given.
  PatternScore after;                  ///< … and with `yaml` laid over it.
};

/// @param frames at least one, CV_8UC3, of one size; more and different ones make it surer.
/// @throws ConfigError when the pipeline cannot be built; std::invalid_argument when its tracker or
///   segmenter cannot be calibrated, or `frames` is empty or of several sizes.
CalibrationResult calibrate(const CalibrationRequest& request, std::span<const cv::Mat> frames,
                            PluginRegistry& registry);

}  // namespace maggic
