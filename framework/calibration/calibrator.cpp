/// The order of a calibration. Each step is a file of its own beside this one.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calibration/calibration_file.hpp"
#include "calibration/field_finder.hpp"
#include "calibration/pattern_score.hpp"
#include "calibration/plateau.hpp"
#include "calibration/sample_store.hpp"
#include "calibration/threshold_scan.hpp"
#include "maggic/border_check.hpp"
#include "maggic/calibration.hpp"

namespace maggic {
namespace calibration {
namespace {

// So many frames are looked at on every step of the ladder of thresholds; all are looked at once
// the threshold is known.
constexpr std::size_t kScanFrames = 5;
constexpr std::size_t kTrialFrames = 10;

// A field is seen at least so large and at most so large in the picture.
constexpr double kMinFieldShare = 0.35;
constexpr double kMaxFieldShare = 1.6;

// The threshold is set nearer to the background than to the palest tag, on a logarithmic scale:
// light falls more often than it rises, and a tag lost is worse than a blob too many.
constexpr double kThresholdPlace = 0.4;

constexpr double kAsGood = 0.02;  // of PatternScore::value

Node laid_over(const Node& document, const std::string& yaml) {
  Node merged = document;
  merge_document(merged, parse_document(yaml, "calibration"));
  return merged;
}

/// Numbers are found in the light there is, so following another one must not come between.
Node without_outputs_and_light(Node document) {
  std::erase_if(document.entries, [](const Node::Entry& entry) {
    return entry.key == "sinks" || entry.key == "light";
  });
  return document;
}

template <class Picture>
std::vector<Picture> evenly(std::span<const Picture> frames, std::size_t most) {
  std::vector<Picture> chosen;
  const std::size_t count = std::min(frames.size(), most);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(frames[(2 * i + 1) * frames.size() / (2 * count)]);
  }
  return chosen;
}

std::string one_line(const PatternScore& score) {
  return fmt::format(
      "{:.1f} complete robots and {:.1f} doubtful ones a frame, a ball in {:.0f} % "
      "of frames",
      score.robots, score.doubtful, 100.0 * score.balls);
}

/// Trials may go wrong in ways that concern nobody.
class SilentReporter final : public Reporter {
 public:
  void warn(std::string_view) override {}
};

class Calibrator {
 public:
  Calibrator(const CalibrationRequest& request, std::span<const cv::Mat> frames,
             PluginRegistry& registry)
      : request_(request),
        registry_(registry),
        document_(without_outputs_and_light(request.document)),
        frames_(frames.begin(), frames.end()) {
    built_ = build_pipeline(document_, registry_, silent_);
    const PipelineParts& parts = built_.pipeline->parts();
    const std::optional<TrackedPattern> pattern = parts.tracker.stage->pattern();
    if (!pattern) {
      throw std::invalid_argument(fmt::format(
          "the tracker '{}' does not say which tag pattern it looks for, so there is nothing to "
          "learn the colours from (two_tag, three_tag and tag_layout do)",
          parts.tracker.name));
    }
    pattern_ = *pattern;
    if (dynamic_cast<const ColorSegmenter*>(parts.segmenter.stage.get()) == nullptr) {
      throw std::invalid_argument(
          fmt::format("the segmenter '{}' does not judge single colours, so no numbers can be "
                      "fitted to samples of them",
                      parts.segmenter.name));
    }
    for (const cv::Mat& frame : frames_) {
      chroma_.push_back(make_chroma_frame(frame, *parts.normalizer.stage));
    }
  }

  CalibrationResult run() {
    {
      const Node& known = request_.with_known ? *request_.with_known : request_.document;
      BuiltPipeline as_it_was = build_pipeline(known, registry_, silent_);
      known_field_ = as_it_was.pipeline->parts().field;
      result_.before =
          score_by_pattern(*as_it_was.pipeline, evenly<cv::Mat>(frames_, kTrialFrames));
    }
    if (!learn_pattern()) return std::move(result_);
    choose_field();
    name();
    if (naming_.robots == 0.0) {
      result_.unsettled.push_back(
          "patches were found that lie to each other like those of a tag, but no choice of names "
          "makes them robots of this pattern: is it the right tracker for these robots?");
      return std::move(result_);
    }
    choose_blob_limits();
    choose_threshold();
    leave_out_strays();
    write_down();
    report_colors();
    return std::move(result_);
  }

 private:
  const PipelineParts& parts() const { return built_.pipeline->parts(); }
  const Palette& palette() const { return parts().palette; }

