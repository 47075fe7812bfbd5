/// hue_pivots: the colour whose pivot is nearest in hue
/// ====================================================
///
/// What it does: a colour whose normalised channels lie within `gray_threshold` of each other is
/// background; any other gets the label of the pivot nearest to its hue, around the circle. The
/// hue is OpenCV's COLOR_BGR2HSV_FULL, 0 … 255, bit for bit. Between two pivots equally near, the
/// one listed first wins. Rectangles of `exclude` are always background.
/// When to use it: the Maggic method. One threshold and a few hues instead of a box per colour.
///
///     segmenter:
///       hue_pivots:
///         gray_threshold: 20
///         hue_of: original          # or normalized: the colour whose hue is taken
///         pivots:                   # one hue or several for each colour to be found
///           red: 0
///           magenta: [230, 240]
///         exclude:                  # brown wood, say: dark orange
///           - {hue: [5, 20], value: [0, 90]}
///           - {hue: [250, 10], saturation: [0, 60]}   # a span may run through 255 to 0
///
/// Without `pivots`, or with none in it, those of the paper are taken for the colours the palette
/// has: red 0, orange 7, yellow 43, green 97, cyan 140, blue 151, magenta 235. Value and saturation
/// are OpenCV's as well, of the colour the hue is taken of; where a rectangle names both, both must
/// hold.
/// A colour without a hue (all channels equal) is background at any threshold.
///
/// Source: MaggicVision, pivot segmentation. `hue_of: original` is the default because `weighted`
/// draws neighbouring hues together: measured in docs/adr/0003-hue-of-the-original-colour.md.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "circular_span.hpp"
#include "exclusion_fit.hpp"
#include "exclusions.hpp"
#include "maggic/plugin.hpp"
#include "maggic/vectorized.hpp"
#include "opencv_hsv.hpp"
#include "pivot_fit.hpp"

namespace {

using maggic::ChannelRange;
using maggic::ColorBatch;
using maggic::ColorBox;
using maggic::kBackground;
using maggic::Label;
using maggic::Parameters;

using maggic::hue_pivots::CircularSpan;
using maggic::hue_pivots::Exclusions;
using maggic::hue_pivots::hue_index;
using maggic::hue_pivots::hue_index_of;
using maggic::hue_pivots::hue_indices;
using maggic::hue_pivots::kHues;
using maggic::hue_pivots::largest;
using maggic::hue_pivots::nearest_pivots;
using maggic::hue_pivots::opencv_hues;
using maggic::hue_pivots::Pivots;
using maggic::hue_pivots::smallest;
using maggic::hue_pivots::spread_of;

struct DefaultPivot {
  std::string_view color;
  int hue;
};
constexpr std::array<DefaultPivot, 7> kDefaultPivots{{{"red", 0},
                                                      {"orange", 7},
                                                      {"yellow", 43},
                                                      {"green", 97},
                                                      {"cyan", 140},
                                                      {"blue", 151},
                                                      {"magenta", 235}}};

// OpenCV's hue is off the true one by less: half a step of rounding, and up to 1275 · 0.5 / 4096 of
// the scale's. So two of them order as the true ones do, give or take one step.
constexpr int kHueError = 1;

// Colours are worked through in pieces that keep what lies between two loops on the stack.
constexpr std::size_t kPiece = Exclusions::kMostAtOnce;

int distance_on_circle(int a, int b) {
  const int straight = std::abs(a - b);
  return std::min(straight, kHues - straight);
}

class HuePivots final : public maggic::ColorSegmenter {
 public:
  void describe(Parameters& p) override {
    p.integer({"gray_threshold",
               "normalised colours whose channels lie within this of each other are background",
               "8-bit steps"},
              gray_threshold_, {0, 255});
    p.choice({"hue_of", "the colour whose hue is taken"}, hue_of_,
             {{"original", HueOf::kOriginal}, {"normalized", HueOf::kNormalized}});
    p.by_color(
        {"pivots",
         "hues of each colour to be found; none: red 0, orange 7, yellow 43, green 97, "
         "cyan 140, blue 151, magenta 235, as far as the palette has them",
         "1/256 of the hue circle"},
        pivots_, {0, 255}, [](Parameters& color, std::vector<int>& hues) {
          color.list(
              {"", "one hue or several", "1/256 of the hue circle"}, hues, {1, kHues},
              [](Parameters& element, int& hue) {
                element.integer({"", "a hue", "1/256 of the hue circle"}, hue, {0, kHues - 1});
              });
        });
    check_pivots_differ(p);
    exclusions_.describe(p);
  }

