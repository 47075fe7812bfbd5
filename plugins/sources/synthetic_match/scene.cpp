#include "scene.hpp"

#include <cmath>
#include <numbers>

namespace maggic::synthetic_match {
namespace {

constexpr Rgb kSurroundings{66, 62, 58};
constexpr Rgb kWall{22, 22, 24};
constexpr Rgb kFloor{43, 44, 48};
constexpr Rgb kLine{192, 194, 190};
constexpr Rgb kBodySide{24, 24, 26};
constexpr Rgb kBodyTop{33, 33, 35};

constexpr double kLineWidthMm = 4.0;
constexpr double kWallWidthMm = 25.0;
constexpr double kGoalWidthMm = 400.0;
constexpr double kGoalDepthMm = 100.0;
constexpr double kCenterRadiusMm = 200.0;
constexpr double kGoalAreaDepthMm = 150.0;
constexpr double kGoalAreaWidthMm = 700.0;
/// Long edges are split so that they bend with the lens.
constexpr double kEdgeStepMm = 40.0;

struct Outline {
  cv::Point2d centroid;
  double area = 0.0;
};

/// By the shoelace formula, about the first corner to keep the digits.
Outline outline_of(std::span<const cv::Point2d> contour) {
  double twice_area = 0.0;
  cv::Point2d moment(0.0, 0.0);
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const cv::Point2d a = contour[i] - contour[0];
    const cv::Point2d b = contour[(i + 1) % contour.size()] - contour[0];
    const double cross = a.cross(b);
    twice_area += cross;
    moment += cross * (a + b);
  }
  return {contour[0] + moment / (3.0 * twice_area), std::abs(twice_area) / 2.0};
}

/// Corners of a regular polygon with the area of the circle.
template <class F>
void for_circle(cv::Point2d center, double radius, int corners, F&& corner) {
  const double step = 2.0 * std::numbers::pi / corners;
  const double r = radius * std::sqrt(step / std::sin(step));
  for (int i = 0; i < corners; ++i) {
    corner(center + r * cv::Point2d(std::cos(i * step), std::sin(i * step)));
  }
}

cv::Point2d place(const RobotMotion& robot, cv::Point2d local_mm) {
  const double c = std::cos(robot.heading_rad);
  const double s = std::sin(robot.heading_rad);
  return robot.position_mm +
         cv::Point2d(c * local_mm.x - s * local_mm.y, s * local_mm.x + c * local_mm.y);
}

std::array<cv::Point2d, 4> rectangle(cv::Point2d low, cv::Point2d high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

}  // namespace

Scene::Scene(const Field& field, std::vector<Rgb> colors, Label ball_color,
             std::span<const FloorPatch> clutter)
    : field_(field),
      colors_(std::move(colors)),
      ball_color_(ball_color),
      coverage_(field.frame_size_px()),
      picture_(field.frame_size_px(), CV_32FC3,
               cv::Scalar(kSurroundings[2], kSurroundings[1], kSurroundings[0])) {
  draw_field();
  for (const FloorPatch& patch : clutter) {
    add_polygon(patch.corners_mm);
    fill(patch.color);
  }
  background_ = picture_.clone();
}

cv::Rect Scene::fill(const Rgb& color) {
  return coverage_.paint([&](int x, int y, float covered) {
    cv::Vec3f& pixel = picture_.ptr<cv::Vec3f>(y)[x];
    for (int c = 0; c < 3; ++c) {
      pixel[c] += covered * (static_cast<float>(color[static_cast<std::size_t>(2 - c)]) - pixel[c]);
    }
  });
}

void Scene::fill_on(const Rgb& base, const Rgb& color) {
  const cv::Vec3f step(static_cast<float>(color[2] - base[2]),
                       static_cast<float>(color[1] - base[1]),
                       static_cast<float>(color[0] - base[0]));
  coverage_.paint(
      [&](int x, int y, float covered) { picture_.ptr<cv::Vec3f>(y)[x] += covered * step; });
}

void Scene::label(std::span<const cv::Point2d> contour_px, Label label) {
  if (label_picture_) label_picture_->paint(contour_px, label);
}

void Scene::add_polygon(std::span<const cv::Point2d> corners_mm) {
  contour_.clear();
  for (std::size_t i = 0; i < corners_mm.size(); ++i) {
    const cv::Point2d from = corners_mm[i];
    const cv::Point2d edge = corners_mm[(i + 1) % corners_mm.size()] - from;
    const int steps = 1 + static_cast<int>(std::hypot(edge.x, edge.y) / kEdgeStepMm);
    for (int k = 0; k < steps; ++k) {
      contour_.push_back(field_.to_image_px(from + edge * (static_cast<double>(k) / steps), 0.0));
    }
  }
  coverage_.add_contour(contour_);
}

void Scene::add_circle(cv::Point2d center_mm, double radius_mm, bool hole) {
  contour_.clear();
  for_circle(center_mm, radius_mm, 128,
             [&](cv::Point2d p) { contour_.push_back(field_.to_image_px(p, 0.0)); });
  if (hole) std::ranges::reverse(contour_);
  coverage_.add_contour(contour_);
}

/// A straight line of kLineWidthMm, in the direction of an axis.
void Scene::add_band(cv::Point2d from_mm, cv::Point2d to_mm) {
  const cv::Point2d half(kLineWidthMm / 2.0, kLineWidthMm / 2.0);
  const cv::Point2d low(std::min(from_mm.x, to_mm.x), std::min(from_mm.y, to_mm.y));
  const cv::Point2d high(std::max(from_mm.x, to_mm.x), std::max(from_mm.y, to_mm.y));
  add_polygon(rectangle(low - half, high + half));
}

void Scene::draw_field() {
  const double x = field_.parameters().length_mm / 2.0;
  const double y = field_.parameters().width_mm / 2.0;
  const double goal = std::min(kGoalWidthMm / 2.0, y);
  const double goal_back = x + kGoalDepthMm;
  const auto floor_and_goals = [&](double wider) {
    add_polygon(rectangle({-x - wider, -y - wider}, {x + wider, y + wider}));
    const double mouth = goal + wider;
    for (const double side : {-1.0, 1.0}) {  // from the goal line outwards only: no overlap
      const double near = side * (x + wider);
      const double far = side * (goal_back + wider);
      add_polygon(rectangle({std::min(near, far), -mouth}, {std::max(near, far), mouth}));
    }
  };
  floor_and_goals(kWallWidthMm);
  fill(kWall);
  floor_and_goals(0.0);
  fill(kFloor);

  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      const double d = kCornerTriangleMm;
      add_polygon(std::array<cv::Point2d, 3>{
          {{sx * x, sy * y}, {sx * (x - d), sy * y}, {sx * x, sy * (y - d)}}});
      fill(kWall);
    }
  }
  const double area_x = x - kGoalAreaDepthMm;
  const double area_y = std::min(kGoalAreaWidthMm / 2.0, y);
  add_band({-x, -y}, {x, -y});
  fill(kLine);
  add_band({-x, y}, {x, y});
  fill(kLine);
  add_band({0, -y}, {0, y});
  fill(kLine);
  for (const double side : {-1.0, 1.0}) {
    add_band({side * x, -y}, {side * x, y});
    fill(kLine);
    add_band({side * area_x, -area_y}, {side * area_x, area_y});
    fill(kLine);
    for (const double end : {-1.0, 1.0}) {
      add_band({side * area_x, end * area_y}, {side * x, end * area_y});
      fill(kLine);
      const cv::Point2d mark(side * x / 2.0, end * (y - 250.0));  // free-ball cross
      add_band(mark - cv::Point2d(20, 0), mark + cv::Point2d(20, 0));
      fill(kLine);
      add_band(mark - cv::Point2d(0, 20), mark + cv::Point2d(0, 20));
      fill(kLine);
    }
  }
  add_circle({0, 0}, kCenterRadiusMm + kLineWidthMm / 2.0, false);
  add_circle({0, 0}, kCenterRadiusMm - kLineWidthMm / 2.0, true);
  fill(kLine);
}

