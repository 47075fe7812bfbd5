#include "exclusion_fit.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace maggic::hue_pivots {
namespace {

constexpr int kHues = 256;
constexpr double kTail = 0.01;           // of pixels, at either end, that do not count
constexpr int kSmallestGroup = 12;       // pixels …
constexpr double kSmallestShare = 0.02;  // … and of all that are no tag
constexpr int kLargestGap = 3;           // hues without a pixel within one group
constexpr int kMargin = 3;               // round a group, as far as there is room
constexpr double kClearly = 1.12;        // brighter, stronger: by so much at least
// Elsewhere on the field, and later in the day, tags are darker than was seen yet, so cuts by
// brightness keep to the others.
constexpr double kCutPlace = 0.25;  // of the way from the others to the tags
constexpr int kNear = 3;            // hues to either side whose tags a cut looks at too
constexpr std::size_t kMost = 12;   // rectangles

std::size_t at(int hue) { return static_cast<std::size_t>(((hue % kHues) + kHues) % kHues); }

/// Middle of the values; nothing where there are none.
std::optional<Span> middle_of(std::vector<std::uint8_t>& values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const auto tail = static_cast<std::size_t>(kTail * static_cast<double>(values.size()));
  return Span{values[tail], values[values.size() - 1 - tail]};
}

/// By `steps` to either side; the whole circle where the ends would meet.
Span widened(const Span& hues, int steps) {
  if (hues.last - hues.first + 2 * steps >= kHues - 1) return {0, kHues - 1};
  return {static_cast<int>(at(hues.first - steps)), static_cast<int>(at(hues.last + steps))};
}

bool holds(const Span& hues, int hue) {
  return static_cast<int>(at(hue - hues.first)) <= static_cast<int>(at(hues.last - hues.first));
}

/// Stretches of hue in which pixels lie whose hue is, or is not, a tag's.
std::vector<Span> groups_of(std::span<const Hsv> others, const std::array<bool, kHues>& taken,
                            bool among_tags) {
  std::array<int, kHues> count{};
  for (const Hsv& other : others) {
    if (taken[other.hue] == among_tags) ++count[other.hue];
  }
  // Start in an empty place, so that no group is cut in two.
  int start = 0;
  for (int hue = 0, empty = 0; hue < 2 * kHues; ++hue) {
    empty = count[at(hue)] == 0 ? empty + 1 : 0;
    if (empty > kLargestGap) {
      start = hue;
      break;
    }
  }
  std::vector<Span> groups;
  std::optional<Span> open;
  int pixels = 0;
  const auto close = [&] {
    const double least =
        std::max<double>(kSmallestGroup, kSmallestShare * static_cast<double>(others.size()));
    if (open && pixels >= least) groups.push_back(*open);
    open.reset();
    pixels = 0;
  };
  for (int hue = start; hue < start + kHues; ++hue) {
    if (open && hue - open->last > kLargestGap) close();
    if (count[at(hue)] == 0) continue;
    if (!open) open = Span{hue, hue};
    open->last = hue;
    pixels += count[at(hue)];
  }
  close();
  return groups;
}

/// Where `other` lies wholly below or above `tag`: everything on its side.
std::optional<Span> side_of(const Span& other, const Span& tag) {
  const auto cut = [](int from, int to) {
    return from + static_cast<int>(kCutPlace * (to - from));
  };
  if (other.last * kClearly < tag.first) return Span{0, cut(other.last, tag.first)};
  if (other.first > tag.last * kClearly) return Span{cut(other.first, tag.last), 255};
  return std::nullopt;
}

class ExclusionFitter {
 public:
  ExclusionFitter(std::span<const Hsv> tags, std::span<const Hsv> others)
      : tags_(tags), others_(others), taken_(hues_near(tags, 0)) {}

  ExclusionFit fit() {
    for (Span group : groups_of(others_, taken_, false)) {
      const int first = group.first - room_beyond(group.first, -1);
      const int last = group.last + room_beyond(group.last, 1);
      add({.hue = {static_cast<int>(at(first)), static_cast<int>(at(last))}});
    }
    for (const Span& group : groups_of(others_, taken_, true)) separate(group);
    std::ranges::sort(fit_.exclusions, std::greater<>(), &FittedExclusion::share);
    if (fit_.exclusions.size() > kMost) fit_.exclusions.resize(kMost);
    std::size_t left = 0;
    for (const Hsv& other : others_) {
      const auto excludes = [&](const FittedExclusion& e) { return contains(e, other); };
      left += std::ranges::none_of(fit_.exclusions, excludes) ? 1 : 0;
    }
    if (!others_.empty()) {
      fit_.left_over = static_cast<double>(left) / static_cast<double>(others_.size());
    }
    return fit_;
  }

 private:
  static bool contains(const FittedExclusion& e, const Hsv& color) {
    return holds(e.hue, color.hue) && color.value >= e.value.first && color.value <= e.value.last &&
           color.saturation >= e.saturation.first && color.saturation <= e.saturation.last;
  }

  /// How far a group may reach out: half the way to the next tag's hue is that tag's.
  int room_beyond(int hue, int step) const {
    int free = 0;
    while (free < 2 * kMargin && !taken_[at(hue + step * (free + 1))]) ++free;
    return free / 2;
  }

  void add(FittedExclusion exclusion) {
    std::size_t held = 0;
    for (const Hsv& other : others_) held += contains(exclusion, other) ? 1 : 0;
    exclusion.share = static_cast<double>(held) / static_cast<double>(others_.size());
    fit_.exclusions.push_back(exclusion);
  }

  /// Hues that tags have too.
  void separate(const Span& group) {
    const Span hue = widened(group, 1);
    const Span near = widened(group, 1 + kNear);
    const auto range_of = [&](std::span<const Hsv> colors, std::uint8_t Hsv::*channel) {
      std::vector<std::uint8_t> values;
      for (const Hsv& color : colors) {
        if (holds(near, color.hue)) values.push_back(color.*channel);
      }
      return middle_of(values);
    };
    for (std::uint8_t Hsv::*channel : {&Hsv::value, &Hsv::saturation}) {
      const auto other = range_of(others_, channel);
      const auto tag = range_of(tags_, channel);
      if (!other || !tag) continue;
      const std::optional<Span> side = side_of(*other, *tag);
      if (!side) continue;
      FittedExclusion exclusion{.hue = hue};
      (channel == &Hsv::value ? exclusion.value : exclusion.saturation) = *side;
      add(exclusion);
      return;
    }
  }

  std::span<const Hsv> tags_;
  std::span<const Hsv> others_;
  std::array<bool, kHues> taken_;
  ExclusionFit fit_;
};

}  // namespace

std::array<bool, 256> hues_near(std::span<const Hsv> tags, int reach) {
  std::array<int, kHues> count{};
  for (const Hsv& tag : tags) ++count[tag.hue];
  const double least = 0.0008 * static_cast<double>(tags.size());
  std::array<bool, kHues> near{};
  for (int hue = 0; hue < kHues; ++hue) {
    if (count[at(hue - 1)] + count[at(hue)] + count[at(hue + 1)] <= least) continue;
    for (int i = -reach; i <= reach; ++i) near[at(hue + i)] = true;
  }
  return near;
}

ExclusionFit fit_exclusions(std::span<const Hsv> tags, std::span<const Hsv> others) {
  return ExclusionFitter(tags, others).fit();
}

}  // namespace maggic::hue_pivots
