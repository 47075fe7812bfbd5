#include "calibration/ball_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "calibration/hue_clusters.hpp"
#include "maggic/picture_colors.hpp"

namespace maggic::calibration {
namespace {

constexpr double kMinAreaRatio = 0.4;
constexpr double kMaxAreaRatio = 2.6;  // with what blur adds to it
constexpr double kMaxElongation = 1.6;
constexpr double kFarthestHue = 40.0;
constexpr double kMovesPx = 8.0;
constexpr double kWorthOfMoving = 1.5;  // what moves is rather the ball than what never does
constexpr PeakRules kPeaks{.sigma = 1.5, .min_distance = 4, .max_valley = 0.5, .min_height = 0.01};

class BallSearch {
 public:
  BallSearch(std::span<const FramePatches> patches, const TrackedPattern& pattern,
             const Palette& palette, const TagMetric& metric)
      : patches_(patches), pattern_(pattern), metric_(metric) {
    const DisplayColor shown = palette.display_color(pattern.ball_color);
    ball_hue_ = hue_of({shown.blue, shown.green, shown.red});
  }

  BallSightings find(std::span<const FramePatches> found, const Naming& naming) const {
    std::vector<std::vector<const Patch*>> looks_like(patches_.size());
    HueHistogram histogram{};
    for (std::size_t f = 0; f < patches_.size(); ++f) {
      for (const Patch& patch : patches_[f].patches) {
        if (!has_its_shape(patch) || lies_on_robot(patch, found[f], naming.frames[f])) continue;
        looks_like[f].push_back(&patch);
        histogram[index_of(patch)] += 1.0;
      }
    }
    const HueClusters clusters = cluster_hues(histogram, kPeaks);
    BallSightings sightings;
    sightings.by_frame.resize(patches_.size());
    if (clusters.peaks.empty()) return sightings;
    const int cluster = likeliest(looks_like, clusters);
    for (std::size_t f = 0; f < patches_.size(); ++f) {
      const Patch* best = nullptr;
      for (const Patch* patch : looks_like[f]) {
        if (clusters.of_hue[index_of(*patch)] != cluster) continue;
        if (best == nullptr || shape_cost(*patch) < shape_cost(*best)) best = patch;
      }
      if (best == nullptr) continue;
      sightings.by_frame[f] = *best;
      ++sightings.count;
    }
    return sightings;
  }

 private:
  static std::size_t index_of(const Patch& patch) {
    return static_cast<std::size_t>(std::lround(patch.hue)) % kHues;
  }

  int likeliest(const std::vector<std::vector<const Patch*>>& looks_like,
                const HueClusters& clusters) const {
    std::vector<double> worth(clusters.peaks.size(), 0.0);
    std::vector<cv::Rect2d> places(clusters.peaks.size());
    for (const auto& frame : looks_like) {
      std::map<std::size_t, std::vector<const Patch*>> by_cluster;
      for (const Patch* patch : frame) {
        by_cluster[clusters.of_hue[index_of(*patch)]].push_back(patch);
      }
      for (const auto& [cluster, patches] : by_cluster) {
        const double off = hue_difference(clusters.peaks[cluster], ball_hue_) / kFarthestHue;
        // The ball is the strongest orange there is; wood and leather are paler.
        worth[cluster] += (1.0 - off * off) * patches.front()->median_spread /
                          static_cast<double>(patches.size());
        for (const Patch* patch : patches) {
          places[cluster] |= cv::Rect2d(patch->centroid_px, cv::Size2d(1.0, 1.0));
        }
      }
    }
    for (std::size_t cluster = 0; cluster < worth.size(); ++cluster) {
      const double way_px = std::hypot(places[cluster].width, places[cluster].height);
      if (way_px > kMovesPx) worth[cluster] *= kWorthOfMoving;
    }
    return static_cast<int>(std::ranges::max_element(worth) - worth.begin());
  }

  double area_ratio(const Patch& patch) const {
    const double disc_mm2 = std::numbers::pi / 4.0 * std::pow(pattern_.ball_diameter_mm, 2);
    return patch.area_px * metric_.pixel_mm2() / disc_mm2;
  }
  bool has_its_shape(const Patch& patch) const {
    const double ratio = area_ratio(patch);
    return ratio >= kMinAreaRatio && ratio <= kMaxAreaRatio &&
           patch.elongation() <= kMaxElongation &&
           std::abs(hue_difference(patch.hue, ball_hue_)) <= kFarthestHue;
  }
  double shape_cost(const Patch& patch) const {
    return std::abs(std::log(area_ratio(patch))) + std::log(patch.elongation()) +
           0.2 * patch.companions;
  }

  static bool lies_on_robot(const Patch& patch, const FramePatches& found,
                            const NamedFrame& named) {
    for (std::size_t p = 0; p < found.patches.size(); ++p) {
      if (named.label_of_patch[p] == kBackground) continue;
      const Patch& tag = found.patches[p];
      if (cv::norm(tag.centroid_px - patch.centroid_px) < 0.6 * std::sqrt(tag.area_px)) return true;
    }
    return false;
  }

  std::span<const FramePatches> patches_;
  const TrackedPattern& pattern_;
  const TagMetric& metric_;
  int ball_hue_ = 0;
};

}  // namespace

BallSightings find_ball(std::span<const FramePatches> patches, std::span<const FramePatches> found,
                        const Naming& naming, const TrackedPattern& pattern, const Palette& palette,
                        const TagMetric& metric) {
  return BallSearch(patches, pattern, palette, metric).find(found, naming);
}

}  // namespace maggic::calibration