void Scene::draw(std::span<const RobotMotion> robots, std::span<const RobotOutfit> outfits,
                 const BallMotion& ball, Detections& truth) {
  for (const cv::Rect& box : drawn_) {
    if (!box.empty()) background_(box).copyTo(picture_(box));  // empty: outside the picture
  }
  changed_.assign(drawn_.begin(), drawn_.end());
  drawn_.clear();
  if (label_picture_) label_picture_->clear();

  // From the floor upwards: the sides of robots, then the ball, then their tops, which hide the
  // sides of neighbours further out.
  for (const RobotMotion& robot : robots) drawn_.push_back(draw_body(robot));
  truth.ball.emplace();
  drawn_.push_back(draw_ball(ball, *truth.ball));
  truth.robots.resize(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    drawn_[i] |= draw_top(robots[i], outfits[i], truth.robots[i]);
  }
  changed_.insert(changed_.end(), drawn_.begin(), drawn_.end());
}

cv::Rect Scene::draw_body(const RobotMotion& robot) {
  const double half = kRobotSideMm / 2.0;
  const auto corners = rectangle({-half, -half}, {half, half});
  std::array<cv::Point2d, 4> base;
  std::array<cv::Point2d, 4> top;
  for (std::size_t i = 0; i < 4; ++i) {
    base[i] = field_.to_image_px(place(robot, corners[i]), 0.0);
    top[i] = field_.to_image_px(place(robot, corners[i]), field_.robot_height_mm());
  }
  coverage_.add_contour(base);
  label(base, kBackground);
  cv::Rect box = fill(kBodySide);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const std::array<cv::Point2d, 4> side{base[i], base[next], top[next], top[i]};
    coverage_.add_contour(side);
    label(side, kBackground);
    box |= fill(kBodySide);
  }
  return box;
}

