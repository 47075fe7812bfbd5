#pragma once
/// Scenes for tests of the tracking room: robots and balls as the blobs a camera would give.

#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "maggic/blob.hpp"
#include "maggic/detections.hpp"
#include "maggic/field.hpp"
#include "maggic/tag_layout.hpp"
#include "maggic/tracking_engine.hpp"
#include "tracking/pose.hpp"

namespace maggic::tracking {

/// The standard palette's labels by name.
inline Label color(std::string_view name) {
  static const Palette palette = Palette::standard();
  return palette.find(name).value();
}

inline TagLayout two_tags() { return two_tag_layout(Palette::standard()); }
inline TagLayout three_tags() { return three_tag_layout(Palette::standard()); }
/// Two squares on a diagonal.
inline TagLayout diagonal_squares() {
  return {"diagonal",
          {{PatchRole::kTeam, PatchShape::kRectangle, {-17.5, 17.5}, {35, 35}, 0},
           {PatchRole::kPlayer, PatchShape::kRectangle, {17.5, -17.5}, {35, 35}, 0}},
          {{20, {color("red")}}, {21, {color("green")}}, {22, {color("cyan")}}},
          0.0};
}

/// Random numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  /// Normal distribution to a good approximation: a sum of twelve.
  double normal(double sigma) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform(0.0, 1.0);
    return sigma * sum;
  }

 private:
  std::mt19937 engine_;
};

/// A frame's blobs, put together patch by patch on a 640×480 picture of the 3v3 field.
class Scene {
 public:
  explicit Scene(const FieldParameters& parameters = {}) : field_(parameters, {640, 480}) {}

  const Field& field() const { return field_; }
  const std::vector<Blob>& blobs() const { return blobs_; }
  std::vector<Blob>& blobs() { return blobs_; }
  void clear() { blobs_.clear(); }

  /// A blob of the given extent in millimetres, its width along `axis_rad`.
  Blob& add(Label label, cv::Point2d center_mm, double height_mm, cv::Size2d size_mm,
            double axis_rad, double area_mm2, double variance_divisor = 12.0) {
    Blob blob;
    blob.label = label;
    blob.centroid_px = field_.to_image_px(center_mm, height_mm);
    const cv::Matx22d to_px = field_.jacobian_mm_per_px(blob.centroid_px, height_mm).inv();
    const double c = std::cos(axis_rad);
    const double s = std::sin(axis_rad);
    const cv::Matx22d turn(c, -s, s, c);
    const cv::Matx22d along(size_mm.width * size_mm.width / variance_divisor, 0, 0,
                            size_mm.height * size_mm.height / variance_divisor);
    const cv::Matx22d moments = to_px * turn * along * turn.t() * to_px.t();
    blob.moment_xx_px2 = moments(0, 0);
    blob.moment_xy_px2 = moments(0, 1);
    blob.moment_yy_px2 = moments(1, 1);
    blob.area_px =
        std::max(1, static_cast<int>(std::lround(
                        area_mm2 / field_.mm2_per_px2(blob.centroid_px, height_mm))));
    return blobs_.emplace_back(blob);
  }

  Blob& add_patch(const TagPatch& patch, Label label, const Pose& pose) {
    return add(label, pose.apply(patch.center_mm), field_.robot_height_mm(), patch.size_mm,
               pose.heading_rad, patch.expected_area_mm2(),
               patch.shape == PatchShape::kDisc ? 16.0 : 12.0);
  }

  /// All patches of a robot. Player colours in the layout's order.
  void add_colored_robot(const TagLayout& layout, Label team, const std::vector<Label>& colors,
                         const Pose& pose) {
    std::size_t next = 0;
    for (const TagPatch& patch : layout.patches) {
      add_patch(patch, patch.role == PatchRole::kTeam ? team : colors[next++], pose);
    }
  }
  void add_robot(const TagLayout& layout, Label team, int id, const Pose& pose) {
    for (const TagId& entry : layout.ids) {
      if (entry.id == id) add_colored_robot(layout, team, entry.colors, pose);
    }
  }

  Blob& add_ball(cv::Point2d center_mm, Label label = color("orange"), double diameter_mm = 42.7) {
    return add(label, center_mm, field_.ball_height_mm(), {diameter_mm, diameter_mm}, 0.0,
               CV_PI / 4.0 * diameter_mm * diameter_mm, 16.0);
  }

  /// Shifts every centroid a little.
  void shake(Dice& dice, double sigma_px) {
    for (Blob& blob : blobs_) {
      blob.centroid_px += cv::Point2d(dice.normal(sigma_px), dice.normal(sigma_px));
    }
  }

  /// Replaces two blobs by the one they make together.
  void merge(std::size_t a, std::size_t b) {
    Blob& x = blobs_[a];
    const Blob y = blobs_[b];
    const double total = x.area_px + y.area_px;
    const double wx = x.area_px / total;
    const double wy = y.area_px / total;
    const cv::Point2d mean = wx * x.centroid_px + wy * y.centroid_px;
    const cv::Point2d dx = x.centroid_px - mean;
    const cv::Point2d dy = y.centroid_px - mean;
    x.moment_xx_px2 = wx * (x.moment_xx_px2 + dx.x * dx.x) + wy * (y.moment_xx_px2 + dy.x * dy.x);
    x.moment_xy_px2 = wx * (x.moment_xy_px2 + dx.x * dx.y) + wy * (y.moment_xy_px2 + dy.x * dy.y);
    x.moment_yy_px2 = wx * (x.moment_yy_px2 + dx.y * dx.y) + wy * (y.moment_yy_px2 + dy.y * dy.y);
    x.centroid_px = mean;
    x.area_px += y.area_px;
    blobs_.erase(blobs_.begin() + static_cast<std::ptrdiff_t>(b));
  }

 private:
  Field field_;
  std::vector<Blob> blobs_;
};

inline TrackingParameters standard_parameters() {
  TrackingParameters parameters;
  parameters.use_palette(Palette::standard());
  return parameters;
}

/// An engine that is fed scenes at 60 frames a second.
class Camera {
 public:
  explicit Camera(std::vector<TagLayout> layouts,
                  const TrackingParameters& parameters = standard_parameters())
      : engine_(parameters, std::move(layouts)) {}

  static constexpr double kFrameS = 1.0 / 60.0;

  const Detections& look_at(const Scene& scene, double after_s = kFrameS) {
    captured_ += std::chrono::nanoseconds(std::llround(after_s * 1e9));
    engine_.track({sequence_++, captured_, scene.blobs(), scene.field()}, out_);
    return out_;
  }

  /// What the engine made of a blob of the scene it looked at last.
  std::string explain(const Scene& scene, std::size_t blob) const {
    return engine_.explain({sequence_ - 1, captured_, scene.blobs(), scene.field()}, blob,
                           Palette::standard());
  }

 private:
  TrackingEngine engine_;
  std::uint64_t sequence_ = 0;
  Timestamp captured_{0};
  Detections out_;
};

/// The robot of a team and id; null when it was not reported.
inline const RobotDetection* robot_of(const Detections& detections, Team team, int id) {
  for (const RobotDetection& robot : detections.robots) {
    if (robot.team == team && robot.id == id) return &robot;
  }
  return nullptr;
}

inline double distance_mm(cv::Point2d a, cv::Point2d b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace maggic::tracking
