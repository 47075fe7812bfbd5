#include "camera_effects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/core.hpp>

#include "random.hpp"

namespace maggic::synthetic_match {
namespace {

constexpr int kFraction = 64;      // sub-steps of an 8-bit step
constexpr int kBrightest = 312;    // light above 255 saturates only after the noise is added
constexpr int kNormalScale = 256;
constexpr std::size_t kNormals = 1u << 16;

std::vector<float> gaussian_kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<float> kernel;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    const double weight = radius == 0 ? 1.0 : std::exp(-0.5 * i * i / (sigma * sigma));
    kernel.push_back(static_cast<float>(weight));
    sum += weight;
  }
  for (float& weight : kernel) weight = static_cast<float>(weight / sum);
  return kernel;
}

/// Standard normal numbers by the Box–Muller transform.
std::vector<std::int16_t> normal_numbers(std::uint64_t seed) {
  Random random(seed);
  std::vector<std::int16_t> numbers(kNormals);
  for (std::int16_t& number : numbers) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    number = static_cast<std::int16_t>(std::lround(kNormalScale * radius * std::cos(angle)));
  }
  return numbers;
}

}  // namespace

CameraEffects::CameraEffects(const CameraEffectsParameters& parameters, cv::Size picture,
                             std::uint64_t seed)
    : parameters_(parameters),
      size_(picture),
      seed_(seed),
      kernel_(gaussian_kernel(parameters.blur_px)),
      light_(picture, CV_16SC3),
      gaussian_(normal_numbers(seed)) {
  for (int value = 0; value <= kBrightest; ++value) {
    const double variance = parameters.noise * parameters.noise +
                            parameters.shot_noise * parameters.shot_noise * value / 255.0;
    noise_of_.push_back(static_cast<std::int32_t>(std::lround(kFraction * std::sqrt(variance))));
  }
}

void CameraEffects::develop(const cv::Mat& scene, cv::Rect box) {
  const int radius = static_cast<int>(kernel_.size() / 2);
  box -= cv::Point(radius, radius);
  box += cv::Size(2 * radius, 2 * radius);
  box &= cv::Rect({}, size_);
  if (box.empty()) return;
  blur_rows(scene, box);
  blur_columns(box);
}

void CameraEffects::blur_rows(const cv::Mat& scene, cv::Rect box) {
  const int radius = static_cast<int>(kernel_.size() / 2);
  const auto width = static_cast<std::size_t>(3 * box.width);
  padded_row_.resize(width + static_cast<std::size_t>(6 * radius));
  blurred_rows_.assign(width * static_cast<std::size_t>(box.height + 2 * radius), 0.0f);
  float* out = blurred_rows_.data();
  for (int y = box.y - radius; y < box.br().y + radius; ++y, out += width) {
    const float* row = scene.ptr<float>(std::clamp(y, 0, size_.height - 1));
    // Beyond the picture its edge goes on.
    const int first = box.x - radius;
    const int last = box.br().x + radius;
    float* to = padded_row_.data();
    for (int x = first; x < last; ++x, to += 3) {
      std::copy_n(row + 3 * std::clamp(x, 0, size_.width - 1), 3, to);
    }
    for (std::size_t k = 0; k < kernel_.size(); ++k) {
      const float weight = kernel_[k];
      const float* from = padded_row_.data() + 3 * k;
      for (std::size_t i = 0; i < width; ++i) out[i] += weight * from[i];
    }
  }
}

void CameraEffects::blur_columns(cv::Rect box) {
  const auto width = static_cast<std::size_t>(3 * box.width);
  line_.resize(width);
  const double angle = parameters_.gradient_direction_deg * std::numbers::pi / 180.0;
  const double span = std::max(size_.width, size_.height) / 2.0;
  const double slope_x = parameters_.gradient * std::cos(angle) / span;
  const double slope_y = -parameters_.gradient * std::sin(angle) / span;
  for (int y = box.y; y < box.br().y; ++y) {
    std::ranges::fill(line_, 0.0f);
    const float* from = blurred_rows_.data() + static_cast<std::size_t>(y - box.y) * width;
    for (const float weight : kernel_) {
      for (std::size_t i = 0; i < width; ++i) line_[i] += weight * from[i];
      from += width;
    }
    auto* out = light_.ptr<cv::Vec3s>(y) + box.x;
    for (int x = 0; x < box.width; ++x) {
      const double light =
          parameters_.brightness * (1.0 + slope_x * (box.x + x - 0.5 * (size_.width - 1)) +
                                    slope_y * (y - 0.5 * (size_.height - 1)));
      for (int c = 0; c < 3; ++c) {
        const double value = line_[static_cast<std::size_t>(3 * x + c)] * light *
                             parameters_.color_gains[static_cast<std::size_t>(2 - c)];
        out[x][c] = static_cast<std::int16_t>(
            kFraction * std::clamp(value, 0.0, static_cast<double>(kBrightest)) + 0.5);
      }
    }
  }
}

