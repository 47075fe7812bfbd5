/// synthetic_match: a made-up match seen by a made-up overhead camera, with its exact truth.
///
/// Robots and ball move smoothly, bounce and never overlap; the picture is drawn with exact
/// sub-pixel edges, robots are cubes whose tops stand above the floor (so positions need the
/// parallax correction), and lamp, lens and sensor add what they add in a hall. The same seed gives
/// the same frames on every run. Use it to try pipelines without a camera, to measure accuracy, and
/// in tests.
///
///     source:
///       synthetic_match:
///         format: 5v5          # field size; robots_per_team follows it unless given
///         layout: three_tag    # two_tag, three_tag, or mixed: some robots this, some that
///         width: 800
///         height: 600
///         frames: 600          # 0: endless
///         noise: 3             # standard deviation, 8-bit steps
///         chroma_subsampling: true
///
/// `light` chooses the lamps, in the classes of the MaggicVision monograph; another `seed` hangs
/// other lamps of the same class:
///     even         white, one gradient across the picture (`gradient`, `gradient_direction_deg`)
///     ideal        white and the same everywhere
///     normal       four ceiling lamps, slightly bluish or yellowish, mild unevenness
///     challenging  strongly coloured lamps of uneven strength, a window's patch of daylight, 50 to
///                  70 % of the light and down to 35 % in places; brown and purple boards, cables
///                  and scraps of paper on and around the field, never in a team colour
/// `brightness`, `gradient` and `color_gains` are factors on top of any of them, and so is `drift`:
/// light that changes during the match. Brightness falls to 40 % and the lamps turn warm, and back,
/// every minute:
///
///     source:
///       synthetic_match:
///         drift:
///           - {time_s: 0, brightness: 1.0, color_temperature_k: 6500}
///           - {time_s: 30, brightness: 0.4, color_temperature_k: 4000}
///           - {time_s: 60, brightness: 1.0, color_temperature_k: 6500}
///         drift_end: repeat    # hold: the last keyframe's light stays
///
/// A colour temperature becomes factors on red, green, blue along the Planckian locus (Kim's
/// cubics, linear sRGB), each relative to 6500 K and to green, so that 6500 changes nothing; in
/// between, values follow 3u² − 2u³. `labels: true` adds the true label of every pixel to each
/// frame: tags and ball, all else background. The sink labelled_images writes them beside their
/// pictures; docs/normalizers.md has the command that makes a set of each class.
///
/// Every key of a pipeline's `field:` section stands here too (format, corners_px, lens, camera, …)
/// and means the same, so the truth agrees with a pipeline whose `field:` says the same. Without
/// `corners_px` the field is centred with `margin_px` left on the tight sides, which leaves room
/// for goals and walls; a pipeline has to name the corners that gives:
///     scale = min((width − 2·margin) / length_mm, (height − 2·margin) / width_mm)
///     corners = ((width − 1)/2 ± scale·length_mm/2, (height − 1)/2 ± scale·width_mm/2)
/// By default:
///     3v3, 640 × 480: [[64.5, 18.5], [574.5, 18.5], [574.5, 460.5], [64.5, 460.5]]
///     5v5, 800 × 600, margin_px 30: [[69.5, 29.5], [729.5, 29.5], [729.5, 569.5], [69.5, 569.5]]
///
/// Source: field, robot and ball sizes from the rules of the IEEE Very Small Size Soccer league.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "camera_effects.hpp"
#include "clutter.hpp"
#include "maggic/color_temperature.hpp"
#include "drift.hpp"
#include "lamps.hpp"
#include "maggic/field.hpp"
#include "maggic/plugin.hpp"
#include "maggic/tag_layout.hpp"
#include "match.hpp"
#include "scene.hpp"

