#include "pivot_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace maggic::hue_pivots {
namespace {

constexpr int kHues = 256;
constexpr double kTail = 0.02;            // of a colour's pixels, at either end, that do not count
constexpr double kEquallyGood = 1e-3;     // shares of pixels lost that make no difference
constexpr double kWorthOfImagined = 0.1;  // of a pixel under other light against one that was seen
constexpr double kOverlapShare = 0.03;    // more than that is worth a word
constexpr double kKeptOfTag = 0.5;        // a tag with fewer of its pixels is lost
constexpr int kLongestMove = 64;
constexpr int kRoomForUnseen = 4;  // between a seen colour's end and an unseen one's border

using Histogram = std::array<double, kHues>;

std::size_t at(int hue) { return static_cast<std::size_t>(((hue % kHues) + kHues) % kHues); }

/// A colour's pixels along the unrolled circle: hue = middle + offset, offset in [-128, 128).
struct Cluster {
  Label label = kBackground;
  Histogram share{};     ///< Of its pixels, by hue.
  Histogram imagined{};  ///< The same under light not seen yet.
  int tags = 0;
  int middle = 0;  ///< Circular median, as far as the 2 % tails do not matter.
  int low = 0;     ///< Ends of the middle 96 %, unrolled: low ≤ middle ≤ high.
  int high = 0;
};

/// Start of the emptiest half circle: unrolling there keeps a colour in one piece.
int opposite_of(const Histogram& share) {
  double sine = 0.0;
  double cosine = 0.0;
  for (int hue = 0; hue < kHues; ++hue) {
    const double angle = hue * 6.283185307179586 / kHues;
    sine += share[at(hue)] * std::sin(angle);
    cosine += share[at(hue)] * std::cos(angle);
  }
  return static_cast<int>(std::lround(std::atan2(sine, cosine) / 6.283185307179586 * kHues)) -
         kHues / 2;
}

void find_ends(Cluster& cluster) {
  const int start = opposite_of(cluster.share);
  double sum = 0.0;
  bool low_found = false;
  bool middle_found = false;
  for (int i = 0; i < kHues; ++i) {
    sum += cluster.share[at(start + i)];
    if (!low_found && sum > kTail) {
      cluster.low = start + i;
      low_found = true;
    }
    if (!middle_found && sum >= 0.5) {
      cluster.middle = start + i;
      middle_found = true;
    }
    if (sum >= 1.0 - kTail) {
      cluster.high = start + i;
      break;
    }
  }
  // Everything in the first turn, so that clusters can be put in order.
  const int turn = cluster.middle < 0 ? kHues : cluster.middle >= kHues ? -kHues : 0;
  cluster.low += turn;
  cluster.middle += turn;
  cluster.high += turn;
}

/// A border lies after its hue: `hue` itself belongs to the colour before it.
struct Border {
  int hue = 0;        ///< Unrolled from the first of the two colours.
  double loss = 0.0;  ///< Largest share of either colour on the wrong side.
};

/// Between two neighbours, `a` before `b`: where fewest pixels of either are lost, and among such
/// places where fewest would be under other light; in the middle of what is equally good.
Border place_border(const Cluster& a, const Cluster& b) {
  const int to = a.middle + (((b.middle - a.middle) % kHues) + kHues) % kHues;
  double lost_of_a = 0.0;
  double imagined_lost_of_a = 0.0;
  for (int hue = a.middle + 1; hue <= to; ++hue) {
    lost_of_a += a.share[at(hue)];
    imagined_lost_of_a += a.imagined[at(hue)];
  }
  double lost_of_b = 0.0;
  double imagined_lost_of_b = 0.0;
  Border best{a.middle, 1.0};
  double least = 1e9;
  int first = a.middle;
  int last = a.middle;
  for (int hue = a.middle; hue < to; ++hue) {
    if (hue > a.middle) {
      lost_of_a -= a.share[at(hue)];
      imagined_lost_of_a -= a.imagined[at(hue)];
    }
    lost_of_b += b.share[at(hue)];
    imagined_lost_of_b += b.imagined[at(hue)];
    const double loss =
        lost_of_a + lost_of_b + kWorthOfImagined * (imagined_lost_of_a + imagined_lost_of_b);
    if (loss < least - kEquallyGood) {
      first = hue;
      least = loss;
      best.loss = std::max(lost_of_a, lost_of_b);
    }
    if (loss <= least + kEquallyGood) last = hue;
  }
  best.hue = (first + last) / 2;
  return best;
}

/// Nearest value in [low, high]; the middle where a colour is squeezed to nothing.
double between(double value, double low, double high) {
  return low <= high ? std::clamp(value, low, high) : (low + high) / 2.0;
}

/// Pivots, one a cluster, whose midpoints come nearest to the borders.
std::vector<double> balance(const std::vector<Cluster>& clusters,
                            const std::vector<double>& borders) {
  const std::size_t count = clusters.size();
  std::vector<double> pivots;
  pivots.reserve(count);
  for (const Cluster& cluster : clusters) pivots.push_back(cluster.middle);
  if (count < 2) return pivots;
  const auto before = [&](std::size_t i) {  // border between i - 1 and i, unrolled for i
    return i > 0 ? borders[i - 1] : borders[count - 1] - kHues;
  };
  constexpr int kSweeps = 300;
  constexpr double kPull = 0.02;  // towards the colour itself, where borders leave a choice
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < count; ++i) {
      const double previous = i > 0 ? pivots[i - 1] : pivots[count - 1] - kHues;
      const double next = i + 1 < count ? pivots[i + 1] : pivots[0] + kHues;
      const double wanted =
          (2.0 * before(i) - previous) + (2.0 * borders[i] - next) + kPull * clusters[i].middle;
      pivots[i] = between(wanted / (2.0 + kPull), before(i) + 1.0, borders[i] - 1.0);
    }
  }
  return pivots;
}