  ScaleRange possible_scales() const {
    const FieldParameters& field = parts().field;
    const cv::Size size = frames_.front().size();
    const double whole = std::max(field.length_mm / size.width, field.width_mm / size.height);
    return {whole / kMaxFieldShare, whole / kMinFieldShare};
  }

  /// Scale and rough threshold. @return false when there is no tag to be seen.
  bool learn_pattern() {
    scan_frames_ = evenly<cv::Mat>(frames_, kScanFrames);
    scan_chroma_ = evenly<ChromaFrame>(chroma_, kScanFrames);
    ladder_.assign(threshold_ladder().begin(), threshold_ladder().end());
    if (request_.gray_threshold) ladder_ = {*request_.gray_threshold};
    scan_ = scan_thresholds(scan_chroma_, ladder_, pattern_.layouts, possible_scales());
    if (!scan_.metric) {
      result_.unsettled.push_back(
          "no tags were found: nowhere do coloured patches lie to each other like those of this "
          "tracker's pattern. Put robots with their tags onto the field, light it, and see that "
          "the pipeline's tracker is the one for these tags");
      return false;
    }
    const double mm_per_px = std::sqrt(scan_.metric->pixel_mm2());
    result_.findings.push_back(
        fmt::format("a pixel is {:.2f} mm of the field, by the size of the tags", mm_per_px));
    return true;
  }

  /// Names the colours at the threshold whose names make the best pipeline: the level that finds
  /// most patterns need not be it.
  void name() {
    constexpr std::size_t kReach = 2;
    const std::size_t first = scan_.best - std::min(scan_.best, kReach);
    const std::size_t last = std::min(scan_.best + kReach, scan_.levels.size() - 1);
    std::optional<double> best;
    BallSightings best_ball;
    for (std::size_t level = first; level <= last; ++level) {
      const int threshold = scan_.levels[level].gray_threshold;
      learn_from(scan_.levels[level]);
      if (naming_.robots == 0.0) continue;
      const double worth = worth_of(yaml_for({.best = threshold}), scan_frames_);
      if (best && worth <= *best) continue;
      best = worth;
      best_ball = ball_;
      learning_threshold_ = threshold;
    }
    found_.clear();
    naming_ = {};
    if (!best) return;
    found_ = find_candidates(chroma_, learning_threshold_, pattern_.layouts, *scan_.metric);
    naming_ = name_colors(found_, pattern_, palette());
    ball_ = {};
    ball_.by_frame.resize(chroma_.size());
    if (best_ball.count > 0) {
      const std::vector<FramePatches> patches =
          find_candidates(chroma_, best_ball.gray_threshold, pattern_.layouts, *scan_.metric);
      ball_ = find_ball(patches, found_, naming_, pattern_, palette(), *scan_.metric);
    }
    store_ = std::make_unique<SampleStore>(chroma_, found_, naming_, ball_, pattern_.ball_color);
    const auto* normalizer = dynamic_cast<const ColorNormalizer*>(parts().normalizer.stage.get());
    if (normalizer != nullptr) store_->imagine_other_light(*normalizer);
  }

  /// From one level of the scan.
  void learn_from(const ThresholdLevel& level) {
    naming_ = name_colors(level.frames, pattern_, palette());
    ball_ = find_ball_anywhere(level);
    store_ = std::make_unique<SampleStore>(scan_chroma_, level.frames, naming_, ball_,
                                           pattern_.ball_color);
  }

  /// The ball may show best at another threshold than the tags: where it touches a line, say.
  BallSightings find_ball_anywhere(const ThresholdLevel& robots) const {
    std::vector<double> count;
    std::vector<BallSightings> sightings;
    for (const ThresholdLevel& level : scan_.levels) {
      sightings.push_back(pattern_.ball_color == kBackground
                              ? BallSightings{}
                              : find_ball(level.frames, robots.frames, naming_, pattern_, palette(),
                                          *scan_.metric));
      sightings.back().by_frame.resize(scan_chroma_.size());
      sightings.back().gray_threshold = level.gray_threshold;
      count.push_back(sightings.back().count);
    }
    return sightings[find_plateau(count, 0.0).middle()];
  }

  void choose_field() {
    FieldNumbers numbers;
    numbers.image_size_px = frames_.front().size();
    numbers.lens_comment = "not looked at";
    if (request_.corners_px) {
      numbers.corners_px = *request_.corners_px;
      numbers.corners_comment = "Given by hand.";
    } else if (const auto found = find_field(mean_picture(), parts().field, *scan_.metric)) {
      take_lines(*found, numbers);
    } else if (request_.field_is_known) {
      take_known(numbers);
    } else {
      numbers.corners_px = corners_by_tags();
      numbers.corners_comment =
          "Unsure: no lines of the field were recognised; its size is that of the tags, its middle "
          "the picture's.";
      result_.unsettled.push_back(
          "the field's lines were not recognised: distances are right, but the origin is the "
          "picture's middle. Give the corners with --corners if positions on the field matter");
    }
    numbers_.field = numbers;
  }

