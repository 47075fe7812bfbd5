#include "calibration/color_naming.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "calibration/hue_clusters.hpp"
#include "maggic/picture_colors.hpp"

namespace maggic::calibration {
namespace {

// Light bends hues: a colour may be seen so far from where the palette has it, and each step of
// the way makes the name less likely.
constexpr double kFarthestHue = 60.0;
constexpr double kTypicalHue = 24.0;
constexpr double kDeviationCost = 0.15;
constexpr double kUnlistedWorth = 0.3;  // a robot whose colours together are no id

constexpr std::size_t kMaxClusters = 20;
constexpr std::size_t kMaxCandidates = 300;  // of a frame: the best fitting ones

// Small steps are kept apart here: two clusters may get one name, one cluster never gets two.
constexpr PeakRules kClusterRules{
    .sigma = 1.2, .min_distance = 3, .max_valley = 0.5, .min_height = 0.01};

/// Candidates of one frame, in the order they are taken, with the cluster of each patch.
struct FrameView {
  const FramePatches* patches = nullptr;
  std::vector<const PatternCandidate*> order;
  std::vector<int> cluster_of;  ///< By patch.
};

class Namer {
 public:
  Namer(std::span<const FramePatches> frames, const TrackedPattern& pattern, const Palette& palette)
      : pattern_(pattern) {
    for (std::size_t label = 0; label < palette.size(); ++label) {
      const DisplayColor shown = palette.display_color(static_cast<Label>(label));
      hue_of_label_.push_back(hue_of({shown.blue, shown.green, shown.red}));
    }
    cluster_patches(frames);
    list_names(palette);
  }

  /// The best names of all clusters.
  void search() {
    std::vector<Label> best(options_.size(), kBackground);
    double best_score = score(best);
    // The team colours decide everything else, so every choice of those is a start.
    for (std::size_t blue = 0; blue < options_.size(); ++blue) {
      if (!may_be(blue, pattern_.blue_team_color)) continue;
      for (std::size_t yellow = 0; yellow <= options_.size(); ++yellow) {
        if (yellow == blue) continue;
        if (yellow < options_.size() && !may_be(yellow, pattern_.yellow_team_color)) continue;
        try_start(blue, yellow, best, best_score);
      }
    }
    for (std::size_t yellow = 0; yellow < options_.size(); ++yellow) {
      if (may_be(yellow, pattern_.yellow_team_color)) {
        try_start(options_.size(), yellow, best, best_score);
      }
    }
    // Two clusters may have to trade names at once.
    while (change_pair(best, best_score)) {
    }
    names_ = best;
  }

  NamedFrame apply(std::size_t frame) const {
    NamedFrame named;
    named.label_of_patch.assign(views_[frame].patches->patches.size(), kBackground);
    take_robots(views_[frame], names_, [&](const PatternCandidate& candidate, bool listed, double) {
      const TagLayout& layout = layout_of(candidate);
      NamedRobot robot{&candidate, kBackground, listed};
      for (std::size_t i = 0; i < candidate.patches.size(); ++i) {
        const int patch = candidate.patches[i];
        const Label label = name_of(views_[frame], names_, patch);
        named.label_of_patch[static_cast<std::size_t>(patch)] = label;
        if (layout.patches[i].role == PatchRole::kTeam) robot.team = label;
      }
      named.robots.push_back(robot);
    });
    return named;
  }

 private:
  const TagLayout& layout_of(const PatternCandidate& candidate) const {
    return pattern_.layouts[static_cast<std::size_t>(candidate.layout)];
  }