  void prepare(const maggic::StageContext& context) override {
    palette_ = &context.palette;
    // From now on described as in use.
    pivots_ = pivots_or_defaults(context.palette);
    if (pivots_.empty()) {
      throw std::invalid_argument(fmt::format(
          "no pivots given, and the palette ({}) has none of the colours with a default pivot; "
          "expected pivots for the colours to be found",
          context.palette.known_names()));
    }
    hues_ = opencv_hues();
    label_of_hue_ = nearest_pivots(pivots_);
    label_of_index_.resize(hues_.size());
    std::ranges::transform(hues_, label_of_index_.begin(),
                           [&](std::uint8_t hue) { return label_of_hue_[hue]; });
    count_same_labels();
    label_of_index_[hue_index(0, 0)] = kBackground;
    exclusions_.prepare();
  }

  void segment(const ColorBatch& original, const ColorBatch& normalized,
               std::span<Label> labels) const override {
    std::array<std::uint32_t, kPiece> indices;
    for (std::size_t start = 0; start < labels.size(); start += kPiece) {
      const std::size_t count = std::min(kPiece, labels.size() - start);
      const auto piece_of = [&](const ColorBatch& batch) {
        return ColorBatch{batch.b.subspan(start, count), batch.g.subspan(start, count),
                          batch.r.subspan(start, count)};
      };
      const ColorBatch normalized_piece = piece_of(normalized);
      const ColorBatch hue_piece =
          hue_of_ == HueOf::kOriginal ? piece_of(original) : normalized_piece;
      const std::span<Label> piece = labels.subspan(start, count);
      hue_indices(hue_piece, indices.data());
      const Label* label_of_index = label_of_index_.data();
      Label* out = piece.data();
      // The instructions of a loop not unrolled take longer than the look-ups.
#pragma GCC unroll 8
      for (std::size_t i = 0; i < count; ++i) out[i] = label_of_index[indices[i]];
      clear_gray(normalized_piece, piece);
      if (!exclusions_.empty()) exclusions_.clear(hue_piece, hues_, indices.data(), piece);
    }
  }

  std::optional<Label> label_of(const ColorBox& original,
                                const ColorBox& normalized) const override {
    const ChannelRange spread = maggic::spread_range(normalized);
    if (spread.last <= gray_threshold_) return kBackground;
    const ColorBox& of_hue = hue_of_ == HueOf::kOriginal ? original : normalized;
    const bool may_be_gray = spread.first <= gray_threshold_ || maggic::holds_gray(of_hue);
    if (may_be_gray && exclusions_.empty()) return {};
    const CircularSpan hues = hue_span(of_hue);
    if (!exclusions_.empty()) {
      const Exclusions::Held excluded = exclusions_.held(of_hue, hues);
      if (excluded == Exclusions::Held::kAll) return kBackground;
      if (excluded == Exclusions::Held::kSome) return {};
    }
    if (may_be_gray || hues.steps > same_label_steps_[hues.first]) return {};
    return label_of_hue_[hues.first];
  }

