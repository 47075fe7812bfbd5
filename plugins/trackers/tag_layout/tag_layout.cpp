/// tag_layout: robots with any pattern of coloured patches, written in the pipeline file
///
/// A pattern is one team patch and one to seven player patches, each a rectangle or a disc, placed
/// in the robot's frame: millimetres from the robot's centre, x to the front, y to the left.
/// Several patterns may be listed; all are looked for in every frame, so that two teams with
/// different tags, or an old robot among new ones, can play together. A patch with a bite taken
/// out gives the centroid of what is left as `center_mm` and its area as `area_mm2`.
///
///     tracker:
///       tag_layout:
///         layouts:
///           - preset: two_tag                  # a built-in pattern, with its ids …
///             ids: [{id: 0, colors: red}]      # … or with ids of your own
///           - name: diagonal                   # two squares on a diagonal
///             patches:
///               - {role: team, center_mm: [-17.5, 17.5], size_mm: [35, 35]}
///               - {role: player, center_mm: [17.5, -17.5], size_mm: [35, 35]}
///             ids:
///               - {id: 5, colors: green}
///             heading_offset_deg: 0            # added to the heading, counter-clockwise
///
/// How blobs become robots: docs/adr/0002-tag-matching.md. `maggic describe tag_layout` lists every
/// parameter.

#include <optional>
#include <string>

#include "maggic/plugin.hpp"
#include "maggic/tracking_engine.hpp"

namespace {

using namespace maggic;

enum class Preset { kNone, kTwoTag, kThreeTag };

/// One entry of the list: a preset, changed where the file says so, or a pattern of its own.
struct Pattern {
  Preset preset = Preset::kNone;
  TagLayout layout;

  void describe(Parameters& p) {
    p.choice<Preset>({"preset", "built-in pattern to start from"}, preset,
                     {{"none", Preset::kNone},
                      {"two_tag", Preset::kTwoTag},
                      {"three_tag", Preset::kThreeTag}});
    // A preset's patches and ids become the defaults of what follows.
    if (preset == Preset::kTwoTag) layout = two_tag_layout(p.palette());
    if (preset == Preset::kThreeTag) layout = three_tag_layout(p.palette());
    layout.describe(p);
  }
};

class TagLayoutTracker final : public Tracker {
 public:
  void describe(Parameters& p) override {
    if (patterns_.empty()) {
      patterns_.push_back({Preset::kTwoTag, two_tag_layout(p.palette())});
      parameters_.use_palette(p.palette());
    }
    p.list({"layouts", "patterns looked for in every frame"}, patterns_, {1, 8},
           [](Parameters& element, Pattern& pattern) { pattern.describe(element); });
    parameters_.describe(p);
  }

  void prepare(const StageContext& context) override {
    std::vector<TagLayout> layouts;
    for (const Pattern& pattern : patterns_) layouts.push_back(pattern.layout);
    engine_.emplace(parameters_, layouts, &context.reporter);
  }

  std::optional<TrackedPattern> pattern() const override { return engine_->pattern(); }

  void track(const TrackerInput& input, Detections& out) override { engine_->track(input, out); }

  std::string explain(const TrackerInput& input, std::size_t blob,
                      const Palette& palette) const override {
    return engine_->explain(input, blob, palette);
  }

 private:
  std::vector<Pattern> patterns_;
  TrackingParameters parameters_;
  std::optional<TrackingEngine> engine_;
};

}  // namespace

MAGGIC_PLUGIN(TagLayoutTracker, "any pattern of patches, written in the YAML; several at once")
