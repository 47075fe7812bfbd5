#pragma once
/// Are the borders between colours where no tag's colour is? A border that cuts through the colours
/// of a tag makes its pixels flicker between two labels with every change of the light.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "maggic/frame_result.hpp"
#include "maggic/pipeline.hpp"

namespace maggic {

/// Colours of the blobs of a few frames, spread evenly over all that were offered. Only pixels of
/// blobs count, that is of regions within the `blobs:` limits: specks of noise have every colour.
class BlobColors {
 public:
  static constexpr std::size_t kMaxFrames = 8;
  /// Of one frame, spread evenly over its blobs.
  static constexpr std::size_t kMaxPixels = 20'000;

  /// Takes the colours of a processed frame when its turn has come: of 8, 16, 32, … frames every
  /// first, second, fourth, … is kept. Cheap enough for the run loop's `on_frame`.
  /// @param gains what the pipeline multiplied the frame's colours by, if anything:
  ///   Pipeline::channel_gains().
  void offer(const FrameResult& result, const ChannelGains* gains = nullptr);

  /// One colour and in how many pixels it was seen.
  struct Count {
    std::uint8_t b = 0;
    std::uint8_t g = 0;
    std::uint8_t r = 0;
    std::uint32_t pixels = 0;
  };
  /// Every colour once.
  std::vector<Count> counts() const;

 private:
  std::vector<std::vector<std::uint32_t>> frames_;  ///< Colours as 0xRRGGBB, repeated as seen.
  std::uint64_t offered_ = 0;
  std::uint64_t stride_ = 1;
};

/// Two colours whose regions meet, or overlap, where there are pixels.
struct DoubtfulBorder {
  enum class Kind {
    kCut,      ///< The border cuts through seen colours.
    kOverlap,  ///< Both regions hold seen colours; `first` gets them because it comes first.
  };

  Kind kind = Kind::kCut;
  Label first = kBackground;
  Label second = kBackground;
  /// Part of a label's pixels that lie at the border or in the overlap, 0 … 1. The second label has
  /// no pixels in an overlap: there it is 0.
  double share_of_first = 0.0;
  double share_of_second = 0.0;
  /// Where the border is, in 1/256 of the hue circle, if it is one between hues.
  std::optional<int> hue;

  /// One sentence: "the border between red and orange at hue 7 cuts through …".
  std::string to_string(const Palette& palette) const;
};

/// When a border is worth a word.
struct BorderLimits {
  /// A pixel lies at a border when it would change from one colour to another (not to background)
  /// if its hue were up to so many 1/256 of the circle to either side …
  int hue_steps = 2;
  /// … or if all its channels were so much brighter or darker, as a part.
  double gain = 0.05;
  double min_share = 0.05;        ///< Of the pixels of either colour …
  std::uint64_t min_pixels = 50;  ///< … and at least so many, so that a speck is no reason.
};

/// The doubtful borders of what the pipeline makes of these colours, the worst first. Empty for
/// stages that judge the picture as a whole: they have no borders between colours.
///
/// For `hue_pivots` the answer is exact to the rounding of 8-bit channels: brightness does not move
/// a hue, so what is found are pixels within `hue_steps` of the hue where the label changes.
std::vector<DoubtfulBorder> find_doubtful_borders(const Pipeline& pipeline,
                                                  const BlobColors& colors,
                                                  const BorderLimits& limits = {});

}  // namespace maggic
