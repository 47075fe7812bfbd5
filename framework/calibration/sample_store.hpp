#pragma once
/// Keeps the pixels a segmenter is fitted to.

#include <cstdint>
#include <span>
#include <vector>

#include "calibration/ball_search.hpp"
#include "calibration/strays.hpp"
#include "maggic/color_samples.hpp"
#include "maggic/normalizer.hpp"

namespace maggic::calibration {

class SampleStore {
 public:
  /// Takes pixels of every named patch and of the ball and, thinned out, of what lies apart from
  /// all of them.
  /// @param found,named,ball of the same frames.
  SampleStore(std::span<const ChromaFrame> frames, std::span<const FramePatches> found,
              const Naming& named, const BallSightings& ball, Label ball_color);

  /// Adds the heart of strays, as background that must not be taken for tags.
  void add_strays(std::span<const ChromaFrame> frames, std::span<const std::vector<Stray>> strays);

  /// Adds the tags' pixels as they would look under warmer, colder and dimmer light.
  void imagine_other_light(const ColorNormalizer& normalizer);

  /// Borrows from this store.
  ColorSamples samples(const Palette& palette, const GrayThreshold& gray_threshold) const;

 private:
  struct Planes {
    std::vector<std::uint8_t> b, g, r;
    void add(cv::Vec3b bgr);
    ColorBatch batch() const { return {b, g, r}; }
    MutableColorBatch mutable_batch() { return {b, g, r}; }
    void resize(std::size_t size);
  };

  void add(const ChromaFrame& frame, cv::Point pixel, Label label, std::int32_t tag);
  void add_tag(const ChromaFrame& frame, const Patch& patch, Label label);
  void add_background(const ChromaFrame& frame, const std::vector<const Patch*>& tags,
                      std::size_t wanted);

  Planes original_;
  Planes normalized_;
  std::vector<Label> labels_;
  std::vector<std::int32_t> tags_;
  std::int32_t next_tag_ = 0;

  Planes imagined_original_;
  Planes imagined_normalized_;
  std::vector<Label> imagined_labels_;
};

}  // namespace maggic::calibration
