#include "maggic/point_explanation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "inspection/connected_runs.hpp"
#include "maggic/blob_extractor.hpp"
#include "maggic/field_area.hpp"
#include "maggic/longest_runs.hpp"
#include "maggic/picture_colors.hpp"
#include "maggic/scan_area.hpp"
#include "search/predicted_search.hpp"

namespace maggic {
namespace {

/// One colour as a batch; the batch is valid as long as this lives.
struct OneColor {
  std::array<std::uint8_t, 3> bgr{};

  ColorBatch batch() const { return {{&bgr[0], 1}, {&bgr[1], 1}, {&bgr[2], 1}}; }
  MutableColorBatch mutable_batch() { return {{&bgr[0], 1}, {&bgr[1], 1}, {&bgr[2], 1}}; }
  std::string to_string() const { return fmt::format("RGB {} {} {}", bgr[2], bgr[1], bgr[0]); }
};

OneColor color_at(const cv::Mat& bgr, cv::Point pixel_px) {
  const auto& pixel = bgr.at<cv::Vec3b>(pixel_px);
  return {{pixel[0], pixel[1], pixel[2]}};
}

std::string hsv_text(const OneColor& color) {
  const cv::Vec3b value = hsv_of({color.bgr[0], color.bgr[1], color.bgr[2]});
  return fmt::format("hue {}, saturation {}, value {}", value[0], value[1], value[2]);
}

class Walk {
 public:
  Walk(const Pipeline& pipeline, const FrameResult& result, cv::Point pixel_px)
      : pipeline_(pipeline), result_(result), pixel_px_(pixel_px) {}

  std::vector<StageAnswer> answers() {
    original_ = color_at(result_.frame.bgr, pixel_px_);
    add("pixel", fmt::format("{}, {}", original_.to_string(), hsv_text(original_)));
    if (const ChannelGains* gains = pipeline_.channel_gains()) {
      for (std::size_t c = 0; c < 3; ++c) original_.bgr[c] = (*gains)(c, original_.bgr[c]);
      add("light", fmt::format("{}, {}, in the light of the calibration", original_.to_string(),
                               hsv_text(original_)));
    }
    if (!holds(pipeline_.scanned_area(), pixel_px_)) {
      add("scan", holds(pipeline_.field_area(), pixel_px_) ? other_turn_text() : beyond_text());
      return std::move(answers_);
    }
    normalized_ = normalized_color();
    add("normalized",
        fmt::format("{} by {}", normalized_.to_string(), pipeline_.parts().normalizer.name));
    const Run* run = run_at(result_.runs, pixel_px_);
    add_label(run == nullptr ? kBackground : run->label);
    if (run != nullptr) add_blob();
    return std::move(answers_);
  }

 private:
  void add(std::string_view stage, std::string text) {
    answers_.push_back({std::string(stage), std::move(text)});
  }

  std::string beyond_text() const {
    const double beyond_mm = std::ceil(beyond_lines_mm(*pipeline_.field(), pixel_px_));
    const double margin_mm = pipeline_.parts().scan.margin_mm;
    constexpr double kMaxMm = ScanParameters::kMaxMarginMm;
    std::string text = fmt::format(
        "not looked at: beyond the field: {}{} mm outside the lines, scan.margin_mm is {}\n",
        beyond_mm > kMaxMm ? "more than " : "", std::min(beyond_mm, kMaxMm), margin_mm);
    if (beyond_mm <= kMaxMm) {
      text += fmt::format("scan.margin_mm {} would take it in; ", beyond_mm);
    }
    return text + "if it is nearer to the field than that, field.corners_px are not its corners";
  }

  std::string other_turn_text() const {
    return fmt::format(
        "not looked at in this frame: with scan.search: predicted that is only round what was seen "
        "last, and one part of the field in turn\n"
        "this place's turn comes within scan.unseen_frames, {}; scan.search: full looks at all of "
        "it in every frame",
        unseen_frames_text());
  }