  std::string explain(const ColorBatch& original, const ColorBatch& normalized) const override {
    const bool takes_original = hue_of_ == HueOf::kOriginal;
    const ColorBatch& of_hue = takes_original ? original : normalized;
    const int spread = spread_of(normalized.b[0], normalized.g[0], normalized.r[0]);
    const int spread_of_hue = spread_of(of_hue.b[0], of_hue.g[0], of_hue.r[0]);
    if (spread_of_hue == 0) {
      return "gray: the channels are all equal, so the colour has no hue";
    }
    std::uint32_t index = 0;
    hue_indices(of_hue, &index);
    const std::uint8_t hue = hues_[index];
    const std::string by_hue =
        fmt::format("hue {} of the {} colour {}", hue, takes_original ? "original" : "normalized",
                    nearest_text(hue));
    if (spread <= gray_threshold_) {
      return fmt::format(
          "gray: channels of the normalized colour spread over {} steps, gray_threshold is {}\n"
          "without the gray filter: {}",
          spread, gray_threshold_, by_hue);
    }
    const std::uint8_t value = largest(of_hue.b[0], of_hue.g[0], of_hue.r[0]);
    if (const std::string excluded = exclusions_.text_of(hue, value, spread_of_hue);
        !excluded.empty()) {
      return fmt::format("{}\nwithout that: {}", excluded, by_hue);
    }
    return by_hue;
  }

  std::string fit(const maggic::ColorSamples& samples) const override {
    const bool of_original = hue_of_ == HueOf::kOriginal;
    const ColorBatch& colors = of_original ? samples.original : samples.normalized;
    const std::vector<std::uint8_t> hues = hues_of(colors);
    const std::vector<std::uint8_t> imagined =
        hues_of(of_original ? samples.imagined.original : samples.imagined.normalized);
    const auto fit = maggic::hue_pivots::fit_pivots(hues, samples.labels, samples.tags,
                                                    {imagined, samples.imagined.labels},
                                                    pivots_or_defaults(samples.palette));
    return describe_fit(fit, samples) + describe_exclusions(fit, colors, hues, samples);
  }

 private:
  /// Holds the hues of all the box's colours.
  CircularSpan hue_span(const ColorBox& box) const {
    constexpr CircularSpan kAll;
    if (maggic::holds_gray(box)) return kAll;
    const auto hue_at = [&](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
      return hues_[hue_index_of(b, g, r)];
    };
    // Seen along the gray axis the box is a hexagon and colours of one hue lie on a ray from the
    // axis: from outside of the hexagon the first and the last ray to touch it do so at corners.
    const auto& [b, g, r] = box;
    const std::uint8_t start = hue_at(b.last, g.first, r.first);
    const std::array<std::uint8_t, 5> others{
        hue_at(b.last, g.last, r.first), hue_at(b.first, g.last, r.first),
        hue_at(b.first, g.last, r.last), hue_at(b.first, g.first, r.last),
        hue_at(b.last, g.first, r.last)};
    int lowest = 0;
    int highest = 0;
    for (const std::uint8_t hue : others) {
      const int ahead = static_cast<std::int8_t>(hue - start);
      lowest = std::min(lowest, ahead);
      highest = std::max(highest, ahead);
    }
    // Near half a circle, which way round it goes is not certain.
    if (highest - lowest > kHues / 3) return kAll;
    return CircularSpan::from_to(start + lowest - kHueError, start + highest + kHueError);
  }

  std::vector<std::uint8_t> hues_of(const ColorBatch& colors) const {
    std::vector<std::uint32_t> indices(colors.size());
    hue_indices(colors, indices.data());
    std::vector<std::uint8_t> hues(colors.size());
    std::ranges::transform(indices, hues.begin(), [&](std::uint32_t i) { return hues_[i]; });
    return hues;
  }

  Pivots pivots_or_defaults(const maggic::Palette& palette) const {
    if (!pivots_.empty()) return pivots_;
    Pivots pivots;
    for (const DefaultPivot& pivot : kDefaultPivots) {
      if (const auto label = palette.find(pivot.color)) pivots.push_back({*label, {pivot.hue}});
    }
    return pivots;
  }