struct TagHistogram {
  Label label = kBackground;
  Histogram count{};
  double pixels = 0.0;
};

/// How far the pivots of `color` can be moved by `step` a time before a tag loses half.
int room_to_move(const Pivots& pivots, Label color, int step,
                 const std::vector<TagHistogram>& tags) {
  for (int distance = 1; distance <= kLongestMove; ++distance) {
    Pivots moved = pivots;
    for (auto& [label, hues] : moved) {
      if (label != color) continue;
      for (int& hue : hues) hue = static_cast<int>(at(hue + step * distance));
    }
    const auto labels = nearest_pivots(moved);
    for (const TagHistogram& tag : tags) {
      double kept = 0.0;
      for (int hue = 0; hue < kHues; ++hue) {
        if (labels[at(hue)] == tag.label) kept += tag.count[at(hue)];
      }
      if (kept < kKeptOfTag * tag.pixels) return distance - 1;
    }
  }
  return kLongestMove;
}

class Fitter {
 public:
  Fitter(std::span<const std::uint8_t> hues, std::span<const Label> labels,
         std::span<const std::int32_t> tags, const ImaginedHues& imagined, const Pivots& known)
      : known_(known) {
    std::map<std::int32_t, TagHistogram> by_tag;
    for (std::size_t i = 0; i < hues.size(); ++i) {
      if (labels[i] == kBackground) continue;
      TagHistogram& tag = by_tag[tags[i]];
      tag.label = labels[i];
      tag.count[hues[i]] += 1.0;
      tag.pixels += 1.0;
    }
    std::map<Label, Cluster> by_label;
    for (auto& [id, tag] : by_tag) {
      Cluster& cluster = by_label[tag.label];
      cluster.label = tag.label;
      // Every tag counts alike, whatever its size.
      for (int hue = 0; hue < kHues; ++hue) {
        cluster.share[at(hue)] += tag.count[at(hue)] / tag.pixels;
      }
      ++cluster.tags;
      tags_.push_back(tag);
    }
    for (auto& [label, cluster] : by_label) {
      for (double& share : cluster.share) share /= cluster.tags;
      add_imagined(imagined, cluster);
      find_ends(cluster);
      clusters_.push_back(cluster);
    }
    std::ranges::sort(clusters_, {}, &Cluster::middle);
  }

  PivotFit fit() {
    PivotFit result;
    place_borders(result);
    place_pivots();
    order(result);
    Pivots all;
    for (const FittedColor& color : result.colors) {
      if (!color.pivots.empty()) all.push_back({color.label, color.pivots});
    }
    for (FittedColor& color : result.colors) {
      if (color.tags == 0) continue;
      color.move_down = room_to_move(all, color.label, -1, tags_);
      color.move_up = room_to_move(all, color.label, 1, tags_);
    }
    return result;
  }

 private:
  static void add_imagined(const ImaginedHues& imagined, Cluster& cluster) {
    double count = 0.0;
    for (std::size_t i = 0; i < imagined.hues.size(); ++i) {
      if (imagined.labels[i] != cluster.label) continue;
      cluster.imagined[imagined.hues[i]] += 1.0;
      count += 1.0;
    }
    if (count == 0.0) return;
    for (double& share : cluster.imagined) share /= count;
  }

