/// yuv_boxes: a box in YUV space for every colour (the teams' legacy method)
/// =========================================================================
///
/// What it does: turns the colour into YUV and gives it the first listed label whose box holds it,
/// bounds included; no box, background. The conversion is full-range BT.601 in integers,
/// Y = (306R+601G+117B)>>10, U = ((-172R-340G+512B)>>10)+128, V = ((512R-419G-83B)>>10)+128.
/// When to use it: to run a calibration made for the legacy programs, or to compare against them.
///
/// The boxes hold the *normalised* colour: with `normalizer: none` that is the legacy method
/// exactly, and with another normalizer the boxes are set on what that one makes of the picture.
/// The gray filter looks at the original colour, as the legacy programs do.
///
///     segmenter:
///       yuv_boxes:
///         gray_threshold: 20        # leave out for no gray filter
///         boxes:                    # at most 8 colours; where boxes overlap the first one wins
///           orange: {y: [60, 200], u: [40, 110], v: [170, 240]}
///           blue: {y: [20, 120], u: [150, 255], v: [60, 130]}
///
/// Source: the legacy vision programs of the 3v3 teams; full-range BT.601 in integers.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "box_fit.hpp"
#include "maggic/plugin.hpp"
#include "maggic/vectorized.hpp"

namespace {

using maggic::ColorBatch;
using maggic::Label;
using maggic::Parameters;

struct Box {
  std::vector<int> y{0, 255};
  std::vector<int> u{0, 255};
  std::vector<int> v{0, 255};
};

void describe_bounds(Parameters& p, std::string_view key, std::string_view meaning,
                     std::vector<int>& bounds) {
  p.list({key, meaning, "8-bit steps", maggic::Presence::kRequired}, bounds, {2, 2},
         [](Parameters& element, int& bound) {
           element.integer({"", "smallest, then largest value, both included", "8-bit steps"},
                           bound, {0, 255});
         });
  if (bounds.size() != 2) return;  // The reader has said so.
  p.check(key, bounds[0] <= bounds[1],
          fmt::format("found [{}, {}], expected the smaller value first", bounds[0], bounds[1]));
}

// One side of a box; all ones for a value within it, as a vector comparison answers.
struct Bounds {
  std::uint8_t min;
  std::uint8_t length;

  explicit Bounds(const std::vector<int>& bounds)
      : min(static_cast<std::uint8_t>(bounds[0])),
        length(static_cast<std::uint8_t>(bounds[1] - bounds[0])) {}

  std::uint8_t mask(std::uint8_t value) const {
    return static_cast<std::uint8_t>(value - min) <= length ? 0xFF : 0;
  }
};

// Colours are worked through in pieces that keep the planes in between on the stack.
constexpr std::size_t kPiece = 2048;
using Plane = std::array<std::uint8_t, kPiece>;

// The conversion in 16 bits, which doubles what a vector register holds. A sum of products is
// split as 128·p + q, and (128·p + q) >> 10 = (p + (q >> 7)) >> 3 exactly. The results need no
// clamping: over all colours they stay within 0 … 255.
MAGGIC_VECTORIZED void convert_to_yuv(const ColorBatch& colors, std::uint8_t* __restrict y,
                                      std::uint8_t* __restrict u, std::uint8_t* __restrict v) {
  const std::uint8_t* __restrict blue = colors.b.data();
  const std::uint8_t* __restrict green = colors.g.data();
  const std::uint8_t* __restrict red = colors.r.data();
  const auto shifted = [](int p, int q) {
    const auto fraction = static_cast<std::int16_t>(static_cast<std::int16_t>(q) >> 7);
    return static_cast<std::int16_t>(static_cast<std::int16_t>(p + fraction) >> 3);
  };
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const std::int16_t b = blue[i];
    const std::int16_t g = green[i];
    const std::int16_t r = red[i];
    y[i] = static_cast<std::uint8_t>(shifted(2 * r + 5 * g + b, 50 * r - 39 * g - 11 * b));
    u[i] = static_cast<std::uint8_t>(shifted(4 * b - r - 3 * g, 44 * (g - r)) + 128);
    v[i] = static_cast<std::uint8_t>(shifted(4 * r - 3 * g - b, 45 * b - 35 * g) + 128);
  }
}