  /// YAML, a comment on every number.
  std::string describe_fit(const maggic::hue_pivots::PivotFit& fit,
                           const maggic::ColorSamples& samples) const {
    const maggic::GrayThreshold& gray = samples.gray_threshold;
    std::string yaml = fmt::format("gray_threshold: {}   # {}\n", gray.best, maggic::describe(gray));
    yaml += fmt::format("hue_of: {}\n", hue_of_ == HueOf::kOriginal ? "original" : "normalized");
    for (const maggic::hue_pivots::Overlap& overlap : fit.overlaps) {
      yaml += fmt::format("# Unsure: {} and {} share hues; {:.0f} % of one's pixels take the other's "
                          "label.\n",
                          samples.palette.name(overlap.a), samples.palette.name(overlap.b),
                          100.0 * overlap.share);
    }
    yaml += "pivots:   # hues, 0 … 255 round the circle; the nearest pivot names the colour\n";
    for (const maggic::hue_pivots::FittedColor& color : fit.colors) {
      yaml += fmt::format("  {}: ", samples.palette.name(color.label));
      if (color.pivots.empty()) {
        yaml += "~   # not seen; its pivot so far would take hues of colours that were\n";
        continue;
      }
      yaml += color.pivots.size() == 1 ? fmt::format("{}", color.pivots[0])
                                       : fmt::format("[{}]", fmt::join(color.pivots, ", "));
      yaml += color.tags == 0
                  ? "   # not seen: as it was\n"
                  : fmt::format("   # seen {} times, hues {} … {}; no tag is lost while it moves by "
                                "-{} … +{}\n",
                                color.tags, color.first_hue, color.last_hue, color.move_down,
                                color.move_up);
    }
    return yaml;
  }

  /// YAML of what has to be left out, with the pivots as fitted.
  std::string describe_exclusions(const maggic::hue_pivots::PivotFit& pivots,
                                  const ColorBatch& colors, const std::vector<std::uint8_t>& hues,
                                  const maggic::ColorSamples& samples) const {
    using maggic::hue_pivots::Hsv;
    std::vector<Hsv> tags;
    std::vector<Hsv> others;
    std::vector<Hsv> background;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const std::uint8_t value = largest(colors.b[i], colors.g[i], colors.r[i]);
      const int spread = value - smallest(colors.b[i], colors.g[i], colors.r[i]);
      const Hsv hsv{hues[i], exclusions_.saturation_of(value, spread), value};
      if (samples.labels[i] != kBackground) {
        tags.push_back(hsv);
        continue;
      }
      if (spread == 0) continue;
      if (samples.tags[i] == maggic::kStrayTag) {
        others.push_back(hsv);
      } else if (!is_gray(samples, i)) {
        background.push_back(hsv);
      }
    }
    // What else is coloured and far from every colour to be found makes trouble once something cuts
    // a piece of a tag's size out of it.
    std::array<bool, kHues> near = maggic::hue_pivots::hues_near(tags, kFarFromTags);
    for (const auto& color : pivots.colors) {
      for (int hue = 0; hue < kHues; ++hue) {
        const auto is_near = [&](int pivot) {
          return distance_on_circle(hue, pivot) <= kFarFromTags;
        };
        if (color.tags == 0 && std::ranges::any_of(color.pivots, is_near)) {
          near[static_cast<std::size_t>(hue)] = true;
        }
      }
    }
    std::ranges::copy_if(background, std::back_inserter(others),
                         [&](const Hsv& hsv) { return !near[hsv.hue]; });
    const auto fit = maggic::hue_pivots::fit_exclusions(tags, others);
    std::string yaml;
    if (!fit.exclusions.empty()) {
      yaml += "exclude:   # what was no tag and would have been taken for one\n";
    }
    for (const auto& exclusion : fit.exclusions) {
      yaml += fmt::format("  - {{hue: [{}, {}]", exclusion.hue.first, exclusion.hue.last);
      const auto add_span = [&](std::string_view key, const maggic::hue_pivots::Span& span) {
        if (span.first == 0 && span.last == 255) return;
        yaml += fmt::format(", {}: [{}, {}]", key, span.first, span.last);
      };
      add_span("value", exclusion.value);
      add_span("saturation", exclusion.saturation);
      yaml += fmt::format("}}   # {:.0f} % of that\n", 100.0 * exclusion.share);
    }
    return yaml;
  }