  void cluster_patches(std::span<const FramePatches> frames) {
    HueHistogram histogram{};
    for (const FramePatches& frame : frames) {
      std::set<int> used;
      for (const PatternCandidate& candidate : frame.candidates) {
        used.insert(candidate.patches.begin(), candidate.patches.end());
      }
      for (const int patch : used) {
        histogram[hue_index(frame.patches[static_cast<std::size_t>(patch)].hue)] += 1.0;
      }
    }
    // A hall full of colours must not make the search endless: the rarest hues go first.
    PeakRules rules = kClusterRules;
    HueClusters clusters = cluster_hues(histogram, rules);
    while (clusters.peaks.size() > kMaxClusters && rules.min_height < 1.0) {
      rules.min_height *= 1.5;
      clusters = cluster_hues(histogram, rules);
    }
    options_.resize(clusters.peaks.size());
    deviation_.resize(clusters.peaks.size());
    peaks_ = clusters.peaks;
    for (const FramePatches& frame : frames) {
      FrameView view{&frame, {}, {}};
      for (const PatternCandidate& candidate : frame.candidates) view.order.push_back(&candidate);
      std::ranges::stable_sort(view.order, [](const auto* a, const auto* b) {
        if (a->patches.size() != b->patches.size()) return a->patches.size() > b->patches.size();
        return a->misfit < b->misfit;
      });
      if (view.order.size() > kMaxCandidates) view.order.resize(kMaxCandidates);
      for (const Patch& patch : frame.patches) {
        view.cluster_of.push_back(clusters.of_hue[hue_index(patch.hue)]);
      }
      views_.push_back(std::move(view));
    }
  }

  static std::size_t hue_index(double hue) {
    return static_cast<std::size_t>(std::lround(hue)) % kHues;
  }

  void list_names(const Palette& palette) {
    std::set<Label> names{pattern_.blue_team_color, pattern_.yellow_team_color};
    for (const TagLayout& layout : pattern_.layouts) {
      for (const TagId& id : layout.ids) names.insert(id.colors.begin(), id.colors.end());
    }
    names.erase(kBackground);
    for (std::size_t cluster = 0; cluster < options_.size(); ++cluster) {
      deviation_[cluster].resize(palette.size());
      for (const Label name : names) {
        const double off = std::abs(hue_difference(peaks_[cluster], hue_of_label_[name]));
        deviation_[cluster][name] = off;
        if (off <= kFarthestHue) options_[cluster].push_back(name);
      }
      std::ranges::sort(options_[cluster], {},
                        [&](Label name) { return deviation_[cluster][name]; });
    }
  }

  bool may_be(std::size_t cluster, Label name) const {
    return std::ranges::count(options_[cluster], name) > 0;
  }

  void try_start(std::size_t blue, std::size_t yellow, std::vector<Label>& best,
                 double& best_score) {
    std::vector<Label> names(options_.size(), kBackground);
    for (std::size_t cluster = 0; cluster < names.size(); ++cluster) {
      if (cluster == blue) names[cluster] = pattern_.blue_team_color;
      if (cluster == yellow) names[cluster] = pattern_.yellow_team_color;
      if (cluster == blue || cluster == yellow) continue;
      for (const Label option : options_[cluster]) {
        if (option == pattern_.blue_team_color || option == pattern_.yellow_team_color) continue;
        names[cluster] = option;
        break;
      }
    }
    double here = score(names);
    // One name at a time, always the change that helps most.
    for (;;) {
      double best_there = here;
      std::size_t changed = names.size();
      Label to = kBackground;
      for (std::size_t cluster = 0; cluster < names.size(); ++cluster) {
        const Label before = names[cluster];
        for (std::size_t i = 0; i <= options_[cluster].size(); ++i) {
          names[cluster] = i < options_[cluster].size() ? options_[cluster][i] : kBackground;
          const double there = score(names);
          if (there <= best_there + 1e-9) continue;
          best_there = there;
          changed = cluster;
          to = names[cluster];
        }
        names[cluster] = before;
      }
      if (changed == names.size()) break;
      names[changed] = to;
      here = best_there;
    }
    if (here > best_score + 1e-9) {
      best_score = here;
      best = names;
    }
  }

  bool change_pair(std::vector<Label>& names, double& here) const {
    const std::vector<Label> before = names;
    std::vector<Label> trial = names;
    for (std::size_t a = 0; a < trial.size(); ++a) {
      for (std::size_t b = a + 1; b < trial.size(); ++b) {
        for (const Label name_a : options_[a]) {
          for (const Label name_b : options_[b]) {
            trial[a] = name_a;
            trial[b] = name_b;
            const double there = score(trial);
            if (there <= here + 1e-9) continue;
            here = there;
            names = trial;
          }
        }
        trial[a] = before[a];
        trial[b] = before[b];
      }
    }
    return names != before;
  }

