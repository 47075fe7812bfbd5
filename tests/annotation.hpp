#pragma once
/// Hand-made annotations of recorded footage, as the footage folder holds them.

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <opencv2/core/types.hpp>

namespace maggic {

struct AnnotatedTag {
  std::string color;
  cv::Point2d centroid_px;
};

struct AnnotatedRobot {
  std::string team;
  std::vector<std::string> player_colors;
  cv::Point2d centroid_px;
  /// From the mean of the player tags to the team tag, counter-clockwise, y up in the picture.
  double players_to_team_deg = 0.0;
  std::vector<AnnotatedTag> tags;
};

/// What stands in the picture; nothing moves within a clip.
struct Annotation {
  std::string media;
  double tolerance_px = 0.0;
  std::optional<cv::Point2d> ball_px;
  std::vector<AnnotatedRobot> robots;
};

inline Annotation load_annotation(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const nlohmann::json json = nlohmann::json::parse(stream);
  Annotation annotation;
  annotation.media = json.at("media");
  annotation.tolerance_px = json.at("tolerance_px");
  if (!json.at("ball").is_null()) {
    annotation.ball_px = cv::Point2d(json["ball"].at("x"), json["ball"].at("y"));
  }
  for (const nlohmann::json& robot : json.at("robots")) {
    annotation.robots.push_back({robot.at("team"),
                                 robot.at("player_colors").get<std::vector<std::string>>(),
                                 {robot.at("x"), robot.at("y")},
                                 robot.at("heading_deg"),
                                 {}});
    for (const nlohmann::json& tag : robot.at("tags")) {
      annotation.robots.back().tags.push_back({tag.at("color"), {tag.at("x"), tag.at("y")}});
    }
  }
  return annotation;
}

}  // namespace maggic
