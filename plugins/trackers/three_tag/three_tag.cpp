/// three_tag: robots with a team half and two player squares
///
/// Half of the robot's square shows the team's colour, the other half two player squares; the pair
/// of player colours is the id. The front is the side of the player squares. Use it for up to ten
/// robots a team. Colours of an id are listed as seen with the team half on top: left, right.
///
///     tracker:
///       three_tag:
///         tag_size_mm: 70            # side of the whole square
///         square_size_mm: 33         # side of one player square
///         ids:                       # the extended pattern's ten pairs when left out
///           - {id: 0, colors: [red, green]}
///           - {id: 1, colors: [red, cyan]}
///         heading_offset_deg: 0
///
/// The default id table is the extended pattern's: 0 RG, 1 RC, 2 GR, 3 GC, 4 GM, 5 CR, 6 CG, 7 CM,
/// 8 MG, 9 MC. How blobs become robots: docs/adr/0002-tag-matching.md. `maggic describe three_tag`
/// lists every parameter.

#include <optional>
#include <string>

#include "maggic/plugin.hpp"
#include "maggic/tracking_engine.hpp"

namespace {

using namespace maggic;

class ThreeTag final : public Tracker {
 public:
  void describe(Parameters& p) override {
    if (layout_.patches.empty()) {
      layout_ = three_tag_layout(p.palette());
      parameters_.use_palette(p.palette());
    }
    p.number({"tag_size_mm", "side of the square all patches make", "mm"}, tag_size_mm_,
             {20.0, 200.0});
    p.number({"square_size_mm", "side of one player square", "mm"}, square_size_mm_,
             {5.0, 100.0});
    p.check("square_size_mm", square_size_mm_ <= tag_size_mm_ / 2.0,
            "larger than half of tag_size_mm, expected two squares to fit beside each other");
    layout_.describe_identity(p);
    parameters_.describe(p);
  }

  void prepare(const StageContext& context) override {
    layout_.patches = three_tag_layout(context.palette, tag_size_mm_, square_size_mm_).patches;
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
  double square_size_mm_ = 33.0;
  TagLayout layout_;
  TrackingParameters parameters_;
  std::optional<TrackingEngine> engine_;
};

}  // namespace

MAGGIC_PLUGIN(ThreeTag, "robots with a team half and two player squares (up to 10 a team)")