  void place_borders(PivotFit& result) {
    if (clusters_.size() < 2) return;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      const Cluster& a = clusters_[i];
      const Cluster& b = clusters_[(i + 1) % clusters_.size()];
      const Border border = place_border(a, b);
      borders_.push_back(border.hue + 0.5);
      if (border.loss > kOverlapShare) result.overlaps.push_back({a.label, b.label, border.loss});
    }
  }

  void place_pivots() {
    const std::vector<double> balanced = balance(clusters_, borders_);
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      pivots_[clusters_[i].label] = {static_cast<int>(std::lround(balanced[i]))};
    }
    // A border that is not half-way between its pivots gets a pivot close to it on either side.
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      const Cluster& a = clusters_[i];
      const Cluster& b = clusters_[(i + 1) % clusters_.size()];
      const double pivot_a = balanced[i];
      const double pivot_b = i + 1 < clusters_.size() ? balanced[i + 1] : balanced[0] + kHues;
      const int end_of_b = b.low + (i + 1 < clusters_.size() ? 0 : kHues);
      const double gap = std::max(0, end_of_b - a.high);
      const double off = std::abs((pivot_a + pivot_b) / 2.0 - borders_[i]);
      if (off <= std::max(1.0, 0.25 * gap)) continue;
      const double reach = std::max(1.0, std::min(borders_[i] - pivot_a, pivot_b - borders_[i]));
      const int below = static_cast<int>(std::floor(borders_[i] - reach + 0.5));
      pivots_[a.label].push_back(below);
      pivots_[b.label].push_back(static_cast<int>(std::lround(2.0 * borders_[i])) - below);
    }
    for (auto& [label, hues] : pivots_) {
      for (int& hue : hues) hue = static_cast<int>(at(hue));
      std::ranges::sort(hues);
      hues.erase(std::unique(hues.begin(), hues.end()), hues.end());
    }
  }

  FittedColor fitted(const Cluster& cluster) const {
    return {.label = cluster.label,
            .pivots = pivots_.at(cluster.label),
            .tags = cluster.tags,
            .first_hue = static_cast<int>(at(cluster.low)),
            .last_hue = static_cast<int>(at(cluster.high))};
  }

  void order(PivotFit& result) const {
    for (const auto& [label, hues] : known_) {
      const auto seen = std::ranges::find(clusters_, label, &Cluster::label);
      if (seen != clusters_.end()) {
        result.colors.push_back(fitted(*seen));
      } else {
        result.colors.push_back({.label = label, .pivots = hues_out_of_the_way(hues)});
      }
    }
    for (const Cluster& cluster : clusters_) {
      const auto is_listed = [&](const FittedColor& c) { return c.label == cluster.label; };
      if (std::ranges::none_of(result.colors, is_listed)) result.colors.push_back(fitted(cluster));
    }
  }

  /// Those of an unseen colour's pivots that take nothing from any seen colour.
  std::vector<int> hues_out_of_the_way(const std::vector<int>& hues) const {
    std::vector<int> kept;
    for (const int hue : hues) {
      const bool in_the_way = std::ranges::any_of(clusters_, [&](const Cluster& cluster) {
        return std::ranges::any_of(pivots_.at(cluster.label), [&](int pivot) {
          const int up = static_cast<int>(at(hue - pivot));  // the way round from the pivot
          const int ahead = static_cast<int>(at(cluster.high - pivot));
          const int behind = static_cast<int>(at(pivot - cluster.low));
          const int down = static_cast<int>(at(pivot - hue));
          const bool hits_above = ahead < kHues / 2 && up / 2 <= ahead + kRoomForUnseen;
          const bool hits_below = behind < kHues / 2 && down / 2 <= behind + kRoomForUnseen;
          return up == 0 || hits_above || hits_below;
        });
      });
      if (!in_the_way) kept.push_back(hue);
    }
    return kept;
  }

  const Pivots& known_;
  std::vector<TagHistogram> tags_;
  std::vector<Cluster> clusters_;  ///< By hue.
  std::vector<double> borders_;    ///< Border i lies between cluster i and the next.
  std::map<Label, std::vector<int>> pivots_;
};

}  // namespace

std::array<Label, 256> nearest_pivots(const Pivots& pivots) {
  std::array<Label, kHues> labels{};
  for (int hue = 0; hue < kHues; ++hue) {
    int nearest = kHues;
    for (const auto& [label, pivot_hues] : pivots) {
      for (const int pivot : pivot_hues) {
        const int straight = std::abs(hue - pivot);
        const int distance = std::min(straight, kHues - straight);
        if (distance < nearest) {
          nearest = distance;
          labels[at(hue)] = label;
        }
      }
    }
  }
  return labels;
}

PivotFit fit_pivots(std::span<const std::uint8_t> hues, std::span<const Label> labels,
                    std::span<const std::int32_t> tags, const ImaginedHues& imagined,
                    const Pivots& known) {
  return Fitter(hues, labels, tags, imagined, known).fit();
}

}  // namespace maggic::hue_pivots
