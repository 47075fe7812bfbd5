/// MaggicSegmentation.txt as parameters of hue_pivots.

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interchange/imported_blocks.hpp"
#include "maggic/palette.hpp"

namespace maggic {
namespace {

constexpr int kHues = 256;

struct Pivot {
  int hue = 0;  ///< 0 … 255.
  int label = 0;
};

/// The label of every hue: that of the nearest pivot, of those equally near the first.
std::array<int, kHues> nearest_labels(const std::vector<Pivot>& pivots) {
  std::array<int, kHues> labels{};
  for (int hue = 0; hue < kHues; ++hue) {
    int nearest = kHues;
    for (const Pivot& pivot : pivots) {
      const int straight = std::abs(hue - pivot.hue);
      const int distance = std::min(straight, kHues - straight);
      if (distance >= nearest) continue;
      nearest = distance;
      labels[static_cast<std::size_t>(hue)] = pivot.label;
    }
  }
  return labels;
}

/// A colour's pivots, and where they came from.
struct ColorPivots {
  int label = 0;
  std::vector<int> hues;
  std::string sources;
};

std::vector<Pivot> in_order(const std::vector<ColorPivots>& colors) {
  std::vector<Pivot> pivots;
  for (const ColorPivots& color : colors) {
    for (const int hue : color.hues) pivots.push_back({hue, color.label});
  }
  return pivots;
}

/// hue_pivots lists pivots by colour, so the order of colours decides between pivots equally near.
/// Orders them so that as few hues as can be fall to another colour than they did.
/// @return hues that still do.
std::vector<std::size_t> put_in_order(const std::vector<Pivot>& theirs,
                                      std::vector<ColorPivots>& colors) {
  constexpr int kMaxMoves = 32;  // some wishes contradict each other
  const auto before = nearest_labels(theirs);
  for (int move = 0;; ++move) {
    const auto after = nearest_labels(in_order(colors));
    std::vector<std::size_t> changed;
    for (std::size_t hue = 0; hue < before.size(); ++hue) {
      if (before[hue] != after[hue]) changed.push_back(hue);
    }
    if (changed.empty() || move == kMaxMoves) return changed;
    const auto loser = std::ranges::find(colors, after[changed.front()], &ColorPivots::label);
    const auto winner = std::ranges::find(colors, before[changed.front()], &ColorPivots::label);
    std::rotate(loser, winner, winner + 1);
  }
}

std::string yaml_of(const ColorPivots& color, std::string_view name) {
  const std::string code = color.hues.size() == 1
                               ? fmt::format("      {}: {}", name, color.hues.front())
                               : fmt::format("      {}: [{}]", name, fmt::join(color.hues, ", "));
  return commented_line(code, color.sources);
}

}  // namespace

ImportedBlock import_pivots(const MaggicSession& session) {
  static const Palette palette = Palette::standard();
  const auto name_of_label = [&](int label) { return palette.name(static_cast<Label>(label)); };

  // Their program sorts by hue, then label, and of equally near pivots takes the first.
  std::vector<MaggicSession::Pivot> sorted = session.pivots;
  std::ranges::stable_sort(sorted, {}, [](const MaggicSession::Pivot& pivot) {
    return std::pair(pivot.hue.value, pivot.label.value);
  });

  ImportedBlock block;
  std::vector<Pivot> theirs;
  std::vector<ColorPivots> colors;
  for (const MaggicSession::Pivot& pivot : sorted) {
    const int hue = (pivot.hue.value + kHues) % kHues;
    const int label = pivot.label.value;
    const auto same_hue = std::ranges::find(theirs, hue, &Pivot::hue);
    if (same_hue != theirs.end()) {
      if (same_hue->label != label) {
        block.notes.push_back(
            fmt::format("{}: hue {} is {} already, so its pivot for {} never wins: left out",
                        source_text(pivot.hue.place), pivot.hue.value,
                        name_of_label(same_hue->label), name_of_label(label)));
      }
      continue;
    }
    theirs.push_back({hue, label});
    auto color = std::ranges::find(colors, label, &ColorPivots::label);
    if (color == colors.end()) color = colors.insert(colors.end(), {label, {}, {}});
    color->hues.push_back(hue);
    color->sources += color->sources.empty() ? source_text(pivot.hue.place)
                                             : fmt::format(", line {}", pivot.hue.place.line);
    if (pivot.hue.value < 0) color->sources += ": hue -1, which is 255 on the circle";
  }

  const std::vector<std::size_t> changed = put_in_order(theirs, colors);
  if (!changed.empty()) {
    block.notes.push_back(fmt::format(
        "hue {}: two pivots are equally near, and hue_pivots takes the other colour than "
        "MaggicSegmentation did",
        fmt::join(changed, ", ")));
  }

  block.yaml = commented_line("  hue_pivots:", "with the normalizer `weighted`, as there");
  block.yaml += commented_line(fmt::format("    gray_threshold: {}", session.gray_threshold.value),
                               source_text(session.gray_threshold.place));
  block.yaml += commented_line("    hue_of: original", "as there");
  block.yaml += commented_line("    pivots:", "0 … 255 round the circle, as there");
  for (const ColorPivots& color : colors) block.yaml += yaml_of(color, name_of_label(color.label));
  block.found = fmt::format("{} pivots of {} colours for hue_pivots", theirs.size(), colors.size());
  return block;
}

}  // namespace maggic
