#include "camera_effects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <opencv2/core.hpp>

#include "random.hpp"

namespace maggic::synthetic_match {
namespace {

constexpr int kFractionBits = 6;
constexpr int kFraction = 1 << kFractionBits;  // sub-steps of an 8-bit step
constexpr int kBrightest = 312;  // light above 255 saturates only after the noise is added
/// Where the light drifts, what saturates now may not do so later: kept as far as 16 bits go.
constexpr int kBrightestKept = 511;
constexpr int kNormalBits = 8;
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
    number = static_cast<std::int16_t>(std::lround((1 << kNormalBits) * radius * std::cos(angle)));
  }
  return numbers;
}

}  // namespace

CameraEffects::CameraEffects(const CameraEffectsParameters& parameters, cv::Size picture,
                             cv::Mat lamps, std::uint64_t seed)
    : parameters_(parameters),
      size_(picture),
      seed_(seed),
      lamps_(std::move(lamps)),
      kernel_(gaussian_kernel(parameters.blur_px)),
      light_(picture, CV_16SC3),
      deviation_(picture, CV_16SC3),
      gaussian_(normal_numbers(seed)) {
  for (int value = 0; value <= kBrightest; ++value) {
    const double variance = parameters.noise * parameters.noise +
                            parameters.shot_noise * parameters.shot_noise * value / 255.0;
    noise_of_.push_back(static_cast<std::int16_t>(std::lround(kFraction * std::sqrt(variance))));
  }
  if (parameters.drifts) {
    drifted_light_.create(picture, CV_16SC3);
    drifted_deviation_.create(picture, CV_16SC3);
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
  const double brightest = parameters_.drifts ? kBrightestKept : kBrightest;
  for (int y = box.y; y < box.br().y; ++y) {
    std::ranges::fill(line_, 0.0f);
    const float* from = blurred_rows_.data() + static_cast<std::size_t>(y - box.y) * width;
    for (const float weight : kernel_) {
      for (std::size_t i = 0; i < width; ++i) line_[i] += weight * from[i];
      from += width;
    }
    const cv::Vec3f* lamps = lamps_.empty() ? nullptr : lamps_.ptr<cv::Vec3f>(y) + box.x;
    auto* out = light_.ptr<cv::Vec3s>(y) + box.x;
    auto* deviation = deviation_.ptr<cv::Vec3s>(y) + box.x;
    for (int x = 0; x < box.width; ++x) {
      const double light =
          parameters_.brightness * (1.0 + slope_x * (box.x + x - 0.5 * (size_.width - 1)) +
                                    slope_y * (y - 0.5 * (size_.height - 1)));
      for (int c = 0; c < 3; ++c) {
        double value = line_[static_cast<std::size_t>(3 * x + c)] * light *
                       parameters_.color_gains[static_cast<std::size_t>(2 - c)];
        if (lamps != nullptr) value *= lamps[x][c];
        out[x][c] = static_cast<std::int16_t>(kFraction * std::clamp(value, 0.0, brightest) + 0.5);
        deviation[x][c] =
            noise_of_[static_cast<std::size_t>(std::min(out[x][c] >> kFractionBits, kBrightest))];
      }
    }
  }
}

void CameraEffects::dim(const std::array<double, 3>& gains) {
  constexpr int kGainBits = 10;
  std::array<int, 3> factors;  // blue, green, red
  for (std::size_t c = 0; c < 3; ++c) {
    factors[c] = static_cast<int>(std::lround(gains[2 - c] * (1 << kGainBits)));
  }
  for (int y = 0; y < size_.height; ++y) {
    const auto* light = light_.ptr<cv::Vec3s>(y);
    auto* out = drifted_light_.ptr<cv::Vec3s>(y);
    auto* deviation = drifted_deviation_.ptr<cv::Vec3s>(y);
    for (int x = 0; x < size_.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int value =
            std::min((light[x][c] * factors[static_cast<std::size_t>(c)]) >> kGainBits,
                     kBrightest * kFraction);
        out[x][c] = static_cast<std::int16_t>(value);
        deviation[x][c] = noise_of_[static_cast<std::size_t>(value >> kFractionBits)];
      }
    }
  }
}

void CameraEffects::expose(std::uint64_t number, const std::array<double, 3>& gains, cv::Mat& bgr) {
  bgr.create(size_, CV_8UC3);
  if (parameters_.drifts) dim(gains);
  const cv::Mat& seen = parameters_.drifts ? drifted_light_ : light_;
  const cv::Mat& spread = parameters_.drifts ? drifted_deviation_ : deviation_;
  const auto width = static_cast<std::size_t>(3 * size_.width);
  // A generator of its own for each frame: a frame does not depend on those before it.
  Random random(seed_ ^ (0xd1342543de82ef95u * (number + 1)));
  for (int y = 0; y < size_.height; ++y) {
    const std::int16_t* light = seen.ptr<std::int16_t>(y);
    const std::int16_t* normal = gaussian_.data() + random.next() % (kNormals - width);
    const std::int16_t* deviation = spread.ptr<std::int16_t>(y);
    std::uint8_t* out = bgr.ptr<std::uint8_t>(y);
    for (std::size_t i = 0; i < width; ++i) {
      const int value = light[i] + ((deviation[i] * normal[i]) >> kNormalBits);
      out[i] =
          static_cast<std::uint8_t>(std::clamp((value + kFraction / 2) >> kFractionBits, 0, 255));
    }
  }
  if (parameters_.chroma_subsampling) subsample_chroma(bgr);
}