  /// Scaled to these frames, as the file is to stand on its own.
  void take_known(FieldNumbers& numbers) {
    const cv::Size size = frames_.front().size();
    const cv::Size taken = known_field_.image_size_px;
    const cv::Point2d scale = taken.width > 0 ? cv::Point2d(1.0 * size.width / taken.width,
                                                            1.0 * size.height / taken.height)
                                              : cv::Point2d(1.0, 1.0);
    const std::vector<cv::Point2d> corners =
        known_field_.corners_px.empty()
            ? fitted_corners_px(known_field_, taken.width > 0 ? taken : size)
            : known_field_.corners_px;
    for (std::size_t i = 0; i < 4; ++i) {
      numbers.corners_px[i] = {corners[i].x * scale.x, corners[i].y * scale.y};
    }
    numbers.lens_k1 = known_field_.lens_k1;
    numbers.lens_k2 = known_field_.lens_k2;
    numbers.lens_comment = "as it was";
    numbers.corners_comment = "As they were: no lines of the field were recognised.";
    result_.unsettled.push_back(
        "the field's lines were not recognised: its corners are as they were before");
  }

  void take_lines(const FoundField& found, FieldNumbers& numbers) {
    numbers.corners_px = found.corners_px;
    numbers.lens_k1 = found.lens_k1;
    numbers.corners_comment =
        fmt::format("From {} of its lines, which lie within {:.1f} px (RMS) of where they should.",
                    found.lines.size(), found.error_px);
    numbers.lens_comment = found.lens_k1 != 0.0
                               ? "bends the field's straight lines as they are seen"
                               : "straight lines are seen straight";
    result_.findings.push_back(fmt::format("the field by its {} (RMS {:.1f} px)",
                                           fmt::join(found.lines, ", "), found.error_px));
  }

  /// Steadier than any frame, and robots that move are gone from it.
  cv::Mat mean_picture() const {
    cv::Mat sum = cv::Mat::zeros(frames_.front().size(), CV_32FC3);
    for (const cv::Mat& frame : frames_) cv::accumulate(frame, sum);
    cv::Mat mean;
    sum.convertTo(mean, CV_8UC3, 1.0 / static_cast<double>(frames_.size()));
    return mean;
  }

  /// A rectangle of the field's size round the picture's middle.
  std::array<cv::Point2d, 4> corners_by_tags() const {
    const cv::Size size = frames_.front().size();
    const FieldParameters& field = parts().field;
    const cv::Matx22d px_per_mm = scan_.metric->mm_per_px().inv();
    const cv::Point2d middle((size.width - 1) / 2.0, (size.height - 1) / 2.0);
    const cv::Point2d half(field.length_mm / 2.0 * px_per_mm(0, 0),
                           field.width_mm / 2.0 * px_per_mm(1, 1));
    return {middle - half, middle + cv::Point2d(half.x, -half.y), middle + half,
            middle + cv::Point2d(-half.x, half.y)};
  }

  std::string yaml_for(const GrayThreshold& threshold) {
    const auto& segmenter = dynamic_cast<const ColorSegmenter&>(*parts().segmenter.stage);
    numbers_.segmenter = parts().segmenter.name;
    numbers_.segmenter_yaml = segmenter.fit(store_->samples(palette(), threshold));
    if (numbers_.segmenter_yaml.empty()) {
      throw std::invalid_argument(
          fmt::format("the segmenter '{}' cannot be calibrated", parts().segmenter.name));
    }
    return to_calibration_yaml(numbers_);
  }

  /// What the numbers are worth; nothing at all where they are no configuration.
  double worth_of(const std::string& yaml, std::span<const cv::Mat> frames) {
    try {
      BuiltPipeline trial = build_pipeline(laid_over(document_, yaml), registry_, silent_);
      return score_by_pattern(*trial.pipeline, frames).value();
    } catch (const ConfigError&) {
      return 0.0;
    }
  }

