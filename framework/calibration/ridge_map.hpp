#pragma once
/// Bright thin structures of a picture: field lines and the tops of walls.

#include <vector>

#include <opencv2/core/mat.hpp>

namespace maggic::calibration {

enum class Direction { kUpright, kLevel };

/// How much brighter a pixel is than what lies to both sides of it, 8-bit steps, for lines of up to
/// a given width.
struct RidgeMap {
  cv::Mat upright;  ///< CV_8UC1: against left and right.
  cv::Mat level;    ///< CV_8UC1: against above and below.

  const cv::Mat& of(Direction direction) const {
    return direction == Direction::kUpright ? upright : level;
  }
};

/// @param gray CV_8UC1. @param max_width_px widest line that counts, at least 1.
RidgeMap make_ridge_map(const cv::Mat& gray, int max_width_px);

/// A straight line across the whole picture: for an upright one x = position + slope · (y −
/// middle), for a level one y = position + slope · (x − middle), where middle is the picture's.
struct SeenLine {
  double position_px = 0.0;
  double slope = 0.0;
  double length_px = 0.0;  ///< Of what was seen of it.
};

/// Longest first, at most 14; lines within ±20° of the direction.
/// @param min_length_px of one unbroken piece.
std::vector<SeenLine> find_lines(const RidgeMap& ridges, Direction direction, int min_contrast,
                                 double min_length_px);

}  // namespace maggic::calibration
