#pragma once
/// Segmenters: give every pixel the label of a palette colour, or background.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/color_batch.hpp"
#include "maggic/color_box.hpp"
#include "maggic/color_samples.hpp"
#include "maggic/palette.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// Either a ColorSegmenter or an ImageSegmenter; derive from one of those.
class Segmenter : public Stage {};

/// A segmenter whose answer depends on the pixel's colour alone, before and after normalisation.
/// Compiled into the ColorTable; costs nothing per frame.
class ColorSegmenter : public Segmenter {
 public:
  /// Writes the label of colour i, given as `original[i]` and `normalized[i]`, to `labels[i]`.
  /// Contract: all three have one size, any size including 0; every label written is below the
  /// palette's size; batch equals single; thread-safe; never throws.
  virtual void segment(const ColorBatch& original, const ColorBatch& normalized,
                       std::span<Label> labels) const = 0;

  /// The one label that `segment` gives whenever the original colour lies in `original` and the
  /// normalised one in `normalized`, whichever colours of the two boxes meet. Spares the host a
  /// `segment` of them all. Nothing: the labels differ, or the segmenter cannot tell.
  /// Contract: a label answered is the one `segment` gives to all of them; thread-safe; never
  /// throws. The default, nothing, is always right and never helps.
  virtual std::optional<Label> label_of(const ColorBox& /*original*/,
                                        const ColorBox& /*normalized*/) const {
    return {};
  }

  /// Why one colour gets its label, in words a person at the field can act on, naming the rule and
  /// its numbers: "gray: channels spread over 12 steps, gray_threshold is 60". One sentence a line.
  /// Empty: the segmenter does not say.
  /// @param original,normalized one colour each.
  virtual std::string explain(const ColorBatch& /*original*/,
                              const ColorBatch& /*normalized*/) const {
    return {};
  }

  /// Every colour whose region holds this one, the one `segment` gives it first. More than one means
  /// that an order decides, which is worth a warning where such colours are seen. Empty: regions
  /// cannot overlap, or the segmenter does not say.
  /// @param original,normalized one colour each.
  virtual std::vector<Label> claimants(const ColorBatch& /*original*/,
                                       const ColorBatch& /*normalized*/) const {
    return {};
  }

  /// Finds parameters that give the samples their labels, as `maggic calibrate` asks for. Empty:
  /// the segmenter cannot calibrate itself.
  /// @return the YAML of the plugin's parameters, a comment on every number.
  virtual std::string fit(const ColorSamples& /*samples*/) const { return {}; }
};

/// A segmenter that needs the picture (neighbourhoods, learned models). Runs on every frame.
class ImageSegmenter : public Segmenter {
 public:
  /// @param original CV_8UC3, at least 1×1, perhaps with padded rows; not to be written.
  /// @param normalized same size and type as `original`.
  /// @param labels CV_8UC1 of the same size, allocated by the host; every pixel is written.
  virtual void segment(const cv::Mat& original, const cv::Mat& normalized, cv::Mat& labels) = 0;
};

}  // namespace maggic