void CameraEffects::expose(std::uint64_t number, cv::Mat& bgr) {
  bgr.create(size_, CV_8UC3);
  const auto width = static_cast<std::size_t>(3 * size_.width);
  // A generator of its own for each frame: a frame does not depend on those before it.
  Random random(seed_ ^ (0xd1342543de82ef95u * (number + 1)));
  for (int y = 0; y < size_.height; ++y) {
    const std::int16_t* light = light_.ptr<std::int16_t>(y);
    const std::int16_t* normal = gaussian_.data() + random.next() % (kNormals - width);
    std::uint8_t* out = bgr.ptr<std::uint8_t>(y);
    for (std::size_t i = 0; i < width; ++i) {
      const std::int32_t deviation = noise_of_[static_cast<std::size_t>(light[i] / kFraction)];
      const std::int32_t value = light[i] + deviation * normal[i] / kNormalScale;
      out[i] = static_cast<std::uint8_t>(
          std::clamp((value + kFraction / 2) / kFraction, 0, 255));
    }
  }
  if (parameters_.chroma_subsampling) subsample_chroma(bgr);
}

/// One pair of colour differences for 2 × 2 pixels, interpolated as JPEG decoders do: 3/4 of the
/// pixel's own block and 1/4 of the next, along either axis. Full-range BT.601.
void CameraEffects::subsample_chroma(cv::Mat& bgr) {
  const int blocks_x = (size_.width + 1) / 2;
  const int blocks_y = (size_.height + 1) / 2;
  const auto stride = static_cast<std::size_t>(2 * blocks_x);
  chroma_.resize(stride * static_cast<std::size_t>(blocks_y));
  chroma_line_.resize(stride);
  // 2^10 fixed point of the sum of four pixels; the last shift below takes both factors out.
  for (int by = 0; by < blocks_y; ++by) {
    const std::uint8_t* upper = bgr.ptr<std::uint8_t>(2 * by);
    const std::uint8_t* lower = bgr.ptr<std::uint8_t>(std::min(2 * by + 1, size_.height - 1));
    std::int32_t* out = chroma_.data() + stride * static_cast<std::size_t>(by);
    for (int bx = 0; bx < blocks_x; ++bx) {
      const int left = 6 * bx;
      const int right = 3 * std::min(2 * bx + 1, size_.width - 1);
      const auto sum = [&](int c) {
        return upper[left + c] + upper[right + c] + lower[left + c] + lower[right + c];
      };
      const int b = sum(0), g = sum(1), r = sum(2);
      out[2 * bx] = (-173 * r - 339 * g + 512 * b) >> 8;
      out[2 * bx + 1] = (512 * r - 429 * g - 83 * b) >> 8;
    }
  }
  for (int y = 0; y < size_.height; ++y) {
    const int own = y / 2;
    const int next = std::clamp(y % 2 == 0 ? own - 1 : own + 1, 0, blocks_y - 1);
    const std::int32_t* near = chroma_.data() + stride * static_cast<std::size_t>(own);
    const std::int32_t* far = chroma_.data() + stride * static_cast<std::size_t>(next);
    for (std::size_t i = 0; i < stride; ++i) chroma_line_[i] = 3 * near[i] + far[i];
    std::uint8_t* pixel = bgr.ptr<std::uint8_t>(y);
    for (int x = 0; x < size_.width; ++x, pixel += 3) {
      const int own_x = x / 2;
      const int next_x = std::clamp(x % 2 == 0 ? own_x - 1 : own_x + 1, 0, blocks_x - 1);
      const auto chroma = [&](int c) {  // 4 (fixed point) · 4 (pixels) · 16 (weights) = 2^8
        return 3 * chroma_line_[static_cast<std::size_t>(2 * own_x + c)] +
               chroma_line_[static_cast<std::size_t>(2 * next_x + c)];
      };
      const int cb = chroma(0);
      const int cr = chroma(1);
      const int luma = 299 * pixel[2] + 587 * pixel[1] + 114 * pixel[0];
      const auto channel = [&](int chroma_times_1000) {
        const int value = luma * 256 + chroma_times_1000;
        return static_cast<std::uint8_t>(std::clamp((value + 128'000) / 256'000, 0, 255));
      };
      pixel[0] = channel(1772 * cb);
      pixel[1] = channel(-344 * cb - 714 * cr);
      pixel[2] = channel(1402 * cr);
    }
  }
}

}  // namespace maggic::synthetic_match
