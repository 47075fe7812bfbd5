#include "box_fit.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace maggic::yuv_boxes {
namespace {

constexpr double kTail = 0.02;  // of a colour's pixels, at either end, that do not count
constexpr double kCore = 0.2;   // … that are not in the box it grows from
// A few pixels of something else, as rims and noise have them, do not stop a box.
constexpr double kForeignAllowed = 0.004;
// Light changes how bright a tag is far more than its colour.
constexpr std::array<int, 3> kMostGrowth{40, 14, 14};
constexpr int kGrowthStep = 2;

/// @param values sorted.
Side middle_of(const std::vector<std::uint8_t>& values, double left_out) {
  const auto tail = static_cast<std::size_t>(left_out * static_cast<double>(values.size()));
  return {values[tail], values[values.size() - 1 - tail]};
}

class Grower {
 public:
  Grower(std::span<const Yuv> colors, std::span<const Label> labels)
      : colors_(colors), labels_(labels) {}

  void grow(FittedBox& fitted) const {
    const auto own = static_cast<double>(std::ranges::count(labels_, fitted.label));
    const std::size_t allowed =
        count_foreign(fitted.box, fitted.label) + static_cast<std::size_t>(kForeignAllowed * own);
    std::array<bool, 6> stopped{};
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t face = 0; face < 6; ++face) {
        if (stopped[face]) continue;
        std::array<Side, 3> larger = fitted.box;
        if (!push_out(face, fitted.seen, larger) || count_foreign(larger, fitted.label) > allowed) {
          stopped[face] = true;
          continue;
        }
        fitted.box = larger;
        grew = true;
      }
    }
    const std::size_t foreign = count_foreign(fitted.box, fitted.label);
    std::size_t inside = 0;
    for (const Yuv& color : colors_) inside += holds(fitted.box, color) ? 1 : 0;
    fitted.foreign = inside == 0 ? 0.0 : static_cast<double>(foreign) / static_cast<double>(inside);
  }

 private:
  static bool push_out(std::size_t face, const std::array<Side, 3>& seen,
                       std::array<Side, 3>& box) {
    const std::size_t channel = face / 2;
    Side& side = box[channel];
    if (face % 2 == 0) {
      if (side.min <= 0 || seen[channel].min - side.min >= kMostGrowth[channel]) return false;
      side.min = std::max(0, side.min - kGrowthStep);
    } else {
      if (side.max >= 255 || side.max - seen[channel].max >= kMostGrowth[channel]) return false;
      side.max = std::min(255, side.max + kGrowthStep);
    }
    return true;
  }

  std::size_t count_foreign(const std::array<Side, 3>& box, Label own) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      if (labels_[i] != own && holds(box, colors_[i])) ++count;
    }
    return count;
  }

  std::span<const Yuv> colors_;
  std::span<const Label> labels_;
};

}  // namespace

bool holds(const std::array<Side, 3>& box, const Yuv& color) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (color[c] < box[c].min || color[c] > box[c].max) return false;
  }
  return true;
}

std::vector<FittedBox> fit_boxes(std::span<const Yuv> colors, std::span<const Label> labels,
                                 std::span<const std::int32_t> tags) {
  std::map<Label, std::array<std::vector<std::uint8_t>, 3>> values;
  std::map<Label, std::set<std::int32_t>> tags_of;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (labels[i] == kBackground) continue;
    for (std::size_t c = 0; c < 3; ++c) values[labels[i]][c].push_back(colors[i][c]);
    tags_of[labels[i]].insert(tags[i]);
  }
  const Grower grower(colors, labels);
  std::vector<FittedBox> boxes;
  for (auto& [label, channels] : values) {
    FittedBox fitted{.label = label, .tags = static_cast<int>(tags_of[label].size())};
    for (std::size_t c = 0; c < 3; ++c) {
      std::ranges::sort(channels[c]);
      fitted.seen[c] = middle_of(channels[c], kTail);
      fitted.box[c] = middle_of(channels[c], kCore);
    }
    grower.grow(fitted);
    boxes.push_back(fitted);
  }
  return boxes;
}

}  // namespace maggic::yuv_boxes
