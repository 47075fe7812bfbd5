#include "lamps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>

#include "maggic/color_temperature.hpp"
#include "random.hpp"

namespace maggic::synthetic_match {
namespace {

constexpr std::uint64_t kStream = 0x6c616d7073u;  // apart from the numbers the match is made of

/// Lengths in heights of the picture, from its centre, x to the right and y down.
struct Lamp {
  cv::Point2d position;
  double height = 1.0;
  double strength = 1.0;
  cv::Vec3d color{1.0, 1.0, 1.0};  ///< Blue, green, red.
};

/// A patch of daylight with soft edges, a bar of the frame across it.
struct Window {
  cv::Point2d center;
  cv::Point2d half_size;
  double angle_rad = 0.0;
  double strength = 0.0;
  cv::Vec3d color{1.0, 1.0, 1.0};
};

struct Hall {
  cv::Vec3d ambient{0.0, 0.0, 0.0};
  std::vector<Lamp> lamps;
  std::vector<Window> windows;
};

/// @param power below 1: the cast is weaker than the lamp alone would make it, as walls reflect it.
cv::Vec3d cast_of(double kelvin, double power) {
  const std::array<double, 3> gains = lamp_gains(kelvin);
  return {std::pow(gains[2], power), 1.0, std::pow(gains[0], power)};
}

Hall normal_hall(Random& random, double aspect) {
  Hall hall;
  const bool first_is_cool = random.uniform() < 0.5;
  for (int i = 0; i < 4; ++i) {
    Lamp lamp;
    lamp.position = {(i % 2 == 0 ? -0.3 : 0.3) * aspect + random.uniform(-0.08, 0.08),
                     (i < 2 ? -0.3 : 0.3) + random.uniform(-0.08, 0.08)};
    lamp.height = random.uniform(0.85, 1.05);
    lamp.strength = random.uniform(0.9, 1.1);
    const bool is_cool = first_is_cool == (i % 2 == 0);
    lamp.color = cast_of(is_cool ? random.uniform(6800, 7600) : random.uniform(5200, 6000), 1.0);
    hall.lamps.push_back(lamp);
  }
  return hall;
}

Hall challenging_hall(Random& random, double aspect) {
  Hall hall;
  hall.ambient = cv::Vec3d::all(0.16);
  // Warm, cool and greenish or pinkish lamps: where they hang is the seed's.
  std::array<cv::Vec3d, 4> colors{
      cast_of(random.uniform(3200, 4000), 0.8), cast_of(random.uniform(9000, 14000), 0.9),
      cast_of(random.uniform(4200, 5000), 0.8), cast_of(random.uniform(6000, 7500), 1.0)};
  colors[3][1] *= random.uniform() < 0.5 ? random.uniform(0.84, 0.92) : random.uniform(1.08, 1.16);
  const double first_angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double angle =
        first_angle + 0.5 * std::numbers::pi * static_cast<double>(i) + random.uniform(-0.35, 0.35);
    Lamp lamp;
    lamp.position = {0.42 * aspect * std::cos(angle), 0.42 * std::sin(angle)};
    lamp.height = random.uniform(0.42, 0.6);
    lamp.strength = random.uniform(0.55, 1.3);
    lamp.color = colors[i];
    hall.lamps.push_back(lamp);
  }
  Window window;
  window.center = {random.uniform(-0.35, 0.35) * aspect, random.uniform(-0.3, 0.3)};
  window.half_size = {random.uniform(0.12, 0.2), random.uniform(0.08, 0.14)};
  window.angle_rad = random.uniform(0.0, std::numbers::pi);
  window.strength = random.uniform(0.35, 0.7);
  window.color = cast_of(random.uniform(7500, 10000), 1.0);
  hall.windows.push_back(window);
  return hall;
}

double light_of(const Lamp& lamp, cv::Point2d at) {
  const cv::Point2d offset = at - lamp.position;
  const double cosine_squared =
      lamp.height * lamp.height / (lamp.height * lamp.height + offset.dot(offset));
  return lamp.strength * cosine_squared * cosine_squared;
}

double light_of(const Window& window, cv::Point2d at) {
  const cv::Point2d offset = at - window.center;
  const double c = std::cos(window.angle_rad);
  const double s = std::sin(window.angle_rad);
  const cv::Point2d local(c * offset.x + s * offset.y, -s * offset.x + c * offset.y);
  const auto inside = [](double distance, double half) {  // a smooth step 0.03 wide
    return 1.0 / (1.0 + std::exp((std::abs(distance) - half) / 0.0075));
  };
  const double bar = inside(local.x, 0.012);
  return window.strength * inside(local.x, window.half_size.x) *
         inside(local.y, window.half_size.y) * (1.0 - 0.8 * bar);
}

/// Scales all so that green's mean is `mean`; where green would be below `dimmest`, its pixel is
/// brightened without changing its cast.
void set_mean(cv::Mat& light, double mean, double dimmest) {
  const double factor = mean / cv::mean(light)[1];
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x) {
      cv::Vec3f& pixel = light.at<cv::Vec3f>(y, x);
      const double green = factor * pixel[1];
      pixel *= static_cast<float>(factor * std::max(1.0, dimmest / green));
    }
  }
}

}  // namespace

cv::Mat light_over_picture(LightClass light, cv::Size picture, std::uint64_t seed) {
  if (light == LightClass::kEven || light == LightClass::kIdeal) return {};
  Random random(seed ^ kStream);
  const double height = picture.height;
  const double aspect = picture.width / height;
  const bool is_normal = light == LightClass::kNormal;
  const Hall hall = is_normal ? normal_hall(random, aspect) : challenging_hall(random, aspect);
  cv::Mat gains(picture, CV_32FC3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const cv::Point2d at((x - 0.5 * (picture.width - 1)) / height,
                           (y - 0.5 * (picture.height - 1)) / height);
      cv::Vec3d sum = hall.ambient;
      for (const Lamp& lamp : hall.lamps) sum += light_of(lamp, at) * lamp.color;
      for (const Window& window : hall.windows) sum += light_of(window, at) * window.color;
      gains.at<cv::Vec3f>(y, x) = sum;
    }
  }
  set_mean(gains, is_normal ? 1.0 : random.uniform(0.5, 0.7), is_normal ? 0.0 : kDimmest);
  return gains;
}

}  // namespace maggic::synthetic_match