/// One pair of colour differences for 2 × 2 pixels, interpolated as JPEG decoders do: 3/4 of the
/// pixel's own block and 1/4 of the next, along either axis. Full-range BT.601.
void CameraEffects::subsample_chroma(cv::Mat& bgr) {
  cv::split(bgr, planes_.data());  // compilers vectorise planes, not interleaved pixels
  const auto blocks_x = static_cast<std::size_t>((size_.width + 1) / 2);
  const int blocks_y = (size_.height + 1) / 2;
  for (std::vector<float>& differences : chroma_) {
    differences.resize(blocks_x * static_cast<std::size_t>(blocks_y));
  }
  for (int by = 0; by < blocks_y; ++by) average_blocks(by, blocks_x);
  for (int y = 0; y < size_.height; ++y) {
    for (std::size_t c = 0; c < 2; ++c) spread_blocks(y, blocks_x, blocks_y, c);
    std::uint8_t* b = planes_[0].ptr<std::uint8_t>(y);
    std::uint8_t* g = planes_[1].ptr<std::uint8_t>(y);
    std::uint8_t* r = planes_[2].ptr<std::uint8_t>(y);
    const float* cb = chroma_line_[0].data();
    const float* cr = chroma_line_[1].data();
    const auto rounded = [](float v) {
      return static_cast<std::uint8_t>(static_cast<int>(std::clamp(v, 0.0f, 255.0f) + 0.5f));
    };
    for (int x = 0; x < size_.width; ++x) {
      const float luma = 0.299f * r[x] + 0.587f * g[x] + 0.114f * b[x];
      b[x] = rounded(luma + 1.772f * cb[x]);
      g[x] = rounded(luma - 0.344136f * cb[x] - 0.714136f * cr[x]);
      r[x] = rounded(luma + 1.402f * cr[x]);
    }
  }
  cv::merge(planes_.data(), planes_.size(), bgr);
}

void CameraEffects::average_blocks(int block_y, std::size_t blocks_x) {
  std::array<const std::uint8_t*, 3> upper;
  std::array<const std::uint8_t*, 3> lower;
  for (std::size_t c = 0; c < 3; ++c) {
    upper[c] = planes_[c].ptr<std::uint8_t>(2 * block_y);
    lower[c] = planes_[c].ptr<std::uint8_t>(std::min(2 * block_y + 1, size_.height - 1));
  }
  float* cb = chroma_[0].data() + blocks_x * static_cast<std::size_t>(block_y);
  float* cr = chroma_[1].data() + blocks_x * static_cast<std::size_t>(block_y);
  const auto average = [&](std::size_t block, std::size_t left, std::size_t right) {
    const auto mean = [&](std::size_t c) {
      return 0.25f * static_cast<float>(upper[c][left] + upper[c][right] + lower[c][left] +
                                        lower[c][right]);
    };
    const float b = mean(0), g = mean(1), r = mean(2);
    cb[block] = -0.168736f * r - 0.331264f * g + 0.5f * b;
    cr[block] = 0.5f * r - 0.418688f * g - 0.081312f * b;
  };
  const auto whole = static_cast<std::size_t>(size_.width / 2);
  for (std::size_t block = 0; block < whole; ++block) average(block, 2 * block, 2 * block + 1);
  if (whole < blocks_x) average(whole, 2 * whole, 2 * whole);  // odd width
}

/// Interpolates the blocks to the pixels of row `y`.
void CameraEffects::spread_blocks(int y, std::size_t blocks_x, int blocks_y, std::size_t channel) {
  const int own = y / 2;
  const int next = std::clamp(y % 2 == 0 ? own - 1 : own + 1, 0, blocks_y - 1);
  const float* near = chroma_[channel].data() + blocks_x * static_cast<std::size_t>(own);
  const float* far = chroma_[channel].data() + blocks_x * static_cast<std::size_t>(next);
  // One block more at either end, so that the ends need no case of their own.
  block_line_.resize(blocks_x + 2);
  float* line = block_line_.data() + 1;
  for (std::size_t i = 0; i < blocks_x; ++i) line[i] = 0.75f * near[i] + 0.25f * far[i];
  line[-1] = line[0];
  line[blocks_x] = line[blocks_x - 1];
  chroma_line_[channel].resize(2 * blocks_x);
  float* out = chroma_line_[channel].data();
  for (std::size_t i = 0; i < blocks_x; ++i) {
    out[2 * i] = 0.75f * line[i] + 0.25f * block_line_[i];
    out[2 * i + 1] = 0.75f * line[i] + 0.25f * line[i + 1];
  }
}

}  // namespace maggic::synthetic_match
