#include "maggic/border_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace maggic {
namespace {

constexpr double kHues = 256.0;

using Channels = std::array<double, 3>;  // red, green, blue

/// Hue in 1/256 of the circle, not rounded. @param rgb with a hue.
double hue_of(const Channels& rgb) {
  const auto [least, most] = std::ranges::minmax(rgb);
  const double spread = most - least;
  const auto sector = [&](double difference, double start) {
    return (start + difference / spread) * kHues / 6.0;
  };
  if (most == rgb[0]) return std::fmod(sector(rgb[1] - rgb[2], 0.0) + kHues, kHues);
  if (most == rgb[1]) return sector(rgb[2] - rgb[0], 2.0);
  return sector(rgb[0] - rgb[1], 4.0);
}

/// The same saturation and value at another hue.
Channels with_hue(const Channels& rgb, double hue) {
  const auto [least, most] = std::ranges::minmax(rgb);
  Channels turned{};
  for (std::size_t i = 0; i < 3; ++i) {
    // How far round the circle, in sixths, the hue lies from where this channel is largest.
    const double off =
        std::abs(std::remainder(hue * 6.0 / kHues - 2.0 * static_cast<double>(i), 6.0));
    turned[i] = least + (most - least) * std::clamp(2.0 - off, 0.0, 1.0);
  }
  return turned;
}

/// What a colour may look like a moment later; `hue` is where a border between both hues would be.
struct Disturbed {
  Channels rgb{};
  std::optional<double> hue;
};

class Checker {
 public:
  Checker(const ColorTable& table, const ColorNormalizer& normalizer,
          const ColorSegmenter& segmenter, const BorderLimits& limits)
      : table_(table), normalizer_(normalizer), segmenter_(segmenter), limits_(limits) {}

  void add(const BlobColors::Count& color) {
    const Label label = table_(color.b, color.g, color.r);
    if (label == kBackground) return;
    pixels_[label] += color.pixels;
    add_cut(color, label);
    add_overlap(color);
  }

  std::vector<DoubtfulBorder> borders() const {
    std::vector<DoubtfulBorder> found;
    for (const auto& [pair, cut] : cuts_) {
      DoubtfulBorder border;
      border.first = pair.first;
      border.second = pair.second;
      border.share_of_first = share(cut.of_first, pair.first);
      border.share_of_second = share(cut.of_second, pair.second);
      border.hue = hue_of_border(cut);
      if (is_worth_a_word(border, cut.of_first + cut.of_second)) found.push_back(border);
    }
    for (const auto& [pair, pixels] : overlaps_) {
      DoubtfulBorder border;
      border.kind = DoubtfulBorder::Kind::kOverlap;
      border.first = pair.first;
      border.second = pair.second;
      border.share_of_first = share(pixels, pair.first);
      if (is_worth_a_word(border, pixels)) found.push_back(border);
    }
    std::ranges::stable_sort(found, std::ranges::greater(), worst_share);
    return found;
  }

 private:
  struct Cut {
    std::uint64_t of_first = 0;
    std::uint64_t of_second = 0;
    std::uint64_t by_hue = 0;
    std::map<int, std::uint64_t> at_hue;
  };

  static double worst_share(const DoubtfulBorder& border) {
    return std::max(border.share_of_first, border.share_of_second);
  }

  bool is_worth_a_word(const DoubtfulBorder& border, std::uint64_t pixels) const {
    return worst_share(border) >= limits_.min_share && pixels >= limits_.min_pixels;
  }

  double share(std::uint64_t pixels, Label of) const {
    const auto all = pixels_.find(of);
    if (all == pixels_.end()) return 0.0;
    return static_cast<double>(pixels) / static_cast<double>(all->second);
  }

  std::vector<Disturbed> disturbed(const BlobColors::Count& color) const {
    const Channels rgb{double(color.r), double(color.g), double(color.b)};
    std::vector<Disturbed> all;
    if (const auto [least, most] = std::ranges::minmax(rgb); least < most) {
      const double hue = hue_of(rgb);
      for (int step = 1; step <= limits_.hue_steps; ++step) {
        all.push_back({with_hue(rgb, hue + step), hue + step - 0.5});
        all.push_back({with_hue(rgb, hue - step), hue - step + 0.5});
      }
    }
    for (const double gain : {1.0 - limits_.gain, 1.0 + limits_.gain}) {
      const Channels scaled{rgb[0] * gain, rgb[1] * gain, rgb[2] * gain};
      // A channel that is cut off at 255 would turn the hue as well.
      if (std::ranges::max(scaled) <= 255.0) all.push_back({scaled, std::nullopt});
    }
    return all;
  }