  static constexpr int kFarFromTags = 14;

  static bool is_gray(const maggic::ColorSamples& samples, std::size_t i) {
    const ColorBatch& colors = samples.normalized;
    return largest(colors.b[i], colors.g[i], colors.r[i]) -
               smallest(colors.b[i], colors.g[i], colors.r[i]) <=
           samples.gray_threshold.best;
  }

  enum class HueOf { kOriginal, kNormalized };

  void check_pivots_differ(Parameters& p) const {
    for (auto later = pivots_.begin(); later != pivots_.end(); ++later) {
      for (auto earlier = pivots_.begin(); earlier != later; ++earlier) {
        for (const int hue : later->second) {
          p.check("pivots", std::ranges::count(earlier->second, hue) == 0,
                  fmt::format("found hue {} for both {} and {}, expected pivots that differ", hue,
                              p.palette().name(earlier->first), p.palette().name(later->first)));
        }
      }
    }
  }

  void count_same_labels() {
    for (std::size_t hue = 0; hue < kHues; ++hue) {
      int& steps = same_label_steps_[hue];
      steps = 0;
      while (steps < kHues - 1 &&
             label_of_hue_[(hue + static_cast<std::size_t>(steps) + 1) % kHues] ==
                 label_of_hue_[hue]) {
        ++steps;
      }
    }
  }

  struct Nearest {
    Label label = kBackground;
    int pivot = 0;
    int distance = kHues;
  };

  /// The pivot nearest to a hue among those of all colours but `but`; ties as in `segment`.
  Nearest nearest_pivot(int hue, Label but = kBackground) const {
    Nearest nearest;
    for (const auto& [label, pivot_hues] : pivots_) {
      if (label == but) continue;
      for (const int pivot : pivot_hues) {
        const int distance = distance_on_circle(hue, pivot);
        if (distance < nearest.distance) nearest = {label, pivot, distance};
      }
    }
    return nearest;
  }

  std::string nearest_text(int hue) const {
    const Nearest first = nearest_pivot(hue);
    const Nearest second = nearest_pivot(hue, first.label);
    std::string text = fmt::format("is nearest to {}'s pivot {} ({} away)",
                                   palette_->name(first.label), first.pivot, first.distance);
    if (second.label != kBackground) {
      text += fmt::format("; next is {}'s {} ({} away)", palette_->name(second.label), second.pivot,
                          second.distance);
    }
    return text;
  }

  MAGGIC_VECTORIZED void clear_gray(const ColorBatch& colors, std::span<Label> labels) const {
    const std::uint8_t* __restrict b = colors.b.data();
    const std::uint8_t* __restrict g = colors.g.data();
    const std::uint8_t* __restrict r = colors.r.data();
    Label* __restrict out = labels.data();
    const auto threshold = static_cast<std::uint8_t>(gray_threshold_);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto spread =
          static_cast<std::uint8_t>(largest(b[i], g[i], r[i]) - smallest(b[i], g[i], r[i]));
      out[i] = spread <= threshold ? kBackground : out[i];
    }
  }

  int gray_threshold_ = 20;
  HueOf hue_of_ = HueOf::kOriginal;
  Pivots pivots_;  ///< Those given; once prepared, the defaults where none were.
  Exclusions exclusions_;

  const maggic::Palette* palette_ = nullptr;
  std::vector<std::uint8_t> hues_;     ///< At hue_index.
  std::vector<Label> label_of_index_;  ///< At hue_index.
  std::array<Label, kHues> label_of_hue_{};
  std::array<int, kHues> same_label_steps_{};  ///< How many hues after this one share its label.
};

}  // namespace

MAGGIC_PLUGIN(HuePivots, "the colour whose pivot is nearest in hue, after a gray filter")