  static Label name_of(const FrameView& view, const std::vector<Label>& names, int patch) {
    return names[static_cast<std::size_t>(view.cluster_of[static_cast<std::size_t>(patch)])];
  }

  double score(const std::vector<Label>& names) const {
    double sum = 0.0;
    for (const FrameView& view : views_) {
      take_robots(view, names, [&](const PatternCandidate&, bool, double worth) { sum += worth; });
    }
    return sum;
  }

  /// Robots under these names, best fit first, no patch and no identity twice.
  template <class Take>
  void take_robots(const FrameView& view, const std::vector<Label>& names, Take take) const {
    std::vector<bool> taken(view.patches->patches.size(), false);
    std::set<std::pair<Label, int>> identities;
    // A whole identity first, so that an unlisted pair never takes a listed robot's patch.
    for (const bool listed_wanted : {true, false}) {
      for (const PatternCandidate* candidate : view.order) {
        const auto is_taken = [&](int p) { return taken[static_cast<std::size_t>(p)]; };
        if (std::ranges::any_of(candidate->patches, is_taken)) continue;
        const std::optional<Reading> reading = read(view, names, *candidate);
        if (!reading || (reading->id >= 0) != listed_wanted) continue;
        if (reading->id >= 0 && !identities.insert({reading->team, reading->id}).second) continue;
        for (const int p : candidate->patches) taken[static_cast<std::size_t>(p)] = true;
        const double likely = std::max(0.0, 1.0 - kDeviationCost * reading->deviation);
        take(*candidate, listed_wanted,
             (listed_wanted ? 1.0 : kUnlistedWorth) * likely * (1.0 - 0.2 * candidate->misfit));
      }
    }
  }

  struct Reading {
    Label team = kBackground;
    int id = kUnknownId;
    double deviation = 0.0;  ///< Mean square over the patches, in typical deviations.
  };

  std::optional<Reading> read(const FrameView& view, const std::vector<Label>& names,
                              const PatternCandidate& candidate) const {
    const TagLayout& layout = layout_of(candidate);
    Reading reading;
    boost::container::static_vector<Label, kMaxPatches> colors;
    for (std::size_t i = 0; i < candidate.patches.size(); ++i) {
      const int patch = candidate.patches[i];
      const Label name = name_of(view, names, patch);
      if (name == kBackground) return std::nullopt;
      const bool is_team = name == pattern_.blue_team_color || name == pattern_.yellow_team_color;
      const bool wants_team = layout.patches[i].role == PatchRole::kTeam;
      if (is_team != wants_team) return std::nullopt;
      if (is_team) {
        reading.team = name;
      } else {
        colors.push_back(name);
      }
      const auto cluster =
          static_cast<std::size_t>(view.cluster_of[static_cast<std::size_t>(patch)]);
      const double off = deviation_[cluster][name] / kTypicalHue;
      reading.deviation += off * off / static_cast<double>(candidate.patches.size());
    }
    for (const TagId& id : layout.ids) {
      if (std::ranges::equal(id.colors, colors)) reading.id = id.id;
    }
    return reading;
  }

  const TrackedPattern& pattern_;
  std::vector<int> hue_of_label_;
  std::vector<FrameView> views_;
  std::vector<int> peaks_;                      ///< By cluster.
  std::vector<std::vector<Label>> options_;     ///< By cluster, likeliest first.
  std::vector<std::vector<double>> deviation_;  ///< By cluster and label, hue steps.
  std::vector<Label> names_;
};

}  // namespace

Naming name_colors(std::span<const FramePatches> frames, const TrackedPattern& pattern,
                   const Palette& palette) {
  Namer namer(frames, pattern, palette);
  namer.search();
  Naming naming;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    naming.frames.push_back(namer.apply(f));
    naming.robots += static_cast<double>(naming.frames.back().robots.size());
  }
  return naming;
}

}  // namespace maggic::calibration