  void add_cut(const BlobColors::Count& color, Label label) {
    counted_.clear();
    for (const Disturbed& after : disturbed(color)) {
      const auto channel = [&](std::size_t i) {
        return static_cast<std::uint8_t>(std::lround(after.rgb[i]));
      };
      const Label other = table_(channel(2), channel(1), channel(0));
      if (other == kBackground || other == label) continue;
      if (std::ranges::find(counted_, other) != counted_.end()) continue;
      counted_.push_back(other);
      Cut& cut = cuts_[std::minmax(label, other)];
      (label < other ? cut.of_first : cut.of_second) += color.pixels;
      if (!after.hue) continue;
      cut.by_hue += color.pixels;
      const int hue = static_cast<int>(std::lround(*after.hue + kHues)) % static_cast<int>(kHues);
      cut.at_hue[hue] += color.pixels;
    }
  }

  void add_overlap(const BlobColors::Count& color) {
    const std::uint8_t b = color.b;
    const std::uint8_t g = color.g;
    const std::uint8_t r = color.r;
    std::uint8_t nb = 0;
    std::uint8_t ng = 0;
    std::uint8_t nr = 0;
    const ColorBatch original{{&b, 1}, {&g, 1}, {&r, 1}};
    normalizer_.normalize(original, {{&nb, 1}, {&ng, 1}, {&nr, 1}});
    const std::vector<Label> claimants =
        segmenter_.claimants(original, {{&nb, 1}, {&ng, 1}, {&nr, 1}});
    for (std::size_t i = 1; i < claimants.size(); ++i) {
      overlaps_[{claimants.front(), claimants[i]}] += color.pixels;
    }
  }

  /// Where nearly all pixels agree, to the width that is looked at, on the hue of the border.
  std::optional<int> hue_of_border(const Cut& cut) const {
    if (cut.at_hue.empty() || 10 * cut.by_hue < 9 * (cut.of_first + cut.of_second)) return {};
    const auto most =
        std::ranges::max_element(cut.at_hue, {}, [](const auto& entry) { return entry.second; });
    std::uint64_t near = 0;
    for (const auto& [hue, pixels] : cut.at_hue) {
      if (std::abs(std::remainder(hue - most->first, kHues)) <= limits_.hue_steps) near += pixels;
    }
    if (10 * near < 9 * cut.by_hue) return {};
    return most->first;
  }

  const ColorTable& table_;
  const ColorNormalizer& normalizer_;
  const ColorSegmenter& segmenter_;
  const BorderLimits& limits_;
  std::map<Label, std::uint64_t> pixels_;
  std::map<std::pair<Label, Label>, Cut> cuts_;
  std::map<std::pair<Label, Label>, std::uint64_t> overlaps_;
  std::vector<Label> counted_;
};

}  // namespace

std::string DoubtfulBorder::to_string(const Palette& palette) const {
  const auto percent = [](double share) { return fmt::format("{:.0f} %", 100.0 * share); };
  if (kind == Kind::kOverlap) {
    return fmt::format(
        "{} of {}'s pixels lie in the region of {} too, and are {} only because it "
        "is listed first",
        percent(share_of_first), palette.name(first), palette.name(second), palette.name(first));
  }
  return fmt::format("the border between {} and {}{} cuts through {} of {}'s and {} of {}'s pixels",
                     palette.name(first), palette.name(second),
                     hue ? fmt::format(" at hue {}", *hue) : std::string(), percent(share_of_first),
                     palette.name(first), percent(share_of_second), palette.name(second));
}

std::vector<DoubtfulBorder> find_doubtful_borders(const Pipeline& pipeline,
                                                  const BlobColors& colors,
                                                  const BorderLimits& limits) {
  const ColorTable* table = pipeline.color_table();
  if (table == nullptr) return {};
  const Normalizer& normalizer = *pipeline.parts().normalizer.stage;
  const Segmenter& segmenter = *pipeline.parts().segmenter.stage;
  Checker checker(*table, dynamic_cast<const ColorNormalizer&>(normalizer),
                  dynamic_cast<const ColorSegmenter&>(segmenter), limits);
  for (const BlobColors::Count& color : colors.counts()) checker.add(color);
  return checker.borders();
}

}  // namespace maggic
