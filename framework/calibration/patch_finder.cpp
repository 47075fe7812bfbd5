#include "calibration/patch_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "calibration/hue_clusters.hpp"

namespace maggic::calibration {
namespace {

// A region may be several robots side by side, but not a wall or the floor.
constexpr double kMaxRegionShare = 0.025;
constexpr int kMinRegionPx = 12;
constexpr int kMinPatchPx = 8;
constexpr double kMinPatchShare = 0.05;  // of its region
// Two colours of one region lie so far apart in hue, and so few of its pixels lie between.
constexpr PeakRules kRegionPeaks{
    .sigma = 2.0, .min_distance = 6, .max_valley = 0.6, .min_height = 0.08};
constexpr double kMaxElongation = 4.5;
constexpr double kMinFill = 0.7;

void measure(const ChromaFrame& frame, Patch& patch) {
  cv::Point2d sum;
  double sine = 0.0;
  double cosine = 0.0;
  std::vector<std::uint8_t> spreads;
  spreads.reserve(patch.pixels.size());
  for (const cv::Point& p : patch.pixels) {
    sum += cv::Point2d(p);
    const double angle = frame.hue.at<std::uint8_t>(p) * std::numbers::pi / 128.0;
    sine += std::sin(angle);
    cosine += std::cos(angle);
    spreads.push_back(frame.spread.at<std::uint8_t>(p));
  }
  const auto count = static_cast<double>(patch.pixels.size());
  patch.area_px = count;
  patch.centroid_px = sum / count;
  patch.hue = std::atan2(sine, cosine) * 128.0 / std::numbers::pi;
  if (patch.hue < 0.0) patch.hue += kHues;
  const auto middle = spreads.begin() + static_cast<std::ptrdiff_t>(spreads.size() / 2);
  std::nth_element(spreads.begin(), middle, spreads.end());
  patch.median_spread = *middle;
  patch.moments_px2 = {1.0 / 12.0, 0.0, 0.0, 1.0 / 12.0};
  double squares = 0.0;
  std::vector<double> turns;
  turns.reserve(patch.pixels.size());
  for (const cv::Point& p : patch.pixels) {
    const cv::Point2d off = cv::Point2d(p) - patch.centroid_px;
    patch.moments_px2 +=
        cv::Matx22d(off.x * off.x, off.x * off.y, off.x * off.y, off.y * off.y) * (1.0 / count);
    const double turned = hue_difference(frame.hue.at<std::uint8_t>(p), patch.hue);
    squares += turned * turned;
    turns.push_back(turned);
  }
  // The median: the rim is mixed with the neighbour's colour.
  const auto middle_turn = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), middle_turn, turns.end());
  patch.hue = std::fmod(patch.hue + *middle_turn + kHues, kHues);
  patch.hue_deviation = std::sqrt(squares / count);
}

/// Eigenvalues of the second moments, larger first.
std::array<double, 2> principal_variances(const cv::Matx22d& m) {
  const double mean = (m(0, 0) + m(1, 1)) / 2.0;
  const double half = std::hypot((m(0, 0) - m(1, 1)) / 2.0, m(0, 1));
  return {mean + half, mean - half};
}

bool is_compact(const Patch& patch) {
  const auto [major, minor] = principal_variances(patch.moments_px2);
  const double fill = patch.area_px / (4.0 * std::numbers::pi * std::sqrt(major * minor));
  return patch.elongation() <= kMaxElongation && fill >= kMinFill;
}

/// Cuts one region of colour into patches.
class RegionCutter {
 public:
  RegionCutter(const ChromaFrame& frame, const cv::Mat& regions)
      : frame_(frame), regions_(regions) {}

  void cut(int region, cv::Rect box, int area_px, std::vector<Patch>& patches) {
    HueHistogram histogram{};
    for (int y = box.y; y < box.br().y; ++y) {
      const int* region_of = regions_.ptr<int>(y);
      for (int x = box.x; x < box.br().x; ++x) {
        if (region_of[x] != region) continue;
        histogram[frame_.hue.at<std::uint8_t>(y, x)] += frame_.spread.at<std::uint8_t>(y, x);
      }
    }
    const HueClusters clusters = cluster_hues(histogram, kRegionPeaks);
    const std::size_t first = patches.size();
    for (std::size_t peak = 0; peak < clusters.peaks.size(); ++peak) {
      mask_.create(box.size(), CV_8UC1);
      for (int y = 0; y < box.height; ++y) {
        const int* region_of = regions_.ptr<int>(box.y + y) + box.x;
        const std::uint8_t* hue = frame_.hue.ptr<std::uint8_t>(box.y + y) + box.x;
        for (int x = 0; x < box.width; ++x) {
          mask_.at<std::uint8_t>(y, x) =
              region_of[x] == region && clusters.of_hue[hue[x]] == peak ? 255 : 0;
        }
      }
      add_parts(box.tl(), std::max<int>(kMinPatchPx, static_cast<int>(kMinPatchShare * area_px)),
                patches);
    }
    for (std::size_t i = first; i < patches.size(); ++i) {
      patches[i].companions = static_cast<int>(patches.size() - first) - 1;
    }
  }

 private:
  void add_parts(cv::Point origin, int min_area_px, std::vector<Patch>& patches) {
    const int count = cv::connectedComponentsWithStats(mask_, parts_, stats_, centroids_, 4);
    for (int part = 1; part < count; ++part) {
      if (stats_.at<int>(part, cv::CC_STAT_AREA) < min_area_px) continue;
      const cv::Rect box(
          stats_.at<int>(part, cv::CC_STAT_LEFT), stats_.at<int>(part, cv::CC_STAT_TOP),
          stats_.at<int>(part, cv::CC_STAT_WIDTH), stats_.at<int>(part, cv::CC_STAT_HEIGHT));
      Patch patch;
      for (int y = box.y; y < box.br().y; ++y) {
        for (int x = box.x; x < box.br().x; ++x) {
          if (parts_.at<int>(y, x) == part) patch.pixels.push_back(cv::Point(x, y) + origin);
        }
      }
      measure(frame_, patch);
      if (is_compact(patch)) patches.push_back(std::move(patch));
    }
  }

  const ChromaFrame& frame_;
  const cv::Mat& regions_;
  cv::Mat mask_;
  cv::Mat parts_;
  cv::Mat stats_;
  cv::Mat centroids_;
};

}  // namespace

double Patch::elongation() const {
  const auto [major, minor] = principal_variances(moments_px2);
  return std::sqrt(major / minor);
}

std::vector<Patch> find_patches(const ChromaFrame& frame, int gray_threshold) {
  cv::Mat regions;
  cv::Mat stats;
  cv::Mat centroids;
  const int count =
      cv::connectedComponentsWithStats(frame.spread > gray_threshold, regions, stats, centroids, 4);
  const double max_area_px = kMaxRegionShare * static_cast<double>(frame.spread.total());
  RegionCutter cutter(frame, regions);
  std::vector<Patch> patches;
  for (int region = 1; region < count; ++region) {
    const int area_px = stats.at<int>(region, cv::CC_STAT_AREA);
    if (area_px < kMinRegionPx || area_px > max_area_px) continue;
    cutter.cut(
        region,
        {stats.at<int>(region, cv::CC_STAT_LEFT), stats.at<int>(region, cv::CC_STAT_TOP),
         stats.at<int>(region, cv::CC_STAT_WIDTH), stats.at<int>(region, cv::CC_STAT_HEIGHT)},
        area_px, patches);
  }
  return patches;
}

}  // namespace maggic::calibration
