#include <optional>
#include <string_view>

#include "maggic/tracking_engine.hpp"

namespace maggic {

void TrackingParameters::use_palette(const Palette& palette) {
  const auto use = [&](std::string_view name, Label& label) {
    if (const std::optional<Label> found = palette.find(name)) label = *found;
  };
  use("blue", blue_team_color);
  use("yellow", yellow_team_color);
  use("orange", ball_color);
}

void TrackingParameters::describe(Parameters& p) {
  p.color({"blue_team_color", "colour of the blue team's tags"}, blue_team_color);
  p.color({"yellow_team_color", "colour of the yellow team's tags"}, yellow_team_color);
  p.color({"ball_color", "colour of the ball"}, ball_color);
  p.check("blue_team_color", blue_team_color != kBackground,
          "the palette has no colour `blue`, expected the name of the blue team's colour");
  p.check("yellow_team_color", yellow_team_color != kBackground,
          "the palette has no colour `yellow`, expected the name of the yellow team's colour");
  p.check("ball_color", ball_color != kBackground,
          "the palette has no colour `orange`, expected the name of the ball's colour");
  p.check("yellow_team_color",
          blue_team_color == kBackground || blue_team_color != yellow_team_color,
          "the same colour as blue_team_color, expected another one");

  p.number({"ball_diameter_mm", "diameter of the ball", "mm"}, ball_diameter_mm, {5.0, 500.0});
  p.number({"ball_min_area_ratio", "smallest ball blob, as a part of the ball's disc"},
           ball_min_area_ratio, {0.01, 1.0});
  p.number({"ball_max_area_ratio", "largest ball blob, in multiples of the ball's disc"},
           ball_max_area_ratio, {1.0, 20.0});

  p.number({"patch_min_area_ratio", "smallest blob taken for a patch, as a part of its area"},
           patch_min_area_ratio, {0.05, 1.0});
  p.number({"patch_max_area_ratio", "largest blob taken for a patch, in multiples of its area"},
           patch_max_area_ratio, {1.0, 10.0});
  p.number({"max_patch_error_mm", "how far a patch may lie from where the robot's pose puts it",
            "mm"},
           max_patch_error_mm, {0.5, 50.0});

  p.boolean({"report_unknown", "report robots whose player colours are in no id table, as id -1"},
            report_unknown);
  p.integer({"max_robots_per_team", "most robots reported a team"}, max_robots_per_team, {1, 100});

  p.integer({"predict_frames", "how long a missed object is carried on by its motion", "frames"},
            predict_frames, {0, 600});
  p.number({"max_speed_mm_s", "an object that moved faster was put there by hand", "mm/s"},
           max_speed_mm_s, {100.0, 50000.0});
  p.number({"position_noise_mm", "standard deviation of a measured position", "mm"},
           position_noise_mm, {0.01, 50.0});
  p.number({"heading_noise_deg", "standard deviation of a measured heading", "degrees"},
           heading_noise_deg, {0.01, 45.0});
  p.number({"acceleration_mm_s2", "how hard objects change their velocity", "mm/s²"},
           acceleration_mm_s2, {1.0, 1e6});
  p.number({"angular_acceleration_rad_s2", "how hard robots change their turning", "rad/s²"},
           angular_acceleration_rad_s2, {0.1, 1e5});
}

}  // namespace maggic
