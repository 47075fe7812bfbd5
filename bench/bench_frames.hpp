#pragma once
/// Pictures the frame-path benchmarks share: one typical, the others as bad as they get.

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "maggic/color_table.hpp"
#include "maggic/testing.hpp"

namespace maggic::bench {

enum class Scene { kTypical, kBackground, kOneColor, kCheckerboard, kNoise };

inline const char* name_of(Scene scene) {
  switch (scene) {
    case Scene::kTypical: return "typical";
    case Scene::kBackground: return "background";
    case Scene::kOneColor: return "one colour";
    case Scene::kCheckerboard: return "checkerboard";
    case Scene::kNoise: return "noise";
  }
  return "";
}

/// A BGR frame. `kTypical` is a dark field with sensor noise, lines, six robots and a ball.
inline cv::Mat frame_of(Scene scene, cv::Size size) {
  cv::Mat frame(size, CV_8UC3, cv::Scalar(28, 26, 27));
  cv::RNG random(1);
  switch (scene) {
    case Scene::kBackground: break;
    case Scene::kOneColor: frame.setTo(cv::Scalar(20, 20, 220)); break;
    case Scene::kCheckerboard:
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          frame.at<cv::Vec3b>(y, x) = (x + y) % 2 ? cv::Vec3b(20, 20, 220) : cv::Vec3b(220, 40, 20);
        }
      }
      break;
    case Scene::kNoise: random.fill(frame, cv::RNG::UNIFORM, 0, 256); break;
    case Scene::kTypical: {
      const int side = size.height / 18;
      cv::rectangle(frame, cv::Rect(size.width / 20, size.height / 20, size.width * 9 / 10,
                                    size.height * 9 / 10),
                    cv::Scalar(220, 220, 220), 2);
      for (int robot = 0; robot < 6; ++robot) {
        const int x = size.width * (20 + 12 * robot) / 100;
        const int y = size.height * (30 + 7 * robot) / 100;
        cv::rectangle(frame, cv::Rect(x, y, side, side / 2),
                      robot % 2 ? cv::Scalar(30, 220, 230) : cv::Scalar(220, 60, 20), cv::FILLED);
        cv::rectangle(frame, cv::Rect(x, y + side / 2, side, side / 2),
                      robot % 3 ? cv::Scalar(40, 30, 220) : cv::Scalar(60, 200, 40), cv::FILLED);
      }
      cv::circle(frame, cv::Point(size.width / 2, size.height / 2), side / 3, cv::Scalar(0, 120, 250), cv::FILLED);
      cv::Mat noise(size, CV_16SC3);
      random.fill(noise, cv::RNG::NORMAL, 0, 3);
      cv::add(frame, noise, frame, cv::noArray(), CV_8UC3);
      break;
    }
  }
  return frame;
}

inline const ColorTable& maggic_table() {
  static const ColorTable table = [] {
    const auto normalizer = testing::make<Normalizer>("weighted");
    const auto segmenter = testing::make<Segmenter>("hue_pivots", "gray_threshold: 20");
    return ColorTable::compile(dynamic_cast<const ColorNormalizer&>(*normalizer),
                               dynamic_cast<const ColorSegmenter&>(*segmenter),
                               testing::standard_palette().size());
  }();
  return table;
}

}  // namespace maggic::bench