  void choose_threshold() {
    const std::vector<cv::Mat> frames = evenly<cv::Mat>(frames_, kTrialFrames);
    std::vector<double> worth;
    std::map<std::string, double> tried;  // a segmenter without a threshold has one text for all
    for (const int gray_threshold : ladder_) {
      const std::string yaml = yaml_for({.best = gray_threshold});
      const auto [entry, is_new] = tried.try_emplace(yaml, 0.0);
      if (is_new) entry->second = worth_of(yaml, frames);
      worth.push_back(entry->second);
    }
    const auto [first, last] = find_plateau(worth, kAsGood);

    threshold_ = {.lowest = ladder_[first], .highest = ladder_[last]};
    threshold_.given = request_.gray_threshold.has_value();
    matters_ = tried.size() > 1 || threshold_.given;
    if (threshold_.given) {
      threshold_.best = *request_.gray_threshold;
      return;
    }
    threshold_.best = static_cast<int>(std::lround(
        threshold_.lowest *
        std::pow(static_cast<double>(threshold_.highest) / threshold_.lowest, kThresholdPlace)));
  }

  /// What comes out as a lone team tag or a second ball is shown to the segmenter as such.
  void leave_out_strays() {
    const std::string plain = yaml_for(threshold_);
    BuiltPipeline trial = build_pipeline(laid_over(document_, plain), registry_, silent_);
    const auto strays = find_strays(*trial.pipeline, frames_, ball_, pattern_, identities());
    if (std::ranges::all_of(strays, [](const auto& of_frame) { return of_frame.empty(); })) return;
    const SampleStore clean = *store_;
    store_->add_strays(chroma_, strays);
    // Robots that are none may go; only those that are there must stay.
    const double before = known_robots(*trial.pipeline);
    BuiltPipeline without =
        build_pipeline(laid_over(document_, yaml_for(threshold_)), registry_, silent_);
    if (known_robots(*without.pipeline) < (1.0 - kAsGood) * before) *store_ = clean;
  }

  /// Robots of known identities, and balls where there is one, in all frames.
  double known_robots(Pipeline& pipeline) const {
    const std::set<Identity> known = identities();
    double count = 0.0;
    score_by_pattern(pipeline, frames_, [&](const FrameResult& result) {
      for (const RobotDetection& robot : result.detections.robots) {
        if (known.contains(identity_of(robot, pattern_))) count += 1.0;
      }
      const std::optional<Patch>& ball = ball_.by_frame[result.frame.sequence];
      const auto& seen = result.detections.ball;
      if (ball && seen &&
          cv::norm(ball->centroid_px - seen->centroid_px) < std::sqrt(ball->area_px)) {
        count += 1.0;
      }
    });
    return count;
  }

  /// Those the naming found.
  std::set<Identity> identities() const {
    std::set<Identity> known;
    for (const NamedFrame& frame : naming_.frames) {
      for (const NamedRobot& robot : frame.robots) {
        const TagLayout& layout =
            pattern_.layouts[static_cast<std::size_t>(robot.candidate->layout)];
        Identity identity{robot.team, {}};
        for (std::size_t i = 0; i < layout.patches.size(); ++i) {
          if (layout.patches[i].role == PatchRole::kTeam) continue;
          const auto patch = static_cast<std::size_t>(robot.candidate->patches[i]);
          identity.second.push_back(frame.label_of_patch[patch]);
        }
        known.insert(identity);
      }
    }
    return known;
  }

  void write_down() {
    note_light();
    BuiltPipeline final =
        build_pipeline(laid_over(document_, yaml_for(threshold_)), registry_, silent_);
    BlobColors colors;
    result_.after = score_by_pattern(
        *final.pipeline, evenly<cv::Mat>(frames_, kTrialFrames),
        [&](const FrameResult& frame) { colors.offer(frame, final.pipeline->channel_gains()); });
    for (const DoubtfulBorder& border : find_doubtful_borders(*final.pipeline, colors)) {
      result_.unsettled.push_back(border.to_string(palette()));
    }
    if (matters_) {
      result_.findings.push_back(
          fmt::format("gray threshold {} ({})", threshold_.best, describe(threshold_)));
    }
    numbers_.heading = {
        "Written by maggic calibrate.",
        fmt::format("From {} frames of {} x {}: {}.", frames_.size(), frames_.front().cols,
                    frames_.front().rows, one_line(result_.after))};
    result_.yaml = yaml_for(threshold_);
  }

