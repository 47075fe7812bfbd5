#pragma once
/// How many pixels get their true label, against the gray threshold (MaggicVision monograph,
/// figures 46, 47 and 51).

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/color_batch.hpp"
#include "maggic/normalizer.hpp"
#include "maggic/palette.hpp"
#include "maggic/segmenter.hpp"

namespace maggic {

/// The pixels of labelled pictures, each colour with each of its labels once and counted: what a
/// method makes of a pixel depends on its colour alone, so this is all there is to know of them.
class LabelledColors {
 public:
  explicit LabelledColors(const Palette& palette) : pixels_(palette.size(), 0) {}

  /// @param bgr CV_8UC3. @param labels CV_8UC1, labels of the palette.
  /// @throws std::invalid_argument when the sizes differ, a type is another one, or a label is not
  ///   the palette's; nothing was added then.
  void add(const cv::Mat& bgr, const cv::Mat& labels);

  /// Distinct pairs of colour and label.
  std::size_t size() const { return entries_.size(); }
  /// Pixels added with that label. @param label below the palette's size.
  std::uint64_t pixels(Label label) const { return pixels_.at(label); }
  std::size_t palette_size() const { return pixels_.size(); }

  /// One pair with its count; ascending by `key`.
  struct Entry {
    std::uint32_t key = 0;  ///< Red, green, blue, label from the highest byte down.
    std::uint64_t count = 0;
  };
  std::span<const Entry> entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::uint64_t> pixels_;
};

/// What one normalizer gives at each of the 256 thresholds.
class LabelSweep {
 public:
  static constexpr std::size_t kThresholds = 256;

  /// @param pixels of each label in the pictures, by label.
  explicit LabelSweep(std::vector<std::uint64_t> pixels);

  /// Share, 0 … 1, of the label's pixels that got it; NaN when the pictures have none of it. For
  /// background: what was kept out of the blobs.
  double share(Label label, std::size_t threshold) const;
  /// The smallest of all labels' shares, of those the pictures have, and whose it is.
  std::pair<double, Label> smallest_share(std::size_t threshold) const;
  /// The threshold at which the smallest share is largest; the lowest of several.
  std::size_t best_threshold() const;

  /// Thresholds from first to last, both included.
  struct Range {
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t width() const { return last - first + 1; }
  };
  /// The widest range without a gap in which every label has at least `share` (0 … 1); the lowest
  /// of several. Nothing when no threshold will do.
  std::optional<Range> usable(double share) const;

  std::size_t labels() const { return pixels_.size(); }
  std::uint64_t pixels(Label label) const { return pixels_.at(label); }
  void count_right(Label label, std::size_t threshold, std::uint64_t pixels) {
    right_.at(label).at(threshold) += pixels;
  }

 private:
  std::vector<std::uint64_t> pixels_;
  std::vector<std::array<std::uint64_t, kThresholds>> right_;  ///< By label.
};

/// Asks the stages for every colour at every threshold, with no assumption about how answers depend
/// on it: exact for any segmenter.
/// @param segmenter_with a segmenter, configured and prepared, with that gray threshold (0 … 255);
///   called once for each.
/// @return a sweep each normalizer, in their order.
/// @throws what `segmenter_with` throws.
std::vector<LabelSweep> sweep_gray_threshold(
    const LabelledColors& colors, std::span<const ColorNormalizer* const> normalizers,
    const std::function<const ColorSegmenter&(int threshold)>& segmenter_with);

}  // namespace maggic