namespace maggic::synthetic_match {

enum class Pattern { kTwoTag, kThreeTag, kMixed };

namespace {

constexpr double kEvenGradient = 0.2;

struct DyedColor {
  std::string_view name;
  Rgb rgb;
};

/// Paper and balls as a camera sees them under hall light, not the ideal hues of the palette.
constexpr std::array<DyedColor, 9> kDyes{{{"orange", {238, 96, 30}},
                                          {"blue", {38, 78, 205}},
                                          {"yellow", {228, 208, 52}},
                                          {"red", {212, 28, 42}},
                                          {"green", {44, 172, 88}},
                                          {"magenta", {214, 58, 148}},
                                          {"cyan", {58, 184, 214}},
                                          {"purple", {126, 62, 188}},
                                          {"brown", {136, 88, 48}}}};

std::vector<Rgb> dyes_for(const Palette& palette) {
  std::vector<Rgb> colors;
  for (std::size_t label = 0; label < palette.size(); ++label) {
    const std::string_view name = palette.name(static_cast<Label>(label));
    const auto* dye = std::ranges::find(kDyes, name, &DyedColor::name);
    const DisplayColor shown = palette.display_color(static_cast<Label>(label));
    const Rgb as_drawn{static_cast<double>(shown.red), static_cast<double>(shown.green),
                       static_cast<double>(shown.blue)};
    colors.push_back(dye == kDyes.end() ? as_drawn : dye->rgb);
  }
  return colors;
}

Label label_of(const Palette& palette, std::string_view name) {
  if (const std::optional<Label> label = palette.find(name)) return *label;
  throw std::invalid_argument(
      fmt::format("the palette has no colour '{}', which the synthetic match needs (known: {})",
                  name, palette.known_names()));
}

}  // namespace

class SyntheticMatch final : public Source {
 public:
  void describe(Parameters& p) override {
    p.integer({"width", "width of the picture", "px"}, size_.width, {16, 8192});
    p.integer({"height", "height of the picture", "px"}, size_.height, {16, 8192});
    p.number({"fps", "frames per second; frame n is captured at n/fps", "1/s"}, fps_,
             {1.0, 1000.0});
    p.integer({"frames", "how many frames to give; 0: endless"}, frames_, {0, 1'000'000'000});
    p.integer({"skip", "so many frames of the match are played before the first one is given"},
              skip_, {0, 1'000'000});
    p.integer({"seed", "another number is another match"}, seed_, {0, 1'000'000'000});
    p.choice<Pattern>({"layout", "tag pattern of the robots; mixed: both in either team"}, pattern_,
                      {{"two_tag", Pattern::kTwoTag},
                       {"three_tag", Pattern::kThreeTag},
                       {"mixed", Pattern::kMixed}});
    p.integer({"robots_per_team", "robots in either team; left out: 3 or 5 as the format says"},
              robots_per_team_, {1, 11});
    p.number({"margin_px",
              "border around the field on the tight sides where corners_px is left "
              "out",
              "px"},
             margin_px_, {0.0, 4096.0});
    p.check("margin_px", 2.0 * margin_px_ < std::min(size_.width, size_.height) - 1.0,
            fmt::format("a border of {} px leaves nothing of a picture of {} x {}: expected less "
                        "than half the smaller side",
                        margin_px_, size_.width, size_.height));
    field_.describe(p);
    describe_light(p);
    describe_camera_effects(p);
    p.by_color({"colors",
                "red, green, blue of a palette colour under the lamp; colours left out "
                "keep a realistic one",
                "8-bit steps"},
               colors_, {0, 255}, [](Parameters& element, Rgb& rgb) {
                 element.numbers({"", "red, green, blue", "8-bit steps"}, rgb, {0.0, 255.0});
               });
  }

  void prepare(const StageContext& context) override {
    const Palette& palette = context.palette;
    std::vector<Rgb> colors = dyes_for(palette);
    for (const auto& [label, rgb] : colors_) colors.at(label) = rgb;
    two_tag_ = two_tag_layout(palette);
    three_tag_ = three_tag_layout(palette);

    const int robots = robots_per_team_.value_or(field_.format == FieldFormat::k5v5 ? 5 : 3);
    dress(robots, Team::kBlue, label_of(palette, "blue"));
    dress(robots, Team::kYellow, label_of(palette, "yellow"));

    if (field_.corners_px.empty()) {
      const cv::Size sized = field_.image_size_px.width > 0 ? field_.image_size_px : size_;
      field_.corners_px = fitted_corners_px(field_, sized, margin_px_);
    }
    match_.emplace(match_parameters(robots));
    const auto seed = static_cast<std::uint64_t>(seed_);
    std::vector<FloorPatch> clutter;
    if (light_ == LightClass::kChallenging) {
      clutter = brown_and_purple_clutter({field_.length_mm, field_.width_mm}, seed);
    }
    scene_ = std::make_unique<Scene>(Field(field_, size_), std::move(colors),
                                     label_of(palette, "orange"), clutter);
    if (labels_) scene_->keep_labels();
    drift_ = Drift(keyframes_, drift_end_);
    effects_.drifts = !drift_.is_still();
    effects_.gradient = gradient_.value_or(light_ == LightClass::kEven ? kEvenGradient : 0.0);
    camera_ = std::make_unique<CameraEffects>(effects_, size_,
                                              light_over_picture(light_, size_, seed), seed);
    camera_->develop(scene_->picture(), cv::Rect({}, size_));
  }

  SourceInfo open() override {
    SourceInfo info;
    if (frames_ > 0) info.frame_count = static_cast<std::uint64_t>(frames_);
    info.frames_per_second = fps_;
    return info;
  }

  ReadStatus read(Frame& frame) override {
    const auto first = static_cast<std::uint64_t>(skip_);
    if (frames_ > 0 && next_ >= first + static_cast<std::uint64_t>(frames_)) {
      return ReadStatus::kEnd;
    }
    for (; next_ < first; ++next_) match_->advance();
    if (next_ > 0 && next_ != first) match_->advance();
    frame.captured = Timestamp(std::llround(static_cast<double>(next_) * 1e9 / fps_));
    frame.truth.sequence = next_;
    frame.truth.captured = frame.captured;
    scene_->draw(match_->robots(), outfits_, match_->ball(), frame.truth);
    frame.has_truth = true;
    for (const cv::Rect& box : scene_->changed()) camera_->develop(scene_->picture(), box);
    camera_->expose(next_, drift_.gains_at(static_cast<double>(next_) / fps_), frame.bgr);
    if (labels_) scene_->labels().copyTo(frame.truth_labels);
    ++next_;
    return ReadStatus::kFrame;
  }

 private:
  void describe_light(Parameters& p) {
    p.boolean({"labels", "give the true label of every pixel with each frame"}, labels_);
    p.choice<LightClass>({"light",
                          "lamps of the hall; challenging also strews brown and purple "
                          "things on and around the field"},
                         light_,
                         {{"even", LightClass::kEven},
                          {"ideal", LightClass::kIdeal},
                          {"normal", LightClass::kNormal},
                          {"challenging", LightClass::kChallenging}});
    p.list({"drift", "moments between which the light changes smoothly; none: it stays"},
           keyframes_, {0, 1000}, describe_keyframe);
    for (std::size_t i = 1; i < keyframes_.size(); ++i) {
      p.check("drift", keyframes_[i - 1].time_s < keyframes_[i].time_s,
              fmt::format("time_s {} follows {}, expected ascending times", keyframes_[i].time_s,
                          keyframes_[i - 1].time_s));
    }
    p.choice<DriftEnd>({"drift_end",
                        "after the last of them: hold its light, or repeat from time "
                        "0 on"},
                       drift_end_, {{"hold", DriftEnd::kHold}, {"repeat", DriftEnd::kRepeat}});
  }

  static void describe_keyframe(Parameters& p, DriftKeyframe& keyframe) {
    p.number({"time_s", "since the first frame", "s", Presence::kRequired}, keyframe.time_s,
             {0.0, 1e6});
    p.number({"brightness", "factor on all light"}, keyframe.brightness, {0.0, 4.0});
    p.number({"color_temperature_k", "of the lamps, seen by a camera balanced for 6500", "K"},
             keyframe.color_temperature_k, {kLowestKelvin, kHighestKelvin});
  }

  void describe_camera_effects(Parameters& p) {
    p.number({"brightness", "factor on the light; above 1 bright colours saturate"},
             effects_.brightness, {0.05, 4.0});
    p.number({"gradient",
              "how much brighter the bright end of the picture is than its middle; "
              "left out: 0.2 where light is even, otherwise 0"},
             gradient_, {0.0, 0.9});
    p.number({"gradient_direction_deg", "where the bright end is, counter-clockwise from the right",
              "degrees"},
             effects_.gradient_direction_deg, {-360.0, 360.0});
    p.numbers({"color_gains", "colour cast: factors for red, green, blue"}, effects_.color_gains,
              {0.1, 4.0});
    p.number({"blur_px", "standard deviation of the lens's blur", "px"}, effects_.blur_px,
             {0.0, 10.0});
    p.number({"noise", "standard deviation of the sensor's noise in the dark", "8-bit steps"},
             effects_.noise, {0.0, 40.0});
    p.number({"shot_noise", "standard deviation added (in squares) by the light itself at 255",
              "8-bit steps"},
             effects_.shot_noise, {0.0, 40.0});
    p.boolean({"chroma_subsampling", "share colour among 2 x 2 pixels, as JPEG and YUV 4:2:0 do"},
              effects_.chroma_subsampling);
  }

  /// Gives the team its ids. In mixed patterns robots take turns, each with an id still free.
  void dress(int robots, Team team, Label team_color) {
    const std::size_t first = outfits_.size();
    const auto taken = [&](int id) {
      return std::any_of(outfits_.begin() + static_cast<std::ptrdiff_t>(first), outfits_.end(),
                         [id](const RobotOutfit& outfit) { return outfit.id.id == id; });
    };
    const auto dress_one = [&](const TagLayout& layout) {
      const auto free =
          std::ranges::find_if(layout.ids, [&](const TagId& id) { return !taken(id.id); });
      if (free == layout.ids.end()) return false;
      outfits_.push_back({team, *free, &layout, team_color});
      return true;
    };
    for (int i = 0; i < robots; ++i) {
      const bool two = pattern_ == Pattern::kTwoTag || (pattern_ == Pattern::kMixed && i % 2 == 0);
      if (dress_one(two ? two_tag_ : three_tag_)) continue;
      if (pattern_ == Pattern::kMixed && dress_one(three_tag_)) continue;
      throw std::invalid_argument(
          fmt::format("robots_per_team is {}, expected at most {}: so many ids the tag pattern "
                      "tells apart in this palette",
                      robots, i));
    }
    std::sort(outfits_.begin() + static_cast<std::ptrdiff_t>(first), outfits_.end(),
              [](const RobotOutfit& a, const RobotOutfit& b) { return a.id.id < b.id.id; });
  }

  MatchParameters match_parameters(int robots) const {
    MatchParameters match;
    match.length_mm = field_.length_mm;
    match.width_mm = field_.width_mm;
    match.robots_per_team = robots;
    match.seed = static_cast<std::uint64_t>(seed_);
    match.frame_time_s = 1.0 / fps_;
    match.parallax_gain = std::abs((field_.camera_height_mm - field_.ball_height_mm) /
                                       (field_.camera_height_mm - field_.robot_height_mm) -
                                   1.0);
    match.below_camera_mm = field_.camera_position_mm * (field_.half_time ? -1.0 : 1.0);
    return match;
  }

  cv::Size size_{640, 480};
  double fps_ = 60.0;
  int frames_ = 0;
  int skip_ = 0;
  int seed_ = 1;
  Pattern pattern_ = Pattern::kTwoTag;
  std::optional<int> robots_per_team_;
  double margin_px_ = 19.0;
  FieldParameters field_;
  bool labels_ = false;
  LightClass light_ = LightClass::kEven;
  std::vector<DriftKeyframe> keyframes_;
  DriftEnd drift_end_ = DriftEnd::kHold;
  std::optional<double> gradient_;
  CameraEffectsParameters effects_;
  std::vector<std::pair<Label, Rgb>> colors_;

  TagLayout two_tag_;
  TagLayout three_tag_;
  std::vector<RobotOutfit> outfits_;  ///< Blue before yellow, ids ascending.
  std::optional<Match> match_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<CameraEffects> camera_;
  Drift drift_{{}, DriftEnd::kHold};
  std::uint64_t next_ = 0;
};

}  // namespace maggic::synthetic_match

MAGGIC_PLUGIN(maggic::synthetic_match::SyntheticMatch,
              "a made-up 3v3 or 5v5 match with exact ground truth")