cv::Rect Scene::draw_top(const RobotMotion& robot, const RobotOutfit& outfit,
                         RobotDetection& truth) {
  const double height = field_.robot_height_mm();
  const double half = kRobotSideMm / 2.0;
  const auto add_outline = [&](auto&& corners) {
    contour_.clear();
    for (const cv::Point2d& corner : corners) {
      contour_.push_back(field_.to_image_px(place(robot, corner), height));
    }
    coverage_.add_contour(contour_);
  };
  add_outline(rectangle({-half, -half}, {half, half}));
  label(contour_, kBackground);
  const cv::Rect box = fill(kBodyTop);

  truth = {};
  std::size_t player = 0;
  for (const TagPatch& patch : outfit.layout->patches) {
    const Label color =
        patch.role == PatchRole::kTeam ? outfit.team_color : outfit.id.colors[player++];
    if (patch.shape == PatchShape::kDisc) {
      contour_.clear();
      for_circle(patch.center_mm, patch.size_mm.width / 2.0, 32, [&](cv::Point2d p) {
        contour_.push_back(field_.to_image_px(place(robot, p), height));
      });
      coverage_.add_contour(contour_);
    } else {
      const cv::Point2d extent(patch.size_mm.width / 2.0, patch.size_mm.height / 2.0);
      add_outline(rectangle(patch.center_mm - extent, patch.center_mm + extent));
    }
    fill_on(kBodyTop, colors_[color]);
    label(contour_, color);
    const Outline outline = outline_of(contour_);
    const TagSighting sighting{color, outline.centroid, outline.area};
    if (patch.role == PatchRole::kTeam) {
      truth.tags.insert(truth.tags.begin(), sighting);
    } else {
      truth.tags.push_back(sighting);
      truth.player_colors.push_back(color);
    }
  }
  truth.team = outfit.team;
  truth.id = outfit.id.id;
  truth.position_mm = robot.position_mm;
  truth.heading_rad = robot.heading_rad;
  truth.velocity_mm_s = robot.velocity_mm_s();
  truth.angular_velocity_rad_s = robot.omega_rad_s;
  truth.centroid_px = field_.to_image_px(robot.position_mm, height);
  truth.confidence = 1.0;
  return box;
}

cv::Rect Scene::draw_ball(const BallMotion& ball, BallDetection& truth) {
  const double height = field_.ball_height_mm();
  contour_.clear();
  for_circle(ball.position_mm, kBallRadiusMm, 48,
             [&](cv::Point2d p) { contour_.push_back(field_.to_image_px(p, height)); });
  coverage_.add_contour(contour_);
  label(contour_, ball_color_);
  const Outline outline = outline_of(contour_);
  const Rgb& color = colors_[ball_color_];
  const double per_radius_squared = std::numbers::pi / outline.area;
  const cv::Rect box = coverage_.paint([&](int x, int y, float covered) {
    // Darker towards the rim, as a ball under a lamp is; even all around, so that the centroid
    // stays the centre.
    const double dx = x - outline.centroid.x;
    const double dy = y - outline.centroid.y;
    const double inside = std::max(1.0 - (dx * dx + dy * dy) * per_radius_squared, 0.0);
    const double shade = 0.8 + 0.2 * std::sqrt(inside);
    cv::Vec3f& pixel = picture_.ptr<cv::Vec3f>(y)[x];
    for (int c = 0; c < 3; ++c) {
      const auto lit = static_cast<float>(shade * color[static_cast<std::size_t>(2 - c)]);
      pixel[c] += covered * (lit - pixel[c]);
    }
  });
  truth = {};
  truth.position_mm = ball.position_mm;
  truth.velocity_mm_s = ball.velocity_mm_s;
  truth.centroid_px = outline.centroid;
  truth.area_px = outline.area;
  truth.confidence = 1.0;
  return box;
}

}  // namespace maggic::synthetic_match
