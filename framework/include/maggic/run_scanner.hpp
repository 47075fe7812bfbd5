#pragma once
/// From pixels to runs in one pass: the part of the frame path that touches every pixel.

#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "maggic/blob.hpp"
#include "maggic/channel_gains.hpp"
#include "maggic/color_table.hpp"
#include "maggic/scan_area.hpp"

namespace maggic {

/// Finds runs of equal label in pictures, with the machine's widest vector instructions; no picture
/// of labels is made. The runs are the same on every machine and for every number of threads.
/// One caller at a time; allocates nothing once it has seen the busiest frame.
class RunScanner {
 public:
  /// @param threads how many share the rows of a frame, the caller among them; at least 1.
  explicit RunScanner(unsigned threads = 1);
  ~RunScanner();

  /// Looks pixels up in `table` from now on.
  /// @param table outlives the scanner or the next call.
  void set_table(const ColorTable& table);

  /// Replaces `runs` by the maximal runs of equal non-background label in each span of `area`, by
  /// rows and then by columns, both ascending. A run ends where its span does.
  /// @param bgr CV_8UC3, at most 65535 a side, rows may be padded; nothing outside `area` is read.
  /// @param area within the picture.
  /// @param gains what colours are multiplied by before they are looked up; null: nothing.
  void scan(const cv::Mat& bgr, const ScanArea& area, const ChannelGains* gains,
            std::vector<Run>& runs);

  /// The same of a picture of labels, from segmenters that need the picture. Needs no table.
  /// @param labels CV_8UC1, at most 65535 a side.
  void scan_labels(const cv::Mat& labels, const ScanArea& area, std::vector<Run>& runs);

 private:
  class Bands;

  std::unique_ptr<Bands> bands_;
};

/// Writes the label image that `runs` describe, for sinks and views that want to see it.
/// @param labels set to CV_8UC1 of `size`.
void draw_runs(const std::vector<Run>& runs, cv::Size size, cv::Mat& labels);

}  // namespace maggic
