#pragma once
/// Normalizers: take the light out of a colour before it is segmented.

#include <opencv2/core/mat.hpp>

#include "maggic/color_batch.hpp"
#include "maggic/color_box.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// Either a ColorNormalizer or an ImageNormalizer; derive from one of those.
class Normalizer : public Stage {};

/// A normalizer whose answer depends on the pixel's colour alone. It is compiled, together with
/// the segmenter, into the ColorTable before the first frame and costs nothing per frame.
class ColorNormalizer : public Normalizer {
 public:
  /// Writes the normalised colour of `in[i]` to `out[i]`.
  /// Contract: `in.size() == out.size()`, any size including 0; the answer for a colour does not
  /// depend on its neighbours, on the batch size or on earlier calls (batch equals single);
  /// thread-safe, as `const` says: the host compiles on several threads at once; never throws.
  virtual void normalize(const ColorBatch& in, const MutableColorBatch& out) const = 0;

  /// A box that holds the normalised colour of every colour of `in`. The narrower, the fewer
  /// colours the host has to run one by one through `normalize` and the segmenter. Where a channel
  /// grows or falls with each channel of `in`, the corners of `in` give the narrowest box.
  /// Contract: no normalised colour lies outside; thread-safe; never throws. The default, the whole
  /// cube, is always right and never helps.
  virtual ColorBox bounds(const ColorBox& /*in*/) const { return {}; }
};

/// A normalizer that needs the picture (for instance to estimate the light over the field). Runs
/// on every frame.
class ImageNormalizer : public Normalizer {
 public:
  /// @param bgr CV_8UC3, at least 1×1, perhaps with padded rows; not to be written.
  /// @param normalized CV_8UC3 of the same size, allocated by the host; every pixel is written.
  virtual void normalize(const cv::Mat& bgr, cv::Mat& normalized) = 0;
};

}  // namespace maggic
