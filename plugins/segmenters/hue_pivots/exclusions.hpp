#pragma once
/// Rectangles of hue and value or saturation that are always background.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "circular_span.hpp"
#include "maggic/color_batch.hpp"
#include "maggic/color_box.hpp"
#include "maggic/palette.hpp"
#include "maggic/parameters.hpp"

namespace maggic::hue_pivots {

/// The parameter `exclude` and what comes of it. Hues are given by those who have them: they are
/// looked up for the pivots as well.
class Exclusions {
 public:
  /// Colours that `clear` takes at once.
  static constexpr std::size_t kMostAtOnce = 1024;

  void describe(Parameters& p);
  /// To be called once they are read.
  void prepare();

  bool empty() const { return rectangles_.empty(); }

  enum class Held { kNone, kSome, kAll };
  /// How many of the box's colours, whose hues are within `hues`, they hold.
  Held held(const ColorBox& box, const CircularSpan& hues) const;

  /// Makes background of the labels of colours they hold.
  /// @param colors at most kMostAtOnce. @param hue_indices where in `hues` that of each stands.
  void clear(const ColorBatch& colors, const std::vector<std::uint8_t>& hues,
             const std::uint32_t* hue_indices, std::span<Label> labels) const;

  /// Names the first that holds a colour; empty when none does.
  std::string text_of(std::uint8_t hue, std::uint8_t value, int spread) const;

  /// As OpenCV has it.
  std::uint8_t saturation_of(std::uint8_t value, int spread) const;

 private:
  /// All three spans must hold.
  struct Exclusion {
    std::vector<int> hue{0, 255};
    std::vector<int> value{0, 255};
    std::vector<int> saturation{0, 255};
  };
  /// The same, to be compared with.
  struct Rectangle {
    CircularSpan hue;
    CircularSpan value;
    CircularSpan saturation;

    explicit Rectangle(const Exclusion& exclusion);
  };
  struct HsvPlanes;

  static void describe_one(Parameters& p, Exclusion& exclusion);
  static void clear_inside(const Rectangle& rectangle, const HsvPlanes& planes,
                           std::span<Label> labels);
  CircularSpan saturation_span(const ColorBox& box) const;

  std::vector<Exclusion> exclusions_;
  std::vector<Rectangle> rectangles_;  ///< One for each of exclusions_.
  std::array<std::int32_t, 256> saturation_scales_{};
};

}  // namespace maggic::hue_pivots
