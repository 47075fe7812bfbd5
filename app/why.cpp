#include "app/why.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "app/text_table.hpp"

namespace maggic::app {
namespace {

constexpr double kMaxPixel = 65535.0;  // a frame's longest side

bool read_pixel(std::string_view text, int& pixel) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || !(std::abs(number) <= kMaxPixel)) return false;
  pixel = static_cast<int>(std::lround(number));
  return true;
}

cv::Point pixel_from(std::string_view text) {
  const std::size_t comma = text.find(',');
  cv::Point pixel;
  if (comma == std::string_view::npos || !read_pixel(text.substr(0, comma), pixel.x) ||
      !read_pixel(text.substr(comma + 1), pixel.y)) {
    throw std::invalid_argument(fmt::format(
        "--why: found '{}', expected a point of the picture in pixels: X,Y, such as 320,240",
        text));
  }
  return pixel;
}

std::string text_of(const std::vector<StageAnswer>& answers, std::size_t width) {
  TextTable table({TextTable::Align::kLeft, TextTable::Align::kLeft});
  for (const StageAnswer& answer : answers) {
    std::string_view rest = answer.text;
    std::string stage = answer.stage;
    while (true) {
      const std::size_t end = rest.find('\n');
      table.add({std::move(stage), std::string(rest.substr(0, end))});
      if (end == std::string_view::npos) break;
      rest.remove_prefix(end + 1);
      stage.clear();
    }
  }
  return table.to_string(2, width);
}

}  // namespace

Why::Why(const WhyOptions& options) : wanted_frame_(options.frame) {
  for (const std::string& point : options.points) points_.push_back({pixel_from(point), {}});
}

void Why::look(const Pipeline& pipeline, const FrameResult& result, std::atomic<bool>& stop) {
  if (points_.empty() || !mistake_.empty()) return;
  const cv::Rect picture_px(cv::Point(), result.frame.bgr.size());
  for (const Point& point : points_) {
    if (picture_px.contains(point.pixel_px)) continue;
    mistake_ = fmt::format("--why: {},{} lies outside of the picture, which is {} × {} pixels",
                           point.pixel_px.x, point.pixel_px.y, picture_px.width, picture_px.height);
    stop = true;
    return;
  }
  last_frame_ = result.frame.sequence;
  if (wanted_frame_ && *wanted_frame_ != result.frame.sequence) return;
  for (Point& point : points_) point.answers = explain_point(pipeline, result, point.pixel_px);
  explained_frame_ = result.frame.sequence;
}

ExitCode Why::print(std::FILE* out, Console& console) const {
  if (points_.empty()) return kFine;
  std::string mistake = mistake_;
  if (mistake.empty() && !explained_frame_ && wanted_frame_ && last_frame_) {
    mistake = fmt::format("--why-frame: frame {} was never processed; the last one was {}",
                          *wanted_frame_, *last_frame_);
  }
  if (!mistake.empty()) {
    console.line(mistake, Console::Tone::kError, "error: ");
    return kMistake;
  }
  if (!explained_frame_) return kFine;  // no frame at all, which the run says itself
  for (const Point& point : points_) {
    fmt::print(out, "why {},{} in frame {}\n{}", point.pixel_px.x, point.pixel_px.y,
               *explained_frame_,
               text_of(point.answers, static_cast<std::size_t>(console.width())));
  }
  std::fflush(out);
  return kFine;
}

}  // namespace maggic::app