  std::string cut_text(const Blob& blob) const {
    return fmt::format(
        "{} px of it were looked at in this frame, around {:.1f},{:.1f}\n"
        "dropped: with scan.search: predicted, as it may go on where this frame was not looked at\n"
        "a tag or a ball is seen whole within scan.unseen_frames, {}; scan.search: full looks at "
        "all of the field in every frame",
        blob.area_px, blob.centroid_px.x, blob.centroid_px.y, unseen_frames_text());
  }

  std::string unseen_frames_text() const {
    const int frames = pipeline_.parts().scan.unseen_frames;
    return fmt::format("{} frame{}", frames, frames == 1 ? "" : "s");
  }

  OneColor normalized_color() const {
    if (const cv::Mat* picture = pipeline_.normalized_picture()) {
      return color_at(*picture, pixel_px_);
    }
    OneColor color;
    const Normalizer& stage = *pipeline_.parts().normalizer.stage;
    dynamic_cast<const ColorNormalizer&>(stage).normalize(original_.batch(), color.mutable_batch());
    return color;
  }

  void add_label(Label label) {
    std::string text(pipeline_.palette().name(label));
    const auto& named = pipeline_.parts().segmenter;
    if (const auto* by_color = dynamic_cast<const ColorSegmenter*>(named.stage.get())) {
      const std::string why = by_color->explain(original_.batch(), normalized_.batch());
      if (!why.empty()) text += ": " + why;
    } else {
      text += fmt::format(": {} judges the picture as a whole and gives no reason for one pixel",
                          named.name);
    }
    if (label == kBackground) text += nearest_blob_text();
    add("label", std::move(text));
  }

  /// People point beside things; empty when there is nothing near.
  std::string nearest_blob_text() const {
    constexpr double kNearPx = 15.0;
    const Run* nearest = nullptr;
    double nearest_px = kNearPx;
    for (const Run& run : result_.runs) {
      const int dx = std::max({run.begin - pixel_px_.x, 0, pixel_px_.x - (run.end - 1)});
      const double distance_px = std::hypot(dx, run.row - pixel_px_.y);
      if (distance_px >= nearest_px) continue;
      nearest_px = distance_px;
      nearest = &run;
    }
    if (nearest == nullptr) return {};
    return fmt::format(
        "\nthe nearest coloured pixel is {} at {},{}", pipeline_.palette().name(nearest->label),
        std::clamp<int>(pixel_px_.x, nearest->begin, nearest->end - 1), nearest->row);
  }

  void add_blob() {
    LongestRuns longest;
    const std::vector<Run> region =
        connected_runs(longest.keep(result_.runs, pipeline_.blob_limits_px().max_runs), pixel_px_);
    if (region.empty()) {
      add("blob", fmt::format("dropped: {}", run_limit_text(longest.shortest_px())));
      return;
    }
    BlobExtractor extractor;
    std::vector<Blob> found;
    extractor.extract(region, {0.0, std::numeric_limits<double>::max(), 1, region.size()}, found);
    const Blob& blob = found.front();
    const auto& blobs = result_.blobs;
    const auto kept = std::ranges::find_if(blobs, [&](const Blob& other) {
      return other.label == blob.label && other.area_px == blob.area_px &&
             other.bounds_px == blob.bounds_px && other.centroid_px == blob.centroid_px;
    });
    if (kept == blobs.end() &&
        may_go_on_unseen(blob, pipeline_.scanned_area(), pipeline_.field_area())) {
      add("blob", cut_text(blob));
      return;
    }
    std::string text = fmt::format(
        "{} px, {:.0f} mm² (limits {} … {} mm²), {}×{} px around {:.1f},{:.1f}", blob.area_px,
        blob.area_px * pipeline_.blob_scale_mm2_per_px(), pipeline_.parts().blobs.min_area_mm2,
        pipeline_.parts().blobs.max_area_mm2, blob.bounds_px.width, blob.bounds_px.height,
        blob.centroid_px.x, blob.centroid_px.y);
    if (longest.shortest_px() > 1) text += '\n' + run_limit_text(longest.shortest_px());
    if (kept == blobs.end()) {
      add("blob", fmt::format("{}\ndropped: {}", text, limit_text(blob)));
      return;
    }
    add("blob", std::move(text));
    add_tracker(static_cast<std::size_t>(kept - blobs.begin()));
  }

