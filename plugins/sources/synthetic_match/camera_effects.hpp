#pragma once
/// What lamp, lens, sensor and link make of an ideal picture.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace maggic::synthetic_match {

struct CameraEffectsParameters {
  double brightness = 1.0;
  double gradient = 0.0;
  double gradient_direction_deg = 20.0;
  std::array<double, 3> color_gains{1.0, 1.0, 1.0};  ///< Red, green, blue.
  double blur_px = 0.5;
  double noise = 2.0;
  double shot_noise = 1.5;
  bool chroma_subsampling = false;
  bool drifts = false;  ///< Whether `expose` is given factors other than 1.
};

/// Keeps the lit and blurred picture and develops only what changed; noise is drawn anew for every
/// frame. Deterministic by seed and frame number.
class CameraEffects {
 public:
  /// @param lamps factors on blue, green, red of every pixel (CV_32FC3); empty: all 1.
  CameraEffects(const CameraEffectsParameters& parameters, cv::Size picture, cv::Mat lamps,
                std::uint64_t seed);

  /// Lights and blurs the part `box` of `scene` (CV_32FC3) and what blur carries beyond it.
  void develop(const cv::Mat& scene, cv::Rect box);

  /// Adds the noise of frame `number` and writes 8-bit B G R. `bgr` is reused when it fits.
  /// @param gains factors of this frame on red, green, blue; looked at only when the light drifts.
  void expose(std::uint64_t number, const std::array<double, 3>& gains, cv::Mat& bgr);

 private:
  void blur_rows(const cv::Mat& scene, cv::Rect box);
  void blur_columns(cv::Rect box);
  void dim(const std::array<double, 3>& gains);
  void subsample_chroma(cv::Mat& bgr);
  void average_blocks(int block_y, std::size_t blocks_x);
  void spread_blocks(int y, std::size_t blocks_x, int blocks_y, std::size_t channel);

  CameraEffectsParameters parameters_;
  cv::Size size_;
  std::uint64_t seed_;
  cv::Mat lamps_;
  std::vector<float> kernel_;  ///< Odd length, sums to 1.
  cv::Mat light_;              ///< CV_16SC3: light on the sensor in 1/64 of a step.
  cv::Mat deviation_;          ///< CV_16SC3: of the noise there, in 1/64 of a step.
  cv::Mat drifted_light_;      ///< Both again as they are at the moment, where the light drifts.
  cv::Mat drifted_deviation_;

  std::vector<float> padded_row_;
  std::vector<float> blurred_rows_;
  std::vector<float> line_;
  std::vector<std::int16_t> gaussian_;  ///< Standard normal numbers in 1/256.
  std::vector<std::int16_t> noise_of_;  ///< Standard deviation by light in whole steps.
  std::array<cv::Mat, 3> planes_;
  std::array<std::vector<float>, 2> chroma_;       ///< Blue and red difference of each block.
  std::array<std::vector<float>, 2> chroma_line_;  ///< The same for the pixels of a row.
  std::vector<float> block_line_;
};

}  // namespace maggic::synthetic_match