class YuvBoxes final : public maggic::ColorSegmenter {
 public:
  void describe(Parameters& p) override {
    p.integer({"gray_threshold",
               "original colours whose channels lie within this of each other are background; "
               "absent: no gray filter",
               "8-bit steps"},
              gray_threshold_, {0, 255});
    p.by_color({"boxes", "what each colour may be; the first box that holds a pixel wins", "",
                maggic::Presence::kRequired},
               boxes_, {1, 8}, [](Parameters& box_parameters, Box& box) {
                 describe_bounds(box_parameters, "y", "brightness", box.y);
                 describe_bounds(box_parameters, "u", "blue difference", box.u);
                 describe_bounds(box_parameters, "v", "red difference", box.v);
               });
  }

  void prepare(const maggic::StageContext& context) override { palette_ = &context.palette; }

  void segment(const ColorBatch& original, const ColorBatch& normalized,
               std::span<Label> labels) const override {
    Plane y;
    Plane u;
    Plane v;
    for (std::size_t start = 0; start < labels.size(); start += kPiece) {
      const std::size_t count = std::min(kPiece, labels.size() - start);
      const std::span<Label> piece = labels.subspan(start, count);
      convert_to_yuv({normalized.b.subspan(start, count), normalized.g.subspan(start, count),
                      normalized.r.subspan(start, count)},
                     y.data(), u.data(), v.data());
      std::ranges::fill(piece, maggic::kBackground);
      // From the last box to the first, so that the first one has the last word.
      for (auto box = boxes_.rbegin(); box != boxes_.rend(); ++box) {
        paint_inside(box->second, box->first, y, u, v, piece);
      }
      if (gray_threshold_) {
        clear_gray({original.b.subspan(start, count), original.g.subspan(start, count),
                    original.r.subspan(start, count)},
                   *gray_threshold_, piece);
      }
    }
  }

  std::optional<Label> label_of(const maggic::ColorBox& original,
                                const maggic::ColorBox& normalized) const override {
    bool may_be_gray = false;
    if (gray_threshold_) {
      const maggic::ChannelRange spread = maggic::spread_range(original);
      if (spread.last <= *gray_threshold_) return maggic::kBackground;
      may_be_gray = spread.first <= *gray_threshold_;
    }
    const YuvRanges colors(normalized);
    for (const auto& [label, box] : boxes_) {
      if (!overlap(colors.y, box.y) || !overlap(colors.u, box.u) || !overlap(colors.v, box.v)) {
        continue;
      }
      const bool holds_all = holds(box.y, colors.y) && holds(box.u, colors.u) &&
                             holds(box.v, colors.v);
      if (may_be_gray || !holds_all) return {};
      return label;
    }
    return maggic::kBackground;
  }

  std::string explain(const ColorBatch& original, const ColorBatch& normalized) const override {
    const Yuv color(normalized);
    std::string by_box = fmt::format("YUV {} {} {} of the normalized colour {}", color.y, color.u,
                                     color.v, box_text(color));
    if (!is_gray(original)) return by_box;
    return fmt::format(
        "gray: channels of the original colour spread over {} steps, gray_threshold is {}\n"
        "without the gray filter: {}",
        spread_of(original), *gray_threshold_, by_box);
  }

  std::vector<Label> claimants(const ColorBatch& original,
                               const ColorBatch& normalized) const override {
    std::vector<Label> holding;
    if (is_gray(original)) return holding;
    const Yuv color(normalized);
    for (const auto& [label, box] : boxes_) {
      if (miss_of(box, color).steps == 0) holding.push_back(label);
    }
    return holding;
  }