  std::string run_limit_text(int shortest_px) const {
    return fmt::format(
        "the frame has {} runs (stretches of one colour along a row), more than blobs.max_runs {}, "
        "and those shorter than {} px were left out",
        result_.runs.size(), pipeline_.blob_limits_px().max_runs, shortest_px);
  }

  std::string limit_text(const Blob& blob) const {
    const BlobExtractor::Limits& limits = pipeline_.blob_limits_px();
    if (blob.area_px < limits.min_area_px) {
      return fmt::format("smaller than blobs.min_area_mm2, {:.1f} px here", limits.min_area_px);
    }
    if (blob.area_px > limits.max_area_px) {
      return fmt::format("larger than blobs.max_area_mm2, {:.1f} px here", limits.max_area_px);
    }
    return fmt::format(
        "the frame has more than blobs.max_blobs {} blobs, and the smallest were "
        "left out",
        limits.max_blobs);
  }

  void add_tracker(std::size_t blob) {
    const auto& named = pipeline_.parts().tracker;
    const TrackerInput input{result_.frame.sequence, result_.frame.captured, result_.blobs,
                             *pipeline_.field()};
    std::string text = named.stage->explain(input, blob, pipeline_.palette());
    if (text.empty()) text = fmt::format("{} gives no reasons", named.name);
    if (!is_detected(result_.blobs[blob]) && !all_round_was_scanned(result_.blobs[blob])) {
      text += fmt::format(
          "\nnot all within {} mm of it was looked at in this frame (scan.search: predicted); all "
          "is seen together within scan.unseen_frames, {}",
          PredictedSearch::kRobotBreadthMm, unseen_frames_text());
    }
    add("tracker", std::move(text));
  }

  bool is_detected(const Blob& blob) const {
    const Detections& found = result_.detections;
    const auto is_it = [&](const auto& sighting) {
      return sighting.label == blob.label && sighting.centroid_px == blob.centroid_px;
    };
    return (found.ball && is_it(*found.ball)) ||
           std::ranges::any_of(found.robots, [&](const RobotDetection& robot) {
             return std::ranges::any_of(robot.tags, is_it);
           });
  }

  bool all_round_was_scanned(const Blob& blob) const {
    const int reach_px = static_cast<int>(PredictedSearch::kRobotBreadthMm /
                                          std::sqrt(pipeline_.blob_scale_mm2_per_px()));
    const cv::Rect& box = blob.bounds_px;
    return covers(
        pipeline_.scanned_area(), pipeline_.field_area(),
        {box.x - reach_px, box.y - reach_px, box.width + 2 * reach_px, box.height + 2 * reach_px});
  }

  const Pipeline& pipeline_;
  const FrameResult& result_;
  const cv::Point pixel_px_;
  OneColor original_;
  OneColor normalized_;
  std::vector<StageAnswer> answers_;
};

}  // namespace

std::vector<StageAnswer> explain_point(const Pipeline& pipeline, const FrameResult& result,
                                       cv::Point pixel_px) {
  const cv::Size size_px = result.frame.bgr.size();
  if (!cv::Rect(cv::Point(), size_px).contains(pixel_px)) {
    throw std::out_of_range(fmt::format("{},{} lies outside of the picture of {}×{} pixels",
                                        pixel_px.x, pixel_px.y, size_px.width, size_px.height));
  }
  return Walk(pipeline, result, pixel_px).answers();
}

}  // namespace maggic
