#include "bounds_contract.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "maggic/testing.hpp"

namespace maggic::testing {
namespace {

constexpr int kBoxes = 1000;
constexpr std::size_t kColorsPerBox = 600;
constexpr std::size_t kCorners = 8;

/// The same in every run.
class RandomBoxes {
 public:
  /// The sizes that the host asks for, and all others.
  ColorBox next() {
    const int side = 1 << below(7);
    return is_one_in(3) ? ColorBox{range(), range(), range()}
                        : ColorBox{range(side), range(side), range(side)};
  }

  std::uint8_t within(ChannelRange range) {
    return static_cast<std::uint8_t>(range.first + below(range.last - range.first + 1));
  }

  bool is_one_in(int count) { return below(count) == 0; }

 private:
  int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }

  ChannelRange range() {
    const auto [first, last] = std::minmax({within({}), within({})});
    return {first, last};
  }

  ChannelRange range(int side) {
    const int first = below(256 / side) * side;
    return {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(first + side - 1)};
  }

  std::mt19937 random_{11};
};

struct Colors {
  std::vector<std::uint8_t> b = std::vector<std::uint8_t>(kColorsPerBox);
  std::vector<std::uint8_t> g = std::vector<std::uint8_t>(kColorsPerBox);
  std::vector<std::uint8_t> r = std::vector<std::uint8_t>(kColorsPerBox);

  ColorBatch batch() const { return {b, g, r}; }
  std::string text(std::size_t i) const { return fmt::format("B {} G {} R {}", b[i], g[i], r[i]); }

  void set_corner(std::size_t i, const ColorBox& box, std::size_t corner) {
    b[i] = (corner & 1) != 0 ? box.b.last : box.b.first;
    g[i] = (corner & 2) != 0 ? box.g.last : box.g.first;
    r[i] = (corner & 4) != 0 ? box.r.last : box.r.first;
  }
  void set_random(std::size_t i, const ColorBox& box, RandomBoxes& random) {
    b[i] = random.within(box.b);
    g[i] = random.within(box.g);
    r[i] = random.within(box.r);
  }
};

std::string text(const ColorBox& box) {
  return fmt::format("B {}…{} G {}…{} R {}…{}", box.b.first, box.b.last, box.g.first, box.g.last,
                     box.r.first, box.r.last);
}

bool is_within(std::uint8_t value, ChannelRange range) {
  return value >= range.first && value <= range.last;
}

bool is_range(ChannelRange range) { return range.first <= range.last; }

bool is_sound(const ColorNormalizer& normalizer, const ColorBox& box, RandomBoxes& random,
              Findings& findings) {
  const ColorBox bounds = normalizer.bounds(box);
  if (!is_range(bounds.b) || !is_range(bounds.g) || !is_range(bounds.r)) {
    findings.add("the bounds of {} are {}, expected first values that are not above the last",
                 text(box), text(bounds));
    return false;
  }
  Colors colors;
  for (std::size_t i = 0; i < kColorsPerBox; ++i) {
    i < kCorners ? colors.set_corner(i, box, i) : colors.set_random(i, box, random);
  }
  Colors normalized;
  normalizer.normalize(colors.batch(), {normalized.b, normalized.g, normalized.r});
  for (std::size_t i = 0; i < kColorsPerBox; ++i) {
    if (!is_within(normalized.b[i], bounds.b) || !is_within(normalized.g[i], bounds.g) ||
        !is_within(normalized.r[i], bounds.r)) {
      findings.add("the bounds of {} are {}, but {} becomes {}", text(box), text(bounds),
                   colors.text(i), normalized.text(i));
      return false;
    }
  }
  return true;
}

bool is_sound(const ColorSegmenter& segmenter, const ColorBox& original, const ColorBox& normalized,
              RandomBoxes& random, Findings& findings) {
  const std::optional<Label> answer = segmenter.label_of(original, normalized);
  if (!answer) return true;
  Colors originals;
  Colors normals;
  for (std::size_t i = 0; i < kColorsPerBox; ++i) {
    if (i < kCorners * kCorners) {
      originals.set_corner(i, original, i % kCorners);
      normals.set_corner(i, normalized, i / kCorners);
    } else {
      originals.set_random(i, original, random);
      normals.set_random(i, normalized, random);
    }
  }
  std::vector<Label> labels(kColorsPerBox);
  segmenter.segment(originals.batch(), normals.batch(), labels);
  for (std::size_t i = 0; i < kColorsPerBox; ++i) {
    if (labels[i] != *answer) {
      findings.add(
          "label_of gives {}, normalised {}, the label {}, but segment gives {}, "
          "normalised {}, the label {}",
          text(original), text(normalized), *answer, originals.text(i), normals.text(i), labels[i]);
      return false;
    }
  }
  return true;
}

}  // namespace

void check_bounds(const ColorNormalizer& normalizer, Findings& findings) {
  runs(findings, "bounds", [&] {
    RandomBoxes random;
    for (int i = 0; i < kBoxes; ++i) {
      if (!is_sound(normalizer, random.next(), random, findings)) return;
    }
  });
}

void check_label_of(const ColorSegmenter& segmenter, Findings& findings) {
  runs(findings, "label_of", [&] {
    RandomBoxes random;
    for (int i = 0; i < kBoxes; ++i) {
      const ColorBox original = random.next();
      // As a normalizer may leave it, and as none would make it.
      const ColorBox normalized = random.is_one_in(2) ? original : random.next();
      if (!is_sound(segmenter, original, normalized, random, findings)) return;
    }
  });
}

}  // namespace maggic::testing
