/// Broken on purpose: doubled ids, no order, nothing but NaN, and blobs used twice.

#include <limits>

#include "maggic/plugin.hpp"

namespace {

class CarelessTracker final : public maggic::Tracker {
 public:
  void track(const maggic::TrackerInput& input, maggic::Detections& out) override {
    out.clear();
    for (const maggic::Blob& blob : input.blobs) {
      maggic::RobotDetection robot;
      robot.team = out.robots.size() % 2 == 0 ? maggic::Team::kYellow : maggic::Team::kBlue;
      robot.id = 1;
      robot.position_mm.x = std::numeric_limits<double>::quiet_NaN();
      robot.tags = {{blob.label, blob.centroid_px, 1.0}, {blob.label, blob.centroid_px, 1.0}};
      out.robots.push_back(robot);
    }
  }
};

}  // namespace

MAGGIC_PLUGIN(CarelessTracker, "breaks every promise of a tracker")