  /// The field's colour now, so that its change later tells what the light did.
  void note_light() {
    BuiltPipeline trial =
        build_pipeline(laid_over(document_, yaml_for(threshold_)), registry_, silent_);
    score_by_pattern(*trial.pipeline, std::span(frames_).first(1));
    const std::shared_ptr<const Field>& field = trial.pipeline->field();
    if (!field) return;
    LightNumbers light;
    // Who has turned it off keeps it off.
    const Node* section = request_.document.find("light");
    const Node* follow = section != nullptr ? section->find("follow") : nullptr;
    light.follow = follow == nullptr || follow->scalar != "false";
    for (const cv::Mat& frame : frames_) {
      const std::array<double, 3> color = scene_color(frame, *field);
      for (std::size_t c = 0; c < 3; ++c) {
        light.reference_rgb[c] += color[c] / static_cast<double>(frames_.size());
      }
    }
    // Black tells nothing: where pictures are rendered there may be no floor to go by.
    constexpr double kDarkestFloor = 4.0;
    if (std::ranges::min(light.reference_rgb) >= kDarkestFloor) numbers_.light = light;
  }

  /// A tag or ball as small as the smallest seen, or as large as two of the largest merged.
  void choose_blob_limits() {
    double smallest = 1e9;
    double largest = 0.0;
    for (std::size_t f = 0; f < found_.size(); ++f) {
      for (std::size_t p = 0; p < found_[f].patches.size(); ++p) {
        if (naming_.frames[f].label_of_patch[p] == kBackground) continue;
        const double area = found_[f].patches[p].area_px * scan_.metric->pixel_mm2();
        smallest = std::min(smallest, area);
        largest = std::max(largest, area);
      }
    }
    constexpr double kSmallestPart = 0.35;
    constexpr double kLargestPart = 3.0;
    numbers_.blobs =
        BlobNumbers{kSmallestPart * smallest,
                    fmt::format("about a third of the smallest tag seen, {:.0f} mm²", smallest),
                    kLargestPart * largest,
                    fmt::format("three times the largest tag seen, {:.0f} mm²", largest)};
  }

  void report_colors() {
    std::map<Label, int> count;
    std::set<Label> teams;
    for (const NamedFrame& frame : naming_.frames) {
      for (const Label label : frame.label_of_patch) {
        if (label != kBackground) ++count[label];
      }
      for (const NamedRobot& robot : frame.robots) teams.insert(robot.team);
    }
    if (ball_.count > 0) count[pattern_.ball_color] = ball_.count;
    std::vector<std::string> seen;
    for (const auto& [label, times] : count) seen.emplace_back(palette().name(label));
    result_.findings.push_back(fmt::format("colours seen: {}", fmt::join(seen, ", ")));
    for (const Label team : {pattern_.blue_team_color, pattern_.yellow_team_color}) {
      if (team == kBackground || teams.contains(team)) continue;
      result_.unsettled.push_back(
          fmt::format("no robot of the {} team was seen: its colour is as it was before",
                      palette().name(team)));
    }
    if (pattern_.ball_color != kBackground && ball_.count == 0) {
      result_.unsettled.push_back(
          "no ball was seen: show one and calibrate again, or look into the file for what became "
          "of its colour");
    }
    if (frames_.size() == 1) {
      result_.unsettled.push_back(
          "there was one frame only: what changes from frame to frame (noise, light) is not in "
          "these numbers");
    }
  }

  const CalibrationRequest& request_;
  PluginRegistry& registry_;
  SilentReporter silent_;
  Node document_;
  std::vector<cv::Mat> frames_;
  BuiltPipeline built_;
  TrackedPattern pattern_;
  std::vector<ChromaFrame> chroma_;

  std::vector<cv::Mat> scan_frames_;
  std::vector<ChromaFrame> scan_chroma_;
  std::vector<int> ladder_;
  ThresholdScan scan_;
  int learning_threshold_ = 0;
  std::vector<FramePatches> found_;
  Naming naming_;
  BallSightings ball_;
  std::unique_ptr<SampleStore> store_;
  FieldParameters known_field_;
  GrayThreshold threshold_;
  bool matters_ = false;  ///< The segmenter has a gray threshold.
  CalibrationNumbers numbers_;
  CalibrationResult result_;
};

void check_frames(std::span<const cv::Mat> frames) {
  if (frames.empty()) throw std::invalid_argument("there is no frame to calibrate from");
  for (const cv::Mat& frame : frames) {
    if (frame.size() == frames.front().size()) continue;
    throw std::invalid_argument(
        fmt::format("frames of {}x{} and of {}x{} were given, expected one size",
                    frames.front().cols, frames.front().rows, frame.cols, frame.rows));
  }
}

}  // namespace
}  // namespace calibration

CalibrationResult calibrate(const CalibrationRequest& request, std::span<const cv::Mat> frames,
                            PluginRegistry& registry) {
  calibration::check_frames(frames);
  return calibration::Calibrator(request, frames, registry).run();
}

}  // namespace maggic
