#include "report/svg_canvas.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "config/characters.hpp"

namespace maggic {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
constexpr double kMeanGlyphWidth = 0.56;  // of the font size, in common sans-serif fonts

std::string_view name_of(SvgCanvas::Anchor anchor) {
  switch (anchor) {
    case SvgCanvas::Anchor::kMiddle: return "middle";
    case SvgCanvas::Anchor::kEnd: return "end";
    case SvgCanvas::Anchor::kStart: break;
  }
  return "start";
}

/// XML 1.0 has no place for U+FFFE and U+FFFF, well-formed as they are.
bool is_noncharacter(std::string_view character) {
  return character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, length);
    if (length == 0 || invisible_length(text) > 0 || is_noncharacter(character)) {
      escaped += kReplacement;
    } else if (character == "&") {
      escaped += "&amp;";
    } else if (character == "<") {
      escaped += "&lt;";
    } else if (character == ">") {
      escaped += "&gt;";
    } else if (character == "\"") {
      escaped += "&quot;";
    } else if (character == "'") {
      escaped += "&apos;";
    } else {
      escaped += character;
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return escaped;
}

std::string svg_number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string svg_color(DisplayColor color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

double text_width(std::string_view text, double font_size) {
  return kMeanGlyphWidth * font_size * static_cast<double>(characters_in(text));
}

SvgCanvas::SvgCanvas(cv::Size size) {
  fmt::format_to(std::back_inserter(svg_),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                 "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\">\n",
                 size.width, size.height);
  rectangle({0.0, 0.0, static_cast<double>(size.width), static_cast<double>(size.height)},
            "#ffffff");
}

void SvgCanvas::add_points(std::span<const cv::Point2d> points) {
  svg_ += " points=\"";
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) svg_ += ' ';
    svg_ += svg_number(points[i].x) + ',' + svg_number(points[i].y);
  }
  svg_ += '"';
}

void SvgCanvas::add_stroke(const Stroke& stroke) {
  fmt::format_to(std::back_inserter(svg_), " stroke=\"{}\" stroke-width=\"{}\"", stroke.color,
                 svg_number(stroke.width, 2));
  if (!stroke.dashes.empty()) svg_ += fmt::format(" stroke-dasharray=\"{}\"", stroke.dashes);
}

void SvgCanvas::line(cv::Point2d from, cv::Point2d to, const Stroke& stroke) {
  fmt::format_to(std::back_inserter(svg_), "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"",
                 svg_number(from.x), svg_number(from.y), svg_number(to.x), svg_number(to.y));
  add_stroke(stroke);
  svg_ += "/>\n";
}

void SvgCanvas::polyline(std::span<const cv::Point2d> points, const Stroke& stroke) {
  svg_ += "<polyline fill=\"none\" stroke-linejoin=\"round\"";
  add_stroke(stroke);
  add_points(points);
  svg_ += "/>\n";
}

void SvgCanvas::polygon(std::span<const cv::Point2d> points, std::string_view fill,
                        const Stroke& stroke) {
  svg_ += fmt::format("<polygon fill=\"{}\"", fill);
  add_stroke(stroke);
  add_points(points);
  svg_ += "/>\n";
}

void SvgCanvas::rectangle(cv::Rect2d box, std::string_view fill, double opacity) {
  fmt::format_to(
      std::back_inserter(svg_), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"",
      svg_number(box.x), svg_number(box.y), svg_number(box.width), svg_number(box.height), fill);
  if (opacity < 1.0) svg_ += fmt::format(" fill-opacity=\"{}\"", svg_number(opacity, 2));
  svg_ += "/>\n";
}

void SvgCanvas::frame(cv::Rect2d box, const Stroke& stroke) {
  fmt::format_to(
      std::back_inserter(svg_), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\"",
      svg_number(box.x), svg_number(box.y), svg_number(box.width), svg_number(box.height));
  add_stroke(stroke);
  svg_ += "/>\n";
}

void SvgCanvas::circle(cv::Point2d center, double radius, std::string_view fill,
                       const Stroke& stroke) {
  fmt::format_to(std::back_inserter(svg_), "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"",
                 svg_number(center.x), svg_number(center.y), svg_number(radius), fill);
  add_stroke(stroke);
  svg_ += "/>\n";
}

void SvgCanvas::text(cv::Point2d at, std::string_view text, const Font& font) {
  fmt::format_to(std::back_inserter(svg_),
                 "<text x=\"{0}\" y=\"{1}\" font-size=\"{2}\" text-anchor=\"{3}\" fill=\"{4}\"",
                 svg_number(at.x), svg_number(at.y), svg_number(font.size), name_of(font.anchor),
                 font.color);
  if (font.bold) svg_ += " font-weight=\"bold\"";
  if (font.upwards) {
    svg_ += fmt::format(" transform=\"rotate(-90 {} {})\"", svg_number(at.x), svg_number(at.y));
  }
  svg_ += '>' + xml_escaped(text) + "</text>\n";
}

// A nested picture clips without the identifier a clipPath needs.
void SvgCanvas::begin_clip(cv::Rect2d box) {
  fmt::format_to(std::back_inserter(svg_),
                 "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" "
                 "viewBox=\"{0} {1} {2} {3}\">\n",
                 svg_number(box.x), svg_number(box.y), svg_number(box.width),
                 svg_number(box.height));
}

void SvgCanvas::end_clip() { svg_ += "</svg>\n"; }

std::string SvgCanvas::finish() {
  svg_ += "</svg>\n";
  return std::exchange(svg_, {});
}

}  // namespace maggic
