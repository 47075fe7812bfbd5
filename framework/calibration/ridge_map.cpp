#include "calibration/ridge_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace maggic::calibration {
namespace {

constexpr std::size_t kMaxLines = 14;
constexpr double kMaxSlope = 0.36;       // tan 20°
constexpr double kSamePositionPx = 2.5;  // pieces of one line
constexpr double kSameSlope = 0.012;

/// Against the pixels `offset` to either side; beyond the picture its edge goes on.
void raise_ridges(const cv::Mat& gray, cv::Point offset, cv::Mat& ridges) {
  for (int y = 0; y < gray.rows; ++y) {
    const std::uint8_t* here = gray.ptr<std::uint8_t>(y);
    const std::uint8_t* before = gray.ptr<std::uint8_t>(std::max(y - offset.y, 0));
    const std::uint8_t* after = gray.ptr<std::uint8_t>(std::min(y + offset.y, gray.rows - 1));
    std::uint8_t* out = ridges.ptr<std::uint8_t>(y);
    for (int x = 0; x < gray.cols; ++x) {
      const int higher =
          std::max(before[std::max(x - offset.x, 0)], after[std::min(x + offset.x, gray.cols - 1)]);
      out[x] = static_cast<std::uint8_t>(std::max<int>(out[x], here[x] - higher));
    }
  }
}

/// Keeps what is not lower than its neighbours across the line.
cv::Mat thin(const cv::Mat& ridges, Direction direction, int min_contrast) {
  cv::Mat crest = cv::Mat::zeros(ridges.size(), CV_8UC1);
  const cv::Point across = direction == Direction::kUpright ? cv::Point(1, 0) : cv::Point(0, 1);
  for (int y = 1; y + 1 < ridges.rows; ++y) {
    for (int x = 1; x + 1 < ridges.cols; ++x) {
      const int here = ridges.at<std::uint8_t>(y, x);
      if (here < min_contrast) continue;
      const cv::Point p(x, y);
      if (here >= ridges.at<std::uint8_t>(p - across) &&
          here > ridges.at<std::uint8_t>(p + across)) {
        crest.at<std::uint8_t>(p) = 255;
      }
    }
  }
  return crest;
}

}  // namespace

RidgeMap make_ridge_map(const cv::Mat& gray, int max_width_px) {
  RidgeMap map{cv::Mat::zeros(gray.size(), CV_8UC1), cv::Mat::zeros(gray.size(), CV_8UC1)};
  for (int offset = 2; offset <= std::max(2, max_width_px); offset *= 2) {
    raise_ridges(gray, {offset, 0}, map.upright);
    raise_ridges(gray, {0, offset}, map.level);
  }
  return map;
}

std::vector<SeenLine> find_lines(const RidgeMap& ridges, Direction direction, int min_contrast,
                                 double min_length_px) {
  const cv::Mat crest = thin(ridges.of(direction), direction, min_contrast);
  std::vector<cv::Vec4i> pieces;
  const int votes = std::max(8, static_cast<int>(min_length_px * 0.6));
  cv::HoughLinesP(crest, pieces, 1.0, std::numbers::pi / 720.0, votes, min_length_px,
                  min_length_px * 0.25);
  const cv::Point2d middle((crest.cols - 1) / 2.0, (crest.rows - 1) / 2.0);
  std::vector<SeenLine> lines;
  for (const cv::Vec4i& piece : pieces) {
    cv::Point2d a(piece[0], piece[1]);
    cv::Point2d b(piece[2], piece[3]);
    cv::Point2d origin = middle;
    if (direction == Direction::kUpright) {  // along becomes x
      std::swap(a.x, a.y);
      std::swap(b.x, b.y);
      std::swap(origin.x, origin.y);
    }
    if (std::abs(b.y - a.y) > kMaxSlope * std::abs(b.x - a.x)) continue;
    const double slope = (b.y - a.y) / (b.x - a.x);
    lines.push_back({a.y + slope * (origin.x - a.x), slope, cv::norm(b - a)});
  }
  std::ranges::sort(lines, std::greater<>(), &SeenLine::length_px);
  std::vector<SeenLine> joined;
  for (const SeenLine& line : lines) {
    const auto same = std::ranges::find_if(joined, [&](const SeenLine& other) {
      return std::abs(other.position_px - line.position_px) <= kSamePositionPx &&
             std::abs(other.slope - line.slope) <= kSameSlope + 2.0 / line.length_px;
    });
    if (same == joined.end()) {
      joined.push_back(line);
    } else {
      same->length_px += line.length_px;
    }
  }
  std::ranges::sort(joined, std::greater<>(), &SeenLine::length_px);
  if (joined.size() > kMaxLines) joined.resize(kMaxLines);
  return joined;
}

}  // namespace maggic::calibration
