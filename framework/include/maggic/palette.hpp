#pragma once
/// The colours a pipeline can tell apart, by name and by label.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace maggic {

/// What a pixel is taken for: an index into the pipeline's Palette. 0 is background.
using Label = std::uint8_t;

inline constexpr Label kBackground = 0;

/// A colour as a person sees it, 8 bit a channel; used for drawing only, never for segmenting.
struct DisplayColor {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  friend bool operator==(const DisplayColor&, const DisplayColor&) = default;
};

/// The ordered set of named colours of one pipeline. Label 0 is always `background`; named colours
/// are labels 1 … size()-1. Palettes are data: a pipeline file may add colours or redraw them.
class Palette {
 public:
  /// A palette with background alone.
  Palette();

  /// orange, blue, yellow, red, green, magenta, cyan, purple, brown as labels 1 … 9.
  static Palette standard();

  /// Adds `name`, or changes how it is drawn where it exists; returns its label.
  /// @param name non-empty, lower-case letters, digits and `_`, starting with a letter.
  /// @throws std::invalid_argument for a malformed name, for `background`, or past 255 colours.
  Label set(std::string_view name, DisplayColor color);

  /// The label of `name`; nothing when the palette does not hold it. `background` is label 0.
  std::optional<Label> find(std::string_view name) const;

  /// @param label in [0, size()). @throws std::out_of_range otherwise.
  std::string_view name(Label label) const;
  DisplayColor display_color(Label label) const;

  /// Number of labels, background included: 1 … 256.
  std::size_t size() const { return entries_.size(); }

  /// "orange, blue, yellow, …" without background, for messages.
  std::string known_names() const;

 private:
  struct Entry {
    std::string name;
    DisplayColor color;
  };
  std::vector<Entry> entries_;
};

}  // namespace maggic
