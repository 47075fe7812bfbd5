#pragma once
/// Looking where things are expected, and at the rest of the field in turns.

#include <optional>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/blob.hpp"
#include "maggic/detections.hpp"
#include "maggic/field.hpp"
#include "maggic/frame.hpp"
#include "maggic/scan_area.hpp"

namespace maggic {

/// Whether a blob found in `area` may go on in pixels of the field's area that were not looked at:
/// the rule by which a predicted search takes blobs out. It judges by the blob's bounding box.
bool may_go_on_unseen(const Blob& blob, const ScanArea& area, const ScanArea& field_area);

/// Plans the area of each frame from what was detected in the last one. Never sure of itself: the
/// whole field is searched as long as anything known is out of sight, and at once in a frame in
/// which something is not where it was expected, whole. So a search differs from a full one only in
/// that something new may wait for its turn, at most `unseen_frames` frames.
///
/// A frame goes through `plan`, then, if that gave an area, `accept`, and last `remember`.
class PredictedSearch {
 public:
  /// Any two blobs of one robot lie within it: corner to corner, with a tag that reaches over.
  static constexpr double kRobotBreadthMm = 130.0;

  /// @param unseen_frames how many turns the rest of the field takes, at least 1.
  explicit PredictedSearch(int unseen_frames) : turns_(unseen_frames) {}

  /// Where to look in a frame; null: all over `field_area`. Valid until the next call.
  /// @param field_area at most one span a row; the same until `forget`.
  const ScanArea* plan(Timestamp captured, const Field& field, const ScanArea& field_area);

  /// Takes out blobs that may go on outside the planned area.
  /// @return whether everything expected is among those left; if not, search all over.
  bool accept(std::vector<Blob>& blobs) const;

  /// Learns what was detected in the frame.
  void remember(const Detections& detections);

  /// Starts over, as for the first frame.
  void forget();

 private:
  /// A blob that has to be seen again.
  struct Expected {
    Label label = kBackground;
    cv::Point2d centroid_px;
    double reach_px = 0.0;
    double area_px = 0.0;
  };

  /// Of an object: how far its blobs reach from its centre, and how far off it may be at rest.
  struct Extent {
    double radius_mm = 0.0;
    double slack_mm = 0.0;
  };
  /// Of an object from the last frame to this one.
  struct Motion {
    cv::Point2d moved_px;
    double slack_mm = 0.0;
    double height_mm = 0.0;
  };

  void expect_robot(const RobotDetection& robot, const Field& field, double dt_s);
  void expect_ball(const BallDetection& ball, const Field& field, double dt_s);
  /// Adds where the object can be to the regions.
  Motion predict(cv::Point2d position_mm, cv::Point2d velocity_mm_s, double height_mm,
                 const Extent& extent, const Field& field, double dt_s);
  void expect_blob(Label label, cv::Point2d centroid_px, double area_px, const Motion& motion,
                   const Field& field);
  void add_region(const Field& field, cv::Point2d position_mm, double height_mm, double radius_mm);
  void join_regions_and_turn(const ScanArea& field_area, double overlap_px);

  int turns_;
  int turn_ = 0;
  int full_frames_left_ = 0;  ///< Until everything had its chance of being seen.
  bool started_ = false;
  bool all_seen_ = false;
  std::optional<Timestamp> last_;
  Detections seen_;
  const ScanArea* field_area_ = nullptr;
  ScanArea area_;
  std::vector<cv::Rect> regions_;  ///< By left edge.
  std::vector<Expected> expected_;
};

}  // namespace maggic
