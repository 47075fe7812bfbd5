#pragma once
/// What is really in a frame: what detections are compared with.

#include <optional>
#include <string>
#include <vector>

#include <boost/container/static_vector.hpp>
#include <opencv2/core/types.hpp>

#include "maggic/detections.hpp"
#include "maggic/palette.hpp"

namespace maggic {

/// Who a robot is. By id where one is known, else by the colours it wears.
struct TrueIdentity {
  Team team = Team::kBlue;
  std::optional<int> id;
  /// In the tag layout's order, team patch left out; empty: not known.
  boost::container::static_vector<Label, kMaxPatches> player_colors;

  friend bool operator==(const TrueIdentity&, const TrueIdentity&) = default;
};

/// "blue 0"; without an id "blue cyan" or "blue red+green"; with neither "blue".
std::string name_of(const TrueIdentity& identity, const Palette& palette);

/// One tag patch where it really is.
struct TrueTag {
  Label label = kBackground;
  cv::Point2d centroid_px;
};

/// A robot's place is known in pixels, in millimetres, or both.
struct TrueRobot {
  TrueIdentity identity;
  std::optional<cv::Point2d> centroid_px;
  std::optional<cv::Point2d> position_mm;
  std::optional<double> heading_rad;  ///< Of its front, in the field frame.
  /// The same as an angle in the picture: counter-clockwise from the right, y up. Used where
  /// `heading_rad` is not known.
  std::optional<double> picture_heading_rad;
  std::vector<TrueTag> tags;  ///< Empty when not known.
};

struct TrueBall {
  std::optional<cv::Point2d> centroid_px;
  std::optional<cv::Point2d> position_mm;
};

/// Everything in one frame; what is not listed is not there.
struct TrueScene {
  std::optional<TrueBall> ball;
  std::vector<TrueRobot> robots;
};

/// A source's own truth, or another pipeline's detections taken as the truth: what is only
/// predicted there is left out.
TrueScene scene_of(const Detections& detections);

/// How far from the truth is near enough.
struct Tolerance {
  enum class Unit { kMillimeters, kPixels };
  double distance = 10.0;
  Unit unit = Unit::kMillimeters;
};

}  // namespace maggic
