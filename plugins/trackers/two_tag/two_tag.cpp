/// two_tag: robots with one team half and one player half
///
/// Every robot carries a square: half of it in the team's colour, half in a player colour that is
/// its id. The front is the side of the player colour. Use it for up to five robots a team (one id
/// a player colour); see `three_tag` for more and `tag_layout` for patterns of your own.
///
///     tracker:
///       two_tag:
///         tag_size_mm: 70            # side of the whole square
///         heading_offset_deg: 180    # the front is the team's side instead
///         ids:                       # red 0, green 1, cyan 2, magenta 3, purple 4 when left out
///           - {id: 0, colors: red}
///           - {id: 1, colors: green}
///           - {id: 2, colors: purple}
///         predict_frames: 15         # carry a missed robot on for a quarter of a second
///
/// How blobs become robots: docs/adr/0002-tag-matching.md. `maggic describe two_tag` lists every
/// parameter.

#include <optional>
#include <string>

#include "maggic/plugin.hpp"
#include "maggic/tracking_engine.hpp"

namespace {

using namespace maggic;

class TwoTag final : public Tracker {
 public:
  void describe(Parameters& p) override {
    if (layout_.patches.empty()) {
      layout_ = two_tag_layout(p.palette());
      parameters_.use_palette(p.palette());
    }
    p.number({"tag_size_mm", "side of the square both halves make", "mm"}, tag_size_mm_,
             {10.0, 200.0});
    layout_.describe_identity(p);
    parameters_.describe(p);
  }

  void prepare(const StageContext& context) override {
    layout_.patches = two_tag_layout(context.palette, tag_size_mm_).patches;
    engine_.emplace(parameters_, std::vector{layout_}, &context.reporter);
  }

  std::optional<TrackedPattern> pattern() const override { return engine_->pattern(); }

  void track(const TrackerInput& input, Detections& out) override { engine_->track(input, out); }

  std::string explain(const TrackerInput& input, std::size_t blob,
                      const Palette& palette) const override {
    return engine_->explain(input, blob, palette);
  }

 private:
  double tag_size_mm_ = 70.0;
  TagLayout layout_;
  TrackingParameters parameters_;
  std::optional<TrackingEngine> engine_;
};

}  // namespace

MAGGIC_PLUGIN(TwoTag, "robots with a team half and a player half (up to 5 a team)")
