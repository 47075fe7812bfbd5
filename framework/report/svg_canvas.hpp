#pragma once
/// The few SVG elements our reports are drawn with. What is put in is always well-formed XML.

#include <span>
#include <string>
#include <string_view>

#include <opencv2/core/types.hpp>

#include "maggic/palette.hpp"

namespace maggic {

/// Escapes what XML gives a meaning; what XML cannot hold becomes U+FFFD.
std::string xml_escaped(std::string_view text);

/// With one or two decimals at most and without trailing zeros, as coordinates need it.
std::string svg_number(double value, int decimals = 1);

/// "#rrggbb".
std::string svg_color(DisplayColor color);

/// An SVG picture in the making, white to begin with. Lengths and places in pixels, y down.
class SvgCanvas {
 public:
  enum class Anchor { kStart, kMiddle, kEnd };

  struct Stroke {
    std::string color = "#000000";
    double width = 1.0;
    std::string_view dashes = {};  ///< As `stroke-dasharray`; empty: solid.
  };

  struct Font {
    double size = 12.0;
    Anchor anchor = Anchor::kStart;
    bool bold = false;
    bool upwards = false;  ///< Turned to be read from below to above.
    std::string color = "#222222";
  };

  explicit SvgCanvas(cv::Size size);

  void line(cv::Point2d from, cv::Point2d to, const Stroke& stroke);
  void polyline(std::span<const cv::Point2d> points, const Stroke& stroke);
  void rectangle(cv::Rect2d box, std::string_view fill, double opacity = 1.0);
  void frame(cv::Rect2d box, const Stroke& stroke);
  void circle(cv::Point2d center, double radius, std::string_view fill, const Stroke& stroke);
  void polygon(std::span<const cv::Point2d> points, std::string_view fill, const Stroke& stroke);
  void text(cv::Point2d at, std::string_view text, const Font& font);

  /// What is drawn until `end_clip` is seen inside `box` only; its coordinates stay the picture's.
  void begin_clip(cv::Rect2d box);
  void end_clip();

  /// The whole document; the canvas is empty afterwards.
  std::string finish();

 private:
  void add_points(std::span<const cv::Point2d> points);
  void add_stroke(const Stroke& stroke);

  std::string svg_;
};

/// About how wide `text` is drawn; no font is asked.
double text_width(std::string_view text, double font_size);

}  // namespace maggic