  std::string fit(const maggic::ColorSamples& samples) const override {
    using maggic::yuv_boxes::FittedBox;
    const std::vector<maggic::yuv_boxes::Yuv> colors = to_yuv(samples.normalized);
    const std::vector<FittedBox> fitted =
        maggic::yuv_boxes::fit_boxes(colors, samples.labels, samples.tags);
    std::string yaml;
    if (gray_threshold_ || samples.gray_threshold.given) {
      yaml += fmt::format("gray_threshold: {}   # {}\n", samples.gray_threshold.best,
                          maggic::describe(samples.gray_threshold));
    }
    yaml += "boxes:   # [min, max] of Y, U, V; a box holds what was seen and the room round it\n";
    for (const FittedBox& box : fitted) {
      yaml += fmt::format("  {}: {{{}}}   # seen {} times, {}; a tag is lost when a side cuts into "
                          "that\n",
                          samples.palette.name(box.label), text_of(box.box, "{}: [{}, {}]"),
                          box.tags, text_of(box.seen, "{} {} … {}"));
      if (box.foreign > kForeignShare) {
        yaml += fmt::format("    # Unsure: {:.0f} % of what the box of {} holds is something else.\n",
                            100.0 * box.foreign, samples.palette.name(box.label));
      }
    }
    for (const auto& [label, box] : boxes_) {
      if (std::ranges::count(fitted, label, &FittedBox::label) > 0) continue;
      const std::array<maggic::yuv_boxes::Side, 3> sides{
          {{box.y[0], box.y[1]}, {box.u[0], box.u[1]}, {box.v[0], box.v[1]}}};
      const bool in_the_way = std::ranges::any_of(
          colors, [&](const auto& color) { return maggic::yuv_boxes::holds(sides, color); });
      if (!in_the_way) continue;
      yaml += fmt::format("  {}: ~   # not seen; its box so far holds what is something else\n",
                          samples.palette.name(label));
    }
    return yaml;
  }

 private:
  struct Yuv {
    int y;
    int u;
    int v;

    explicit Yuv(const ColorBatch& color) {
      std::array<std::uint8_t, 3> yuv{};
      convert_to_yuv({color.b.first(1), color.g.first(1), color.r.first(1)}, &yuv[0], &yuv[1],
                     &yuv[2]);
      y = yuv[0];
      u = yuv[1];
      v = yuv[2];
    }
  };

  /// The values that the conversion gives to the colours of a box. Each of the three grows or falls
  /// with each channel, so the corners have the extremes.
  struct YuvRanges {
    maggic::ChannelRange y;
    maggic::ChannelRange u;
    maggic::ChannelRange v;

    explicit YuvRanges(const maggic::ColorBox& box) {
      const auto& [b, g, r] = box;
      const std::array<std::uint8_t, 6> blue{b.first, b.last, b.first, b.last, b.last, b.first};
      const std::array<std::uint8_t, 6> green{g.first, g.last, g.last, g.first, g.last, g.first};
      const std::array<std::uint8_t, 6> red{r.first, r.last, r.last, r.first, r.first, r.last};
      std::array<std::uint8_t, 6> all_y;
      std::array<std::uint8_t, 6> all_u;
      std::array<std::uint8_t, 6> all_v;
      convert_to_yuv({blue, green, red}, all_y.data(), all_u.data(), all_v.data());
      y = {all_y[0], all_y[1]};
      u = {all_u[2], all_u[3]};
      v = {all_v[4], all_v[5]};
    }
  };

  static bool overlap(maggic::ChannelRange range, const std::vector<int>& bounds) {
    return range.first <= bounds[1] && range.last >= bounds[0];
  }
  static bool holds(const std::vector<int>& bounds, maggic::ChannelRange range) {
    return range.first >= bounds[0] && range.last <= bounds[1];
  }

  /// How far a colour lies outside of a box.
  struct Miss {
    int steps = 0;     ///< Over all sides; 0: the box holds it.
    std::string text;  ///< "V 190 is 4 below its 194 … 230".
  };

  static Miss miss_of(const Box& box, const Yuv& color) {
    Miss miss;
    const auto add = [&](char axis, const std::vector<int>& bounds, int value) {
      const int below = bounds[0] - value;
      const int above = value - bounds[1];
      if (below <= 0 && above <= 0) return;
      miss.steps += std::max(below, above);
      miss.text +=
          fmt::format("{}{} {} is {} {} its {} … {}", miss.text.empty() ? "" : ", ", axis, value,
                      std::max(below, above), below > 0 ? "below" : "above", bounds[0], bounds[1]);
    };
    add('Y', box.y, color.y);
    add('U', box.u, color.u);
    add('V', box.v, color.v);
    return miss;
  }

