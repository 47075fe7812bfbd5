#pragma once
/// Two teams on the large field among stray blobs that could be their patches: what the cost of
/// tracking is measured, and bounded, on.

#include <algorithm>
#include <vector>

#include "tracking/scene_for_tests.hpp"

namespace maggic::tracking {

struct Crowd {
  TagLayout layout;
  int robots = 0;  ///< At most 24; half of them a team.
  /// Blobs of every colour and about the size of a patch.
  int strays = 0;
  /// Strays lie in heaps of 50, within 150 mm of each heap's middle, instead of all over.
  bool heaped = false;
  /// Robots drive in circles, once round in `kFrames`, and strays jump about.
  bool moving = false;

  static constexpr int kFrames = 60;
};

/// The 5v5 field.
inline FieldParameters large_field() {
  FieldParameters parameters;
  parameters.length_mm = 2200;
  parameters.width_mm = 1800;
  return parameters;
}

inline void add_robots(const Crowd& crowd, double phase_rad, Scene& scene) {
  constexpr int kColumns = 6;
  const double radius_mm = 60.0;
  for (int i = 0; i < crowd.robots; ++i) {
    const cv::Point2d middle_mm(360.0 * (i % kColumns) - 900.0, 400.0 * (i / kColumns) - 600.0);
    const double heading = phase_rad + i;
    const cv::Point2d out(std::sin(heading), -std::cos(heading));
    // Ids go round where a team has more robots than its table has ids.
    const auto id = static_cast<std::size_t>(i / 2) % crowd.layout.ids.size();
    scene.add_robot(crowd.layout, color(i % 2 == 0 ? "blue" : "yellow"), crowd.layout.ids[id].id,
                    {middle_mm + radius_mm * out, heading});
  }
}

inline void add_strays(const Crowd& crowd, Dice dice, Scene& scene) {
  constexpr int kHeap = 50;
  constexpr double kHeapRadiusMm = 150.0;
  const FieldParameters& field = scene.field().parameters();
  const auto anywhere = [&] {
    return cv::Point2d(field.length_mm * dice.uniform(-0.5, 0.5),
                       field.width_mm * dice.uniform(-0.5, 0.5));
  };
  const int colors = static_cast<int>(Palette::standard().size()) - 1;
  cv::Point2d heap_mm;
  for (int i = 0; i < crowd.strays; ++i) {
    if (i % kHeap == 0) heap_mm = anywhere();
    const cv::Point2d center_mm =
        crowd.heaped ? heap_mm + kHeapRadiusMm *
                                     cv::Point2d(dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 1.0))
                     : anywhere();
    const cv::Size2d size_mm(dice.uniform(20.0, 50.0), dice.uniform(20.0, 50.0));
    scene.add(static_cast<Label>(1 + dice.below(colors)), center_mm,
              scene.field().robot_height_mm(), size_mm, dice.uniform(-CV_PI, CV_PI),
              size_mm.area());
  }
}

/// `Crowd::kFrames` frames, the same in every run, that may be repeated without a jump of the
/// robots. Blobs come top down, as from a picture.
inline std::vector<Scene> scenes_of(const Crowd& crowd) {
  std::vector<Scene> scenes(Crowd::kFrames, Scene(large_field()));
  for (int i = 0; i < Crowd::kFrames; ++i) {
    Scene& scene = scenes[static_cast<std::size_t>(i)];
    const int time = crowd.moving ? i : 0;
    add_robots(crowd, 2.0 * CV_PI * time / Crowd::kFrames, scene);
    add_strays(crowd, Dice(static_cast<std::uint32_t>(1 + time)), scene);
    scene.add_ball({0.0, 0.0});
    std::ranges::sort(scene.blobs(), {}, [](const Blob& blob) { return blob.centroid_px.y; });
  }
  return scenes;
}

}  // namespace maggic::tracking
