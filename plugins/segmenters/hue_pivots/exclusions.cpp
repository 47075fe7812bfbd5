#include "exclusions.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "maggic/vectorized.hpp"
#include "opencv_hsv.hpp"

namespace maggic::hue_pivots {
namespace {

constexpr int kMaxExclusions = 32;

CircularSpan span_of(const std::vector<int>& ends) {
  return CircularSpan::from_to(ends[0], ends[1]);
}

MAGGIC_VECTORIZED void values_and_spreads(const ColorBatch& colors, std::uint8_t* __restrict values,
                                          std::uint8_t* __restrict spreads) {
  const std::uint8_t* __restrict b = colors.b.data();
  const std::uint8_t* __restrict g = colors.g.data();
  const std::uint8_t* __restrict r = colors.r.data();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    values[i] = largest(b[i], g[i], r[i]);
    spreads[i] = static_cast<std::uint8_t>(values[i] - smallest(b[i], g[i], r[i]));
  }
}

MAGGIC_VECTORIZED void scale_spreads(const std::int32_t* __restrict scales,
                                     std::span<std::uint8_t> spreads) {
  std::uint8_t* __restrict out = spreads.data();
  for (std::size_t i = 0; i < spreads.size(); ++i) out[i] = scaled_spread(out[i], scales[i]);
}

}  // namespace

/// Colours by OpenCV's HSV_FULL.
struct Exclusions::HsvPlanes {
  std::array<std::uint8_t, kMostAtOnce> hue;
  std::array<std::uint8_t, kMostAtOnce> value;
  std::array<std::uint8_t, kMostAtOnce> saturation;
};

Exclusions::Rectangle::Rectangle(const Exclusion& exclusion)
    : hue(span_of(exclusion.hue)),
      value(span_of(exclusion.value)),
      saturation(span_of(exclusion.saturation)) {}

void Exclusions::describe(Parameters& p) {
  p.list({"exclude", "rectangles of hue and value or saturation that are always background"},
         exclusions_, {0, kMaxExclusions}, describe_one);
}

void Exclusions::describe_one(Parameters& p, Exclusion& exclusion) {
  const auto describe_span = [&](const Parameter& what, std::vector<int>& span) {
    p.list(what, span, {2, 2}, [](Parameters& element, int& end) {
      element.integer({"", "first, then last, both included", "8-bit steps"}, end, {0, 255});
    });
  };
  const auto check_order = [&](std::string_view key, const std::vector<int>& span) {
    if (span.size() != 2) return;  // The reader has said so.
    p.check(key, span[0] <= span[1],
            fmt::format("found [{}, {}], expected the smaller value first", span[0], span[1]));
  };
  describe_span({"hue", "from, to around the circle: [250, 10] runs through 255 and 0",
                 "1/256 of the hue circle", Presence::kRequired},
                exclusion.hue);
  describe_span({"value", "of the largest channel; absent: any", "8-bit steps"}, exclusion.value);
  describe_span(
      {"saturation", "absent: any; where value is given too, both must hold", "8-bit steps"},
      exclusion.saturation);
  check_order("value", exclusion.value);
  check_order("saturation", exclusion.saturation);
}

void Exclusions::prepare() {
  saturation_scales_ = opencv_saturation_scales();
  rectangles_ = {exclusions_.begin(), exclusions_.end()};
}

Exclusions::Held Exclusions::held(const ColorBox& box, const CircularSpan& hues) const {
  const ChannelRange values = value_range(box);
  const auto value = CircularSpan::from_to(values.first, values.last);
  const CircularSpan saturation = saturation_span(box);
  Held held = Held::kNone;
  for (const Rectangle& excluded : rectangles_) {
    if (!excluded.hue.meets(hues) || !excluded.value.meets(value) ||
        !excluded.saturation.meets(saturation)) {
      continue;
    }
    if (excluded.hue.holds(hues) && excluded.value.holds(value) &&
        excluded.saturation.holds(saturation)) {
      return Held::kAll;
    }
    held = Held::kSome;
  }
  return held;
}

// Grows with the value and falls with the smallest channel, but for the step that is rounded.
CircularSpan Exclusions::saturation_span(const ColorBox& box) const {
  const ChannelRange value = value_range(box);
  const int least_spread = value.first - smallest(box.b.last, box.g.last, box.r.last);
  const int most_spread = value.last - smallest(box.b.first, box.g.first, box.r.first);
  const int first = saturation_of(value.first, std::max(least_spread, 0)) - 1;
  const int last = saturation_of(value.last, most_spread) + 1;
  return CircularSpan::from_to(std::max(first, 0), std::min(last, 255));
}

std::uint8_t Exclusions::saturation_of(std::uint8_t value, int spread) const {
  return scaled_spread(spread, saturation_scales_[value]);
}

std::string Exclusions::text_of(std::uint8_t hue, std::uint8_t value, int spread) const {
  const std::uint8_t saturation = saturation_of(value, spread);
  const auto holding = std::ranges::find_if(rectangles_, [&](const Rectangle& excluded) {
    return excluded.hue.holds(hue) && excluded.value.holds(value) &&
           excluded.saturation.holds(saturation);
  });
  if (holding == rectangles_.end()) return {};
  const auto number = static_cast<std::size_t>(holding - rectangles_.begin());
  const Exclusion& span = exclusions_[number];
  return fmt::format(
      "excluded: hue {}, saturation {}, value {} lie in exclude[{}] (hue [{}], saturation [{}], "
      "value [{}])",
      hue, saturation, value, number, fmt::join(span.hue, ", "), fmt::join(span.saturation, ", "),
      fmt::join(span.value, ", "));
}

MAGGIC_VECTORIZED void Exclusions::clear_inside(const Rectangle& rectangle, const HsvPlanes& planes,
                                                std::span<Label> labels) {
  const Rectangle in = rectangle;
  Label* __restrict out = labels.data();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool inside = in.hue.holds(planes.hue[i]) & in.value.holds(planes.value[i]) &
                        in.saturation.holds(planes.saturation[i]);
    out[i] = inside ? kBackground : out[i];
  }
}

// In loops of one look-up each and loops without any, which vectorise.
void Exclusions::clear(const ColorBatch& colors, const std::vector<std::uint8_t>& hues,
                       const std::uint32_t* hue_indices, std::span<Label> labels) const {
  HsvPlanes planes;
  std::array<std::int32_t, kMostAtOnce> scales;
  values_and_spreads(colors, planes.value.data(), planes.saturation.data());
#pragma GCC unroll 8
  for (std::size_t i = 0; i < labels.size(); ++i) {
    planes.hue[i] = hues[hue_indices[i]];
    scales[i] = saturation_scales_[planes.value[i]];
  }
  scale_spreads(scales.data(), {planes.saturation.data(), labels.size()});
  for (const Rectangle& excluded : rectangles_) clear_inside(excluded, planes, labels);
}

}  // namespace maggic::hue_pivots