  std::string box_text(const Yuv& color) const {
    std::string holders;
    const std::pair<Label, Box>* nearest = nullptr;
    Miss smallest;
    int holding = 0;
    for (const auto& entry : boxes_) {
      Miss miss = miss_of(entry.second, color);
      if (miss.steps == 0) {
        holders += fmt::format("{}{}", holding++ == 0 ? "" : ", ", palette_->name(entry.first));
      } else if (nearest == nullptr || miss.steps < smallest.steps) {
        nearest = &entry;
        smallest = std::move(miss);
      }
    }
    if (holding == 0) {
      return fmt::format("is in no box; nearest is the box of {}: {}",
                         palette_->name(nearest->first), smallest.text);
    }
    std::string text = holding == 1
                           ? fmt::format("is in the box of {}", holders)
                           : fmt::format("is in the boxes of {}: the first listed wins", holders);
    if (nearest != nullptr) {
      text += fmt::format("; next is {}: {}", palette_->name(nearest->first), smallest.text);
    }
    return text;
  }

  static constexpr double kForeignShare = 0.03;  // more than that is worth a word

  static std::vector<maggic::yuv_boxes::Yuv> to_yuv(const ColorBatch& batch) {
    std::vector<std::uint8_t> y(batch.size());
    std::vector<std::uint8_t> u(batch.size());
    std::vector<std::uint8_t> v(batch.size());
    convert_to_yuv(batch, y.data(), u.data(), v.data());
    std::vector<maggic::yuv_boxes::Yuv> colors;
    for (std::size_t i = 0; i < y.size(); ++i) colors.push_back({y[i], u[i], v[i]});
    return colors;
  }

  static std::string text_of(const std::array<maggic::yuv_boxes::Side, 3>& box,
                             std::string_view side_format) {
    std::string text;
    for (std::size_t c = 0; c < 3; ++c) {
      if (c > 0) text += ", ";
      text += fmt::format(fmt::runtime(side_format), "yuv"[c], box[c].min, box[c].max);
    }
    return text;
  }

  static int spread_of(const ColorBatch& color) {
    const auto [least, most] = std::minmax({color.b[0], color.g[0], color.r[0]});
    return most - least;
  }

  bool is_gray(const ColorBatch& original) const {
    return gray_threshold_ && spread_of(original) <= *gray_threshold_;
  }

  MAGGIC_VECTORIZED static void paint_inside(const Box& box, Label label, const Plane& y,
                                             const Plane& u, const Plane& v,
                                             std::span<Label> labels) {
    const Bounds in_y(box.y);
    const Bounds in_u(box.u);
    const Bounds in_v(box.v);
    Label* __restrict out = labels.data();
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const std::uint8_t inside = in_y.mask(y[i]) & in_u.mask(u[i]) & in_v.mask(v[i]);
      out[i] = inside != 0 ? label : out[i];
    }
  }

  MAGGIC_VECTORIZED static void clear_gray(const ColorBatch& colors, int threshold,
                                           std::span<Label> labels) {
    const std::uint8_t* __restrict b = colors.b.data();
    const std::uint8_t* __restrict g = colors.g.data();
    const std::uint8_t* __restrict r = colors.r.data();
    Label* __restrict out = labels.data();
    const auto limit = static_cast<std::uint8_t>(threshold);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const std::uint8_t largest = std::max(std::max(b[i], g[i]), r[i]);
      const std::uint8_t smallest = std::min(std::min(b[i], g[i]), r[i]);
      const auto spread = static_cast<std::uint8_t>(largest - smallest);
      out[i] = spread <= limit ? maggic::kBackground : out[i];
    }
  }

  std::optional<int> gray_threshold_;
  std::vector<std::pair<Label, Box>> boxes_;
  const maggic::Palette* palette_ = nullptr;
};

}  // namespace

MAGGIC_PLUGIN(YuvBoxes, "a box in YUV space for every colour (the legacy method)")
